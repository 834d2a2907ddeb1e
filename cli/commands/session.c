#include "cli/commands/session.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/row.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OFTEN 1024 /* lines after which progress is told, and whether outputs failed is asked */

static void write_row(session *s, int output)
{
    if (s->row.size > 0) mw_output_write(s->output[output].out, s->row.bytes, s->row.size);
    text_clear(&s->row);
}

/* --- what went wrong ---------------------------------------------------------------------------------------------- */

/* A line that cannot be carried out; `message` names it. */
static int pass_over(session *s, const char *message)
{
    s->skipped++;
    if (!s->skip || !s->quiet) complain("%s", message);
    return s->skip ? 0 : END_INPUT;
}

static const char *name_of(const char *path)
{
    return files_is_stream(path) ? "standard input" : path;
}

/* The editor refuses what a line asks for. */
static int refused(session *s, const char *path, const mw_edit_line *line, const char *kind, const mw_error *error)
{
    char message[1024];
    if (error->status == MW_ERROR_MEMORY) return fail_memory();
    snprintf(message, sizeof message, "%.400s:%" PRId64 ": %s: %s", name_of(path), line->line, kind, error->message);
    if (error->status == MW_ERROR_INPUT) return pass_over(s, message);
    complain("%s", message);
    return END_INTERNAL;
}

/* --- what an edit changed ------------------------------------------------------------------------------------------- */

/* The numbers of so many triangles of a change. */
static void numbers_cell(text *row, const mw_change *c, size_t first, size_t count)
{
    text_string(row, ",");
    for (size_t i = first; i < first + count; i++)
        text_printf(row, i > first ? " %" PRIu32 : "%" PRIu32, c->triangle[i].triangle);
}

static void change_row(session *s, int64_t line, const char *kind, const mw_change *c)
{
    text *row = &s->row;
    if (!s->output[SESSION_CHANGES].out) return;
    text_printf(row, "%" PRId64 ",%s", line, kind);
    row_count(row, c->vertex != MW_NONE, c->vertex);
    text_string(row, c->vertices_made ? ",made" : c->vertices_freed ? ",freed" : ",");
    numbers_cell(row, c, 0, c->made);
    numbers_cell(row, c, c->made, c->reused);
    numbers_cell(row, c, c->made + c->reused, c->freed);
    row_count(row, true, c->flips);
    row_count(row, true, c->constrained_edges);
    row_end(row);
    write_row(s, SESSION_CHANGES);
}

/* --- lines ---------------------------------------------------------------------------------------------------------- */

static int edit(session *s, const char *path, const mw_edit_line *line)
{
    mw_error error;
    mw_change change = {.vertex = MW_NONE};
    const char *kind = mw_edit_name(line->edit.kind);
    mw_change *told = s->output[SESSION_CHANGES].out ? &change : NULL;
    if (mw_edit_apply(s->editor, &line->edit, told, &error) != MW_OK) return refused(s, path, line, kind, &error);
    s->edits[line->edit.kind]++;
    if (line->edit.kind == MW_EDIT_VALUE) change.vertex = line->edit.vertex;
    change_row(s, line->line, kind, &change);
    return edit_log_add(&s->log, &line->edit) ? 0 : fail_memory();
}

static int undo(session *s, const char *path, const mw_edit_line *line)
{
    mw_error error;
    mw_change change = {.vertex = MW_NONE};
    if (mw_edit_undo(s->editor, &change, &error) != MW_OK) return refused(s, path, line, "undo", &error);
    s->undone++;
    change_row(s, line->line, "undo", &change);
    edit_log_undo(&s->log);
    return 0;
}

static int no_place(const session *s, const char *path, const mw_edit_line *line)
{
    const char *taken = "output";
    for (int i = 0; i < SESSION_OUTPUTS; i++)
        if (s->output[i].path && files_is_stream(s->output[i].path)) taken = s->output[i].option;
    complain("%s:%" PRId64 ": standard output is taken by --%s: --answers FILE tells where answers go", name_of(path),
             line->line, taken);
    return END_USAGE;
}

static void answer_header(session *s)
{
    if (s->headed || !s->output[SESSION_ANSWERS].out) return;
    text_string(&s->row, s->heights != MW_NONE ? "x,y,status,triangle,w0,w1,w2,z\n" : "x,y,status,triangle,w0,w1,w2\n");
    write_row(s, SESSION_ANSWERS);
    s->headed = true;
}

static int locate(session *s, const char *path, const mw_edit_line *line)
{
    text *row = &s->row;
    const double point[2] = {line->edit.x, line->edit.y};
    if (!s->output[SESSION_ANSWERS].out) return no_place(s, path, line);
    answer_header(s);
    mw_location at = mw_locate(mw_editor_locator(s->editor), &s->cursor, point[0], point[1]);
    s->located.where[at.where]++;
    s->unanswered += at.triangle == MW_NONE;
    row_numbers(row, point, 2);
    row_triangle(row, mw_where_name((mw_where)at.where), at.triangle);
    row_weights(row, at.triangle, at.weight);
    if (s->heights != MW_NONE) {
        double z;
        mw_editor_interpolate(s->editor, s->heights, &at, 1, &z);
        row_double(row, !isnan(z), z);
    }
    row_end(row);
    write_row(s, SESSION_ANSWERS);
    return 0;
}

/* --- new numbers ------------------------------------------------------------------------------------------------------ */

/* New numbers by the old ones. */
typedef struct numbers {
    uint32_t *triangle, *vertex; /* NULL where they are not asked for */
    mw_editor_info before;
} numbers;

static bool make_numbers(const session *s, numbers *n)
{
    *n = (numbers){0};
    if (!s->output[SESSION_NUMBERS].out) return true;
    mw_editor_describe(s->editor, &n->before);
    n->triangle = malloc(((size_t)n->before.triangle_range + 1) * sizeof *n->triangle);
    n->vertex = malloc(((size_t)n->before.vertex_range + 1) * sizeof *n->vertex);
    return n->triangle && n->vertex;
}

static void free_numbers(numbers *n)
{
    free(n->triangle);
    free(n->vertex);
}

static void number_rows(session *s, int64_t line, const char *what, const uint32_t *number, uint32_t count)
{
    text *row = &s->row;
    for (uint32_t i = 0; i < count; i++) {
        if (line > 0) text_printf(row, "%" PRId64, line);
        text_string(row, what);
        row_count(row, true, i);
        if (number[i] != MW_NONE)
            row_count(row, true, number[i]);
        else
            text_string(row, ",-1");
        row_end(row);
        write_row(s, SESSION_NUMBERS);
    }
}

/* `line` 0: of the mesh that is written. */
static void write_numbers(session *s, int64_t line, const numbers *n)
{
    if (!n->vertex) return;
    number_rows(s, line, ",vertex", n->vertex, n->before.vertex_range);
    number_rows(s, line, ",triangle", n->triangle, n->before.triangle_range);
}

static int compact(session *s, const char *path, const mw_edit_line *line)
{
    mw_error error;
    numbers n;
    int end = make_numbers(s, &n) ? 0 : fail_memory();
    if (end == 0 && mw_editor_compact(s->editor, n.triangle, n.vertex, &error) != MW_OK)
        end = refused(s, path, line, "compact", &error);
    if (end == 0) {
        s->compactions++;
        write_numbers(s, line->line, &n);
        change_row(s, line->line, "compact", &(mw_change){.vertex = MW_NONE});
        edit_log_compact(&s->log);
    }
    free_numbers(&n);
    return end;
}

int session_mesh(session *s, mw_mesh **mesh)
{
    mw_error error;
    numbers n;
    int end = make_numbers(s, &n) ? 0 : fail_memory();
    if (end == 0 && mw_editor_mesh(s->editor, n.triangle, n.vertex, mesh, &error) != MW_OK) end = fail_query(&error);
    if (end == 0) write_numbers(s, 0, &n);
    free_numbers(&n);
    return end;
}

/* --- the stream --------------------------------------------------------------------------------------------------- */

static int carry_out(session *s, const char *path, const mw_edit_line *line)
{
    switch (line->kind) {
    case MW_EDIT_LINE_EDIT: return edit(s, path, line);
    case MW_EDIT_LINE_LOCATE: return locate(s, path, line);
    case MW_EDIT_LINE_UNDO: return undo(s, path, line);
    case MW_EDIT_LINE_COMPACT: return compact(s, path, line);
    default: return 0;
    }
}

/* *more: there was a line, good or bad. */
static int next_line(session *s, const char *path, mw_edit_reader *reader, bool *more)
{
    mw_error error;
    mw_edit_line line;
    mw_status status = mw_edit_reader_read(reader, &line, &error);
    *more = line.line > 0;
    s->lines += *more;
    if (status == MW_OK) return carry_out(s, path, &line);
    return *more ? pass_over(s, error.message) : fail_reading(&error);
}

static void write_headers(session *s)
{
    static const char changes[] = "line,edit,vertex,vertex_is,made,reused,freed,flips,pieces\n";
    static const char renumbered[] = "line,what,old,new\n";
    if (!files_is_stream(s->output[SESSION_ANSWERS].path)) answer_header(s);
    if (s->output[SESSION_CHANGES].out) mw_output_write(s->output[SESSION_CHANGES].out, changes, strlen(changes));
    if (s->output[SESSION_NUMBERS].out) mw_output_write(s->output[SESSION_NUMBERS].out, renumbered, strlen(renumbered));
}

int session_run(session *s, const char *path)
{
    mw_error error;
    mw_edit_reader *reader;
    int end = 0;
    progress_phase("editing", path);
    if (mw_edit_reader_open(path, &s->fields, &reader, &error) != MW_OK) return fail_reading(&error);
    s->log = (edit_log){.out = s->output[SESSION_LOG].out, .fields = &s->fields, .undo = s->undo};
    write_headers(s);
    for (bool more = true; more && end == 0;) {
        end = next_line(s, path, reader, &more);
        if (s->lines % OFTEN != 0) continue;
        progress_lines(s->lines);
        if (outputs_failed(s->output, SESSION_OUTPUTS)) break; /* closing them reports what failed */
    }
    edit_log_flush(&s->log);
    mw_edit_reader_close(reader);
    return end == 0 && s->row.failed ? fail_memory() : end;
}

void session_release(session *s)
{
    edit_log_release(&s->log);
    text_release(&s->row);
    mw_editor_destroy(s->editor);
}
