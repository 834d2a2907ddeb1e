/* locator.c - preparing a mesh for queries. */
#include "locate/locator.h"

#include "mesh/order.h"
#include "start/start.h"

#include <stdio.h>
#include <stdlib.h>

/* Share of links, of a few tiles spread over the array, that lead far away in memory. Walking a mesh whose neighbours lie
 * apart costs a cache miss a step; laid out along a Hilbert curve few links lead farther than this. */
static bool scattered(const mw_tiling *tiling)
{
    enum { SMALL = 1 << 14, PROBES = 4096, FAR = 4096 };
    if (tiling->tri_count < SMALL) return false; /* fits the cache in any order */
    uint32_t links = 0, far = 0, stride = tiling->tri_count / PROBES + 1;
    for (uint32_t t = 0; t < tiling->tri_count; t += stride)
        for (int k = 0; k < 3; k++) {
            if (tiling->tri[t].link[k] == MW_NONE) continue;
            uint32_t other = mw__link_triangle(tiling->tri[t].link[k]);
            links++;
            far += (other > t ? other - t : t - other) > FAR;
        }
    return far > links / 4;
}

static mw_status prepare(mw_locator *locator, const mw_locator_options *options, mw_error *error)
{
    mw_tiling *tiling = &locator->tiling;
    mw_status status = mw__tiling_create(locator->mesh, options->any, tiling, error);
    if (status) return status;
    if (options->layout == 1 || (options->layout == 0 && scattered(tiling))) status = mw__tiling_order(tiling, error);
    if (status) return status;
    if (!tiling->embedding) {
        char first[200];
        mw_defect_describe(&tiling->defect, first, sizeof first);
        snprintf(locator->promise, sizeof locator->promise,
                 "the mesh is no embedding (%s): a point may be reported outside although a triangle contains it, and "
                 "of several triangles that contain it any may be reported",
                 first);
    }
    if (options->border) {
        if (!mw__border_create(&locator->border, locator->mesh, tiling)) return mw__fail_memory(error);
        locator->has_border = true;
    }
    mw__extent(tiling->point, tiling->tri, tiling->tri_count, locator->low, locator->high);
    locator->centre = mw__start_centre(tiling, locator->low, locator->high);
    double width = locator->high[0] - locator->low[0], height = locator->high[1] - locator->low[1];
    locator->near2 = width / mw__sample_count(tiling) * height;
    return MW_OK;
}

mw_status mw_locator_create(const mw_mesh *mesh, const mw_locator_options *options, mw_locator **out, mw_error *error)
{
    static const mw_locator_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the locator");
    *out = NULL;
    if (!mesh) return mw__fail(error, MW_ERROR_ARGUMENT, "no mesh");
    if (!options) options = &defaults;
    if (options->layout < 0 || options->layout > 2) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown layout");
    if (mesh->flat_count == mesh->tri_count)
        return mw__fail(error, MW_ERROR_INPUT, "the mesh has no triangle with an area");
    mw_locator *locator = mw__calloc(1, sizeof *locator);
    if (!locator) return mw__fail_memory(error);
    locator->mesh = mesh;
    mw_status status = prepare(locator, options, error);
    if (status)
        mw_locator_destroy(locator);
    else
        *out = locator;
    return status;
}

void mw_locator_destroy(mw_locator *locator)
{
    if (!locator) return;
    mw__border_release(&locator->border);
    mw__tiling_release(&locator->tiling);
    free(locator);
}

void mw_locator_describe(const mw_locator *locator, mw_locator_info *info)
{
    size_t border = mw__border_bytes(&locator->border);
    *info = (mw_locator_info){
        .bytes = sizeof *locator + mw__tiling_bytes(&locator->tiling) + border,
        .border_bytes = border,
        .ghost_triangles = locator->tiling.ghost_count,
        .holes = locator->tiling.hole_count,
        .copied = !locator->tiling.borrowed,
        .embedding = locator->tiling.embedding,
    };
}

const char *mw_locator_void_promise(const mw_locator *locator)
{
    return locator->tiling.embedding ? NULL : locator->promise;
}

const char *mw_where_name(mw_where where)
{
    static const char *const names[MW_WHERE_COUNT] = {"inside", "edge", "vertex", "outside", "hole", "near", "bad"};
    return (unsigned)where < MW_WHERE_COUNT ? names[where] : NULL;
}

void mw_interpolate(const mw_mesh *mesh, const double *values, const mw_location *locations, size_t n, double *result)
{
    for (size_t i = 0; i < n; i++) {
        const mw_location *at = &locations[i];
        result[i] = NAN;
        if (at->triangle == MW_NONE) continue;
        uint32_t v[3];
        mw_mesh_triangle(mesh, at->triangle, v);
        double sum = 0;
        for (int k = 0; k < 3; k++)
            if (at->weight[k] != 0) sum += at->weight[k] * values[v[k]]; /* a weight of 0 ignores even NaN */
        result[i] = sum;
    }
}
