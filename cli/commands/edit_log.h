/* edit_log.h - the edits that took effect, written as a stream of edits once they cannot be undone any more.
 *
 * Those that can are kept here, so that a log of any length takes memory for no more of them than can be undone. */
#ifndef CLI_EDIT_LOG_H
#define CLI_EDIT_LOG_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct edit_log {
    mw_output *out; /* NULL: nothing is logged */
    const mw_edit_text_options *fields;
    size_t undo;               /* so many edits can be undone, at least one      */
    mw_edit *edit;             /* a ring: the oldest one is edit[first]         */
    size_t first, count, room; /* room: for so many, at most `undo`              */
} edit_log;

/* Add an edit; take back the last one. False when out of memory. */
bool edit_log_add(edit_log *log, const mw_edit *edit);
void edit_log_undo(edit_log *log);

/* Write all that is kept: none can be undone any more. */
void edit_log_flush(edit_log *log);
void edit_log_compact(edit_log *log);
void edit_log_release(edit_log *log);

#endif
