/* chains.h - the tile of a point in O(log n) tests, whatever the mesh: the chain method [Lee,
 * Preparata 1977]. Private. */
#ifndef MW_SRC_START_CHAINS_H
#define MW_SRC_START_CHAINS_H

#include "tiling/tiling.h"
#include "walk/walk.h"

/* An edge, from its lower end to the upper one, and the positions of the tiles to its left and
 * right. */
typedef struct mw_chains_edge {
    mw_point low, high;
    uint32_t left, right;
} mw_chains_edge;

/* Keeps nothing of the tiling it was made from but the names of tiles. */
typedef struct mw_chains {
    mw_chains_edge *edge; /* of chain 1, of chain 2, ...; in each from below to above      */
    uint32_t *from;       /* from[c]: the first edge of chain c, from[c + 1] is behind it  */
    uint32_t *tile;       /* tile[i]: the name of the tile at position i, from 1 to tiles     */
    /* the outermost edges at the lowest vertex and at the highest one: left, right */
    mw_chains_edge bottom[2], top[2];
    uint32_t tiles, points; /* how many; tiles 0: there are no chains */
} mw_chains;

/* Chains of a tiling that fills its hull; of any other one there are none. A stage that takes the
 * present part of the job. Returns false when out of memory, or cancelled; the chains may be
 * released in either case. */
bool mw__chains_create(mw_chains *chains, const mw_tiling *tiling, mw_job *job);
void mw__chains_release(mw_chains *chains);
size_t mw__chains_bytes(const mw_chains *chains);

/* The name of the tile that has q; outside of the hull, of one with a hull edge that q lies beyond.
 * Tile 0 where there are no chains. */
uint32_t mw__chains_first(const mw_chains *chains, mw_point q);

/* The same for n points, at most MW_CHAINS_MANY. Searches wait for memory together. */
#define MW_CHAINS_MANY 64
void mw__chains_first_many(const mw_chains *chains, const mw_point *q, uint32_t n, uint32_t *tile);

/* Add what the search for q does to *work: tests of edges, and comparisons of points. */
void mw__chains_count(const mw_chains *chains, mw_point q, mw_work *work);

#endif
