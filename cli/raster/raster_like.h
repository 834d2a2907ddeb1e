/* raster_like.h - an existing raster whose pixels the new one takes. */
#ifndef MW_CLI_RASTER_RASTER_LIKE_H
#define MW_CLI_RASTER_RASTER_LIKE_H

#include "cli/gdal/gdal_raster.h"
#include "cli/raster/raster_grid.h"

typedef struct raster_like {
    const char *path; /* NULL: there is none */
    gdal_raster_form form;
    char *crs; /* NULL: not known */
} raster_like;

/* Functions with a result of type int return 0, or an exit code after a complaint. */

/* Describe the raster at a path, if there is one. Release it in any case. */
int raster_like_read(raster_like *like, const char *path);
void raster_like_release(raster_like *like);

/* Take its pixels for a raster of a mesh, which has to be in the same coordinate system. */
int raster_like_grid(const raster_like *like, raster_grid *grid, const char *mesh,
                     const char *mesh_crs, bool quiet);

#endif
