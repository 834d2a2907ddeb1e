/* arrays.c - checks and copies the caller's arrays. */
#include "mesh/arrays.h"

#include <inttypes.h>

mw_status mw__arrays_validate(const mw_arrays *arrays, size_t dimension, mw_error *error)
{
    if (!arrays || (!arrays->points && arrays->point_count) ||
        (!arrays->triangles && arrays->triangle_count))
        return mw__fail(error, MW_ERROR_ARGUMENT, "arrays are missing");
    if (arrays->point_stride > 0 && arrays->point_stride < dimension)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a point stride of %zu leaves no room for %c",
                        arrays->point_stride, arrays->point_stride == 1 ? 'y' : 'z');
    if (arrays->integer_type > MW_INT64)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown type of index");
    if (arrays->point_count > MW_MAX_VERTICES)
        return mw__fail(error, MW_ERROR_LIMIT, "%zu vertices, at most %" PRIu32 " are possible",
                        arrays->point_count, MW_MAX_VERTICES);
    if (arrays->triangle_count > MW_MAX_TRIANGLES)
        return mw__fail(error, MW_ERROR_LIMIT, "%zu triangles, at most %" PRIu32 " are possible",
                        arrays->triangle_count, MW_MAX_TRIANGLES);
    return MW_OK;
}

static bool array_vertex_is_finite(const mw_arrays *arrays, size_t dimension, uint32_t vertex)
{
    const double *p =
        arrays->points + vertex * (arrays->point_stride ? arrays->point_stride : dimension);
    return isfinite(p[0]) && isfinite(p[1]) && (dimension < 3 || isfinite(p[2]));
}

mw_status mw__copy_triangle(const mw_arrays *arrays, size_t dimension, bool tolerant, uint32_t t,
                            mw_triangle *tri, mw_error *error)
{
    for (size_t k = 0; k < 3; k++) {
        uint32_t v = mw__index_at(arrays, 3 * (size_t)t + k);
        if (v >= arrays->point_count)
            return mw__fail_at(error, t, -1,
                               "triangle %" PRIu32 ": corner %zu is not a vertex; there are %zu", t,
                               k, arrays->point_count);
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
