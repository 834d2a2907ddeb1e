/* order.h - orders of triangles and vertices along a Hilbert curve. Private. All return false when out of memory. */
#ifndef MW_SRC_ORDER_H
#define MW_SRC_ORDER_H

#include "mesh/mesh.h"

/* Extent of the vertices of the triangles; low > high where there are none. */
void mw__extent(const mw_point *point, const mw_triangle *tri, uint32_t tri_count, double low[2], double high[2]);

/* order[i] is the triangle that comes i-th by its centroid's place on the curve. */
bool mw__order_triangles(const mw_point *point, const mw_triangle *tri, uint32_t tri_count, uint32_t *order);

/* order[i] is the vertex that the triangles, taken in triangle_order, use i-th; those that none uses come last. */
bool mw__order_vertices(const mw_triangle *tri, const uint32_t *triangle_order, uint32_t tri_count,
                        uint32_t point_count, uint32_t *order);

#endif
