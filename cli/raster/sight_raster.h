/* sight_raster.h - a raster of what is visible from a viewpoint. */
#ifndef MW_CLI_RASTER_SIGHT_RASTER_H
#define MW_CLI_RASTER_SIGHT_RASTER_H

#include "cli/gdal/gdal_raster.h"
#include "cli/raster/raster_grid.h"

#include <meshwalk/meshwalk.h>

/* The values of pixels. */
enum { SIGHT_PIXEL_HIDDEN = 0, SIGHT_PIXEL_VISIBLE = 1, SIGHT_PIXEL_NONE = 255 };

typedef struct sight_raster {
    const mw_viewpoint *view;
    const raster_grid *grid;
    double height; /* of the targets, above the ground at the centres of the pixels */
    uint32_t threads;
    uint64_t visible, hidden; /* pixels: counted */
} sight_raster;

/* Compute and write the band, of bytes. Returns 0, or an exit code after a complaint. */
int sight_raster_write(sight_raster *s, gdal_raster *raster);

#endif
