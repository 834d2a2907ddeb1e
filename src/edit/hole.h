/* hole.h - the tiles that go because a new vertex lies in their circles, and the boundary of what they leave. Private.
 *
 * A hole is seen whole from the new vertex [Bowyer 1981; Watson 1981]. Fixed edges bound it, and where the mesh is not kept Delaunay all edges do.
 * Digging changes no tile, nor does it put any into the journal, but for those at the hull that stay and get a neighbour. */
#ifndef MW_SRC_HOLE_H
#define MW_SRC_HOLE_H

#include "edit/fabric.h"

/* Round q: steps, counter-clockwise, in f->rim from `first` on (the one after the last tells where it ends), and the tiles that go in f->pool
 * from `pool` on, in the order in which they are met, from the first tile's neighbours on; which number goes where follows from that. */
typedef struct mw_hole {
    mw_point q;
    size_t first, pool;
    size_t steps, tiles;
} mw_hole;

/* Room for any hole in a mesh of so many tiles, and for the one on the other side of an edge. */
bool mw__hole_room(mw_fabric *f, size_t tiles);

/* Dig from tile t in which q lies, and whose corners are the first three of f->sight. False when out of memory, here and below. */
bool mw__dig_tile(mw_fabric *f, mw_hole *h, uint32_t t);

/* On the side of an edge where `half` is, on which q lies. */
bool mw__dig_side(mw_fabric *f, mw_hole *h, uint32_t half);

/* Beyond the hull edges that q sees, one of which is tile t's: the hole has no tile but those whose circles q lies in. */
bool mw__dig_outside(mw_fabric *f, mw_hole *h, uint32_t t);

/* The first three of f->sight, for which there has to be room: the corners of a tile. */
static MW_INLINE void mw__lift_corners(mw_fabric *f, uint32_t t, mw_point q)
{
    for (int k = 0; k < 3; k++) f->sight[k] = mw__lift_vertex(f->tiling, f->tiling->tri[t].v[k], q);
}

#endif
