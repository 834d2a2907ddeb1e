/* value_table.c - many values at each vertex, interpolated at located points.
 *
 * The corners of a triangle are looked up once for all values, and these stand side by side: a
 * vector of them costs little more than one. */
#include "base/base.h"
#include "mesh/mesh.h"

#include <meshwalk/locate.h>

/* `narrow` is a literal where this is stamped: tables of floats and of doubles are one code. */
static inline double value_load(const void *values, size_t i, bool narrow)
{
    return narrow ? (double)((const float *)values)[i] : ((const double *)values)[i];
}

static inline void value_store(void *values, size_t i, double value, bool narrow)
{
    if (narrow)
        ((float *)values)[i] = (float)value;
    else
        ((double *)values)[i] = value;
}

/* Sums in the order of mw_interpolate: the bits are the same. */
static inline void value_table_inside(const double w[3], const void *const corner[3], size_t count, bool narrow,
                                      void *restrict result)
{
    const void *restrict a = corner[0], *restrict b = corner[1], *restrict c = corner[2];
    for (size_t k = 0; k < count; k++) {
        double sum = 0 + w[0] * value_load(a, k, narrow);
        sum += w[1] * value_load(b, k, narrow);
        sum += w[2] * value_load(c, k, narrow);
        value_store(result, k, sum, narrow);
    }
}

/* A weight of 0 ignores even NaN. */
static inline void value_table_edge(const double w[3], const void *const corner[3], size_t count, bool narrow,
                                    void *result)
{
    for (size_t k = 0; k < count; k++) {
        double sum = 0;
        for (int i = 0; i < 3; i++)
            if (w[i] != 0) sum += w[i] * value_load(corner[i], k, narrow);
        value_store(result, k, sum, narrow);
    }
}

static inline void value_table_point(const mw_mesh *mesh, const mw_value_table *table, const mw_location *at,
                                     bool narrow, void *result)
{
    const size_t size = narrow ? sizeof(float) : sizeof(double), stride = table->stride ? table->stride : table->count;
    const double *w = at->weight;
    if (at->triangle == MW_NONE) {
        for (size_t k = 0; k < table->count; k++) value_store(result, k, NAN, narrow);
        return;
    }
    uint32_t v[3];
    mw_mesh_triangle(mesh, at->triangle, v);
    const void *corner[3];
    for (int i = 0; i < 3; i++) corner[i] = (const char *)table->values + v[i] * stride * size;
    if (w[0] != 0 && w[1] != 0 && w[2] != 0)
        value_table_inside(w, corner, table->count, narrow, result);
    else
        value_table_edge(w, corner, table->count, narrow, result);
}

mw_status mw_interpolate_table(const mw_mesh *mesh, const mw_value_table *table, const mw_location *locations, size_t n,
                               void *result, mw_error *error)
{
    if (!mesh || !table || (n && (!locations || !result)) || (table->count && !table->values))
        return mw__fail(error, MW_ERROR_ARGUMENT, "interpolation needs a mesh, values, locations and a result");
    if (table->type != MW_FLOAT64 && table->type != MW_FLOAT32)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown type of values: %d", (int)table->type);
    if (table->stride && table->stride < table->count)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a stride of %zu for %zu values", table->stride, table->count);
    for (size_t i = 0; i < n && table->type == MW_FLOAT64; i++)
        value_table_point(mesh, table, &locations[i], false, (double *)result + i * table->count);
    for (size_t i = 0; i < n && table->type == MW_FLOAT32; i++)
        value_table_point(mesh, table, &locations[i], true, (float *)result + i * table->count);
    return MW_OK;
}
