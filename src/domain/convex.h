/* convex.h - does a mesh fill a convex polygon, edge to edge? Private. */
#ifndef MW_SRC_CONVEX_H
#define MW_SRC_CONVEX_H

#include "mesh/mesh.h"

/* True only for an embedding of a convex polygon without flat triangles, in one piece: such a mesh is its own tiling.
 * False also for some meshes that fill their hull: with flat triangles, or in pieces that touch. O(n), no memory. */
bool mw__convex(const mw_mesh *mesh);

#endif
