/* call_meshes.c - long calls: triangulations and meshes, made, checked and mended. */
#include "support/calls/call_runs.h"

#include <meshwalk/polygons.h>

/* --- triangulations --------------------------------------------------------------------------- */

mw_status run_delaunay(const call_inputs *in, const call_setting *how, uint64_t *sum,
                       mw_error *error)
{
    mw_mesh *mesh;
    mw_delaunay_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_delaunay(in->points, in->point_count, 2, &options, NULL, NULL, &mesh, error);
    return call_mesh_made(status, mesh, sum);
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
    return call_mesh_made(status, mesh, sum);
}

mw_status run_kind_delaunay(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    return kind_run(MW_KIND_DELAUNAY, in, how, sum, error);
}

mw_status run_kind_greedy(const call_inputs *in, const call_setting *how, uint64_t *sum,
                          mw_error *error)
{
    return kind_run(MW_KIND_GREEDY, in, how, sum, error);
}

mw_status run_kind_min_weight(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    return kind_run(MW_KIND_MIN_WEIGHT, in, how, sum, error);
}

mw_status run_kind_min_max_angle(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                 mw_error *error)
{
    return kind_run(MW_KIND_MIN_MAX_ANGLE, in, how, sum, error);
}

mw_status run_kind_regular(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    return kind_run(MW_KIND_REGULAR, in, how, sum, error);
}

mw_status run_constrained(const call_inputs *in, const call_setting *how, uint64_t *sum,
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
    call_expect(!status || !edges.segment, "there are constrained edges");
    if (!status) mw_constrained_edges_release(&edges);
    return call_mesh_made(status, mesh, sum);
}

/* Two pentagons that cross. */
mw_status run_polygons(const call_inputs *in, const call_setting *how, uint64_t *sum,
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
    call_expect(!status == (polygons != NULL), "there are polygons");
    if (status) return status;
    mw_polygons_describe(polygons, &info);
    call_sum(sum, (uint64_t)info.passages << 32 | info.sets);
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
    return call_mesh_made(status, mesh, sum);
}

mw_status run_mesh_laid_out(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    return mesh_run(in, MW_LAYOUT_HILBERT, how, sum, error);
}

mw_status run_mesh_as_given(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    return mesh_run(in, MW_LAYOUT_AS_GIVEN, how, sum, error);
}

mw_status run_check(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_check check;
    mw_arrays view = arrays_view(&in->plain);
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    return call_check_made(mw_check_arrays(&view, &options, &check, error), &check, sum);
}

mw_status run_check_damaged(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    mw_check check;
    mw_arrays view = arrays_view(&in->damaged);
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    return call_check_made(mw_check_arrays(&view, &options, &check, error), &check, sum);
}

mw_status run_mend(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_mended mended;
    mw_arrays view = arrays_view(&in->damaged);
    mw_mend_options options = {.progress = how->progress};
    mw_status status = mw_mend_arrays(&view, &options, &mended, error);
    call_expect(!status || (!mended.triangles && mended.change_count == 0),
                "there is a mended mesh");
    for (size_t i = 0; i < 3 * mended.triangle_count; i++) call_sum(sum, mended.triangles[i]);
    for (size_t i = 0; i < mended.change_count; i++) call_sum(sum, mended.changes[i].triangle);
    mw_mended_release(&mended);
    return status;
}

mw_status run_describe(const call_inputs *in, const call_setting *how, uint64_t *sum,
                       mw_error *error)
{
    mw_mesh_info info;
    mw_check_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_mesh_describe(in->holed, &options, &info, error);
    if (!status) call_sum(sum, (uint64_t)info.holes << 32 | info.border_edges);
    return status;
}
