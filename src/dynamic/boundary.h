/* boundary.h - fill the polygon inside a boundary with tiles. Private.
 *
 * Used when tiles are replaced by the same number of tiles, or fewer, with the same corners. Steps
 * are given counter-clockwise: the polygon lies to their left. The new tiles reuse the slots and
 * numbers of the old ones (the pool), lowest numbers first. The slots left over are dropped at the
 * end of the edit. */
#ifndef MW_SRC_DYNAMIC_BOUNDARY_H
#define MW_SRC_DYNAMIC_BOUNDARY_H

#include "dynamic/dynamic_tiling.h"

/* Tiles to be replaced: all of the user's, or all ghosts that are connected. The first `used` have
 * become new tiles.
 * `slit`: room for the steps of a chain that are slits, one entry for each slit. `half` is the old
 * half-edge, `beyond` the new one. */
typedef struct mw_pool {
    uint32_t *tile;
    size_t count, used;
    mw_boundary_step *slit;
    size_t slit_count;
} mw_pool;

/* Record the tiles of a pool in the journal, and sort them by number. */
bool mw__pool_begin(mw_dynamic_tiling *dynamic, mw_pool *pool);
/* The same for the star of a vertex. Two of its tiles will be left over; so it suffices to put the
 * two with the highest numbers last. */
bool mw__pool_begin_ring(mw_dynamic_tiling *dynamic, mw_pool *pool);

/* Cut off the corners at which a chain of n steps turns left, until it turns left nowhere [Graham
 * 1972]. This is correct for chains whose vertices are all visible from one point, or from one
 * edge, to their left [Toussaint, Avis 1982]. step[n].vertex is the end of the chain. Sets *n to
 * the number of steps left. If corners were cut off at a step, its `beyond` is edge 2 of the last
 * tile there. Pushes the edges between new tiles for mw__legalise. False when out of memory. */
bool mw__chain_cut_corners(mw_dynamic_tiling *dynamic, mw_boundary_step *step, size_t *n,
                           mw_pool *pool);

/* Fill the closed ring of n steps with Delaunay tiles. The ring is the star of a vertex that has no
 * fixed edge, in a mesh that is kept Delaunay. */
void mw__ring_fill_delaunay(mw_dynamic_tiling *dynamic, const mw_boundary_step *step, size_t n,
                            mw_pool *pool);

/* Fill the closed ring of n steps, the star of a vertex at q, with any tiles: cut off its
 * corners. */
bool mw__ring_cut_corners(mw_dynamic_tiling *dynamic, mw_boundary_step *step, size_t n, mw_point q,
                          mw_pool *pool);

/* Redirect the numbers of the tiles left over to the lowest number used, or, if none was, to the
 * number `heir`. The caller drops the tiles. */
void mw__pool_end(mw_dynamic_tiling *dynamic, mw_pool *pool, uint32_t heir);

#endif
