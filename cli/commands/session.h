/* session.h - a stream of edits, carried out in order: what its lines change and what they ask is written as they come. */
#ifndef CLI_SESSION_H
#define CLI_SESSION_H

#include "cli/commands/edit_log.h"
#include "cli/frame/outputs.h"
#include "cli/frame/tally.h"
#include "cli/frame/text.h"

/* What is written beside the mesh. */
enum { SESSION_ANSWERS, SESSION_CHANGES, SESSION_LOG, SESSION_NUMBERS, SESSION_OUTPUTS };

typedef struct session {
    mw_editor *editor;
    mw_cursor cursor;            /* of the editor's locator */
    mw_edit_text_options fields; /* their names */
    uint32_t heights;            /* the field that answers carry, MW_NONE: none */
    size_t undo;                 /* so many edits can be undone */
    bool skip, quiet;            /* pass bad lines over; do not name them then */
    output_file output[SESSION_OUTPUTS];
    edit_log log;
    text row;
    bool headed; /* the header of the answers is written */
    uint64_t lines, edits[MW_EDIT_KIND_COUNT], undone, compactions, skipped;
    uint64_t unanswered; /* points in no triangle */
    location_tally located;
} session;

/* Carry out the stream in a file; the outputs are open. Returns 0 or an exit code after a complaint. */
int session_run(session *s, const char *path);

/* The mesh as it is now, owned by the caller; its numbers are written where they are asked for. */
int session_mesh(session *s, mw_mesh **mesh);

void session_release(session *s);

#endif
