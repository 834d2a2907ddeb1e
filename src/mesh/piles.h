/* piles.h - triangles of the caller's arrays, piled up by ranges of their lowest vertices. Private.
 *
 * How many triangles a range gets is not known before; so piles are made of blocks, taken as they are needed, and the arrays
 * are gone through once. */
#ifndef MW_SRC_PILES_H
#define MW_SRC_PILES_H

#include "mesh/mesh.h"

/* A triangle, its vertices by their places, and its number in the arrays. */
typedef struct mw_corners {
    uint32_t v[3], user;
} mw_corners;

#define MW_PILE_BLOCK 64u /* triangles */

typedef struct mw_pile {
    uint32_t next;          /* where the next triangle goes; a multiple of MW_PILE_BLOCK: to a new block */
    uint32_t first, blocks; /* its first block, and how many it has                                     */
} mw_pile;

/* Each stacker, a thread, has a pile for each range of 2^shift vertices, and piles up its share of the arrays: those of stacker 0
 * come before those of stacker 1 in the arrays, and so on. */
typedef struct mw_piles {
    mw_corners *at;
    uint32_t *following; /* per block: the next one of its pile */
    mw_pile *pile;       /* those of stacker 0, of stacker 1, ... */
    uint32_t ranges, shift, stackers;
    size_t triangle_count;
} mw_piles;

/* Triangles that `at`, which the caller provides, has to hold: some blocks are not full. */
size_t mw__piles_room(const mw_piles *piles);

/* Make piles of the arrays' triangles; the mesh has its vertices already. *bad becomes the first triangle that is not usable, and
 * then the piles are not; or MW_NONE. all_finite: are the vertices? Returns false when out of memory; release in either case. */
bool mw__pile_up(mw_piles *piles, const mw_mesh *mesh, const mw_arrays *arrays, bool all_finite, uint32_t *bad);
void mw__piles_release(mw_piles *piles);

/* How many triangles a range has. */
uint32_t mw__piles_count(const mw_piles *piles, uint32_t range);

/* Goes through the piles of a range, in the order of the arrays. */
typedef struct mw_pile_reader {
    const mw_piles *piles;
    uint32_t range, stacker, block, left;
} mw_pile_reader;

static MW_INLINE mw_pile_reader mw__read_piles(const mw_piles *piles, uint32_t range)
{
    return (mw_pile_reader){.piles = piles, .range = range};
}

/* The next block of triangles, *count of them; NULL at the end. */
const mw_corners *mw__read_block(mw_pile_reader *reader, uint32_t *count);

#endif
