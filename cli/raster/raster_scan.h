/* raster_scan.h - triangles and values at the centres of pixels, row by row.
 *
 *      . . . . . . .     The triangles are scan-converted: in each row of pixels, a triangle has
 *      . . ./\ . . .     those from one side to another. Which pixel is the first is computed in
 *      . . / .\. . .     doubles, with a bound for the error, and decided exactly where that does
 *      . ./. . \ . .     not tell. A pixel on an edge or a vertex, or too near to tell, is asked
 *      . /_._._.\. .     of the locator. So all pixels have the answers of mw_locate and
 *      . . . . . . .     mw_interpolate at their centres, to the last bit, whatever the order. */
#ifndef MW_CLI_RASTER_RASTER_SCAN_H
#define MW_CLI_RASTER_RASTER_SCAN_H

#include "cli/raster/raster_grid.h"

#include <meshwalk/meshwalk.h>

typedef struct raster_scan raster_scan;

/* Prepare a mesh with a locator of its own, which outlive the scan, on several threads (0: one for
 * each processor). Memory: 32 bytes for each vertex; 8 for each 16 triangles, and 4 for each strip
 * that these reach into, at most four. If triangles that follow each other are far from each other,
 * it is as much for each triangle. Returns 0, or an exit code after a complaint; release it in both
 * cases. */
int raster_scan_create(raster_scan **scan, const mw_locator *locator, const mw_mesh *mesh,
                       const raster_grid *grid, uint32_t threads);
void raster_scan_release(raster_scan *s); /* NULL is allowed */

/* Take the values that strips get from now on: one for each vertex of the mesh, which stay. NULL:
 * none. */
void raster_scan_take_values(raster_scan *s, const double *values);

/* How many strips of how many rows the raster has; the last may have fewer. */
uint32_t raster_scan_strips(const raster_scan *s);
uint32_t raster_scan_height(const raster_scan *s);

/* Where the pixels of a strip go, grid.columns for each row. NULL: not wanted. */
typedef struct raster_scan_pixels {
    double *values;      /* NaN where there is none */
    float *rounded;      /* the same values, rounded; faster than the doubles. Behind the last row
                          * are RASTER_GRID_SPARE more, which mean nothing */
    uint32_t *triangles; /* MW_NONE where there is none */
} raster_scan_pixels;

/* Fill the rows of a strip, on one thread. Several threads may scan strips at a time, each with a
 * cursor of its own of the locator. */
void raster_scan_strip(const raster_scan *s, uint32_t strip, mw_cursor *cursor,
                       const raster_scan_pixels *pixels);

#endif
