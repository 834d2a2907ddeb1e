/* topology_counts.h - counts in linked triangles of any orientation, in the plane or in space.
 * Private.
 *
 * `coincident` as in coincident.h: coincident vertices count as one, and triangles are linked
 * so. */
#ifndef MW_SRC_TOPOLOGY_TOPOLOGY_COUNTS_H
#define MW_SRC_TOPOLOGY_TOPOLOGY_COUNTS_H

#include "topology/fan.h"

/* As mw__has_three_vertices: a triangle with two coincident vertices has no edges, either. */
static MW_INLINE bool mw__has_three_representatives(const mw_triangle *t,
                                                    const uint32_t *coincident)
{
    uint32_t a = mw__representative(coincident, t->v[0]),
             b = mw__representative(coincident, t->v[1]),
             c = mw__representative(coincident, t->v[2]);
    return a != b && b != c && c != a;
}

/* Count the vertices, below vertex_count, that triangles use, and the connected components:
 * triangles that share a vertex are connected. Those marked MW_GHOST do not count. Returns false
 * when out of memory. */
bool mw__count_components(const mw_triangle *tri, uint32_t n, uint32_t vertex_count,
                          const uint32_t *coincident, uint32_t *used, uint32_t *components);

/* Count the border loops: closed chains of edges without a link. The next edge is found by turning
 * round the end of an edge. Returns false when out of memory. */
bool mw__count_border_loops(const mw_triangle *tri, uint32_t n, const uint32_t *coincident,
                            uint32_t *loops);

/* Count fans: fans[v], 0 at first, becomes the number of fans, at most 2, that the triangles with
 * three different vertices form round vertex v. Returns false when out of memory. */
bool mw__count_fans(const mw_triangle *tri, uint32_t n, const uint32_t *coincident, uint8_t *fans);

#endif
