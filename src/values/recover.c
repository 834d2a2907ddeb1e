/* recover.c - values at triangles become values at vertices. */
#include "base/base.h"

#include <meshwalk/locate.h>

#include <math.h>
#include <stdlib.h>

/* Twice the area; rounded, as a weight may be. */
static double recover_area(const mw_mesh *mesh, const uint32_t v[3])
{
    double a[2], b[2], c[2];
    mw_mesh_vertex(mesh, v[0], a);
    mw_mesh_vertex(mesh, v[1], b);
    mw_mesh_vertex(mesh, v[2], c);
    return fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

mw_status mw_recover_vertex_values(const mw_mesh *mesh, const double *values, const uint32_t *faces,
                                   double *result, mw_error *error)
{
    if (!mesh || !values || !result)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the mesh, the values or the result is NULL");
    const uint32_t vertices = mw_mesh_vertex_count(mesh);
    double *around = mw__calloc(vertices, sizeof *around); /* twice the area that has a value */
    if (!around) return mw__fail_memory(error);
    for (uint32_t v = 0; v < vertices; v++) result[v] = 0;
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
        uint32_t v[3];
        const double value = values[faces ? faces[t] : t];
        if (isnan(value)) continue;
        mw_mesh_triangle(mesh, t, v);
        const double area = recover_area(mesh, v);
        for (int k = 0; k < 3; k++) {
            result[v[k]] += area * value;
            around[v[k]] += area;
        }
    }
    for (uint32_t v = 0; v < vertices; v++) result[v] /= around[v]; /* 0 / 0: no triangle has one */
    free(around);
    return MW_OK;
}
