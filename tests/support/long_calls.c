#include "support/long_calls.h"

#include <math.h>
#include <meshwalk/io.h>
#include <meshwalk/operator.h>
#include <meshwalk/polygons.h>
#include <meshwalk/prepared.h>
#include <meshwalk/weights.h>
#include <meshwalk/segment.h>
#include <meshwalk/volume.h>
#include <meshwalk/remap.h>
#include <meshwalk/remesh.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- sums ------------------------------------------------------------------------------------- */

static void sum_add(uint64_t *sum, uint64_t value)
{
    *sum = (*sum ^ value) * UINT64_C(0x9e3779b97f4a7c15);
    *sum ^= *sum >> 29;
}

static void sum_add_number(uint64_t *sum, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    sum_add(sum, bits);
}

static void sum_add_mesh(uint64_t *sum, const mw_mesh *mesh)
{
    uint32_t v[3];
    sum_add(sum, mw_mesh_vertex_count(mesh));
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
        mw_mesh_triangle(mesh, t, v);
        for (unsigned k = 0; k < 3; k++)
            sum_add(sum, (uint64_t)v[k] << 32 | mw_mesh_neighbour(mesh, t, k, NULL));
    }
}

static void sum_add_locations(uint64_t *sum, const mw_location *at, size_t n)
{
    for (size_t i = 0; i < n; i++)
        sum_add(sum, (uint64_t)at[i].triangle << 8 | (uint64_t)at[i].where);
}

static void expect(bool holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "after a failed call: %s\n", what);
    abort();
}

/* --- triangulations --------------------------------------------------------------------------- */

/* A mesh that was made, or was not. */
static mw_status mesh_made(mw_status status, mw_mesh *mesh, uint64_t *sum)
{
    expect(!status == (mesh != NULL), "there is a mesh");
    if (!status) sum_add_mesh(sum, mesh);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status run_delaunay(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    mw_mesh *mesh;
    mw_delaunay_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_delaunay(in->points, in->point_count, 2, &options, NULL, NULL, &mesh, error);
    return mesh_made(status, mesh, sum);
}

static mw_status kind_run(mw_triangulation_kind kind, const call_inputs *in,
                          const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_mesh *mesh;
    mw_kind_options options = {.threads = how->threads, .progress = how->progress};
    /* most other kinds take a hundred times as long, on one thread */
    enum { MOST = 1500 };
    bool all = kind == MW_KIND_DELAUNAY || kind == MW_KIND_REGULAR;
    uint32_t n = all || in->point_count < MOST ? in->point_count : MOST;
    mw_status status = mw_triangulate(kind, in->points, n, 2, &options, NULL, NULL, &mesh, error);
    return mesh_made(status, mesh, sum);
}

static mw_status run_kind_delaunay(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    return kind_run(MW_KIND_DELAUNAY, in, how, sum, error);
}

static mw_status run_kind_greedy(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                 mw_error *error)
{
    return kind_run(MW_KIND_GREEDY, in, how, sum, error);
}

static mw_status run_kind_min_weight(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                     mw_error *error)
{
    return kind_run(MW_KIND_MIN_WEIGHT, in, how, sum, error);
}

static mw_status run_kind_min_max_angle(const call_inputs *in, const call_setting *how,
                                        uint64_t *sum, mw_error *error)
{
    return kind_run(MW_KIND_MIN_MAX_ANGLE, in, how, sum, error);
}

static mw_status run_kind_regular(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                  mw_error *error)
{
    return kind_run(MW_KIND_REGULAR, in, how, sum, error);
}

static mw_status run_constrained(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                 mw_error *error)
{
    mw_mesh *mesh;
    mw_constrained_edges edges;
    mw_constraints constraints = {.points = in->points,
                                  .point_count = in->point_count,
                                  .segments = in->segments,
                                  .segment_count = in->segment_count};
    mw_constrain_options options = {
        .threads = how->threads, .progress = how->progress, .split = 1, .keep = MW_KEEP_HULL};
    mw_status status =
        mw_constrained_delaunay(&constraints, &options, NULL, NULL, &edges, &mesh, error);
    expect(!status || !edges.segment, "there are constrained edges");
    if (!status) mw_constrained_edges_release(&edges);
    return mesh_made(status, mesh, sum);
}

/* Two pentagons that cross. */
static mw_status run_polygons(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    enum { CORNERS = 5 };
    mw_polygons *polygons;
    mw_polygons_info info;
    uint32_t segments[4 * CORNERS], polygon[2 * CORNERS];
    for (uint32_t i = 0; i < 2 * CORNERS; i++) {
        uint32_t first = i < CORNERS ? 0 : CORNERS;
        segments[2 * i] = i;
        segments[2 * i + 1] = first + (i - first + 1) % CORNERS;
        polygon[i] = i / CORNERS;
    }
    mw_constraints rings = {.points = in->points,
                            .point_count = in->point_count,
                            .segments = segments,
                            .segment_count = 2 * CORNERS,
                            .polygon = polygon};
    mw_polygons_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_polygons_create(&rings, &options, &polygons, error);
    expect(!status == (polygons != NULL), "there are polygons");
    if (status) return status;
    mw_polygons_describe(polygons, &info);
    sum_add(sum, (uint64_t)info.passages << 32 | info.sets);
    mw_polygons_destroy(polygons);
    return MW_OK;
}

/* --- meshes ----------------------------------------------------------------------------------- */

static mw_status mesh_run(const call_inputs *in, mw_mesh_layout layout, const call_setting *how,
                          uint64_t *sum, mw_error *error)
{
    mw_mesh *mesh;
    mw_arrays view = arrays_view(&in->plain);
    mw_mesh_options options = {
        .layout = layout, .threads = how->threads, .progress = how->progress};
    mw_status status = mw_mesh_create(&view, &options, &mesh, error);
    return mesh_made(status, mesh, sum);
}

static mw_status run_mesh_laid_out(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    return mesh_run(in, MW_LAYOUT_HILBERT, how, sum, error);
}

static mw_status run_mesh_as_given(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    return mesh_run(in, MW_LAYOUT_AS_GIVEN, how, sum, error);
}

static mw_status check_made(mw_status status, mw_check *check, uint64_t *sum)
{
    expect(!status || (!check->defects && check->defect_count == 0), "there are defects");
    for (size_t i = 0; i < check->defect_count; i++)
        sum_add(sum, (uint64_t)check->defects[i].kind << 32 | check->defects[i].triangle);
    mw_check_release(check);
    return status;
}

static mw_status run_check(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    mw_check check;
    mw_arrays view = arrays_view(&in->plain);
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    return check_made(mw_check_arrays(&view, &options, &check, error), &check, sum);
}

static mw_status run_check_damaged(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    mw_check check;
    mw_arrays view = arrays_view(&in->damaged);
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    return check_made(mw_check_arrays(&view, &options, &check, error), &check, sum);
}

static mw_status run_mend(const call_inputs *in, const call_setting *how, uint64_t *sum,
                          mw_error *error)
{
    mw_mended mended;
    mw_arrays view = arrays_view(&in->damaged);
    mw_mend_options options = {.progress = how->progress};
    mw_status status = mw_mend_arrays(&view, &options, &mended, error);
    expect(!status || (!mended.triangles && mended.change_count == 0), "there is a mended mesh");
    for (size_t i = 0; i < 3 * mended.triangle_count; i++) sum_add(sum, mended.triangles[i]);
    for (size_t i = 0; i < mended.change_count; i++) sum_add(sum, mended.changes[i].triangle);
    mw_mended_release(&mended);
    return status;
}

static mw_status run_describe(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    mw_mesh_info info;
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_mesh_describe(in->holed, &options, &info, error);
    if (!status) sum_add(sum, (uint64_t)info.holes << 32 | info.border_edges);
    return status;
}

/* --- locators --------------------------------------------------------------------------------- */

static mw_status locator_run(const mw_mesh *mesh, mw_locator_options options,
                             const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_locator *locator;
    mw_locator_info info;
    options.threads = how->threads;
    options.progress = how->progress;
    mw_status status = mw_locator_create(mesh, &options, &locator, error);
    expect(!status == (locator != NULL), "there is a locator");
    if (status) return status;
    mw_locator_describe(locator, &info);
    sum_add(sum, (uint64_t)info.ghost_triangles << 32 | info.holes);
    mw_locator_destroy(locator);
    return MW_OK;
}

static mw_status run_locator(const call_inputs *in, const call_setting *how, uint64_t *sum,
                             mw_error *error)
{
    return locator_run(in->mesh, (mw_locator_options){.border = 1, .areas = 1}, how, sum, error);
}

static mw_status run_locator_crowded(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                     mw_error *error)
{
    return locator_run(in->crowded, (mw_locator_options){0}, how, sum, error);
}

static mw_status run_locator_filled(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                    mw_error *error)
{
    return locator_run(in->holed, (mw_locator_options){.fill = MW_FILL_YES}, how, sum, error);
}

static mw_status run_locator_open(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                  mw_error *error)
{
    return locator_run(in->holed, (mw_locator_options){.fill = MW_FILL_NO}, how, sum, error);
}

static mw_status index_run(const call_inputs *in, mw_start_kind start, const call_setting *how,
                           uint64_t *sum, mw_error *error)
{
    mw_index *index;
    mw_index_info info;
    mw_index_options options = {.progress = how->progress};
    mw_status status = mw_index_create(in->locator, start, &options, &index, error);
    expect(!status == (index != NULL), "there is an index");
    if (status) return status;
    mw_index_describe(index, &info);
    sum_add(sum, (uint64_t)info.cells << 32 | info.layers);
    mw_index_destroy(index);
    return MW_OK;
}

static mw_status run_index_grid(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                mw_error *error)
{
    return index_run(in, MW_START_GRID, how, sum, error);
}

static mw_status run_index_two_level(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                     mw_error *error)
{
    return index_run(in, MW_START_TWO_LEVEL_GRID, how, sum, error);
}

static mw_status run_index_curve(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                 mw_error *error)
{
    return index_run(in, MW_START_CURVE, how, sum, error);
}

static mw_status run_index_layers(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                  mw_error *error)
{
    return index_run(in, MW_START_LAYERS, how, sum, error);
}

static mw_status run_index_buckets(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    return index_run(in, MW_START_BUCKETS, how, sum, error);
}

static mw_status run_index_triangle_buckets(const call_inputs *in, const call_setting *how,
                                            uint64_t *sum, mw_error *error)
{
    return index_run(in, MW_START_TRIANGLE_BUCKETS, how, sum, error);
}

static mw_status run_index_kd_tree(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    return index_run(in, MW_START_KD_TREE, how, sum, error);
}

static mw_status run_index_chains(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                  mw_error *error)
{
    return index_run(in, MW_START_CHAINS, how, sum, error);
}

static mw_status run_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    mw_location *at = malloc(in->point_count * sizeof *at);
    mw_query_options options = {
        .start = MW_START_SORTED, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_locate_batch(in->locator, in->points, in->point_count, 2, &options, at, NULL, error);
    if (!status) sum_add_locations(sum, at, in->point_count);
    free(at);
    return status;
}

/* From point to point. */
static mw_status run_segments(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    mw_segment_pieces pieces;
    mw_segment_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_segment_batch(in->locator, in->points, in->point_count - 1, 2, &options, &pieces, error);
    expect(!status == (pieces.offset != NULL), "there are pieces");
    for (size_t i = 0; i < pieces.piece_count; i++) sum_add(sum, pieces.piece[i].triangle);
    mw_segment_pieces_release(&pieces);
    return status;
}

/* Each vertex is as high as its x. */
static mw_status run_volume_above(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                  mw_error *error)
{
    mw_volume_info info;
    mw_volume_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_volume_above(in->locator, in->points, 0.5, &options, &info, error);
    if (!status) sum_add(sum, info.parts), sum_add_number(sum, info.cut);
    return status;
}

static mw_status run_volume_between(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                    mw_error *error)
{
    mw_volume_info info;
    mw_volume_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_volume_between(in->locator, in->points, in->locator, in->points, &options, &info, error);
    if (!status) sum_add(sum, info.parts), sum_add_number(sum, info.cut);
    return status;
}

static mw_status run_surface_area(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                  mw_error *error)
{
    mw_surface_area_info info;
    mw_volume_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_surface_area(in->locator, in->points, in->locator, &options, &info, error);
    if (!status) sum_add(sum, info.parts), sum_add_number(sum, info.surface_area);
    return status;
}

static mw_status remap_sum(mw_status status, mw_remap *r, uint64_t *sum)
{
    expect(!status == (r->weights != NULL), "there are weights");
    if (!status) sum_add_number(sum, r->common_sum), sum_add_number(sum, r->source_fraction[0]);
    mw_remap_release(r);
    return status;
}

static mw_status run_remap_to_mesh(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    mw_remap r;
    mw_remap_mesh mesh = {.locator = in->locator};
    mw_remap_options options = {.threads = how->threads, .progress = how->progress};
    return remap_sum(mw_remap_to_mesh(&mesh, &mesh, &options, &r, error), &r, sum);
}

static mw_status run_remap_to_pixels(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                     mw_error *error)
{
    mw_remap r;
    mw_remap_mesh mesh = {.locator = in->locator};
    mw_remap_pixels pixels = {0, 1, 0.1, 0.1, 10, 10};
    mw_remap_options options = {.threads = how->threads, .progress = how->progress};
    return remap_sum(mw_remap_to_pixels(&mesh, &pixels, &options, &r, error), &r, sum);
}

static mw_status run_table(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    enum { VALUES = 3 };
    size_t n = in->point_count;
    mw_location *at = malloc(n * sizeof *at);
    double *result = calloc(VALUES * n, sizeof *result);
    /* x, then x of the next vertices */
    mw_value_table table = {.values = in->points, .count = VALUES, .step = 2};
    mw_query_options query = {.threads = how->threads};
    mw_interpolate_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_locate_batch(in->locator, in->points, n, 2, &query, at, NULL, error);
    if (!status) status = mw_interpolate_table(in->mesh, &table, at, n, &options, result, error);
    for (size_t i = 0; i < VALUES * n && !status; i++)
        sum_add(sum, (uint64_t)llrint(result[i] * 1e6));
    free(result);
    free(at);
    return status;
}

/* --- borrowed arrays -------------------------------------------------------------------------- */

static mw_status borrow_run(const call_inputs *in, mw_borrow_options options, mw_borrowed **mesh,
                            mw_error *error)
{
    mw_borrowed_arrays foreign = {.mesh = arrays_view(&in->whole), .neighbours = in->neighbours};
    mw_status status = mw_mesh_borrow(&foreign, &options, mesh, error);
    expect(!status == (*mesh != NULL), "there is a borrowed mesh");
    return status;
}

/* An operator that was made, or was not. */
static mw_status operator_made(mw_status status, mw_operator *weights, uint64_t *sum)
{
    mw_operator_info info;
    expect(!status == (weights != NULL), "there is an operator");
    if (status) return status;
    mw_operator_describe(weights, &info);
    sum_add(sum, (uint64_t)info.rows << 32 | info.entries);
    mw_operator_destroy(weights);
    return MW_OK;
}

static mw_operator *operator_of(const call_inputs *in, const call_setting *how, mw_status *status,
                                mw_error *error)
{
    mw_operator *weights = NULL;
    mw_location *at = malloc(in->point_count * sizeof *at);
    mw_query_options alone = {.threads = 1};
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    expect_ok(mw_locate_batch(in->locator, in->points, in->point_count, 2, &alone, at, NULL, error),
              "locations", error);
    *status = mw_operator_create(in->mesh, at, in->point_count, &options, &weights, error);
    free(at);
    return weights;
}

static mw_status run_operator(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    mw_status status;
    mw_operator *weights = operator_of(in, how, &status, error);
    return operator_made(status, weights, sum);
}

static mw_status run_transpose(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    mw_status status;
    mw_operator *turned = NULL,
                *weights = operator_of(in, &(call_setting){.threads = 1}, &status, error);
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    status = mw_operator_transpose(weights, &options, &turned, error);
    mw_operator_destroy(weights);
    return operator_made(status, turned, sum);
}

/* Nearest points of the ball, found beforehand, as places. */
static mw_status run_operator_surface(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                      mw_error *error)
{
    const uint32_t n = in->ball.triangles;
    mw_nearest_surface_point *at = malloc(n * sizeof *at + 1);
    mw_operator *weights;
    for (uint32_t i = 0; i < n; i++)
        at[i] = (mw_nearest_surface_point){.triangle = i * 7919u % n, .weight = {0.5, 0.25, 0.25}};
    const mw_hits hits = mw_hits_of_nearest(at, n);
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_operator_create_on_surface(in->surface, &hits, &options, &weights, error);
    free(at);
    return operator_made(status, weights, sum);
}

static mw_status run_operator_entries(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                      mw_error *error)
{
    mw_operator *weights;
    double *ones = malloc(in->point_count * sizeof *ones);
    uint32_t *number = malloc(in->point_count * sizeof *number);
    for (uint32_t i = 0; i < in->point_count; i++) {
        ones[i] = 1;
        number[i] = i;
    }
    mw_operator_entries entries = {.row = number,
                                   .column = number,
                                   .weight = ones,
                                   .count = in->point_count,
                                   .rows = in->point_count,
                                   .columns = in->point_count};
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_operator_create_from_entries(&entries, &options, &weights, error);
    free(number);
    free(ones);
    return operator_made(status, weights, sum);
}

static mw_status run_operator_apply(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                    mw_error *error)
{
    mw_status status;
    mw_operator *weights = operator_of(in, &(call_setting){.threads = 1}, &status, error);
    double *result = malloc(2 * in->point_count * sizeof *result);
    mw_value_table table = {.values = in->points, .count = 2};
    mw_operator_apply_options options = {.threads = how->threads, .progress = how->progress};
    status = mw_operator_apply(weights, &table, &options, result, error);
    for (uint32_t i = 0; i < in->point_count && !status; i++)
        sum_add(sum, (uint64_t)(result[2 * i] * 1e9));
    free(result);
    mw_operator_destroy(weights);
    return status;
}

static mw_status run_borrow(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    mw_borrowed *mesh;
    mw_borrowed_info info;
    mw_borrow_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = borrow_run(in, options, &mesh, error);
    if (status) return status;
    mw_borrowed_describe(mesh, &info);
    sum_add(sum, (uint64_t)info.convex << 32 | info.clockwise_triangles);
    mw_borrowed_release(mesh);
    return MW_OK;
}

static mw_status run_borrowed_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                    mw_error *error)
{
    mw_borrowed *mesh;
    mw_status status =
        borrow_run(in, (mw_borrow_options){.unchecked = 1, .convex = 1}, &mesh, error);
    if (status) return status;
    mw_location *at = malloc(in->point_count * sizeof *at);
    mw_borrowed_query_options options = {.threads = how->threads, .progress = how->progress};
    status =
        mw_borrowed_locate_batch(mesh, in->points, in->point_count, 2, &options, at, NULL, error);
    if (!status) sum_add_locations(sum, at, in->point_count);
    free(at);
    mw_borrowed_release(mesh);
    return status;
}

/* --- editors ---------------------------------------------------------------------------------- */

static mw_status run_editor(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    mw_editor *editor;
    mw_editor_info info;
    mw_editor_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_editor_create(in->mesh, &options, &editor, error);
    expect(!status == (editor != NULL), "there is an editor");
    if (status) return status;
    mw_editor_describe(editor, &info);
    sum_add(sum, info.triangles);
    mw_editor_destroy(editor);
    return MW_OK;
}

/* The editor's own calls are watched only if it was made with `progress`; so all of them are one
 * call here. What an editor holds must be the same before and after one that fails. */
static uint64_t editor_sum(const mw_editor *editor)
{
    uint64_t sum = 0;
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    sum_add(&sum, (uint64_t)info.triangles << 32 | info.vertices);
    sum_add(&sum, info.edits);
    return sum;
}

static mw_status editor_edit(mw_editor *editor, const call_inputs *in, uint64_t *sum,
                             mw_error *error)
{
    enum { MOST = 200 };
    double more[2 * MOST];
    uint32_t n = in->point_count - 1 < MOST ? in->point_count - 1 : MOST;
    mw_mesh *mesh = NULL;
    mw_index_options layers = {0};
    const mw_index *index;
    uint64_t before = editor_sum(editor);
    for (uint32_t i = 0; i < 2 * n; i++) more[i] = 0.5 * (in->points[i] + in->points[i + 2]);
    mw_status status = mw_edit_insert_points(editor, more, n, 2, NULL, NULL, error);
    expect(!status || before == editor_sum(editor), "the editor has changed");
    if (!status) status = mw_editor_index(editor, MW_START_LAYERS, &layers, &index, error);
    if (!status) before = editor_sum(editor), status = mw_editor_compact(editor, NULL, NULL, error);
    expect(!status || before == editor_sum(editor), "the editor has changed");
    if (!status) {
        status = mw_editor_mesh(editor, NULL, NULL, &mesh, error);
        mesh_made(status, mesh, sum);
    }
    return status;
}

static mw_status run_edits(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    mw_editor *editor;
    mw_editor_options options = {.threads = how->threads, .progress = how->progress, .undo = 2};
    mw_status status = mw_editor_create(in->mesh, &options, &editor, error);
    if (!status) status = editor_edit(editor, in, sum, error);
    mw_editor_destroy(editor);
    return status;
}

/* --- space ------------------------------------------------------------------------------------ */

static mw_status run_surface(const call_inputs *in, const call_setting *how, uint64_t *sum,
                             mw_error *error)
{
    mw_surface *surface;
    mw_arrays view = star_shape_arrays(&in->ball);
    mw_surface_options options = {.weld = 1, .progress = how->progress};
    mw_status status = mw_surface_create(&view, &options, &surface, error);
    expect(!status == (surface != NULL), "there is a surface");
    if (!status) sum_add(sum, mw_surface_triangle_count(surface));
    mw_surface_destroy(surface);
    return status;
}

static mw_status run_surface_check(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    mw_check check;
    mw_arrays view = star_shape_arrays(&in->ball);
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    return check_made(mw_surface_check_arrays(&view, 0, &options, &check, error), &check, sum);
}

static mw_status run_star_check(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                mw_error *error)
{
    mw_check check;
    mw_arrays view = star_shape_arrays(&in->ball);
    mw_star_options options = {.threads = how->threads, .progress = how->progress};
    return check_made(mw_star_check_arrays(&view, 0, &options, &check, error), &check, sum);
}

static mw_status run_star(const call_inputs *in, const call_setting *how, uint64_t *sum,
                          mw_error *error)
{
    mw_star *star;
    mw_star_info info;
    mw_star_options options = {.angles = 1, .threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_create(in->surface, &options, &star, error);
    expect(!status == (star != NULL), "there is a star");
    if (status) return status;
    mw_star_describe(star, &info);
    sum_add(sum, info.bytes);
    mw_star_destroy(star);
    return MW_OK;
}

static mw_status run_star_borrowed(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    mw_star *star;
    mw_location *at = malloc(in->ball.points * sizeof *at);
    mw_star_options options = {.borrow = 1, .threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_create(in->surface, &options, &star, error);
    expect(!status == (star != NULL), "there is a star");
    if (!status)
        status = mw_star_locate_batch(star, in->ball.point, in->ball.points, 3,
                                      &(mw_star_query_options){.threads = how->threads}, at, NULL,
                                      error);
    if (!status) sum_add_locations(sum, at, in->ball.points);
    free(at);
    mw_star_destroy(star);
    return status;
}

static mw_status star_index_run(const call_inputs *in, mw_star_start_kind start,
                                const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_star_index *index;
    mw_star_index_info info;
    mw_star_index_options options = {.progress = how->progress};
    mw_status status = mw_star_index_create(in->star, start, &options, &index, error);
    expect(!status == (index != NULL), "there is an index");
    if (status) return status;
    mw_star_index_describe(index, &info);
    sum_add(sum, info.cells);
    mw_star_index_destroy(index);
    return MW_OK;
}

static mw_status run_star_grid(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    return star_index_run(in, MW_STAR_START_GRID, how, sum, error);
}

static mw_status run_star_octahedron(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                     mw_error *error)
{
    return star_index_run(in, MW_STAR_START_OCTAHEDRON, how, sum, error);
}

static mw_status run_star_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                mw_error *error)
{
    mw_location *at = malloc(in->ball.points * sizeof *at);
    mw_star_query_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_locate_batch(in->star, in->ball.point, in->ball.points, 3, &options,
                                            at, NULL, error);
    if (!status) sum_add_locations(sum, at, in->ball.points);
    free(at);
    return status;
}

static mw_status run_star_project(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                  mw_error *error)
{
    const size_t n = 3 * (size_t)in->ball.points;
    double *meeting = malloc(n * sizeof *meeting);
    mw_star_query_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_project_batch(in->star, in->ball.point, in->ball.points, 3, &options,
                                             meeting, NULL, error);
    for (size_t i = 0; i < n && !status; i++) sum_add_number(sum, meeting[i]);
    free(meeting);
    return status;
}

/* An icosphere of level 6. */
static mw_status run_remesh(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    enum { LEVEL = 6, VERTICES = 10 * 4096 + 2, TRIANGLES = 20 * 4096 };
    double *points = malloc(3 * VERTICES * sizeof *points);
    uint32_t *triangles = malloc(3 * TRIANGLES * sizeof *triangles);
    mw_remesh_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_star_remesh(in->star, LEVEL, &options, points, triangles, NULL, error);
    for (size_t i = 0; i < 3 * VERTICES && !status; i++) sum_add_number(sum, points[i]);
    free(points);
    free(triangles);
    return status;
}

static mw_status run_icosphere(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    enum { LEVEL = 6, VERTICES = 10 * 4096 + 2, TRIANGLES = 20 * 4096 };
    double *points = malloc(3 * VERTICES * sizeof *points);
    uint32_t *triangles = malloc(3 * TRIANGLES * sizeof *triangles);
    mw_remesh_options options = {.threads = how->threads, .progress = how->progress};
    (void)in;
    mw_status status = mw_icosphere_create(LEVEL, &options, points, triangles, error);
    for (size_t i = 0; i < 3 * TRIANGLES && !status; i++) sum_add(sum, triangles[i]);
    free(points);
    free(triangles);
    return status;
}

static mw_status run_deviation(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    mw_deviation d;
    mw_remesh_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_surface_deviation(in->surface, in->prober, &options, &d, error);
    if (!status) sum_add_number(sum, d.at_most);
    return status;
}

static mw_status run_prober(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    mw_prober *prober;
    mw_prober_info info;
    mw_prober_options options = {
        .boxes = 1, .threads = how->threads, .progress = how->progress, .guide = 1};
    mw_status status = mw_prober_create(in->surface, &options, &prober, error);
    expect(!status == (prober != NULL), "there is a prober");
    if (status) return status;
    mw_prober_describe(prober, &info);
    sum_add(sum, info.bytes);
    mw_prober_destroy(prober);
    return MW_OK;
}

static mw_status run_probe_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                 mw_error *error)
{
    size_t n = in->ball.points / 4;
    mw_touch *touches = malloc(n * sizeof *touches);
    mw_probe_options options = {.certain = 1, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_probe_batch(in->prober, in->ball.point, n, 6, &options, touches, NULL, error);
    for (size_t i = 0; i < n && !status; i++) sum_add(sum, touches[i].triangle);
    free(touches);
    return status;
}

static mw_status run_probe_any(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    size_t n = in->ball.points / 4;
    uint8_t *states = malloc(n);
    mw_probe_options options = {.certain = 1, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_probe_any_batch(in->prober, in->ball.point, n, 6, &options, states, NULL, error);
    for (size_t i = 0; i < n && !status; i++) sum_add(sum, states[i]);
    free(states);
    return status;
}

static mw_status run_probe_all(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    size_t n = in->ball.points / 4;
    mw_touch_lists lists;
    mw_probe_options options = {.certain = 1, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_probe_all_batch(in->prober, in->ball.point, n, 6, &options, &lists, NULL, error);
    expect(!status || (!lists.offset && !lists.touch), "there are no touches");
    for (size_t i = 0; i < lists.touch_count; i++) sum_add(sum, lists.touch[i].triangle);
    mw_touch_lists_release(&lists);
    return status;
}

static mw_status run_nearest_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    size_t n = in->ball.points / 2;
    mw_nearest_surface_point *at = malloc(n * sizeof *at);
    mw_nearest_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_nearest_on_surface_batch(in->prober, in->ball.point, n, 6, INFINITY,
                                                   &options, at, error);
    for (size_t i = 0; i < n && !status; i++) {
        sum_add(sum, at[i].triangle);
        sum_add_number(sum, at[i].point[0]);
    }
    free(at);
    return status;
}

/* --- files ------------------------------------------------------------------------------------ */

static mw_status run_read(const call_inputs *in, const call_setting *how, uint64_t *sum,
                          mw_error *error)
{
    mw_mesh_file file;
    mw_file_options options = {.progress = how->progress};
    mw_status status = mw_read_mesh(in->path, &options, &file, error);
    expect(!status || (!file.points && !file.triangles), "there is something from the file");
    if (!status) sum_add(sum, (uint64_t)file.point_count << 32 | file.triangle_count);
    mw_mesh_file_release(&file);
    return status;
}

static mw_status run_read_lines(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                mw_error *error)
{
    mw_constraint_file file;
    mw_file_options options = {.progress = how->progress};
    mw_status status = mw_read_constraints(in->lines, &options, &file, error);
    expect(!status || (!file.points && !file.segments), "there is something from the file");
    if (!status) sum_add(sum, (uint64_t)file.point_count << 32 | file.segment_count);
    mw_constraint_file_release(&file);
    return status;
}

static mw_status write_run(const call_inputs *in, const char *ending, const call_setting *how,
                           mw_error *error)
{
    char path[80];
    mw_mesh_file file;
    mw_file_options options = {.progress = how->progress};
    expect_ok(mw_read_mesh(in->path, NULL, &file, error), "a file", error);
    snprintf(path, sizeof path, "%s%s", in->path, ending);
    mw_status status = mw_write_mesh(path, &file, NULL, &options, error);
    expect(!status == (access(path, F_OK) == 0), "there is a file");
    mw_mesh_file_release(&file);
    unlink(path);
    return status;
}

static mw_status run_write(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    (void)sum;
    return write_run(in, ".ply", how, error);
}

static mw_status run_write_pair(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                mw_error *error)
{
    char path[80];
    (void)sum;
    mw_status status = write_run(in, ".node", how, error);
    snprintf(path, sizeof path, "%s.ele", in->path);
    expect(!status == (access(path, F_OK) == 0), "there is a second file");
    unlink(path);
    return status;
}

static mw_status run_write_weights(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                   mw_error *error)
{
    char path[80];
    mw_status status;
    mw_operator *weights = operator_of(in, &(call_setting){.threads = 1}, &status, error);
    mw_file_options options = {.progress = how->progress};
    (void)sum;
    snprintf(path, sizeof path, "%s.npz", in->path);
    status = mw_write_weights(path, weights, NULL, &options, error);
    expect(!status == (access(path, F_OK) == 0), "there is a file of weights");
    unlink(path);
    mw_operator_destroy(weights);
    return status;
}

static mw_status run_write_tiles(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                 mw_error *error)
{
    static const char *const names[] = {"overview.mwm", "tile-00000.mwm", "tile-00001.mwm",
                                        "tiles.json"};
    char folder[80], path[120];
    mw_tile_options options = {.tiles = 2, .threads = how->threads, .progress = how->progress};
    (void)sum;
    snprintf(folder, sizeof folder, "%s.tiles", in->path);
    mw_status status = mw_write_tiles(in->locator, folder, &options, error);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        expect(!status == (unlink(path) == 0), "there is a file of a tile");
    }
    expect(!status == (rmdir(folder) == 0), "there is a folder");
    return status;
}

const long_call long_calls[] = {
    {"mw_delaunay", run_delaunay},
    {"mw_triangulate, Delaunay", run_kind_delaunay},
    {"mw_triangulate, greedy", run_kind_greedy},
    {"mw_triangulate, least weight", run_kind_min_weight},
    {"mw_triangulate, least angle", run_kind_min_max_angle},
    {"mw_triangulate, regular", run_kind_regular},
    {"mw_constrained_delaunay", run_constrained},
    {"mw_polygons_create", run_polygons},
    {"mw_mesh_create, laid out", run_mesh_laid_out},
    {"mw_mesh_create, as given", run_mesh_as_given},
    {"mw_check_arrays", run_check},
    {"mw_check_arrays, damaged", run_check_damaged},
    {"mw_mend_arrays", run_mend},
    {"mw_mesh_describe", run_describe},
    {"mw_locator_create", run_locator},
    {"mw_locator_create, crowded", run_locator_crowded},
    {"mw_locator_create, filled", run_locator_filled},
    {"mw_locator_create, open", run_locator_open},
    {"mw_index_create, grid", run_index_grid},
    {"mw_index_create, two levels", run_index_two_level},
    {"mw_index_create, curve", run_index_curve},
    {"mw_index_create, layers", run_index_layers},
    {"mw_index_create, buckets", run_index_buckets},
    {"mw_index_create, triangle buckets", run_index_triangle_buckets},
    {"mw_index_create, kd tree", run_index_kd_tree},
    {"mw_index_create, chains", run_index_chains},
    {"mw_locate_batch", run_batch},
    {"mw_segment_batch", run_segments},
    {"mw_remap_to_mesh", run_remap_to_mesh},
    {"mw_remap_to_pixels", run_remap_to_pixels},
    {"mw_surface_area", run_surface_area},
    {"mw_volume_above", run_volume_above},
    {"mw_volume_between", run_volume_between},
    {"mw_interpolate_table", run_table},
    {"mw_operator_create", run_operator},
    {"mw_operator_create_on_surface", run_operator_surface},
    {"mw_operator_create_from_entries", run_operator_entries},
    {"mw_operator_transpose", run_transpose},
    {"mw_operator_apply", run_operator_apply},
    {"mw_mesh_borrow", run_borrow},
    {"mw_borrowed_locate_batch", run_borrowed_batch},
    {"mw_editor_create", run_editor},
    {"an editor's calls", run_edits},
    {"mw_surface_create", run_surface},
    {"mw_surface_check_arrays", run_surface_check},
    {"mw_star_check_arrays", run_star_check},
    {"mw_star_create", run_star},
    {"mw_star_create, borrowed", run_star_borrowed},
    {"mw_star_index_create, grid", run_star_grid},
    {"mw_star_index_create, octahedron", run_star_octahedron},
    {"mw_star_locate_batch", run_star_batch},
    {"mw_star_project_batch", run_star_project},
    {"mw_star_remesh", run_remesh},
    {"mw_icosphere_create", run_icosphere},
    {"mw_surface_deviation", run_deviation},
    {"mw_prober_create", run_prober},
    {"mw_probe_batch", run_probe_batch},
    {"mw_probe_any_batch", run_probe_any},
    {"mw_probe_all_batch", run_probe_all},
    {"mw_nearest_on_surface_batch", run_nearest_batch},
    {"mw_read_mesh", run_read},
    {"mw_read_constraints", run_read_lines},
    {"mw_write_mesh", run_write},
    {"mw_write_mesh, two files", run_write_pair},
    {"mw_write_weights", run_write_weights},
    {"mw_write_tiles", run_write_tiles},
};
const size_t long_call_count = sizeof long_calls / sizeof *long_calls;
