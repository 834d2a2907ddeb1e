/* start.h - ways to choose the first tile of a walk: one file each. Private. "Last" needs no file:
 * it is a number in the cursor. */
#ifndef MW_SRC_START_START_H
#define MW_SRC_START_START_H

#include "base/hilbert.h"
#include "tiling/tiling.h"

#include <meshwalk/locate.h>

/* Any tile with the same chance. */
uint32_t mw__start_random(const mw_tiling *tiling, uint64_t *random);

/* The nearest to q, by its vertex 0, of `count` random tiles, and of `rival` unless that is
 * MW_NONE. */
uint32_t mw__start_sample(const mw_tiling *tiling, mw_point q, uint32_t count, uint32_t rival,
                          uint64_t *random);

/* How many to sample: `sample` itself, or by its rule, but no more than there are tiles. The cube
 * root of the number of vertices balances sampling and walking [Devroye, Muecke, Zhu 1998]. */
uint32_t mw__sample_count(const mw_tiling *tiling, uint32_t sample);

/* The tile that holds the middle of the extent low..high; found by walking, so it is looked for
 * once. */
uint32_t mw__start_centre(const mw_tiling *tiling, const double low[2], const double high[2]);

/* Sort queries along a Hilbert curve. The curve covers the part of their extent that lies within
 * low..high, the extent of the mesh. order[i].item becomes the query that comes i-th. scratch: room
 * for n keys. */
void mw__sort_queries(const double *points, size_t n, size_t stride, const double low[2],
                      const double high[2], mw_key *order, mw_key *scratch);

/* For each finite vertex the name of a tile that has it, the lowest unless tiles are edited;
 * MW_NONE for the other ones. NULL when out of memory. Release with free(). */
uint32_t *mw__tile_of_vertices(const mw_tiling *tiling);

/* Square of the rounded distance: a guide, never a decision. */
static MW_INLINE double mw__distance2(mw_point a, mw_point b)
{
    double dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy;
}

#endif
