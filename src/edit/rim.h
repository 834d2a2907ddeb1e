/* rim.h - the boundary of tiles that are to be replaced by others with the same corners, or fewer. Private.
 *
 * Steps are given counter-clockwise: the tiles to be replaced lie to the left. Their records are the pool, of which the new tiles take what
 * they need, those with the lowest numbers first; what is left is dropped when the edit is done. */
#ifndef MW_SRC_RIM_H
#define MW_SRC_RIM_H

#include "edit/fabric.h"

/* Tiles to be replaced, all of the user's or all ghosts beside one another. */
typedef struct mw_pool {
    uint32_t *tile;
    size_t count, used;
    mw_rim_step *
        slit; /* room for those steps of a chain that are slits, from one side: `half` as it was, `beyond` the new one */
    size_t slit_count;
} mw_pool;

/* Journal the tiles of a pool and sort them by number. */
bool mw__pool_begin(mw_fabric *f, mw_pool *pool);
/* The same for the star of a vertex, of which two tiles will not be needed: only those two, of the highest numbers, are put last. */
bool mw__pool_begin_ring(mw_fabric *f, mw_pool *pool);

/* Cut off corners of the chain of n steps wherever it turns left, until it turns left nowhere [Graham 1972], which is right for chains all
 * of whose vertices are seen from one point or one edge to the left of them [Toussaint, Avis 1982]. step[n].vertex is where it ends.
 * *n becomes the number of steps that are left; where corners were cut off a step, the last tile's edge 2 is its `beyond`. Pushes edges between new tiles for
 * mw__legalise; false when out of memory. */
bool mw__cut_chain(mw_fabric *f, mw_rim_step *step, size_t *n, mw_pool *pool);

/* Fill the closed ring of n steps, the star of a vertex without fixed edges in a mesh kept Delaunay, with tiles that are Delaunay. */
void mw__fill_ring(mw_fabric *f, const mw_rim_step *step, size_t n, mw_pool *pool);

/* Cut the star of a vertex at q, inside the closed ring of n steps, into tiles. */
bool mw__cut_ring(mw_fabric *f, mw_rim_step *step, size_t n, mw_point q, mw_pool *pool);

/* The numbers of tiles not used lead to the lowest that is, or to `heir`, a number; the tiles have to be dropped. */
void mw__pool_end(mw_fabric *f, mw_pool *pool, uint32_t heir);

#endif
