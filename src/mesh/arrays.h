/* arrays.h - the caller's arrays: whether they can be used, and their triangles. Private. */
#ifndef MW_SRC_ARRAYS_H
#define MW_SRC_ARRAYS_H

#include "mesh/mesh.h"

/* Number i of the index array; numbers that do not fit become MW_NONE, which is out of range of any mesh. */
static MW_INLINE uint32_t mw__index_at(const mw_arrays *from, size_t i)
{
    if (MW_LIKELY(from->integer_type == MW_UINT32)) return ((const uint32_t *)from->triangles)[i];
    int64_t v =
        from->integer_type == MW_INT32 ? ((const int32_t *)from->triangles)[i] : ((const int64_t *)from->triangles)[i];
    return v < 0 || v >= MW_NONE ? MW_NONE : (uint32_t)v;
}

/* Are the arrays there, no larger than a mesh may be, and do their strides hold the coordinates of a vertex: 2 or 3? */
mw_status mw__check_arguments(const mw_arrays *arrays, size_t dimension, mw_error *error);

/* Copy the vertices of triangle t, without links; MW_ERROR_INPUT names what makes them unusable, unless it is
 * tolerated. */
mw_status mw__copy_triangle(const mw_arrays *arrays, size_t dimension, bool tolerant, uint32_t t, mw_triangle *tri,
                            mw_error *error);

#endif
