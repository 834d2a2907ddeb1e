/* dem.h - a raster of heights that a TIN is made from. */
#ifndef MW_CLI_RASTER_DEM_H
#define MW_CLI_RASTER_DEM_H

#include "cli/raster/raster_grid.h"

#include <stddef.h>

typedef struct dem {
    const char *path;
    raster_grid grid;
    double *z; /* of each pixel, row by row; NaN: none */
    char *crs; /* NULL: not known */
    size_t filled;
} dem;

/* The functions with a result of type int return 0, or an exit code after a complaint. */

/* Read a band, from 1. Release it in any case. */
int dem_read(dem *d, const char *path, uint32_t band);
void dem_release(dem *d);

/* The height between the four nearest centres of pixels; NaN where one has none. */
double dem_height(const dem *d, double x, double y);

/* The pixels that a TIN begins with: the corners of the convex hull of those with a height, and
 * those beside one without. x, y, z of each; the caller frees them. */
int dem_begin(const dem *d, double **xyz, size_t *count);

#endif
