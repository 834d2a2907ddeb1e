/* arrays.h - the caller's arrays: whether they can be used, and their triangles. Private. */
#ifndef MW_SRC_MESH_ARRAYS_H
#define MW_SRC_MESH_ARRAYS_H

#include "mesh/mesh.h"

/* Entry i of the index array. A number that does not fit becomes MW_NONE, which is out of range of
 * any mesh. */
static MW_INLINE uint32_t mw__index_at(const mw_arrays *from, size_t i)
{
    if (MW_LIKELY(from->integer_type == MW_UINT32)) return ((const uint32_t *)from->triangles)[i];
    int64_t v = from->integer_type == MW_INT32 ? ((const int32_t *)from->triangles)[i]
                                               : ((const int64_t *)from->triangles)[i];
    return v < 0 || v >= MW_NONE ? MW_NONE : (uint32_t)v;
}

/* Check the arrays: present, not too large, and with a stride that holds the coordinates of a
 * vertex, 2 or 3. */
mw_status mw__arrays_validate(const mw_arrays *arrays, size_t dimension, mw_error *error);

/* Copy the vertices of triangle t, without links. MW_ERROR_INPUT names the defect that makes them
 * unusable, unless `tolerant`. */
mw_status mw__copy_triangle(const mw_arrays *arrays, size_t dimension, bool tolerant, uint32_t t,
                            mw_triangle *tri, mw_error *error);

#endif
