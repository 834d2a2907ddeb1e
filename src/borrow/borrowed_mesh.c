/* borrowed_mesh.c - makes and releases a view of the caller's arrays. */
#include "base/options.h"
#include "borrow/borrowed.h"
#include "mesh/arrays.h"

#include <stdlib.h>

/* The extent of a few triangles: where batches sort their queries. */
static void borrowed_mesh_look(mw_borrowed *mesh)
{
    enum { LOOKS = 64 };
    uint32_t step = mesh->tri_count / LOOKS + 1;
    mesh->low[0] = mesh->low[1] = INFINITY;
    mesh->high[0] = mesh->high[1] = -INFINITY;
    for (uint32_t t = 0; t < mesh->tri_count; t += step) {
        mw_borrowed_tile tile;
        if (!mw__borrowed_read(mesh, t, &tile) || !mw__borrowed_is_finite(&tile)) continue;
        for (uint32_t k = 0; k < 3; k++) {
            mesh->low[0] = fmin(mesh->low[0], tile.p[k].x);
            mesh->low[1] = fmin(mesh->low[1], tile.p[k].y);
            mesh->high[0] = fmax(mesh->high[0], tile.p[k].x);
            mesh->high[1] = fmax(mesh->high[1], tile.p[k].y);
        }
    }
}

static mw_status borrowed_mesh_validate(const mw_borrowed_arrays *arrays,
                                        const mw_borrow_options *options, mw_error *error)
{
    mw_status status = MW_RESERVED_CHECK(mw_borrow_options, options, error);
    if (!status) status = mw__arrays_validate(arrays ? &arrays->mesh : NULL, 2, error);
    if (status) return status;
    if (!arrays->neighbours && arrays->mesh.triangle_count)
        return mw__fail(error, MW_ERROR_ARGUMENT, "neighbours are missing");
    if ((unsigned)arrays->layout > MW_NEIGHBOUR_ACROSS_EDGE)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown layout of neighbours");
    if (options->convex && !options->unchecked)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the option 'convex' needs 'unchecked': the check decides this by itself");
    return MW_OK;
}

static mw_borrowed borrowed_mesh_view(const mw_borrowed_arrays *arrays,
                                      const mw_borrow_options *options)
{
    return (mw_borrowed){
        .points = arrays->mesh.points,
        .triangles = arrays->mesh.triangles,
        .neighbours = arrays->neighbours,
        .stride = arrays->mesh.point_stride ? arrays->mesh.point_stride : 2,
        .point_count = (uint32_t)arrays->mesh.point_count,
        .tri_count = (uint32_t)arrays->mesh.triangle_count,
        .turn = arrays->layout == MW_NEIGHBOUR_ACROSS_EDGE,
        .wide = arrays->mesh.integer_type == MW_INT64,
        .checked = !options->unchecked,
        .convex = options->convex,
    };
}

mw_status mw_mesh_borrow(const mw_borrowed_arrays *arrays, const mw_borrow_options *options,
                         mw_borrowed **out, mw_error *error)
{
    static const mw_borrow_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
    *out = NULL;
    if (!options) options = &defaults;
    mw_status status = borrowed_mesh_validate(arrays, options, error);
    if (status) return status;
    mw_borrowed *mesh = mw__alloc(1, sizeof *mesh);
    if (!mesh) return mw__fail_memory(error);
    *mesh = borrowed_mesh_view(arrays, options);
    borrowed_mesh_look(mesh);
    if (mesh->checked) {
        mw_job job = mw__job(options->threads, options->progress);
        status = mw__job_end(&job, mw__borrowed_check(mesh, &job, error), error);
    }
    if (status)
        free(mesh);
    else
        *out = mesh;
    return status;
}

void mw_borrowed_release(mw_borrowed *mesh)
{
    free(mesh);
}

void mw_borrowed_describe(const mw_borrowed *mesh, mw_borrowed_info *info)
{
    *info = (mw_borrowed_info){
        .bytes = sizeof *mesh,
        .checked = mesh->checked,
        .convex = mesh->convex,
        .flat_triangles = mesh->flat_count,
        .clockwise_triangles = mesh->reversed_count,
    };
}
