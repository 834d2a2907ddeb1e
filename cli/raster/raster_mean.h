/* raster_mean.h - a raster whose pixels are means over their areas, by exact clipping of triangles
 * (remap.h). */
#ifndef MW_CLI_RASTER_RASTER_MEAN_H
#define MW_CLI_RASTER_RASTER_MEAN_H

#include "cli/raster/raster_bands.h"

typedef struct raster_mean {
    raster_bands *bands; /* one, of the values of vertices; its counts are set */
    bool degrees;        /* areas are those of the sphere */
    double area;         /* of the mesh in the pixels with a value */
    double integral;     /* of the value over it: the sum of value times area, before rounding to
                          * the type of the pixels */
} raster_mean;

/* Compute and write the band: the mean over the part of each pixel that the mesh covers, no value
 * where it covers none. Strips of rows are computed one after the other, so memory is bounded.
 * Returns 0, or an exit code after a complaint. */
int raster_mean_write(raster_mean *m, gdal_raster *raster);

#endif
