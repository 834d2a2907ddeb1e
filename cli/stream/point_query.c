#include "cli/stream/point_query.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_point_layer.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/stream/statistics.h"

#include <stdlib.h>

static void point_query_warn(const point_query *q, const char *path)
{
    const char *promise = mw_locator_void_promise(q->locator);
    if (promise && !q->settings->stream.common.quiet) complain("%s: warning: %s", path, promise);
}

/* If some triangle has an area, a mesh is refused only for its defects, and --any accepts it. */
static int point_query_fail_mesh(const point_query *q, const char *path, bool area,
                                 const mw_error *error)
{
    int end = fail_mesh(path, error);
    if (end == END_INPUT && q->settings->lines && area)
        complain(
            "'meshwalk check %s' lists every defect, 'meshwalk view' shows it; --fix mends some",
            path);
    else if (end == END_INPUT && !q->settings->any && area)
        complain("'meshwalk check %s' lists every defect, 'meshwalk view' shows it; --any locates "
                 "points all the same",
                 path);
    return end;
}

static int point_query_make_mesh(point_query *q, const char *path, const mw_mesh_file *file,
                                 bool area)
{
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_mesh_options options = {.tolerant = q->settings->any,
                               .threads = q->settings->stream.common.threads,
                               .progress = progress_of_call()};
    progress_phase("preparing", path);
    if (mw_mesh_create(&arrays, &options, &q->own_mesh, &error) != MW_OK)
        return point_query_fail_mesh(q, path, area, &error);
    q->mesh = q->own_mesh;
    return 0;
}

static int point_query_make_locator(point_query *q, const char *path, bool border, bool area)
{
    mw_error error;
    const point_query_settings *settings = q->settings;
    if (settings->globe || settings->elsewhere) return 0;
    mw_locator_options options = {.any = settings->any,
                                  .border = border || settings->tolerance > 0,
                                  .areas = settings->areas,
                                  .fill = (mw_fill_mode)settings->fill,
                                  .threads = settings->stream.common.threads,
                                  .progress = progress_of_call()};
    if (settings->walk == MW_WALK_BORDER && settings->fill == MW_FILL_AUTO)
        options.fill = MW_FILL_NO;
    if (mw_locator_create(q->mesh, &options, &q->own_locator, &error) != MW_OK)
        return point_query_fail_mesh(q, path, area, &error);
    q->locator = q->own_locator;
    point_query_warn(q, path);
    return 0;
}

/* Only the border walk works in a mesh whose pockets and holes are not filled. */
static int point_query_check_fill(const point_query_settings *settings)
{
    if (settings->fill != MW_FILL_NO || settings->walk == MW_WALK_AUTO ||
        settings->walk == MW_WALK_BORDER)
        return 0;
    complain("--fill no needs --walk border, not %s", mw_walk_name((mw_walk_kind)settings->walk));
    return END_USAGE;
}

/* Build the index that the start needs, if it needs one. */
static int point_query_make_index(point_query *q)
{
    mw_error error;
    const point_query_settings *settings = q->settings;
    mw_start_kind start = (mw_start_kind)settings->start;
    if (settings->elsewhere || !mw_start_has_index(start)) return 0;
    mw_index_options options = {.cells = settings->cells,
                                .layers = settings->layers,
                                .descent = (mw_descent)settings->descent,
                                .seed = settings->stream.common.seed,
                                .progress = progress_of_call()};
    return mw_index_create(q->locator, start, &options, &q->index, &error) == MW_OK
               ? 0
               : fail_query(&error);
}

int point_query_begin(point_query *q, const point_query_settings *settings,
                      const char *const *inputs, int count)
{
    *q = (point_query){.settings = settings, .begin = monotonic_seconds()};
    int end = files_check_output(settings->stream.common.output, inputs, count);
    if (end == 0) end = point_layers_check(inputs, count);
    if (end == 0) end = query_stream_check_output(&settings->stream);
    if (end == 0) end = point_query_check_index(settings->cells, settings->layers);
    if (end == 0) end = point_query_check_fill(settings);
    return end ? end : query_crs_check(settings->crs, settings->stream.source.crs);
}

int point_query_prepare(point_query *q, const mw_mesh *mesh, const char *path, const char *crs)
{
    double at[2];
    q->mesh = mesh;
    q->path = path;
    int end =
        mesh_crs_settle(path, q->settings->crs, crs, q->settings->stream.common.quiet, &q->crs);
    if (end) return end;
    for (uint32_t v = 0; v < mw_mesh_vertex_count(mesh); v++) {
        mw_mesh_vertex(mesh, v, at);
        extent_add(&q->extent, at, 1, 2);
    }
    end = point_query_make_locator(q, path, false, true);
    return end ? end : point_query_make_index(q);
}

/* --- a mesh from a file ----------------------------------------------------------------------- */

/* What is the same for all files, once the mesh is there. `file` has no points in a map. */
static int point_query_settle(point_query *q, mw_mesh *mesh, const mw_mesh_file *file,
                              point_query_load *load, const void *self)
{
    const point_query_settings *s = q->settings;
    const bool quiet = s->stream.common.quiet;
    if (!quiet && !s->globe) extent_warn_of_seam(q->path, &q->extent, mesh);
    q->first_number = file->first_number;
    int end = mesh_crs_settle(q->path, s->crs, file->crs, quiet, &q->crs);
    return end || !load ? end : load(mesh, q->path, file, self);
}

static int point_query_open_mesh(point_query *q, bool border, point_query_load *load,
                                 const void *self)
{
    mw_mesh_file file;
    int end = files_read_mesh(q->path, &file);
    if (end) return end;
    bool area = files_has_area(&file);
    extent_add(&q->extent, file.points, file.point_count, 3);
    end = point_query_make_mesh(q, q->path, &file, area);
    if (end == 0) end = point_query_settle(q, q->own_mesh, &file, load, self);
    q->faces = q->own_faces = file.faces;
    file.faces = NULL;
    mw_mesh_file_release(&file);
    return end ? end : point_query_make_locator(q, q->path, border, area);
}

/* Is it a prepared file whose locator is the one that is asked for? */
static bool point_query_fits_map(const point_query_settings *s, const char *path)
{
    return !s->any && !s->areas && s->fill != MW_FILL_NO && s->walk != MW_WALK_BORDER &&
           mw_prepared_known(path);
}

static int point_query_fail_trust(const point_query_settings *s, const char *path)
{
    if (!mw_prepared_known(path)) {
        complain("%s: is no prepared mesh (.mwm), which --trust needs; 'meshwalk prepare' writes "
                 "one",
                 path);
        return END_INPUT;
    }
    if (point_query_fits_map(s, path)) {
        complain("%s: was prepared without --border, but the border is needed here: leave out "
                 "--trust, or prepare it with --border",
                 path);
        return END_INPUT;
    }
    complain("--trust takes a mesh as it was prepared: not with --any, --areas, --fill no or "
             "--walk border");
    return END_USAGE;
}

int point_query_check_trust(const point_query_settings *s, const char *path)
{
    return !s->trust || point_query_fits_map(s, path) ? 0 : point_query_fail_trust(s, path);
}

/* Map a prepared file. `map` stays NULL if its locator lacks a border that is needed. */
static int point_query_map(point_query *q, const char *path, bool border)
{
    mw_error error;
    mw_prepared_info info;
    const point_query_settings *s = q->settings;
    const mw_map_options options = {
        .trust = s->trust, .threads = s->stream.common.threads, .progress = progress_of_call()};
    progress_phase("checking", path);
    if (mw_mesh_map(path, &options, &q->map, &error) != MW_OK) return fail_reading(&error);
    mw_prepared_describe(q->map, &info);
    q->extent = (extent_box){.low = {info.low[0], info.low[1]},
                             .high = {info.high[0], info.high[1]},
                             .count = mw_mesh_vertex_count(mw_prepared_mesh(q->map))};
    if ((border || s->tolerance > 0) && !info.border) {
        mw_prepared_close(q->map);
        q->map = NULL;
    }
    return 0;
}

static int point_query_open_map(point_query *q, point_query_load *load, const void *self)
{
    const mw_mesh_file *values = mw_prepared_values(q->map);
    q->mesh = mw_prepared_mesh(q->map);
    q->locator = mw_prepared_locator(q->map);
    q->faces = values->faces;
    return point_query_settle(q, mw_prepared_mesh(q->map), values, load, self);
}

int point_query_open(point_query *q, const point_query_settings *settings,
                     const char *const *operands, bool border, point_query_load *load,
                     const void *self)
{
    const char *path = operands[0];
    const bool mapped = !settings->elsewhere && point_query_fits_map(settings, path);
    int end = point_query_begin(q, settings, operands, 2);
    q->path = path;
    if (end == 0) end = point_query_check_trust(settings, path);
    if (end == 0 && mapped) end = point_query_map(q, path, border);
    if (end == 0 && mapped && !q->map && settings->trust)
        end = point_query_fail_trust(settings, path);
    if (end == 0)
        end = q->map ? point_query_open_map(q, load, self)
                     : point_query_open_mesh(q, border, load, self);
    return end ? end : point_query_make_index(q);
}

void point_query_release(point_query *q)
{
    mw_index_destroy(q->index);
    mw_locator_destroy(q->own_locator);
    mw_mesh_destroy(q->own_mesh);
    mw_prepared_close(q->map);
    free(q->crs);
    free(q->own_faces);
}

/* What the callbacks of the query stream need. */
typedef struct point_query_context {
    const point_query *query;
    point_query_row *row;
    const void *self;
    location_statistics statistics;
    extent_box extent; /* of the points */
} point_query_context;

/* Interpolate the values of a block. */
static mw_status point_query_interpolate(const point_query *q, const mw_location *answers,
                                         size_t count, mw_error *error)
{
    point_query_values *v = q->values;
    if (!v) return MW_OK;
    const mw_value_table table = {.values = v->field, .type = MW_FLOAT64, .count = 1};
    const mw_interpolate_options options = {.threads = q->settings->stream.common.threads};
    v->first = answers;
    return mw_interpolate_table(q->mesh, &table, answers, count, &options, v->at_points, error);
}

int point_query_locate(const point_query *q, const query_block *block, mw_location *answers,
                       mw_counters *counters)
{
    const point_query_settings *settings = q->settings;
    mw_error error;
    if (q->elsewhere) return q->elsewhere(q->elsewhere_self, block, answers);
    mw_query_options options = {
        .walk = (mw_walk_kind)settings->walk,
        .start = (mw_start_kind)settings->start,
        .arithmetic = (mw_arithmetic)settings->arithmetic,
        .finish = point_query_finish(settings),
        /* Each block has its own random numbers. */
        .seed = settings->stream.common.seed + block->block,
        .samples = settings->sample,
        .steps = settings->steps,
        .threads = settings->stream.common.threads,
        .tolerance = settings->tolerance,
        .counters = settings->stream.stats,
        .index = q->index,
        .progress = progress_of_call(),
    };
    mw_status status = mw_locate_batch(q->locator, block->values, block->count, block->stride,
                                       &options, answers, counters, &error);
    return status == MW_OK ? 0 : fail_query(&error);
}

static int point_query_answer_block(void *self, const query_block *block, void *answers)
{
    point_query_context *context = self;
    mw_error error;
    mw_counters counters = {0};
    int end = point_query_locate(context->query, block, answers, &counters);
    if (end) return end;
    if (point_query_interpolate(context->query, answers, block->count, &error) != MW_OK)
        return fail_query(&error);
    location_statistics_add(&context->statistics, answers, block->count, &counters);
    extent_add(&context->extent, block->values, block->count, block->stride);
    return 0;
}

static bool point_query_write_row(const void *self, const double *point, const void *answer,
                                  text *out)
{
    const point_query_context *context = self;
    return context->row(context->query, context->self, point, answer, out);
}

static void point_query_report_border(report *r, const mw_counters *c)
{
    statistics_report_mean(r, "implicit", c->implicit, c->queries);
    statistics_report_mean(r, "walk_runs", c->walk_runs, c->queries);
    report_count(r, "triangles_walk_max", c->triangles_walk_max);
    statistics_report_mean(r, "border_runs", c->border_runs, c->queries);
    statistics_report_mean(r, "triangles_border", c->triangles_border, c->queries);
    report_count(r, "triangles_border_max", c->triangles_border_max);
    statistics_report_mean(r, "orient_border", c->orient_border, c->queries);
    statistics_report_mean(r, "border_edges", c->border_edges, c->queries);
    report_count(r, "border_edges_max", c->border_edges_max);
}

static void point_query_report_memory(report *r, const point_query *q)
{
    mw_locator_info locator;
    mw_index_info index = {0};
    mw_locator_describe(q->locator, &locator);
    if (q->index) mw_index_describe(q->index, &index);
    report_count(r, "mesh_bytes", mw_mesh_bytes(q->mesh));
    report_count(r, "locator_bytes", locator.bytes);
    report_count(r, "area_bytes", locator.area_bytes);
    report_count(r, "start_bytes", index.bytes);
    report_rounded(r, "start_seconds", index.seconds);
    report_count(r, "ghost_triangles", locator.ghost_triangles);
    report_count(r, "fill_bytes", locator.fill_bytes);
    report_string(r, "guide", locator.guide ? mw_start_name(locator.guide) : "none");
    report_count(r, "guide_bytes", locator.guide_bytes);
    report_count(r, "pieces", locator.components);
}

static void point_query_report(const void *self, report *r)
{
    const point_query_context *context = self;
    const point_query_settings *settings = context->query->settings;
    if (context->query->count_rows) context->query->count_rows(context->self, r);
    for (int i = 0; i < MW_WHERE_COUNT && !context->query->count_rows; i++)
        report_count(r, mw_where_name((mw_where)i), context->statistics.where[i]);
    report_string(r, "walk", mw_walk_name((mw_walk_kind)settings->walk));
    report_string(r, "start", mw_start_name((mw_start_kind)settings->start));
    report_string(r, "arithmetic", point_query_arithmetic(settings));
    statistics_report_settings(r, &settings->stream.common);
    statistics_report_walks(r, &context->statistics.counters);
    point_query_report_border(r, &context->statistics.counters);
    point_query_report_memory(r, context->query);
}

int point_query_run(const point_query *q, const char *points, const char *const *answers,
                    const char *kinds, point_query_row *row, const void *self)
{
    point_query_context context = {.query = q, .row = row, .self = self};
    query_stream s = {
        .settings = &q->settings->stream,
        .begin = q->begin,
        .doing = "locating",
        .columns = {.axes = QUERY_PLANE, .names = {"x", "y"}, .count = 2},
        .domain = QUERIES_IN_PLANE,
        .mesh = q->path,
        .mesh_crs = q->crs,
        .heights = q->values != NULL,
        .shown = 2,
        .answers = answers,
        .kinds = kinds,
        .answer_size = sizeof(mw_location),
        .answer = point_query_answer_block,
        .row = point_query_write_row,
        .report = point_query_report,
        .self = &context,
    };
    int end = query_stream_run(&s, points);
    const uint64_t *where = context.statistics.where;
    bool done = end == 0 || end == END_UNANSWERED;
    if (done && !q->settings->stream.common.quiet)
        extent_remark(q->path, &q->extent, points, &context.extent,
                      where[MW_INSIDE] + where[MW_ON_EDGE] + where[MW_ON_VERTEX] + where[MW_NEAR]);
    return end;
}
