/* sight_raster.h - a raster of what is visible from viewpoints. */
#ifndef MW_CLI_RASTER_SIGHT_RASTER_H
#define MW_CLI_RASTER_SIGHT_RASTER_H

#include "cli/gdal/gdal_raster.h"
#include "cli/raster/raster_grid.h"

#include <meshwalk/meshwalk.h>

/* A pixel is the number of viewpoints that see it, in bytes; or, if there are more than
 * SIGHT_MOST_BYTES, in int32. Outside of the mesh it is sight_raster_none. */
enum { SIGHT_MOST_BYTES = 254 };

typedef struct sight_raster {
    const mw_viewpoint *views;
    size_t count; /* of viewpoints */
    const raster_grid *grid;
    double height; /* of the targets, above the ground at the centres of the pixels */
    uint32_t threads;
    uint64_t visible, hidden; /* pixels that some viewpoint sees, and that none does: counted */
} sight_raster;

raster_type sight_raster_type(const sight_raster *s);
double sight_raster_none(const sight_raster *s);

/* Compute and write the band. Returns 0, or an exit code after a complaint. */
int sight_raster_write(sight_raster *s, gdal_raster *raster);

#endif
