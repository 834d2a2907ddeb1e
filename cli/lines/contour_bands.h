/* contour_bands.h - the values of a mesh as numbers of bands between levels.
 *
 * Band b lies from level b - 1 up to, not including, level b. So a value is at level i or above it
 * if its band is above i, and the levels that cross a triangle are those from its lowest band up
 * to, not including, its highest: integers tell, and a level is compared once for each vertex. */
#ifndef MW_CLI_LINES_CONTOUR_BANDS_H
#define MW_CLI_LINES_CONTOUR_BANDS_H

#include <meshwalk/meshwalk.h>

/* The band of a vertex without a value. */
#define CONTOUR_NO_BAND MW_NONE

/* The band of each of n values, CONTOUR_NO_BAND of NaN. The caller frees it. NULL: memory ran out.
 *   levels  ascending */
uint32_t *contour_bands_of_values(const double *values, size_t n, const double *levels,
                                  size_t level_count);

typedef struct contour_bands {
    uint32_t low, high;
} contour_bands;

/* The lowest and the highest band of a triangle's vertices; both CONTOUR_NO_BAND if one has none.
 */
static inline contour_bands contour_bands_of_corners(const uint32_t *band, const uint32_t v[3])
{
    contour_bands b = {band[v[0]], band[v[0]]};
    for (int k = 1; k < 3; k++) {
        uint32_t other = band[v[k]];
        b.low = other < b.low ? other : b.low;
        b.high = other > b.high ? other : b.high;
    }
    if (b.high == CONTOUR_NO_BAND) b.low = CONTOUR_NO_BAND;
    return b;
}

static inline contour_bands contour_bands_of_triangle(const mw_mesh *mesh, const uint32_t *band,
                                                      uint32_t t)
{
    uint32_t v[3];
    mw_mesh_triangle(mesh, t, v);
    return contour_bands_of_corners(band, v);
}

#endif
