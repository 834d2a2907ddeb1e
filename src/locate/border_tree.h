/* border_tree.h - the nearest border edge: a packed R-tree over the edges that have the mesh on one
 * side only. Private. */
#ifndef MW_SRC_LOCATE_BORDER_TREE_H
#define MW_SRC_LOCATE_BORDER_TREE_H

#include "tiling/box_tree.h"
#include "tiling/tiling.h"

#include <meshwalk/locate.h>

typedef struct mw_border_edge {
    mw_point a, b;
    uint32_t triangle; /* of the user's */
    uint32_t edge;     /* as the user numbers it */
} mw_border_edge;

/* The border edges in Hilbert order, and a tree of their boxes. */
typedef struct mw_border_tree {
    mw_border_edge *edge;
    mw_box_tree tree;
    uint32_t edge_count;
} mw_border_tree;

/* The user's edge that edge k of a tile is, or, where the tile is one part of a triangle that was
 * cut, lies along. */
uint32_t mw__border_edge_of_user(const mw_mesh *mesh, const mw_tiling *tiling,
                                 const mw_triangle *tile, uint32_t k);

/* The box of edge i, for the tree. */
mw_box mw__border_edge_box(const void *edges, uint32_t i);

/* Returns false when out of memory. */
bool mw__border_tree_create(mw_border_tree *border, const mw_mesh *mesh, const mw_tiling *tiling);
void mw__border_tree_release(mw_border_tree *border);
size_t mw__border_tree_bytes(const mw_border_tree *border);

/* The edge nearest to q, and the point of it nearest to q. False if there is no edge. */
bool mw__border_tree_nearest(const mw_border_tree *border, const mw_mesh *mesh, mw_point q,
                             mw_nearest_border_point *hit);

/* Turn a location outside into MW_NEAR if the border is within the tolerance of q. */
void mw__border_tree_apply_tolerance(const mw_border_tree *border, const mw_mesh *mesh, mw_point q,
                                     double tolerance, mw_location *location);

#endif
