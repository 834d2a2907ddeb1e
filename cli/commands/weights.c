/* weights - the weights that interpolate values of a mesh at points, as a file. */
#include "cli/commands/weights.h"
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/remap/remap_weights.h"
#include "cli/stream/globe_points.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char *method_name(int i)
{
    return (const char *[]){"linear", "conservative", NULL}[i];
}
static const char *method_help(int i)
{
    return (const char *[]){"values at points, interpolated linearly in triangles",
                            "means over the cells of a mesh or raster, which keep sums"}[i];
}
static const choices weights_methods = {"method", method_name, method_help};

static const char *cell_value_name(int i)
{
    return (const char *[]){"faces", "vertices", NULL}[i];
}
static const choices weights_values = {"place of --values", cell_value_name, NULL};

static const char *norm_name(int i)
{
    return (const char *[]){"dstarea", "fracarea", NULL}[i];
}
static const char *norm_help(int i)
{
    return (const char *[]){"the mean over the whole cell, 0 where nothing is: sums are kept",
                            "the mean over the part of the cell that MESH covers"}[i];
}
static const choices weights_norms = {"way of --norm", norm_name, norm_help};

int weights_check(const char *output, const char *const *operands)
{
    if (!files_is_standard(output)) return files_check_output(output, operands, 2);
    complain("weights needs an output: -o FILE.nc, or FILE.npz");
    return END_USAGE;
}

/* Places of the vertices, packed, in the mesh's own coordinates. */
static double *weights_vertices(const mw_mesh *mesh)
{
    const uint32_t n = mw_mesh_vertex_count(mesh);
    double *xy = malloc(2 * (size_t)n * sizeof *xy + 1);
    for (uint32_t v = 0; v < n && xy; v++) mw_mesh_vertex(mesh, v, xy + 2 * (size_t)v);
    return xy;
}

static int weights_write(const weights_result *r, const char *output)
{
    mw_error error;
    const located_points *p = r->points;
    const mw_weight_positions positions = {.columns = r->vertices,
                                           .rows = p->moved,
                                           .row_stride = p->width,
                                           .located = p->located,
                                           .degrees =
                                               r->globe || (p->lonlat && p->moved == p->points)};
    const mw_file_options options = {.progress = progress_of_call()};
    progress_phase("writing", output);
    mw_status status = mw_write_weights(output, r->weights, &positions, &options, &error);
    return status == MW_OK ? 0 : fail_writing(&error);
}

static int weights_report(const weights_result *result)
{
    mw_operator_info info;
    report r;
    mw_operator_describe(result->weights, &info);
    report_begin(&r, result->stream->json);
    report_count(&r, "points", result->points->count);
    for (int i = 0; i < MW_WHERE_COUNT; i++)
        report_count(&r, mw_where_name((mw_where)i), result->points->where[i]);
    report_count(&r, "vertices", info.columns);
    report_count(&r, "weights", info.entries);
    report_end(&r);
    return files_write_error_text(&r.text);
}

int weights_finish(const weights_result *result, const char *output)
{
    int end = weights_write(result, output);
    if (end == 0 && result->stream->stats) end = weights_report(result);
    if (end == 0 && result->stream->strict && located_points_lost(result->points))
        end = END_UNANSWERED;
    return end;
}

static int weights_make(const point_query *q, const located_points *p, const char *output)
{
    mw_error error;
    mw_operator *weights;
    const mw_operator_options options = {.threads = q->settings->stream.common.threads,
                                         .progress = progress_of_call()};
    progress_phase("weighing", NULL);
    if (mw_operator_create(q->mesh, p->located, p->count, &options, &weights, &error) != MW_OK)
        return fail_query(&error);
    double *vertices = weights_vertices(q->mesh);
    const weights_result result = {.stream = &q->settings->stream,
                                   .points = p,
                                   .vertices = vertices,
                                   .globe = q->settings->globe,
                                   .weights = weights};
    const int end = vertices ? weights_finish(&result, output) : fail_memory();
    free(vertices);
    mw_operator_destroy(weights);
    return end;
}

/* --- cells --- */

/* Options that are for points only. */
static int weights_refuse_points_options(const weights_settings *s)
{
    const query_stream_settings *stream = &s->query.stream;
    const char *wrong = stream->source.columns ? "columns"
                        : stream->source.layer ? "layer"
                        : stream->source.where ? "where"
                        : s->query.any         ? "any"
                        : s->lonlat            ? "lonlat"
                                               : NULL;
    if (s->query.tolerance > 0) wrong = "tolerance";
    if (!wrong) return 0;
    complain("option '--%s' is for points, not for --method conservative", wrong);
    return END_USAGE;
}

static int weights_of_cells(const weights_settings *s, const char *const *operands)
{
    const query_stream_settings *stream = &s->query.stream;
    const remap_settings settings = {.common = &stream->common,
                                     .crs = s->query.crs,
                                     .grid_crs = stream->source.crs,
                                     .vertices = s->values,
                                     .covered = s->norm,
                                     .strict = stream->strict,
                                     .stats = stream->stats,
                                     .json = stream->json};
    int end = weights_refuse_points_options(s);
    if (end == 0) end = crs_check_option("crs", s->query.crs);
    if (end == 0) end = crs_check_option("points-crs", stream->source.crs);
    return end ? end : remap_weights_run(&settings, operands);
}

/* --- points --- */

static int weights_check_points(const weights_settings *s)
{
    const char *unfit = s->lonlat ? point_query_option_of_plane(&s->query) : NULL;
    if (s->values || s->norm)
        complain("option '--%s' needs --method conservative", s->values ? "values" : "norm");
    else if (s->open && !s->lonlat)
        complain("option '--open' needs --lonlat");
    else if (unfit)
        complain("option '--%s' is for points in the plane, not for --lonlat", unfit);
    else
        return 0;
    return END_USAGE;
}

/* What the loading of the mesh's file makes besides. */
typedef struct weights_globe {
    const weights_settings *settings;
    globe_points points;
} weights_globe;

static int weights_load(mw_mesh *mesh, const char *path, const mw_mesh_file *file, const void *self)
{
    weights_globe *g = *(weights_globe *const *)self;
    (void)mesh;
    return globe_points_make(&g->points, path, file, g->settings->open,
                             g->settings->query.stream.common.threads);
}

static int weights_at_points(const weights_settings *all, const char *const *operands)
{
    weights_globe globe = {.settings = all}, *self = &globe;
    point_query_settings s = all->query;
    const char *output = s.stream.common.output;
    point_query q;
    located_points p = {0};
    s.stream.common.output = NULL; /* the query writes no rows: the output is ours */
    s.any = s.any || all->lonlat;
    s.globe = all->lonlat;
    int end = point_query_open(&q, &s, operands, false, all->lonlat ? weights_load : NULL, &self);
    if (all->lonlat) {
        q.elsewhere = globe_points_locate;
        q.elsewhere_self = &globe.points;
    }
    if (end == 0) end = located_points_read(&p, &q, operands[1], NULL);
    if (end == 0) end = weights_make(&q, &p, output);
    located_points_release(&p);
    point_query_release(&q);
    globe_points_release(&globe.points);
    return end;
}

static int weights_run(const void *settings, const char *const *operands)
{
    const weights_settings *s = settings;
    int end = weights_check(s->query.stream.common.output, operands);
    if (end) return end;
    if (s->method == METHOD_CONSERVATIVE) return weights_of_cells(s, operands);
    end = weights_check_points(s);
    return end ? end : weights_at_points(s, operands);
}

static const option weights_options[] = {
    {"method", 0, OPTION_CHOICE, offsetof(weights_settings, method), "NAME",
     "what the weights do (default: linear):", &weights_methods},
    {"values", 0, OPTION_CHOICE, offsetof(weights_settings, values), "PLACE",
     "--method conservative: what MESH has values at (default: faces):", &weights_values},
    {"norm", 0, OPTION_CHOICE, offsetof(weights_settings, norm), "NAME",
     "--method conservative: what cells get that MESH covers in part (default: dstarea):",
     &weights_norms},
    {"lonlat", 0, OPTION_FLAG, offsetof(weights_settings, lonlat), NULL,
     "MESH and POINTS are longitudes and latitudes in degrees, and MESH lies on the sphere: it may "
     "cross 180 degrees and the poles",
     NULL},
    {"open", 0, OPTION_FLAG, offsetof(weights_settings, open), NULL,
     "--lonlat: MESH may leave parts of the sphere open, as an ocean does", NULL},
    {"strict", 0, OPTION_FLAG, offsetof(weights_settings, query.stream.strict), NULL,
     "exit with 1 if a point is in no triangle", NULL},
    {"stats", 0, OPTION_FLAG, offsetof(weights_settings, query.stream.stats), NULL,
     "print counts on standard error when done", NULL},
    {"json", 0, OPTION_FLAG, offsetof(weights_settings, query.stream.json), NULL,
     "with --stats: as JSON", NULL},
    {"layer", 0, OPTION_TEXT, offsetof(weights_settings, query.stream.source.layer), "NAME",
     "of a file that GDAL reads: the layer with the points (default: the only one that has any)",
     NULL},
    {"where", 0, OPTION_TEXT, offsetof(weights_settings, query.stream.source.where), "CONDITION",
     "of a file that GDAL reads: which features are read, in SQL, as \"depth > 10\" (default: all)",
     NULL},
    {0},
};

const option *const weights_option_tables[] = {weights_options, point_query_options, common_options,
                                               NULL};

const command weights_command = {
    .name = "weights",
    .operands = "MESH POINTS|GRID",
    .operand_count = 2,
    .summary = "write the weights that interpolate values at points",
    .description =
        "Locates POINTS once, and writes which vertices of MESH each takes its value from, and "
        "with "
        "which weights: as netCDF in the layout of ESMF's weight files, which xESMF, uxarray and "
        "meshwalk apply read, or, to a name that ends in .npz, as a sparse matrix of SciPy. A "
        "point in no triangle has no weights; its status is in the variable status_b. With "
        "--method "
        "conservative, GRID is another mesh or a raster that GDAL reads, and its cells get the "
        "means "
        "of the cells of MESH by the areas that they have in common.",
    .options = weights_option_tables,
    .essential = "method columns points-crs stats output",
    .settings_size = sizeof(weights_settings),
    .run = weights_run,
};
