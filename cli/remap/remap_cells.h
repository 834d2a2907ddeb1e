/* remap_cells.h - the cells of a mesh or a raster, for remapping values. */
#ifndef MW_CLI_REMAP_REMAP_CELLS_H
#define MW_CLI_REMAP_REMAP_CELLS_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

typedef struct remap_cells {
    mw_mesh *mesh; /* NULL: pixels */
    mw_locator *locator;
    uint32_t *face; /* the face of each triangle; NULL: they are the triangles */
    size_t face_count;
    bool cut; /* it goes round the globe, and was cut at the longitude `west` (remap.h) */
    double west;
    mw_remap_pixels pixels;
    char *crs; /* NULL: not known */
} remap_cells;

/* Read a mesh; or a raster, if `grid` and the name of the file ends as that of one. `crs` is that
 * of an option, or NULL. Returns 0, or an exit code after a complaint; release it in both cases. */
int remap_cells_read(remap_cells *c, const char *path, const char *crs,
                     const common_settings *common, bool grid);
void remap_cells_release(remap_cells *c);

/* The same for the library's calls; pixels have no locator. */
mw_remap_mesh remap_cells_mesh(const remap_cells *c);

/* x and y of the centroid of each cell, packed, or of each vertex. For free(); NULL without
 * memory. */
double *remap_cells_places(const remap_cells *c, bool vertices);

#endif
