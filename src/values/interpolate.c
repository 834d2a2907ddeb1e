/* interpolate.c - values at located points. */
#include "mesh/mesh.h"

#include <meshwalk/locate.h>

void mw_interpolate(const mw_mesh *mesh, const double *values, const mw_location *locations,
                    size_t n, double *result)
{
    for (size_t i = 0; i < n; i++) {
        const mw_location *at = &locations[i];
        result[i] = NAN;
        if (at->triangle == MW_NONE) continue;
        uint32_t v[3];
        mw_mesh_triangle(mesh, at->triangle, v);
        double sum = 0;
        for (int k = 0; k < 3; k++) /* where the weight is 0, even a NaN counts for nothing */
            if (at->weight[k] != 0) sum += at->weight[k] * values[v[k]];
        result[i] = sum;
    }
}
