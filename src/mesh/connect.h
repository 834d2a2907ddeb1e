/* connect.h - triangles become neighbours. Private. */
#ifndef MW_SRC_CONNECT_H
#define MW_SRC_CONNECT_H

#include "mesh/match.h"

/* Link the triangles tri[0..n) of vertices below vertex_count along their edges, in O(n). *links may be NULL.
 * An edge of more than two triangles links the first two. Links two triangles whatever their orientation, but none that
 * names a vertex twice. They have no links before. threads: 0 = as OpenMP gives. Returns false when out of memory. */
bool mw__connect(mw_triangle *tri, uint32_t n, uint32_t vertex_count, uint32_t threads, mw_links *links);

#endif
