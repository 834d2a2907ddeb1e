/* cavity.h - the cavity of a new vertex: the tiles that its insertion deletes. Private.
 *
 * These are the tiles whose circumcircles contain the new vertex and that are connected to it; the
 * vertex sees the whole cavity [Bowyer 1981; Watson 1981]. Fixed edges bound a cavity. In a mesh
 * that is not kept Delaunay every edge bounds one. Digging a cavity changes no tile. It records
 * only tiles on the hull that stay and get a neighbour. */
#ifndef MW_SRC_DYNAMIC_CAVITY_H
#define MW_SRC_DYNAMIC_CAVITY_H

#include "dynamic/dynamic_tiling.h"

/* A cavity round q. Its boundary, counter-clockwise, is in dynamic->boundary from `first` on; one
 * more step tells where the last one ends. Its tiles are in dynamic->pool from `pool` on, in the
 * order in which they were found. This order decides which new tile gets which number. */
typedef struct mw_cavity {
    mw_point q;
    size_t first, pool;
    size_t steps, tiles;
} mw_cavity;

/* Room for any cavity in a mesh of so many tiles, and for a second one across an edge. */
bool mw__cavity_room(mw_dynamic_tiling *dynamic, size_t tiles);

/* Dig from tile t, which contains q. The first three of dynamic->lifted are its corners. False
 * when out of memory, here and below. */
bool mw__cavity_dig_tile(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t t);

/* Dig on one side of an edge that contains q: the side where `half` is. */
bool mw__cavity_dig_side(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t half);

/* Dig from the hull edges that q sees from outside. One of them is an edge of tile t. */
bool mw__cavity_dig_outside(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t t);

/* Does q lie beyond a hull edge? The hull edges after and before one, counter-clockwise. */
bool mw__sees_hull_edge(const mw_dynamic_tiling *dynamic, mw_point q, uint32_t half);
uint32_t mw__hull_after(const mw_dynamic_tiling *dynamic, uint32_t half);
uint32_t mw__hull_before(const mw_dynamic_tiling *dynamic, uint32_t half);

/* Set the first three of dynamic->lifted to the corners of a tile. There must be room for them. */
static MW_INLINE void mw__lift_corners(mw_dynamic_tiling *dynamic, uint32_t t, mw_point q)
{
    for (int k = 0; k < 3; k++)
        dynamic->lifted[k] = mw__lift_vertex(dynamic->tiling, dynamic->tiling->tri[t].v[k], q);
}

#endif
