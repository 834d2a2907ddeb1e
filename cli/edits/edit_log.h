/* edit_log.h - writes the edits that took effect, as a stream of edits, once they can no longer be
 * undone.
 *
 * The others are kept here, so a log of any length takes memory only for the edits that can be
 * undone. */
#ifndef MW_CLI_EDITS_EDIT_LOG_H
#define MW_CLI_EDITS_EDIT_LOG_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct edit_log {
    mw_output *out; /* NULL: there is no log */
    const mw_edit_text_options *fields;
    size_t undo;               /* how many edits can be undone, at least 1                      */
    mw_edit *edit;             /* a ring buffer of the edits kept; the oldest one is edit[first] */
    size_t first, count, room; /* room: the size of the buffer, at most `undo`                  */
} edit_log;

/* Add an edit. Returns false if memory runs out. */
bool edit_log_add(edit_log *log, const mw_edit *edit);
/* Drop the latest edit, which was undone. */
void edit_log_undo(edit_log *log);

/* Write all edits that are kept: none of them can be undone any more. */
void edit_log_flush(edit_log *log);
/* The same, then write a compact line. */
void edit_log_compact(edit_log *log);
void edit_log_release(edit_log *log);

#endif
