/* layout.h - the order of a mesh in memory: along a Hilbert curve, whatever the order of the
 * caller's arrays. Private.
 *
 * Walks and connectivity go from a triangle to its neighbours. Each step costs a cache miss where
 * neighbours lie far apart in memory. So vertices get slots along the curve, and triangles get
 * slots by their lowest vertex. Users never see slots: the mesh keeps the user's numbers. */
#ifndef MW_SRC_MESH_LAYOUT_H
#define MW_SRC_MESH_LAYOUT_H

#include "base/job.h"
#include "mesh/match.h"

/* Are the vertices of consecutive triangles far apart in memory? Looks at a sample. */
bool mw__arrays_are_scattered(const mw_arrays *arrays);

/* Are consecutive points far apart in the plane? Looks at a sample. */
bool mw__points_are_scattered(const mw_point *points, uint32_t n);

/* Returns points that lie `stride` doubles apart (0: 2) as a packed array: the caller's own array
 * if it is packed, else *copy, which is to be released in any case. Steps of the present stage.
 * NULL when out of memory, or cancelled; or if `from` is NULL. */
const mw_point *mw__points_read(const double *from, size_t stride, uint32_t n, mw_job *job,
                                mw_point **copy);

/* Copy the points into a mesh without points. Its triangles name vertices by slot: slot i gets
 * point order[i]. NULL: slots are numbers; else the mesh takes ownership of `order`. Steps of the
 * present stage. Returns false when out of memory, or cancelled. */
bool mw__mesh_set_points(mw_mesh *mesh, const mw_point *given, uint32_t *order, mw_job *job);

/* Order the vertices of a mesh along the curve, if they are scattered. Its triangles are in a good
 * order already. Stages of the present part of the job. Returns false when out of memory, or
 * cancelled; then the mesh can only be destroyed. */
bool mw__mesh_lay_out_vertices(mw_mesh *mesh, mw_job *job);

/* Fill in points and linked triangles in their new order, with slots and numbers. MW_ERROR_INPUT
 * names the first unusable triangle; MW_ERROR_MEMORY, also if the job is cancelled. Stages of the
 * present part of the job. */
mw_status mw__mesh_lay_out(mw_mesh *mesh, const mw_arrays *arrays, mw_job *job, mw_links *links,
                           mw_error *error);

#endif
