/* edit_stream.h - carries out a stream of edits in order, and writes their answers and changes as
 * they come. */
#ifndef MW_CLI_EDITS_EDIT_STREAM_H
#define MW_CLI_EDITS_EDIT_STREAM_H

#include "cli/frame/text.h"
#include "cli/output/side_outputs.h"
#include "cli/edits/edit_log.h"
#include "cli/stream/statistics.h"

/* The files written beside the mesh, by option. */
enum {
    EDIT_STREAM_ANSWERS,
    EDIT_STREAM_CHANGES,
    EDIT_STREAM_LOG,
    EDIT_STREAM_NUMBERS,
    EDIT_STREAM_OUTPUTS
};

typedef struct edit_stream {
    mw_editor *editor;
    mw_cursor cursor;            /* of the editor's locator */
    mw_edit_text_options fields; /* their names */
    uint32_t heights;            /* the field that answers carry; MW_NONE: none */
    size_t undo;                 /* how many edits can be undone */
    bool skip;                   /* skip lines that fail; else the first of them ends the stream */
    bool quiet;                  /* do not name skipped lines */
    side_output output[EDIT_STREAM_OUTPUTS];
    edit_log log;
    text row;
    bool headed; /* has the header of the answers been written? */
    uint64_t lines, edits[MW_EDIT_KIND_COUNT], undone, compactions, skipped;
    uint64_t unanswered; /* points in no triangle */
    location_statistics located;
} edit_stream;

/* Carry out the lines of a file; the outputs are open. Returns 0, or an exit code after a
 * complaint. */
int edit_stream_run(edit_stream *s, const char *path);

/* Make a mesh of the editor's present state, owned by the caller, and write its numbers if they are
 * requested. Returns 0, or an exit code after a complaint. */
int edit_stream_mesh(edit_stream *s, mw_mesh **mesh);

void edit_stream_release(edit_stream *s);

#endif
