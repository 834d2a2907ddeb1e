/* heights.h - heights and fields of vertices whose file tells none: those of constraints, and those added. */
#ifndef CLI_HEIGHTS_H
#define CLI_HEIGHTS_H

#include "cli/input/vertices.h"

/* Fill in what is not known (NaN) of vertices beyond those of POINTS. Vertices at one place share what one of them has;
 * then, where a constraint's ends both have a value, a vertex added on it gets its own along the constraint; for all
 * others POINTS are interpolated linearly in their Delaunay triangulation, outside it at the nearest place of its
 * border. Where POINTS have no such value either, or no triangle, it stays NaN, or 0 if it is the height and nothing
 * has one. *flat tells whether it was that POINTS, on one line, have no triangle.
 * Vertices from `added` on were added; `segments`, two vertices each, are the constraints that `edges` are parts of.
 * Returns 0 or an exit code. */
int heights_fill(vertices *v, size_t added, const uint32_t *duplicate_of, const uint32_t *segments,
                 const mw_constrained_edges *edges, bool *flat);

#endif
