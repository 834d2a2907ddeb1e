/* remap_weights.h - conservative weights from a mesh to another mesh or to the pixels of a
 * raster. */
#ifndef MW_CLI_REMAP_REMAP_WEIGHTS_H
#define MW_CLI_REMAP_REMAP_WEIGHTS_H

#include "cli/frame/options.h"

typedef struct remap_settings {
    const common_settings *common;
    const char *crs;      /* of the mesh; NULL: not given */
    const char *grid_crs; /* of the grid; NULL: not given */
    bool vertices;        /* values belong to vertices; else to faces */
    bool covered;         /* means over the covered part of a cell */
    bool strict, stats, json;
} remap_settings;

/* operands: a mesh, and a mesh or raster. Returns the exit code. */
int remap_weights_run(const remap_settings *settings, const char *const *operands);

#endif
