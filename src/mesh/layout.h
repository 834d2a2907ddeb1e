/* layout.h - the order of a mesh in memory: along a Hilbert curve, whatever the order of the
 * caller's arrays. Private.
 *
 * Walks and connectivity go from a triangle to its neighbours. Each step costs a cache miss where
 * neighbours lie far apart in memory. So vertices get slots along the curve, and triangles get
 * slots by their lowest vertex. Users never see slots: the mesh keeps the user's numbers. */
#ifndef MW_SRC_MESH_LAYOUT_H
#define MW_SRC_MESH_LAYOUT_H

#include "mesh/match.h"

/* Are the vertices of consecutive triangles far apart in memory? Looks at a sample. */
bool mw__arrays_are_scattered(const mw_arrays *arrays);

/* Are consecutive points far apart in the plane? Looks at a sample. */
bool mw__points_are_scattered(const mw_point *points, uint32_t n);

/* Copy the points into a mesh without points. Its triangles name vertices by slot: slot i gets
 * point order[i]. NULL: slots are numbers; else the mesh takes ownership of `order`. Returns false
 * when out of memory. */
bool mw__mesh_set_points(mw_mesh *mesh, const mw_point *given, uint32_t *order, uint32_t threads);

/* Order the vertices of a mesh along the curve, if they are scattered. Its triangles are in a good
 * order already. Returns false when out of memory; then the mesh can only be destroyed. */
bool mw__mesh_lay_out_vertices(mw_mesh *mesh, uint32_t threads);

/* Fill in points and linked triangles in their new order, with slots and numbers. MW_ERROR_INPUT
 * names the first unusable triangle; MW_ERROR_MEMORY. */
mw_status mw__mesh_lay_out(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_links *links, mw_error *error);

#endif
