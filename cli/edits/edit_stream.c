#include "cli/edits/edit_stream.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/output/csv_row.h"
#include "cli/stream/number_rows.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK_LINES 1024 /* lines between two reports of progress and checks of the outputs */

static void edit_stream_write_row(edit_stream *s, int output)
{
    if (s->row.size > 0) mw_output_write(s->output[output].out, s->row.bytes, s->row.size);
    text_clear(&s->row);
}

/* --- complaints ------------------------------------------------------------------------------- */

/* Skip a line that cannot be carried out, or end with the message that names it. */
static int edit_stream_skip(edit_stream *s, const char *message)
{
    s->skipped++;
    if (!s->skip || !s->quiet) complain("%s", message);
    return s->skip ? 0 : END_INPUT;
}

static const char *input_name(const char *path)
{
    return files_is_standard(path) ? "standard input" : path;
}

/* The editor refuses a line. */
static int edit_stream_refuse(edit_stream *s, const char *path, const mw_edit_line *line,
                              const char *kind, const mw_error *error)
{
    char message[1024];
    if (error->status == MW_ERROR_MEMORY) return fail_memory();
    snprintf(message, sizeof message, "%.400s:%" PRId64 ": %s: %s", input_name(path), line->line,
             kind, error->message);
    if (error->status == MW_ERROR_INPUT) return edit_stream_skip(s, message);
    complain("%s", message);
    return END_RESOURCE;
}

/* --- what an edit changed --------------------------------------------------------------------- */

/* A cell with the numbers of `count` triangles of a change. */
static void change_write_triangles(text *row, const mw_change *c, size_t first, size_t count)
{
    text_string(row, ",");
    for (size_t i = first; i < first + count; i++)
        text_printf(row, i > first ? " %" PRIu32 : "%" PRIu32, c->triangle[i].triangle);
}

static void edit_stream_write_change(edit_stream *s, int64_t line, const char *kind,
                                     const mw_change *c)
{
    text *row = &s->row;
    if (!s->output[EDIT_STREAM_CHANGES].out) return;
    text_printf(row, "%" PRId64 ",%s", line, kind);
    csv_row_count(row, c->vertex != MW_NONE, c->vertex);
    text_string(row, c->vertices_made ? ",made" : c->vertices_freed ? ",freed" : ",");
    change_write_triangles(row, c, 0, c->made);
    change_write_triangles(row, c, c->made, c->reused);
    change_write_triangles(row, c, c->made + c->reused, c->freed);
    csv_row_count(row, true, c->flips);
    csv_row_count(row, true, c->constrained_edges);
    csv_row_end(row);
    edit_stream_write_row(s, EDIT_STREAM_CHANGES);
}

/* --- lines ------------------------------------------------------------------------------------ */

static int edit_stream_apply(edit_stream *s, const char *path, const mw_edit_line *line)
{
    mw_error error;
    mw_change change = {.vertex = MW_NONE};
    const char *kind = mw_edit_name(line->edit.kind);
    mw_change *told = s->output[EDIT_STREAM_CHANGES].out ? &change : NULL;
    if (mw_edit_apply(s->editor, &line->edit, told, &error) != MW_OK)
        return edit_stream_refuse(s, path, line, kind, &error);
    s->edits[line->edit.kind]++;
    if (line->edit.kind == MW_EDIT_VALUE) change.vertex = line->edit.vertex;
    edit_stream_write_change(s, line->line, kind, &change);
    return edit_log_add(&s->log, &line->edit) ? 0 : fail_memory();
}

static int edit_stream_undo(edit_stream *s, const char *path, const mw_edit_line *line)
{
    mw_error error;
    mw_change change = {.vertex = MW_NONE};
    if (mw_edit_undo(s->editor, &change, &error) != MW_OK)
        return edit_stream_refuse(s, path, line, "undo", &error);
    s->undone++;
    edit_stream_write_change(s, line->line, "undo", &change);
    edit_log_undo(&s->log);
    return 0;
}

static int edit_stream_fail_no_answers(const edit_stream *s, const char *path,
                                       const mw_edit_line *line)
{
    const char *taken = "output";
    for (int i = 0; i < EDIT_STREAM_OUTPUTS; i++)
        if (s->output[i].path && files_is_standard(s->output[i].path)) taken = s->output[i].option;
    complain("%s:%" PRId64
             ": --%s already writes to standard output; use --answers FILE for the answers",
             input_name(path), line->line, taken);
    return END_USAGE;
}

static void edit_stream_write_answer_header(edit_stream *s)
{
    if (s->headed || !s->output[EDIT_STREAM_ANSWERS].out) return;
    text_string(&s->row, s->heights != MW_NONE ? "x,y,status,triangle,w0,w1,w2,z\n"
                                               : "x,y,status,triangle,w0,w1,w2\n");
    edit_stream_write_row(s, EDIT_STREAM_ANSWERS);
    s->headed = true;
}

static int edit_stream_locate(edit_stream *s, const char *path, const mw_edit_line *line)
{
    text *row = &s->row;
    const double point[2] = {line->edit.x, line->edit.y};
    if (!s->output[EDIT_STREAM_ANSWERS].out) return edit_stream_fail_no_answers(s, path, line);
    edit_stream_write_answer_header(s);
    mw_location at = mw_locate(mw_editor_locator(s->editor), &s->cursor, point[0], point[1]);
    s->located.where[at.where]++;
    s->unanswered += at.triangle == MW_NONE;
    csv_row_numbers(row, point, 2);
    csv_row_status(row, mw_where_name((mw_where)at.where), at.triangle);
    csv_row_weights(row, at.triangle, at.weight);
    if (s->heights != MW_NONE) {
        double z;
        mw_editor_interpolate(s->editor, s->heights, &at, 1, &z);
        csv_row_double(row, !isnan(z), z);
    }
    csv_row_end(row);
    edit_stream_write_row(s, EDIT_STREAM_ANSWERS);
    return 0;
}

/* --- new numbers ------------------------------------------------------------------------------ */

/* The new numbers, by the old ones. */
typedef struct number_table {
    uint32_t *triangle, *vertex; /* NULL: not requested */
    mw_editor_info before;
} number_table;

static bool number_table_make(const edit_stream *s, number_table *n)
{
    *n = (number_table){0};
    if (!s->output[EDIT_STREAM_NUMBERS].out) return true;
    mw_editor_describe(s->editor, &n->before);
    n->triangle = malloc(((size_t)n->before.triangle_range + 1) * sizeof *n->triangle);
    n->vertex = malloc(((size_t)n->before.vertex_range + 1) * sizeof *n->vertex);
    return n->triangle && n->vertex;
}

static void number_table_release(number_table *n)
{
    free(n->triangle);
    free(n->vertex);
}

/* Write the new numbers of a compact line; of the mesh at the end if `line` is 0. */
static void number_table_write(edit_stream *s, int64_t line, const number_table *n)
{
    if (!n->vertex) return;
    mw_output *out = s->output[EDIT_STREAM_NUMBERS].out;
    number_rows_write(out, &s->row, line, "vertex", n->vertex, n->before.vertex_range);
    number_rows_write(out, &s->row, line, "triangle", n->triangle, n->before.triangle_range);
}

static int edit_stream_compact(edit_stream *s, const char *path, const mw_edit_line *line)
{
    mw_error error;
    number_table n;
    int end = number_table_make(s, &n) ? 0 : fail_memory();
    if (end == 0 && mw_editor_compact(s->editor, n.triangle, n.vertex, &error) != MW_OK)
        end = edit_stream_refuse(s, path, line, "compact", &error);
    if (end == 0) {
        s->compactions++;
        number_table_write(s, line->line, &n);
        edit_stream_write_change(s, line->line, "compact", &(mw_change){.vertex = MW_NONE});
        edit_log_compact(&s->log);
    }
    number_table_release(&n);
    return end;
}

int edit_stream_mesh(edit_stream *s, mw_mesh **mesh)
{
    mw_error error;
    number_table n;
    int end = number_table_make(s, &n) ? 0 : fail_memory();
    if (end == 0 && mw_editor_mesh(s->editor, n.triangle, n.vertex, mesh, &error) != MW_OK)
        end = fail_query(&error);
    if (end == 0) number_table_write(s, 0, &n);
    number_table_release(&n);
    return end;
}

/* --- the stream ------------------------------------------------------------------------------- */

static int edit_stream_execute(edit_stream *s, const char *path, const mw_edit_line *line)
{
    switch (line->kind) {
    case MW_EDIT_LINE_EDIT: return edit_stream_apply(s, path, line);
    case MW_EDIT_LINE_LOCATE: return edit_stream_locate(s, path, line);
    case MW_EDIT_LINE_UNDO: return edit_stream_undo(s, path, line);
    case MW_EDIT_LINE_COMPACT: return edit_stream_compact(s, path, line);
    default: return 0;
    }
}

/* Read and execute one line. Sets *more to whether there was a line, good or bad. */
static int edit_stream_next_line(edit_stream *s, const char *path, mw_edit_reader *reader,
                                 bool *more)
{
    mw_error error;
    mw_edit_line line;
    mw_status status = mw_edit_reader_read(reader, &line, &error);
    *more = line.line > 0;
    s->lines += *more;
    if (status == MW_OK) return edit_stream_execute(s, path, &line);
    return *more ? edit_stream_skip(s, error.message) : fail_reading(&error);
}

static void edit_stream_write_headers(edit_stream *s)
{
    static const char changes[] = "line,edit,vertex,vertex_is,made,reused,freed,flips,pieces\n";
    if (!files_is_standard(s->output[EDIT_STREAM_ANSWERS].path)) edit_stream_write_answer_header(s);
    if (s->output[EDIT_STREAM_CHANGES].out)
        mw_output_write(s->output[EDIT_STREAM_CHANGES].out, changes, strlen(changes));
    if (s->output[EDIT_STREAM_NUMBERS].out) number_rows_begin(s->output[EDIT_STREAM_NUMBERS].out);
}

int edit_stream_run(edit_stream *s, const char *path)
{
    mw_error error;
    mw_edit_reader *reader;
    int end = 0;
    progress_phase("editing", path);
    if (mw_edit_reader_open(path, &s->fields, &reader, &error) != MW_OK)
        return fail_reading(&error);
    s->log =
        (edit_log){.out = s->output[EDIT_STREAM_LOG].out, .fields = &s->fields, .undo = s->undo};
    edit_stream_write_headers(s);
    for (bool more = true; more && end == 0;) {
        end = edit_stream_next_line(s, path, reader, &more);
        if (s->lines % CHECK_LINES != 0) continue;
        progress_lines(s->lines, mw_edit_reader_fraction(reader));
        /* If an output fails, closing it reports the error. */
        if (side_outputs_failed(s->output, EDIT_STREAM_OUTPUTS)) break;
    }
    edit_log_flush(&s->log);
    mw_edit_reader_close(reader);
    return end == 0 && s->row.failed ? fail_memory() : end;
}

void edit_stream_release(edit_stream *s)
{
    edit_log_release(&s->log);
    text_release(&s->row);
    mw_editor_destroy(s->editor);
}
