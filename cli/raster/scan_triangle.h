/* scan_triangle.h - one triangle, scan-converted to the pixels of a grid.
 *
 *        c         A row of pixels crosses the long side (a c) and one of the two short ones: the
 *       /|         lower (a b) below the middle corner b, the upper (b c) above it. Where the row
 *    --/-|----     crosses a side is computed in doubles. If no centre of a pixel is within the
 *     /  |         margin of a crossing, the pixels between the crossings are the triangle's, and
 *    b   |         far enough from its sides for the arithmetic of mw_locate in doubles. Other
 *     `. |         rows are decided by exact tests, and a pixel too near to a side is asked of
 *       `a         the locator. */
#ifndef MW_CLI_RASTER_SCAN_TRIANGLE_H
#define MW_CLI_RASTER_SCAN_TRIANGLE_H

#include "cli/raster/raster_grid.h"

#include <meshwalk/meshwalk.h>

/* A vertex as the scan has it. */
typedef struct scan_vertex {
    double x, y, value;
    int32_t row;   /* scan_row_south_of(y) */
    int32_t strip; /* of that row */
} scan_vertex;

/* Where the pixels of some rows go. */
typedef struct scan_strip {
    const mw_locator *locator;
    const mw_mesh *mesh;
    const double *values; /* of the vertices of the mesh */
    const raster_grid *grid;
    mw_cursor *cursor;
    double per_width;    /* one over the width of a pixel */
    int64_t first, last; /* rows */
    double *result;      /* these three receive values, the same values rounded to floats, and */
    float *rounded;      /* triangles; NULL: not wanted. `rounded` has RASTER_GRID_SPARE floats */
    uint32_t *triangles; /* behind the last row, which only this strip's thread uses */
} scan_strip;

/* Rows, or strips of them: first .. last. None if first > last. */
typedef struct row_range {
    int64_t first, last;
} row_range;

/* The first row whose centres are at this northing or south of it; the number of rows: none. */
int32_t scan_row_south_of(const raster_grid *g, double northing);

/* The least and the greatest of three numbers. */
static inline double scan_least(double a, double b, double c)
{
    double low = a < b ? a : b;
    return low < c ? low : c;
}

static inline double scan_greatest(double a, double b, double c)
{
    double high = a > b ? a : b;
    return high > c ? high : c;
}

/* Give the pixels of the strip that lie in triangle `number`, which has these corners, what they
 * have. A pixel on an edge or a vertex gets the answer of the locator. */
void scan_triangle_fill(const scan_strip *strip, uint32_t number,
                        const scan_vertex *const corner[3]);

#endif
