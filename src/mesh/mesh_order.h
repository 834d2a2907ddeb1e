/* mesh_order.h - orders of triangles and vertices along a Hilbert curve. Private. Functions return
 * false when out of memory. */
#ifndef MW_SRC_MESH_MESH_ORDER_H
#define MW_SRC_MESH_MESH_ORDER_H

#include "mesh/mesh.h"

/* The extent of the vertices of the triangles; low > high where there are none. */
void mw__triangles_extent(const mw_point *point, const mw_triangle *tri, uint32_t tri_count,
                          double low[2], double high[2]);

/* order[i] becomes the i-th triangle, sorted by the positions of their centroids along the
 * curve. */
bool mw__triangles_order(const mw_point *point, const mw_triangle *tri, uint32_t tri_count,
                         uint32_t *order);

/* order[i] becomes the i-th vertex, in the order of first use by the triangles, taken in
 * triangle_order. Unused vertices come last. */
bool mw__vertices_order(const mw_triangle *tri, const uint32_t *triangle_order, uint32_t tri_count,
                        uint32_t point_count, uint32_t *order);

#endif
