/* edit - change a mesh by a stream of edits, and locate points in between. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/constraints/constraint_file.h"
#include "cli/input/mesh_space.h"
#include "cli/vertices/traced_constraints.h"
#include "cli/vertices/vertex_table.h"
#include "cli/output/mesh_output.h"
#include "cli/edits/edit_stream.h"
#include "cli/stream/point_query.h"
#include "cli/edits/surface_edit_stream.h"

#include <stdlib.h>
#include <string.h>

#define USUAL_UNDO 1000

typedef struct edit_settings {
    common_settings common;
    const char *constraints, *paths[EDIT_STREAM_OUTPUTS];
    uint32_t undo, cells, layers;
    int delaunay, format; /* mw_delaunay_mode; a number of mesh_formats */
    int walk, start;      /* mw_walk_kind, mw_start_kind */
    int descent;          /* mw_descent */
    int space;            /* SPACE_PLANE or SPACE_SURFACE */
    bool skip, heights, strict, stats, json;
} edit_settings;

static const char *delaunay_name(int i)
{
    return (const char *[]){"auto", "make", "never", NULL}[i];
}
static const char *delaunay_help(int i)
{
    return (const char *[]){"keep a mesh Delaunay that is so, but for its border and constraints",
                            "make it so first, and keep it so",
                            "flip no edge unless the stream asks for it"}[i];
}
static const char *edit_space_name(int i)
{
    return (const char *[]){"plane", "surface", NULL}[i];
}
static const char *edit_space_help(int i)
{
    return (const char *[]){"a mesh in the plane of x and y",
                            "a surface in space; EDITS then has other lines, and probes"}[i];
}
static const choices edit_spaces = {"way to take a mesh", edit_space_name, edit_space_help};
static const choices delaunay_choices = {"way of --delaunay", delaunay_name, delaunay_help};

static const option edit_options[] = {
    {"as", 0, OPTION_CHOICE, offsetof(edit_settings, space), "NAME",
     "what to take MESH as (default: plane):", &edit_spaces},
    {"answers", 0, OPTION_TEXT, offsetof(edit_settings, paths[EDIT_STREAM_ANSWERS]), "FILE",
     "write the answers to locate or probe lines to FILE (default: -, standard output)", NULL},
    {"heights", 0, OPTION_FLAG, offsetof(edit_settings, heights), NULL,
     "add the column z to the answers, interpolated", NULL},
    {"changes", 0, OPTION_TEXT, offsetof(edit_settings, paths[EDIT_STREAM_CHANGES]), "FILE",
     "write to FILE what each edit changed: its line, its vertex, the triangles made, reused and "
     "freed",
     NULL},
    {"numbers", 0, OPTION_TEXT, offsetof(edit_settings, paths[EDIT_STREAM_NUMBERS]), "FILE",
     "write to FILE the old and the new number of each vertex and triangle, for the mesh written "
     "and for each compact line",
     NULL},
    {"log", 0, OPTION_TEXT, offsetof(edit_settings, paths[EDIT_STREAM_LOG]), "FILE",
     "write to FILE the edits that took effect, as a stream that makes the same mesh from MESH",
     NULL},
    {"constraints", 0, OPTION_TEXT, offsetof(edit_settings, constraints), "FILE",
     "the points, lines and polygons that MESH was made with: edges along them stay, as "
     "triangulate --constraints "
     "takes "
     "them",
     NULL},
    {"undo", 0, OPTION_COUNT, offsetof(edit_settings, undo), "N",
     "undo lines can undo the last N edits (default: 0, the last 1000)", NULL},
    {"delaunay", 0, OPTION_CHOICE, offsetof(edit_settings, delaunay), "NAME",
     "what becomes of edges that are not Delaunay (default: auto):", &delaunay_choices},
    {"skip", 0, OPTION_FLAG, offsetof(edit_settings, skip), NULL,
     "name lines that cannot be carried out, and go on; without it the first one ends the command",
     NULL},
    {"strict", 0, OPTION_FLAG, offsetof(edit_settings, strict), NULL,
     "exit with 1 if a point lies in no triangle, a probe is not finite, or --skip has skipped a "
     "line",
     NULL},
    {"walk", 0, OPTION_CHOICE, offsetof(edit_settings, walk), "NAME",
     "how to walk to the triangle of a point (default: auto):", &point_query_walks},
    {"start", 0, OPTION_CHOICE, offsetof(edit_settings, start), "NAME",
     "how to choose the first triangle (default: auto):", &point_query_starts},
    {"cells", 0, OPTION_COUNT, offsetof(edit_settings, cells), "N",
     "--start grid, ..., curve: as for locate (default: 0, by the size of the mesh)", NULL},
    {"layers", 0, OPTION_COUNT, offsetof(edit_settings, layers), "N",
     "--start layers: N layers, the mesh itself counted (default: 0, by its size)", NULL},
    {"descent", 0, OPTION_CHOICE, offsetof(edit_settings, descent), "NAME",
     "--start layers: the vertex at which to go down from one to the next (default: auto):",
     &point_query_descents},
    {"format", 0, OPTION_CHOICE, offsetof(edit_settings, format), "NAME",
     "format of the mesh written; node is two files, .node and .ele (default: auto, by its "
     "ending):",
     &mesh_formats},
    {"output", 'o', OPTION_TEXT, offsetof(edit_settings, common.output), "FILE",
     "write the mesh to FILE, which appears under its name only when it is complete", NULL},
    {0},
};

/* The stream of edits, and what its editor needs. */
typedef struct edit_work {
    edit_stream stream;
    traced_constraints constraints;
    char **names; /* of the fields */
    size_t name_count;
    char *crs;           /* of the mesh; NULL: not known */
    double begin, ready; /* monotonic_seconds */
} edit_work;

static void edit_work_release(edit_work *w)
{
    edit_stream_release(&w->stream);
    traced_constraints_release(&w->constraints);
    for (size_t i = 0; w->names && i < w->name_count; i++) free(w->names[i]);
    free(w->names);
    free(w->crs);
}

/* --- settings --------------------------------------------------------------------------------- */

static void edit_choose_outputs(const edit_settings *s, edit_stream *e)
{
    static const char *const options[EDIT_STREAM_OUTPUTS] = {"answers", "changes", "log",
                                                             "numbers"};
    bool taken = files_is_standard(s->common.output);
    for (int i = 0; i < EDIT_STREAM_OUTPUTS; i++) {
        e->output[i] = (side_output){.option = options[i], .path = s->paths[i]};
        taken = taken || (s->paths[i] && files_is_standard(s->paths[i]));
    }
    if (!s->paths[EDIT_STREAM_ANSWERS] && !taken) e->output[EDIT_STREAM_ANSWERS].path = "-";
}

static int edit_check_node_file(const edit_settings *s)
{
    const char *output = s->common.output;
    if (!s->constraints || !mesh_output_is_node(output, s->format)) return 0;
    return constraint_file_check_output(s->constraints, output);
}

/* Refuse options that a surface has no use for. */
static int edit_check_surface(const edit_settings *s)
{
    const struct {
        bool given;
        const char *name;
    } options[] = {{s->heights, "heights"},   {s->constraints, "constraints"},
                   {s->delaunay, "delaunay"}, {s->walk, "walk"},
                   {s->start, "start"},       {s->cells, "cells"},
                   {s->layers, "layers"},     {s->descent, "descent"}};
    for (size_t i = 0; i < sizeof options / sizeof *options && s->space == SPACE_SURFACE; i++) {
        if (!options[i].given) continue;
        complain("option '--%s' needs --as plane", options[i].name);
        return END_USAGE;
    }
    return 0;
}

/* Refuse wrong settings before the work begins. */
static int edit_check_settings(const edit_settings *s, const char *const *operands,
                               const edit_stream *e)
{
    const char *output = s->common.output, *inputs[3] = {operands[0], operands[1], s->constraints};
    int count = s->constraints ? 3 : 2, end = edit_check_surface(s);
    if (end == 0) end = point_query_check_index(s->cells, s->layers);
    if (end == 0) end = mesh_output_check("edit", output, s->format);
    if (end == 0) end = files_check_output(output, inputs, count);
    if (end == 0) end = edit_check_node_file(s);
    if (end == 0) end = side_outputs_check(e->output, EDIT_STREAM_OUTPUTS, output, inputs, count);
    return end;
}

/* --- the mesh --------------------------------------------------------------------------------- */

static int edit_fail_mesh(const char *path, const mw_error *error)
{
    int end = fail_mesh(path, error);
    if (end == END_INPUT)
        complain("'meshwalk check %s' lists every defect, 'meshwalk view' shows it", path);
    return end;
}

/* Copy the heights and fields of a file to its mesh. */
static int mesh_set_fields(mw_mesh *mesh, const mw_mesh_file *file)
{
    mw_error error;
    mw_status status =
        file->has_z ? mw_mesh_set_field(mesh, "z", file->points + 2, 3, &error) : MW_OK;
    for (size_t f = 0; f < file->field_count && status == MW_OK; f++)
        if (!file->has_z || strcmp(file->field_names[f], "z") != 0)
            status = mw_mesh_set_field(mesh, file->field_names[f], file->fields[f], 1, &error);
    return status == MW_OK ? 0 : fail_query(&error);
}

static int edit_read_mesh(const char *path, uint32_t threads, mw_mesh **mesh, char **crs)
{
    mw_error error;
    mw_mesh_file file;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    progress_phase("preparing", path);
    mw_mesh_options options = {.threads = threads, .progress = progress_of_call()};
    if (mw_mesh_create(&arrays, &options, mesh, &error) != MW_OK)
        end = edit_fail_mesh(path, &error);
    else
        end = mesh_set_fields(*mesh, &file);
    *crs = file.crs;
    file.crs = NULL;
    mw_mesh_file_release(&file);
    return end;
}

/* Keep the names of the fields, by the numbers they have in the editor. */
static int edit_work_keep_names(edit_work *w, const mw_mesh *mesh)
{
    size_t count = mw_mesh_field_count(mesh);
    w->names = calloc(count + 1, sizeof *w->names);
    if (!w->names) return fail_memory();
    w->name_count = count;
    for (size_t i = 0; i < count; i++) {
        const char *name = mw_mesh_field_name(mesh, i);
        w->names[mw_editor_field_by_name(w->stream.editor, name)] = strdup(name);
    }
    for (size_t i = 0; i < count; i++)
        if (!w->names[i]) return fail_memory();
    w->stream.fields =
        (mw_edit_text_options){.fields = (const char *const *)w->names, .field_count = count};
    return 0;
}

static int edit_make_cursor(const edit_settings *s, edit_stream *e)
{
    mw_error error;
    mw_start_kind start = (mw_start_kind)s->start;
    mw_query_options asking = {.walk = (mw_walk_kind)s->walk,
                               .start = start,
                               .seed = s->common.seed,
                               .counters = s->stats};
    mw_index_options options = {.cells = s->cells,
                                .layers = s->layers,
                                .descent = (mw_descent)s->descent,
                                .seed = s->common.seed,
                                .progress = progress_of_call()};
    if (mw_start_has_index(start) &&
        mw_editor_index(e->editor, start, &options, &asking.index, &error) != MW_OK)
        return fail_query(&error);
    const mw_locator *locator = mw_editor_locator(e->editor);
    return mw_cursor_init(locator, &asking, &e->cursor, &error) == MW_OK ? 0 : fail_query(&error);
}

static int edit_work_make_editor(const edit_settings *s, const char *path, const mw_mesh *mesh,
                                 edit_work *w)
{
    mw_error error;
    mw_editor_options options = {.delaunay = (mw_delaunay_mode)s->delaunay,
                                 .undo = w->stream.undo,
                                 .constrained_edges = w->constraints.vertex,
                                 .constrained_edge_count = w->constraints.count,
                                 .threads = s->common.threads,
                                 .progress = progress_of_call()};
    if (mw_editor_create(mesh, &options, &w->stream.editor, &error) != MW_OK)
        return edit_fail_mesh(path, &error);
    w->stream.heights = s->heights ? mw_editor_field_by_name(w->stream.editor, "z") : MW_NONE;
    if (s->heights && w->stream.heights == MW_NONE) {
        complain("%s: has no heights for --heights", path);
        return END_INPUT;
    }
    int end = edit_work_keep_names(w, mesh);
    return end ? end : edit_make_cursor(s, &w->stream);
}

static int edit_work_prepare(const edit_settings *s, const char *path, edit_work *w)
{
    mw_mesh *mesh = NULL;
    int end = edit_read_mesh(path, s->common.threads, &mesh, &w->crs);
    if (end == 0 && s->constraints)
        end = traced_constraints_read(&w->constraints, s->constraints, &s->common, mesh, path,
                                      w->crs);
    if (end == 0) end = edit_work_make_editor(s, path, mesh, w);
    mw_mesh_destroy(mesh);
    w->ready = monotonic_seconds();
    return end;
}

static int edit_write_mesh(const edit_settings *s, edit_work *w, bool temporary)
{
    mw_mesh *mesh = NULL;
    vertex_table v = {0};
    int end = edit_stream_mesh(&w->stream, &mesh);
    if (end == 0) end = vertex_table_of_mesh(&v, mesh);
    mw_mesh_destroy(mesh);
    v.file.crs = w->crs;
    w->crs = NULL;
    if (end == 0)
        end = mesh_output_write(s->common.output, s->format, &v.file, temporary, s->common.quiet);
    vertex_table_release(&v);
    return end;
}

/* --- the report ------------------------------------------------------------------------------- */

static void edit_report_editor(report *r, const mw_editor *editor)
{
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    report_count(r, "vertices", info.vertices);
    report_count(r, "triangles", info.triangles);
    report_count(r, "vertex_range", info.vertex_range);
    report_count(r, "triangle_range", info.triangle_range);
    report_count(r, "constraints", info.constrained_edges);
    report_flag(r, "delaunay", info.delaunay);
    report_flag(r, "convex", info.convex);
    report_count(r, "editor_bytes", info.bytes);
    report_count(r, "undo_bytes", info.undo_bytes);
    report_count(r, "index_bytes", info.index_bytes);
    report_count(r, "refreshes", info.refreshes);
}

static void edit_report_lines(report *r, const edit_stream *e)
{
    report_count(r, "lines", e->lines);
    for (int i = 0; i < MW_EDIT_KIND_COUNT; i++)
        report_count(r, mw_edit_name((mw_edit_kind)i), e->edits[i]);
    report_count(r, "undo", e->undone);
    report_count(r, "compact", e->compactions);
    report_count(r, "skipped", e->skipped);
    for (int i = 0; i < MW_WHERE_COUNT; i++)
        report_count(r, mw_where_name((mw_where)i), e->located.where[i]);
}

static int edit_print_statistics(const edit_settings *s, const edit_work *w)
{
    report r;
    report_begin(&r, s->json);
    edit_report_lines(&r, &w->stream);
    edit_report_editor(&r, w->stream.editor);
    report_string(&r, "walk", mw_walk_name((mw_walk_kind)s->walk));
    report_string(&r, "start", mw_start_name((mw_start_kind)s->start));
    statistics_report_settings(&r, &s->common);
    statistics_report_walks(&r, &w->stream.cursor.counters);
    report_rounded(&r, "seconds", monotonic_seconds() - w->begin);
    report_rounded(&r, "preparing_seconds", w->ready - w->begin);
    report_end(&r);
    return files_write_error_text(&r.text);
}

/* --- a surface -------------------------------------------------------------------------------- */

static int edit_print_surface_statistics(const edit_settings *s, const surface_edit_stream *e,
                                         double seconds)
{
    report r;
    mw_surface_editor_info info;
    mw_prober_info boxes;
    mw_surface_editor_describe(e->editor, &info);
    mw_prober_describe(e->prober, &boxes);
    report_begin(&r, s->json);
    report_count(&r, "lines", e->lines);
    for (int i = 0; i < MW_SURFACE_EDIT_KIND_COUNT; i++)
        report_count(&r, mw_surface_edit_name((mw_surface_edit_kind)i), e->edits[i]);
    report_count(&r, "undo", e->undone);
    report_count(&r, "compact", e->compactions);
    report_count(&r, "skipped", e->skipped);
    for (int i = 0; i < MW_TOUCH_STATE_COUNT; i++)
        report_count(&r, mw_touch_state_name((mw_touch_state)i), e->states[i]);
    report_count(&r, "vertices", info.vertices);
    report_count(&r, "triangles", info.triangles);
    report_count(&r, "border_edges", info.border_edges);
    report_count(&r, "editor_bytes", info.bytes);
    report_count(&r, "undo_bytes", info.undo_bytes);
    report_count(&r, "box_bytes", boxes.box_bytes);
    statistics_report_settings(&r, &s->common);
    report_rounded(&r, "seconds", seconds);
    report_end(&r);
    return files_write_error_text(&r.text);
}

/* Values of vertices and triangles do not follow edits of a surface. */
static void edit_warn_fields(const edit_settings *s, const char *path, const mw_mesh_file *file)
{
    if (s->common.quiet || (!file->field_count && !file->triangle_field_count)) return;
    complain("%s: its fields are not kept: only the shape of a surface is edited", path);
}

static int edit_surface_work(const edit_settings *s, const char *const *operands,
                             surface_edit_stream *e, bool temporary)
{
    mw_mesh_file file;
    int end = files_read_mesh(operands[0], &file);
    if (end) return end;
    edit_warn_fields(s, operands[0], &file);
    end = surface_edit_stream_open(e, operands[0], &file, s->common.threads);
    if (end == 0) end = surface_edit_stream_run(e, operands[1]);
    if (end == 0 && !side_outputs_failed(e->output, EDIT_STREAM_OUTPUTS)) {
        end = surface_edit_stream_take(e, &file);
        if (end == 0)
            end = mesh_output_write(s->common.output, s->format, &file, temporary, s->common.quiet);
    }
    mw_mesh_file_release(&file);
    return end;
}

/* The outputs are chosen and checked. */
static int edit_surface_run(const edit_settings *s, const char *const *operands, edit_stream *plan)
{
    double begin = monotonic_seconds();
    bool temporary = false;
    surface_edit_stream e = {
        .output = plan->output, .undo = plan->undo, .skip = s->skip, .quiet = s->common.quiet};
    int end = files_try_output(s->common.output, &temporary);
    if (end == 0) end = side_outputs_open(e.output, EDIT_STREAM_OUTPUTS);
    if (end == 0) end = edit_surface_work(s, operands, &e, temporary);
    int closed = side_outputs_close(e.output, EDIT_STREAM_OUTPUTS, end == 0);
    if (end == 0) end = closed;
    if (end == 0 && s->stats)
        end = edit_print_surface_statistics(s, &e, monotonic_seconds() - begin);
    if (end == 0 && s->strict && (e.unanswered || e.skipped)) end = END_UNANSWERED;
    surface_edit_stream_release(&e);
    return end;
}

/* --- the command ------------------------------------------------------------------------------ */

/* The outputs are open. The mesh is written before they are closed: if the disk is full, none of
 * the others appears. */
static int edit_work_run(const edit_settings *s, const char *const *operands, edit_work *w,
                         bool temporary)
{
    int end = edit_work_prepare(s, operands[0], w);
    if (end == 0) end = edit_stream_run(&w->stream, operands[1]);
    if (end == 0 && !side_outputs_failed(w->stream.output, EDIT_STREAM_OUTPUTS))
        end = edit_write_mesh(s, w, temporary);
    return end;
}

static int edit_run(const void *settings, const char *const *operands)
{
    const edit_settings *s = settings;
    edit_work w = {.begin = monotonic_seconds()};
    edit_stream *e = &w.stream;
    bool temporary = false;
    e->undo = s->undo ? s->undo : USUAL_UNDO;
    e->skip = s->skip;
    e->quiet = s->common.quiet;
    edit_choose_outputs(s, e);
    int end = edit_check_settings(s, operands, e);
    if (end == 0 && s->space == SPACE_SURFACE) return edit_surface_run(s, operands, e);
    if (end == 0) end = files_try_output(s->common.output, &temporary);
    if (end == 0) end = side_outputs_open(e->output, EDIT_STREAM_OUTPUTS);
    if (end == 0) end = edit_work_run(s, operands, &w, temporary);
    int closed = side_outputs_close(e->output, EDIT_STREAM_OUTPUTS, end == 0);
    if (end == 0) end = closed;
    if (end == 0 && s->stats) end = edit_print_statistics(s, &w);
    if (end == 0 && s->strict && (e->unanswered || e->skipped)) end = END_UNANSWERED;
    edit_work_release(&w);
    return end;
}

static const option report_options[] = {
    {"stats", 0, OPTION_FLAG, offsetof(edit_settings, stats), NULL,
     "print counts, memory and times on standard error when done", NULL},
    {"json", 0, OPTION_FLAG, offsetof(edit_settings, json), NULL, "with --stats: as JSON", NULL},
    {0},
};

static const option *const tables[] = {edit_options, report_options, common_options, NULL};

const command edit_command = {
    .name = "edit",
    .operands = "MESH EDITS -o OUT",
    .operand_count = 2,
    .summary = "change a mesh by a stream of edits, and locate in between",
    .description =
        "Carries out the lines of EDITS in order, then writes the mesh. A line is one of: insert X "
        "Y [Z], remove V, move V X Y, flip V V, constrain V V, release V V, value V Z, locate X Y, "
        "undo, compact; with blanks or commas between its words. Vertices are named by their "
        "numbers, from 0. Numbers do not change while the stream runs; a new vertex gets the next "
        "number. A locate line is answered as the command locate does it: "
        "x,y,status,triangle,w0,w1,w2. The mesh written is numbered anew, without gaps and in the "
        "same order. '-' is standard input. With --as surface the lines are: add-vertex X Y Z, "
        "remove-vertex V, move-vertex V X Y Z, add-triangle V V V, remove-triangle T, split-edge V "
        "V [X Y Z], split-triangle T [X Y Z], flip V V, collapse V V [X Y Z], cut V V ..., sew V V "
        "... to V V ..., probe X Y Z MX MY MZ, undo, compact; a probe line is answered as 'probe "
        "--certain' does it.",
    .options = tables,
    .essential = "answers changes numbers log output",
    .settings_size = sizeof(edit_settings),
    .run = edit_run,
};
