/* raster_mean.h - a raster whose pixels are means over their areas, by exact clipping of triangles
 * (remap.h). */
#ifndef MW_CLI_RASTER_RASTER_MEAN_H
#define MW_CLI_RASTER_RASTER_MEAN_H

#include "cli/raster/raster_series.h"

typedef struct raster_mean {
    raster_bands *bands;   /* of the raster; of values over time, of one step. Counts are set */
    raster_series *series; /* values over time; NULL: those of the mesh */
    raster_mesh *mesh;     /* the same as that of the bands; its values change over time */
    bool degrees;          /* areas are those of the sphere */
    double area;           /* of the mesh in the pixels with a value in the first band */
    double integral;       /* of that value over it: the sum of value times area, before rounding to
                            * the type of the pixels */
} raster_mean;

/* Compute and write the bands: the mean over the part of each pixel that the mesh covers, no value
 * where it covers none. Of aspects it is the direction of the mean of unit vectors, to which
 * horizontal triangles add nothing. Strips of rows are computed one after the other, so memory is
 * bounded. Returns 0, or an exit code after a complaint. */
int raster_mean_write(raster_mean *m, gdal_raster *raster);

#endif
