/* hits.c - answers of queries in space as places in triangles, and values there. */
#include "operator/hits.h"

mw_hits mw_hits_of_locations(const mw_location *locations, size_t n)
{
    if (!locations) return (mw_hits){.count = n};
    return (mw_hits){&locations->triangle, locations->weight, sizeof *locations, n};
}

mw_hits mw_hits_of_touches(const mw_touch *touches, size_t n)
{
    if (!touches) return (mw_hits){.count = n};
    return (mw_hits){&touches->triangle, touches->weight, sizeof *touches, n};
}

mw_hits mw_hits_of_nearest(const mw_nearest_surface_point *points, size_t n)
{
    if (!points) return (mw_hits){.count = n};
    return (mw_hits){&points->triangle, points->weight, sizeof *points, n};
}

void mw_surface_interpolate(const mw_surface *surface, const double *values, const mw_hits *hits,
                            double *result)
{
    for (size_t i = 0; i < hits->count; i++) {
        const uint32_t triangle = mw__hit_triangle(hits, i);
        result[i] = NAN;
        if (triangle == MW_NONE) continue;
        const uint32_t *v = surface->tri[triangle].v;
        const double *weight = mw__hit_weights(hits, i);
        double sum = 0;
        for (int k = 0; k < 3; k++) /* where the weight is 0, even a NaN counts for nothing */
            if (weight[k] != 0) sum += weight[k] * values[v[k]];
        result[i] = sum;
    }
}
