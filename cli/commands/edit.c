/* edit - change a mesh by a stream of edits, and locate points in between. */
#include "cli/commands/commands.h"
#include "cli/input/constraints.h"
#include "cli/frame/files.h"
#include "cli/commands/fixed_edges.h"
#include "cli/frame/mesh_output.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/commands/query.h"
#include "cli/commands/session.h"
#include "cli/input/vertices.h"

#include <stdlib.h>
#include <string.h>

#define USUAL_UNDO 1000

typedef struct edit_settings {
    common_settings common;
    const char *constraints, *paths[SESSION_OUTPUTS];
    uint32_t undo, cells, layers;
    int delaunay, format, walk, start; /* mw_delaunay_mode; number of a format; mw_walk_kind, mw_start_kind */
    bool skip, heights, strict, stats, json;
} edit_settings;

static const char *delaunay_name(int i)
{
    return (const char *[]){"auto", "make", "never", NULL}[i];
}
static const char *delaunay_help(int i)
{
    return (const char *[]){"keep a mesh Delaunay that is so, but for its border and constraints",
                            "make it so first, and keep it so", "flip no edge unless the stream asks for it"}[i];
}
static const choices delaunays = {"way of --delaunay", delaunay_name, delaunay_help};

static const option edit_options[] = {
    {"answers", 0, OPTION_TEXT, offsetof(edit_settings, paths[SESSION_ANSWERS]), "FILE",
     "write the answers to locate lines to FILE (default: -, standard output)", NULL},
    {"heights", 0, OPTION_FLAG, offsetof(edit_settings, heights), NULL, "add the column z to the answers, interpolated",
     NULL},
    {"changes", 0, OPTION_TEXT, offsetof(edit_settings, paths[SESSION_CHANGES]), "FILE",
     "write to FILE what each edit changed: its line, its vertex, the triangles made, reused and freed", NULL},
    {"numbers", 0, OPTION_TEXT, offsetof(edit_settings, paths[SESSION_NUMBERS]), "FILE",
     "write to FILE which number became which in the mesh written, and at each compact line", NULL},
    {"log", 0, OPTION_TEXT, offsetof(edit_settings, paths[SESSION_LOG]), "FILE",
     "write to FILE the edits that took effect, as a stream that makes the same of MESH", NULL},
    {"constraints", 0, OPTION_TEXT, offsetof(edit_settings, constraints), "FILE",
     "the points, lines and polygons that MESH was made with: edges along them stay, as triangulate --constraints "
     "takes "
     "them",
     NULL},
    {"undo", 0, OPTION_COUNT, offsetof(edit_settings, undo), "N",
     "undo lines can take back the last N edits (default: 0, the last 1000)", NULL},
    {"delaunay", 0, OPTION_CHOICE, offsetof(edit_settings, delaunay), "NAME",
     "what becomes of edges that are not Delaunay (default: auto):", &delaunays},
    {"skip", 0, OPTION_FLAG, offsetof(edit_settings, skip), NULL,
     "name lines that cannot be carried out, and go on; without it the first one ends the command", NULL},
    {"strict", 0, OPTION_FLAG, offsetof(edit_settings, strict), NULL,
     "exit with 1 if a point lies in no triangle, or --skip passed a line over", NULL},
    {"walk", 0, OPTION_CHOICE, offsetof(edit_settings, walk), "NAME",
     "how to walk to the triangle of a point (default: auto):", &query_walks},
    {"start", 0, OPTION_CHOICE, offsetof(edit_settings, start), "NAME",
     "how to choose the first triangle (default: auto):", &query_starts},
    {"cells", 0, OPTION_COUNT, offsetof(edit_settings, cells), "N",
     "--start grid, two-level-grid, curve: as for locate (default: 0, by the size of the mesh)", NULL},
    {"layers", 0, OPTION_COUNT, offsetof(edit_settings, layers), "N",
     "--start layers: N layers, the mesh itself counted (default: 0, by its size)", NULL},
    {"format", 0, OPTION_CHOICE, offsetof(edit_settings, format), "NAME",
     "format of the mesh written; node is two files, .node and .ele (default: auto, by its ending):", &mesh_formats},
    {"output", 'o', OPTION_TEXT, offsetof(edit_settings, common.output), "FILE",
     "write the mesh to FILE, which appears under its name only when it is complete", NULL},
    {0},
};

/* The session, and what it needs beside its editor. */
typedef struct work {
    session session;
    fixed_edges fixed;
    char **names; /* of the fields */
    size_t name_count;
    double begin, ready; /* tally_clock */
} work;

static void release(work *w)
{
    session_release(&w->session);
    fixed_edges_release(&w->fixed);
    for (size_t i = 0; w->names && i < w->name_count; i++) free(w->names[i]);
    free(w->names);
}

/* --- settings ------------------------------------------------------------------------------------------------------- */

static void choose_outputs(const edit_settings *s, session *e)
{
    static const char *const options[SESSION_OUTPUTS] = {"answers", "changes", "log", "numbers"};
    bool taken = files_is_stream(s->common.output);
    for (int i = 0; i < SESSION_OUTPUTS; i++) {
        e->output[i] = (output_file){.option = options[i], .path = s->paths[i]};
        taken = taken || (s->paths[i] && files_is_stream(s->paths[i]));
    }
    if (!s->paths[SESSION_ANSWERS] && !taken) e->output[SESSION_ANSWERS].path = "-";
}

static int check_node(const edit_settings *s)
{
    const char *output = s->common.output;
    if (!s->constraints || !mesh_output_is_node(output, s->format)) return 0;
    return constraints_check_node(s->constraints, output);
}

/* What can be refused before the work begins. */
static int check_settings(const edit_settings *s, const char *const *operands, const session *e)
{
    const char *output = s->common.output, *inputs[3] = {operands[0], operands[1], s->constraints};
    int count = s->constraints ? 3 : 2, end = query_check_index(s->cells, s->layers);
    if (end == 0) end = mesh_output_check("edit", output, s->format);
    if (end == 0) end = files_check(output, inputs, count);
    if (end == 0) end = check_node(s);
    if (end == 0) end = outputs_check(e->output, SESSION_OUTPUTS, output, inputs, count);
    return end;
}

/* --- the mesh ------------------------------------------------------------------------------------------------------- */

static int fail_mesh_defect(const char *path, const mw_error *error)
{
    int end = fail_mesh(path, error);
    if (end == END_INPUT) complain("'meshwalk check %s' lists every defect", path);
    return end;
}

/* Heights and fields of the file. */
static int set_fields(mw_mesh *mesh, const mw_mesh_file *file)
{
    mw_error error;
    mw_status status = file->has_z ? mw_mesh_set_field(mesh, "z", file->points + 2, 3, &error) : MW_OK;
    for (size_t f = 0; f < file->field_count && status == MW_OK; f++)
        if (!file->has_z || strcmp(file->field_names[f], "z") != 0)
            status = mw_mesh_set_field(mesh, file->field_names[f], file->fields[f], 1, &error);
    return status == MW_OK ? 0 : fail_query(&error);
}

static int read_mesh(const char *path, uint32_t threads, mw_mesh **mesh)
{
    mw_error error;
    mw_mesh_file file;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    progress_phase("preparing", path);
    if (mw_mesh_create(&arrays, &(mw_mesh_options){.threads = threads}, mesh, &error) != MW_OK)
        end = fail_mesh_defect(path, &error);
    else
        end = set_fields(*mesh, &file);
    mw_mesh_file_release(&file);
    return end;
}

/* The names of the fields by their numbers in the editor. */
static int keep_names(work *w, const mw_mesh *mesh)
{
    size_t count = mw_mesh_field_count(mesh);
    w->names = calloc(count + 1, sizeof *w->names);
    if (!w->names) return fail_memory();
    w->name_count = count;
    for (size_t i = 0; i < count; i++) {
        const char *name = mw_mesh_field_name(mesh, i);
        w->names[mw_editor_field_by_name(w->session.editor, name)] = strdup(name);
    }
    for (size_t i = 0; i < count; i++)
        if (!w->names[i]) return fail_memory();
    w->session.fields = (mw_edit_text_options){.fields = (const char *const *)w->names, .field_count = count};
    return 0;
}

static int make_cursor(const edit_settings *s, session *e)
{
    mw_error error;
    mw_start_kind start = (mw_start_kind)s->start;
    mw_query_options asking = {
        .walk = (mw_walk_kind)s->walk, .start = start, .seed = s->common.seed, .counters = s->stats};
    mw_index_options options = {.cells = s->cells, .layers = s->layers, .seed = s->common.seed};
    if (mw_start_has_index(start) && mw_editor_index(e->editor, start, &options, &asking.index, &error) != MW_OK)
        return fail_query(&error);
    const mw_locator *locator = mw_editor_locator(e->editor);
    return mw_cursor_init(locator, &asking, &e->cursor, &error) == MW_OK ? 0 : fail_query(&error);
}

static int make_editor(const edit_settings *s, const char *path, const mw_mesh *mesh, work *w)
{
    mw_error error;
    mw_editor_options options = {.delaunay = (mw_delaunay_mode)s->delaunay,
                                 .undo = w->session.undo,
                                 .constrained_edges = w->fixed.vertex,
                                 .constrained_edge_count = w->fixed.count,
                                 .threads = s->common.threads};
    if (mw_editor_create(mesh, &options, &w->session.editor, &error) != MW_OK) return fail_mesh_defect(path, &error);
    w->session.heights = s->heights ? mw_editor_field_by_name(w->session.editor, "z") : MW_NONE;
    if (s->heights && w->session.heights == MW_NONE) {
        complain("%s: has no heights for --heights", path);
        return END_INPUT;
    }
    int end = keep_names(w, mesh);
    return end ? end : make_cursor(s, &w->session);
}

static int prepare(const edit_settings *s, const char *path, work *w)
{
    mw_mesh *mesh = NULL;
    int end = read_mesh(path, s->common.threads, &mesh);
    if (end == 0 && s->constraints) end = fixed_edges_read(&w->fixed, s->constraints, mesh, path);
    if (end == 0) end = make_editor(s, path, mesh, w);
    mw_mesh_destroy(mesh);
    w->ready = tally_clock();
    return end;
}

static int write_mesh(const edit_settings *s, session *e, bool named)
{
    mw_mesh *mesh = NULL;
    vertices v = {0};
    int end = session_mesh(e, &mesh);
    if (end == 0) end = vertices_of_mesh(&v, mesh);
    mw_mesh_destroy(mesh);
    if (end == 0) end = mesh_output_write(s->common.output, s->format, &v.file, named);
    vertices_release(&v);
    return end;
}

/* --- the report ------------------------------------------------------------------------------------------------------- */

static void report_editor(report *r, const mw_editor *editor)
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

static void report_lines(report *r, const session *e)
{
    report_count(r, "lines", e->lines);
    for (int i = 0; i < MW_EDIT_KIND_COUNT; i++) report_count(r, mw_edit_name((mw_edit_kind)i), e->edits[i]);
    report_count(r, "undo", e->undone);
    report_count(r, "compact", e->compactions);
    report_count(r, "skipped", e->skipped);
    for (int i = 0; i < MW_WHERE_COUNT; i++) report_count(r, mw_where_name((mw_where)i), e->located.where[i]);
}

static int print_stats(const edit_settings *s, const work *w)
{
    report r;
    report_begin(&r, s->json);
    report_lines(&r, &w->session);
    report_editor(&r, w->session.editor);
    report_string(&r, "walk", mw_walk_name((mw_walk_kind)s->walk));
    report_string(&r, "start", mw_start_name((mw_start_kind)s->start));
    tally_report_run(&r, &s->common);
    tally_report_walks(&r, &w->session.cursor.counters);
    tally_report_seconds(&r, "seconds", tally_clock() - w->begin);
    tally_report_seconds(&r, "preparing_seconds", w->ready - w->begin);
    report_end(&r);
    return tally_print(&r);
}

/* --- the command ------------------------------------------------------------------------------------------------------- */

/* The outputs are open. The mesh comes first: where there is no room for it, none of the others appears. */
static int edit_mesh(const edit_settings *s, const char *const *operands, work *w, bool named)
{
    int end = prepare(s, operands[0], w);
    if (end == 0) end = session_run(&w->session, operands[1]);
    if (end == 0 && !outputs_failed(w->session.output, SESSION_OUTPUTS)) end = write_mesh(s, &w->session, named);
    return end;
}

static int run(const void *settings, const char *const *operands)
{
    const edit_settings *s = settings;
    work w = {.begin = tally_clock()};
    session *e = &w.session;
    bool named = false;
    e->undo = s->undo ? s->undo : USUAL_UNDO;
    e->skip = s->skip;
    e->quiet = s->common.quiet;
    choose_outputs(s, e);
    int end = check_settings(s, operands, e);
    if (end == 0) end = files_try_output(s->common.output, &named);
    if (end == 0) end = outputs_open(e->output, SESSION_OUTPUTS);
    if (end == 0) end = edit_mesh(s, operands, &w, named);
    int closed = outputs_close(e->output, SESSION_OUTPUTS, end == 0);
    if (end == 0) end = closed;
    if (end == 0 && s->stats) end = print_stats(s, &w);
    if (end == 0 && s->strict && (e->unanswered || e->skipped)) end = END_UNLOCATED;
    release(&w);
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
        "Carries out the lines of EDITS in order, then writes the mesh. A line is one of: insert X Y [Z], remove V, "
        "move V X "
        "Y, flip V V, constrain V V, release V V, value V Z, locate X Y, undo, compact; with blanks or commas between "
        "its "
        "words. Vertices go by their numbers, from 0, which stay as they are while the stream runs; a new vertex gets "
        "the "
        "next one. A locate line is answered as the command locate does it: x,y,status,triangle,w0,w1,w2. The mesh "
        "written is numbered anew, without gaps and in the same order. '-' is standard input.",
    .options = tables,
    .settings_size = sizeof(edit_settings),
    .run = run,
};
