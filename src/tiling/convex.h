/* convex.h - does a mesh fill a convex polygon, edge to edge? Private. */
#ifndef MW_SRC_TILING_CONVEX_H
#define MW_SRC_TILING_CONVEX_H

#include "mesh/mesh.h"

/* True only for a connected embedding without flat triangles that fills a convex polygon. Such a
 * mesh is its own tiling. False for some other meshes that fill their hull: with flat triangles, or
 * with components that touch. O(n), no memory. */
bool mw__mesh_is_convex(const mw_mesh *mesh);

#endif
