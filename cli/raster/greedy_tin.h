/* greedy_tin.h - a TIN that keeps to a raster of heights, by greedy insertion [Garland, Heckbert
 * 1997]: the pixel with the largest error becomes a vertex, until no error exceeds the tolerance.
 * Of equal errors, the first in the raster. */
#ifndef MW_CLI_RASTER_GREEDY_TIN_H
#define MW_CLI_RASTER_GREEDY_TIN_H

#include "cli/frame/options.h"
#include "cli/raster/dem.h"

#include <meshwalk/meshwalk.h>

typedef struct greedy_tin_report {
    size_t pixels;   /* with a height, that the triangles have */
    size_t left_out; /* with a height, in no triangle */
    double largest;  /* the largest error at a pixel in the mesh */
    size_t inserted; /* vertices */
} greedy_tin_report;

typedef struct greedy_tin_options {
    double tolerance;
    bool bounded; /* the mesh does not grow beyond its border */
    const common_settings *common;
} greedy_tin_options;

/* Insert pixels into a mesh, whose field z has a height for each vertex. Each pixel of the raster
 * that lies in the mesh, at its centre, is then verified. Triangles with a pixel without a height
 * are left out of *out, which the caller destroys. Returns 0, or an exit code after a complaint. */
int greedy_tin_make(const dem *d, const mw_mesh *mesh, const mw_constrained_edges *edges,
                    const greedy_tin_options *options, mw_mesh **out, greedy_tin_report *report);

#endif
