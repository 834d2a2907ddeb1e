#include "cli/edits/surface_edit_stream.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/output/csv_row.h"
#include "cli/stream/number_rows.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SURFACE_CHECK_LINES 1024 /* lines between two reports of progress */

/* --- the surface ------------------------------------------------------------------------------ */

static int surface_fail(const char *path, const mw_error *error)
{
    int end = fail_mesh(path, error);
    if (end == END_INPUT)
        complain("'meshwalk check --as surface %s' lists every defect, 'meshwalk view' shows it",
                 path);
    return end;
}

int surface_edit_stream_open(surface_edit_stream *s, const char *path, const mw_mesh_file *file,
                             uint32_t threads)
{
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_surface_options surface = {.progress = progress_of_call()};
    mw_prober_options boxes = {.boxes = 1, .threads = threads, .progress = progress_of_call()};
    mw_probe_options certain = {.certain = 1};
    progress_phase("preparing", path);
    if (mw_surface_create(&arrays, &surface, &s->surface, &error) != MW_OK)
        return surface_fail(path, &error);
    if (mw_prober_create(s->surface, &boxes, &s->prober, &error) != MW_OK)
        return surface_fail(path, &error);
    mw_surface_editor_options options = {.prober = s->prober, .undo = s->undo};
    if (mw_surface_editor_create(s->surface, &options, &s->editor, &error) != MW_OK)
        return surface_fail(path, &error);
    return mw_probe_cursor_init(s->prober, &certain, &s->cursor, &error) == MW_OK
               ? 0
               : fail_query(&error);
}

/* --- complaints ------------------------------------------------------------------------------- */

static int surface_stream_skip(surface_edit_stream *s, const char *message)
{
    s->skipped++;
    if (!s->skip || !s->quiet) complain("%s", message);
    return s->skip ? 0 : END_INPUT;
}

static const char *stream_name(const char *path)
{
    return files_is_standard(path) ? "standard input" : path;
}

/* The editor refuses a line. */
static int surface_stream_refuse(surface_edit_stream *s, const char *path,
                                 const mw_surface_edit_line *line, const char *kind,
                                 const mw_error *error)
{
    char message[1024];
    if (error->status == MW_ERROR_MEMORY) return fail_memory();
    snprintf(message, sizeof message, "%.400s:%" PRId64 ": %s: %s", stream_name(path), line->line,
             kind, error->message);
    if (error->status == MW_ERROR_INPUT) return surface_stream_skip(s, message);
    complain("%s", message);
    return END_RESOURCE;
}

static void surface_stream_write_row(surface_edit_stream *s, int output)
{
    if (s->row.size > 0) mw_output_write(s->output[output].out, s->row.bytes, s->row.size);
    text_clear(&s->row);
}

/* --- the log ---------------------------------------------------------------------------------- */

static void surface_log_write_oldest(surface_edit_stream *s)
{
    char *line = s->pending[s->first];
    mw_output_write(s->output[EDIT_STREAM_LOG].out, line, strlen(line));
    mw_output_write(s->output[EDIT_STREAM_LOG].out, "\n", 1);
    free(line);
    s->first = (s->first + 1) % s->room;
    s->count--;
}

static void surface_log_flush(surface_edit_stream *s)
{
    while (s->count > 0) surface_log_write_oldest(s);
}

static bool surface_log_grow(surface_edit_stream *s)
{
    size_t room = s->room ? 2 * s->room : 64;
    if (room > s->undo) room = s->undo;
    char **pending = malloc(room * sizeof *pending);
    if (!pending) return false;
    for (size_t i = 0; i < s->count; i++) pending[i] = s->pending[(s->first + i) % s->room];
    free(s->pending);
    s->pending = pending;
    s->first = 0;
    s->room = room;
    return true;
}

/* A line stays back as long as an undo line may take it away. */
static int surface_log_add(surface_edit_stream *s, const char *line)
{
    if (!s->output[EDIT_STREAM_LOG].out) return 0;
    if (s->count == s->undo) surface_log_write_oldest(s);
    if (s->count == s->room && !surface_log_grow(s)) return fail_memory();
    char *copy = strdup(line);
    if (!copy) return fail_memory();
    s->pending[(s->first + s->count++) % s->room] = copy;
    return 0;
}

static void surface_log_undo(surface_edit_stream *s)
{
    if (s->count > 0) free(s->pending[(s->first + --s->count) % s->room]);
}

/* --- lines ------------------------------------------------------------------------------------ */

/* Numbers of triangles from number `first` on, then of vertices, with blanks between them. */
static void surface_write_triangles(text *row, const mw_surface_change *c, size_t first,
                                    size_t count)
{
    csv_row_count(row, count > 0, count ? c->triangle[first].triangle : 0);
    for (size_t i = 1; i < count; i++) csv_row_count_more(row, c->triangle[first + i].triangle);
}

static void surface_write_vertices(text *row, const mw_surface_change *c, size_t first,
                                   size_t count)
{
    csv_row_count(row, count > 0, count ? c->vertex[first].vertex : 0);
    for (size_t i = 1; i < count; i++) csv_row_count_more(row, c->vertex[first + i].vertex);
}

static void surface_stream_write_change(surface_edit_stream *s, int64_t line, const char *kind,
                                        const mw_surface_change *c)
{
    text *row = &s->row;
    if (!s->output[EDIT_STREAM_CHANGES].out) return;
    text_printf(row, "%" PRId64 ",%s", line, kind);
    surface_write_triangles(row, c, 0, c->made);
    surface_write_triangles(row, c, c->made, c->reused);
    surface_write_triangles(row, c, c->made + c->reused, c->freed);
    surface_write_vertices(row, c, 0, c->vertices_made);
    surface_write_vertices(row, c, c->vertices_made, c->vertices_freed);
    surface_write_vertices(row, c, c->vertices_made + c->vertices_freed, c->vertices_moved);
    csv_row_end(row);
    surface_stream_write_row(s, EDIT_STREAM_CHANGES);
}

static int surface_stream_apply(surface_edit_stream *s, const char *path,
                                const mw_surface_edit_line *line)
{
    mw_error error;
    mw_surface_change change;
    const char *kind = mw_surface_edit_name(line->edit.kind);
    if (mw_surface_edit_apply(s->editor, &line->edit, &change, &error) != MW_OK)
        return surface_stream_refuse(s, path, line, kind, &error);
    s->edits[line->edit.kind]++;
    surface_stream_write_change(s, line->line, kind, &change);
    return surface_log_add(s, line->text);
}

static int surface_stream_undo(surface_edit_stream *s, const char *path,
                               const mw_surface_edit_line *line)
{
    mw_error error;
    mw_surface_change change;
    if (mw_surface_edit_undo(s->editor, &change, &error) != MW_OK)
        return surface_stream_refuse(s, path, line, "undo", &error);
    s->undone++;
    surface_stream_write_change(s, line->line, "undo", &change);
    surface_log_undo(s);
    return 0;
}

static int surface_stream_fail_no_answers(const surface_edit_stream *s, const char *path,
                                          const mw_surface_edit_line *line)
{
    const char *taken = "output";
    for (int i = 0; i < EDIT_STREAM_OUTPUTS; i++)
        if (s->output[i].path && files_is_standard(s->output[i].path)) taken = s->output[i].option;
    complain("%s:%" PRId64
             ": --%s already writes to standard output; use --answers FILE for the answers",
             stream_name(path), line->line, taken);
    return END_USAGE;
}

static void surface_stream_write_answer_header(surface_edit_stream *s)
{
    if (s->headed || !s->output[EDIT_STREAM_ANSWERS].out) return;
    text_string(&s->row, "x,y,z,status,triangle,distance,w0,w1,w2\n");
    surface_stream_write_row(s, EDIT_STREAM_ANSWERS);
    s->headed = true;
}

static int surface_stream_probe(surface_edit_stream *s, const char *path,
                                const mw_surface_edit_line *line)
{
    text *row = &s->row;
    if (!s->output[EDIT_STREAM_ANSWERS].out) return surface_stream_fail_no_answers(s, path, line);
    surface_stream_write_answer_header(s);
    mw_touch touch = mw_probe(s->prober, &s->cursor, line->point, line->motion);
    s->states[touch.state]++;
    s->unanswered += touch.state == MW_TOUCH_BAD;
    csv_row_numbers(row, line->point, 3);
    csv_row_status(row, mw_touch_state_name((mw_touch_state)touch.state), touch.triangle);
    csv_row_double(row, touch.triangle != MW_NONE, touch.distance);
    csv_row_weights(row, touch.triangle, touch.weight);
    csv_row_end(row);
    surface_stream_write_row(s, EDIT_STREAM_ANSWERS);
    return 0;
}

/* --- new numbers ------------------------------------------------------------------------------ */

/* Renumber without gaps, and write the numbers if they are requested; `line` 0: at the end. */
static mw_status surface_stream_renumber(surface_edit_stream *s, int64_t line, mw_error *error)
{
    uint32_t triangles = mw_surface_triangle_count(s->surface),
             vertices = mw_surface_vertex_count(s->surface);
    uint32_t *triangle = malloc(((size_t)triangles + 1) * sizeof *triangle),
             *vertex = malloc(((size_t)vertices + 1) * sizeof *vertex);
    mw_status status = MW_ERROR_MEMORY;
    mw_output *out = s->output[EDIT_STREAM_NUMBERS].out;
    error->status = MW_ERROR_MEMORY;
    if (triangle && vertex) status = mw_surface_editor_compact(s->editor, triangle, vertex, error);
    if (status == MW_OK && out) {
        number_rows_write(out, &s->row, line, "vertex", vertex, vertices);
        number_rows_write(out, &s->row, line, "triangle", triangle, triangles);
    }
    free(triangle);
    free(vertex);
    return status;
}

static int surface_stream_compact(surface_edit_stream *s, const char *path,
                                  const mw_surface_edit_line *line)
{
    mw_error error;
    if (surface_stream_renumber(s, line->line, &error) != MW_OK)
        return surface_stream_refuse(s, path, line, "compact", &error);
    s->compactions++;
    surface_stream_write_change(s, line->line, "compact", &(mw_surface_change){0});
    surface_log_flush(s);
    if (s->output[EDIT_STREAM_LOG].out)
        mw_output_write(s->output[EDIT_STREAM_LOG].out, "compact\n", strlen("compact\n"));
    return 0;
}

int surface_edit_stream_take(surface_edit_stream *s, mw_mesh_file *file)
{
    mw_error error;
    if (surface_stream_renumber(s, 0, &error) != MW_OK) return fail_memory();
    size_t points = mw_surface_vertex_count(s->surface),
           triangles = mw_surface_triangle_count(s->surface);
    double *point = malloc((3 * points + 1) * sizeof *point);
    uint32_t *triangle = malloc((3 * triangles + 1) * sizeof *triangle);
    if (!point || !triangle) {
        free(point);
        free(triangle);
        return fail_memory();
    }
    memcpy(point, mw_surface_points(s->surface), 3 * points * sizeof *point);
    for (size_t t = 0; t < triangles; t++)
        mw_surface_triangle(s->surface, (uint32_t)t, triangle + 3 * t);
    char *crs = file->crs;
    file->crs = NULL;
    mw_mesh_file_release(file);
    *file = (mw_mesh_file){.points = point,
                           .triangles = triangle,
                           .point_count = points,
                           .triangle_count = triangles,
                           .has_z = 1,
                           .crs = crs};
    return 0;
}

/* --- the stream ------------------------------------------------------------------------------- */

static int surface_stream_execute(surface_edit_stream *s, const char *path,
                                  const mw_surface_edit_line *line)
{
    switch (line->kind) {
    case MW_SURFACE_EDIT_LINE_EDIT: return surface_stream_apply(s, path, line);
    case MW_SURFACE_EDIT_LINE_PROBE: return surface_stream_probe(s, path, line);
    case MW_SURFACE_EDIT_LINE_UNDO: return surface_stream_undo(s, path, line);
    case MW_SURFACE_EDIT_LINE_COMPACT: return surface_stream_compact(s, path, line);
    default: return 0;
    }
}

/* Read and execute one line. Sets *more to whether there was a line, good or bad. */
static int surface_stream_next_line(surface_edit_stream *s, const char *path,
                                    mw_surface_edit_reader *reader, bool *more)
{
    mw_error error;
    mw_surface_edit_line line;
    mw_status status = mw_surface_edit_reader_read(reader, &line, &error);
    *more = line.line > 0;
    s->lines += *more;
    if (status == MW_OK) return surface_stream_execute(s, path, &line);
    return *more ? surface_stream_skip(s, error.message) : fail_reading(&error);
}

static void surface_stream_write_headers(surface_edit_stream *s)
{
    static const char changes[] = "line,edit,made,reused,freed,vertices_made,vertices_freed,"
                                  "vertices_moved\n";
    if (!files_is_standard(s->output[EDIT_STREAM_ANSWERS].path))
        surface_stream_write_answer_header(s);
    if (s->output[EDIT_STREAM_CHANGES].out)
        mw_output_write(s->output[EDIT_STREAM_CHANGES].out, changes, strlen(changes));
    if (s->output[EDIT_STREAM_NUMBERS].out) number_rows_begin(s->output[EDIT_STREAM_NUMBERS].out);
}

int surface_edit_stream_run(surface_edit_stream *s, const char *path)
{
    mw_error error;
    mw_surface_edit_reader *reader;
    int end = 0;
    progress_phase("editing", path);
    if (mw_surface_edit_reader_open(path, &reader, &error) != MW_OK) return fail_reading(&error);
    surface_stream_write_headers(s);
    for (bool more = true; more && end == 0;) {
        end = surface_stream_next_line(s, path, reader, &more);
        if (s->lines % SURFACE_CHECK_LINES != 0) continue;
        progress_lines(s->lines, mw_surface_edit_reader_fraction(reader));
        if (side_outputs_failed(s->output, EDIT_STREAM_OUTPUTS)) break;
    }
    surface_log_flush(s);
    mw_surface_edit_reader_close(reader);
    return end == 0 && s->row.failed ? fail_memory() : end;
}

void surface_edit_stream_release(surface_edit_stream *s)
{
    while (s->count > 0) surface_log_undo(s);
    free(s->pending);
    text_release(&s->row);
    mw_surface_editor_destroy(s->editor);
    mw_prober_destroy(s->prober);
    mw_surface_destroy(s->surface);
}
