/* arrays.c - checks and copies the caller's arrays. */
#include "mesh/arrays.h"

#include <inttypes.h>

mw_status mw__arrays_validate(const mw_arrays *arrays, size_t dimension, mw_error *error)
{
    if (!arrays || (!arrays->points && arrays->point_count) ||
        (!arrays->triangles && arrays->triangle_count))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the points or the triangles are NULL");
    if (arrays->point_stride > 0 && arrays->point_stride < dimension)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a point stride of %zu leaves no room for %c",
                        arrays->point_stride, arrays->point_stride == 1 ? 'y' : 'z');
    if (arrays->integer_type > MW_INT64)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown type of vertex numbers");
    if (arrays->point_count > MW_MAX_VERTICES)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "the mesh has %zu vertices; at most %" PRIu32 " are possible",
                        arrays->point_count, MW_MAX_VERTICES);
    if (arrays->triangle_count > MW_MAX_TRIANGLES)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "the mesh has %zu triangles; at most %" PRIu32 " are possible",
                        arrays->triangle_count, MW_MAX_TRIANGLES);
    return MW_OK;
}

static bool array_vertex_is_finite(const mw_arrays *arrays, size_t dimension, uint32_t vertex)
{
    const double *p =
        arrays->points + vertex * (arrays->point_stride ? arrays->point_stride : dimension);
    return isfinite(p[0]) && isfinite(p[1]) && (dimension < 3 || isfinite(p[2]));
}

/* Are the numbers of vertices from 1 to their count? Then they were counted from 1. */
static bool array_counts_from_one(const mw_arrays *arrays)
{
    bool last = false;
    for (size_t i = 0; i < 3 * arrays->triangle_count; i++) {
        uint32_t v = mw__index_at(arrays, i);
        if (v == 0 || v > arrays->point_count) return false;
        last = last || v == arrays->point_count;
    }
    return last;
}

/* A number as it was given, also a negative one. */
static int64_t array_number(const mw_arrays *arrays, size_t i)
{
    if (arrays->integer_type == MW_INT64) return ((const int64_t *)arrays->triangles)[i];
    if (arrays->integer_type == MW_INT32) return ((const int32_t *)arrays->triangles)[i];
    return ((const uint32_t *)arrays->triangles)[i];
}

/* Corner k of triangle t is no vertex. */
static mw_status array_vertex_is_missing(const mw_arrays *arrays, uint32_t t, size_t k,
                                         mw_error *error)
{
    return mw__fail_at(error, t, -1,
                       "triangle %" PRIu32 ": vertex %" PRId64
                       " does not exist; there are %zu, numbered from 0%s",
                       t, array_number(arrays, 3 * (size_t)t + k), arrays->point_count,
                       array_counts_from_one(arrays) ? ": these seem to be numbered from 1" : "");
}

mw_status mw__copy_triangle(const mw_arrays *arrays, size_t dimension, bool tolerant, uint32_t t,
                            mw_triangle *tri, mw_error *error)
{
    for (size_t k = 0; k < 3; k++) {
        uint32_t v = mw__index_at(arrays, 3 * (size_t)t + k);
        if (v >= arrays->point_count) return array_vertex_is_missing(arrays, t, k, error);
        if (!tolerant && !array_vertex_is_finite(arrays, dimension, v))
            return mw__fail_at(error, t, v,
                               "triangle %" PRIu32 ": vertex %" PRIu32 " is not finite", t, v);
        tri->v[k] = v;
        tri->link[k] = MW_NONE;
    }
    tri->v[3] = tri->v[0];
    tri->user = t;
    for (uint32_t k = 0; k < 3 && !tolerant; k++)
        if (tri->v[k] == tri->v[k + 1])
            return mw__fail_at(error, t, tri->v[k],
                               "triangle %" PRIu32 ": vertex %" PRIu32 " is in it twice", t,
                               tri->v[k]);
    return MW_OK;
}
