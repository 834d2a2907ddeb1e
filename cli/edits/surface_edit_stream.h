/* surface_edit_stream.h - carries out a stream of edits of a surface in order, answers the probes
 * among them, and writes answers and changes as they come. */
#ifndef MW_CLI_EDITS_SURFACE_EDIT_STREAM_H
#define MW_CLI_EDITS_SURFACE_EDIT_STREAM_H

#include "cli/frame/text.h"
#include "cli/output/side_outputs.h"
#include "cli/edits/edit_stream.h"

typedef struct surface_edit_stream {
    mw_surface *surface;
    mw_prober *prober;
    mw_surface_editor *editor;
    mw_probe_cursor cursor;
    side_output *output; /* by the numbers of edit_stream.h */
    size_t undo;         /* how many edits can be undone */
    bool skip, quiet;    /* as in edit_stream */
    text row;
    bool headed;
    /* The lines that can still be undone, for the log: a ring. */
    char **pending;
    size_t first, count, room;
    uint64_t lines, edits[MW_SURFACE_EDIT_KIND_COUNT], undone, compactions, skipped;
    uint64_t states[MW_TOUCH_STATE_COUNT];
    uint64_t unanswered; /* probes that are not finite */
} surface_edit_stream;

/* Make the surface of a file, its boxes and its editor. Returns 0, or an exit code after a
 * complaint about `path`. */
int surface_edit_stream_open(surface_edit_stream *s, const char *path, const mw_mesh_file *file,
                             uint32_t threads);

/* Carry out the lines of a file; the outputs are open. Returns 0, or an exit code after a
 * complaint. */
int surface_edit_stream_run(surface_edit_stream *s, const char *path);

/* Put the surface as it is now, without gaps, in the place of that of the file, and write its
 * numbers if they are requested. Returns 0, or an exit code after a complaint. */
int surface_edit_stream_take(surface_edit_stream *s, mw_mesh_file *file);

void surface_edit_stream_release(surface_edit_stream *s);

#endif
