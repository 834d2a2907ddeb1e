#include "cli/edits/edit_log.h"

#include <stdlib.h>

static void edit_log_write_line(edit_log *log, const mw_edit_line *line)
{
    char text[MW_EDIT_TEXT_SIZE + 1];
    size_t length = mw_edit_format(line, log->fields, text);
    text[length++] = '\n';
    mw_output_write(log->out, text, length);
}

static void edit_log_write_oldest(edit_log *log)
{
    edit_log_write_line(log,
                        &(mw_edit_line){.kind = MW_EDIT_LINE_EDIT, .edit = log->edit[log->first]});
    log->first = (log->first + 1) % log->room;
    log->count--;
}

/* Double the buffer, and move the oldest edit to its front. */
static bool edit_log_grow(edit_log *log)
{
    size_t room = log->room ? 2 * log->room : 64;
    if (room > log->undo) room = log->undo;
    mw_edit *edit = malloc(room * sizeof *edit);
    if (!edit) return false;
    for (size_t i = 0; i < log->count; i++) edit[i] = log->edit[(log->first + i) % log->room];
    free(log->edit);
    log->edit = edit;
    log->first = 0;
    log->room = room;
    return true;
}

bool edit_log_add(edit_log *log, const mw_edit *edit)
{
    if (!log->out) return true;
    if (log->count == log->undo) edit_log_write_oldest(log);
    if (log->count == log->room && !edit_log_grow(log)) return false;
    log->edit[(log->first + log->count++) % log->room] = *edit;
    return true;
}

void edit_log_undo(edit_log *log)
{
    if (log->count > 0) log->count--;
}

void edit_log_flush(edit_log *log)
{
    while (log->count > 0) edit_log_write_oldest(log);
}

void edit_log_compact(edit_log *log)
{
    edit_log_flush(log);
    if (log->out) edit_log_write_line(log, &(mw_edit_line){.kind = MW_EDIT_LINE_COMPACT});
}

void edit_log_release(edit_log *log)
{
    free(log->edit);
    *log = (edit_log){0};
}
