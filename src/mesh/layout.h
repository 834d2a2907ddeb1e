/* layout.h - a mesh in memory along a Hilbert curve, whatever the order of the caller's arrays. Private.
 *
 * Walks and connectivity go from a triangle to its neighbours. Where these lie far apart in memory each step costs a
 * cache miss, so vertices are numbered anew along the curve, and triangles by their lowest vertex. Users never see it:
 * the mesh keeps the numbers of both. */
#ifndef MW_SRC_LAYOUT_H
#define MW_SRC_LAYOUT_H

#include "mesh/match.h"

/* Are the vertices of the arrays' triangles far apart in memory, or triangles that follow each other? Looks at a few. */
bool mw__is_scattered(const mw_arrays *arrays);

/* Are points that follow each other far apart in the plane? Looks at a few. */
bool mw__are_scattered(const mw_point *points, uint32_t n);

/* Copy the points into a mesh that has none yet, the triangles of which name their places by `order`: place i is that of
 * point order[i]. NULL: they are the same; else the mesh owns it from here on. Returns false when out of memory. */
bool mw__give_points(mw_mesh *mesh, const mw_point *given, uint32_t *order, uint32_t threads);

/* Lay out the vertices of a mesh whose triangles are in good order, if they are scattered. Returns false when out of
 * memory; then the mesh can only be destroyed. */
bool mw__lay_out_vertices(mw_mesh *mesh, uint32_t threads);

/* Make points, triangles, linked, and the numbers of both. MW_ERROR_INPUT names the
 * first triangle that is unusable; MW_ERROR_MEMORY. */
mw_status mw__lay_out(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_links *links, mw_error *error);

#endif
