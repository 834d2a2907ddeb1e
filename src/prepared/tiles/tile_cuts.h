/* tile_cuts.h - triangles are divided into tiles, by cuts across the longer side of where they lie.
 * Private. */
#ifndef MW_SRC_PREPARED_TILES_TILE_CUTS_H
#define MW_SRC_PREPARED_TILES_TILE_CUTS_H

#include "base/base.h"

#include <meshwalk/mesh.h>

/* A cut in two. No triangle below it reaches farther than `low_ends` along the axis, none above it
 * begins before `high_begins`. */
typedef struct mw_tile_cut {
    int axis; /* 0: x, 1: y */
    double low_ends, high_begins;
    int64_t low, high; /* what lies below and above: the number of a cut, or -1 - that of a tile */
} mw_tile_cut;

typedef struct mw_tile_cuts {
    mw_tile_cut *cut; /* tiles - 1; each before those below and above it */
    uint32_t tiles, cuts;
    uint32_t *triangle; /* of one tile after the other, ascending in each */
    size_t *begin;      /* where those of each tile begin, and the end */
} mw_tile_cuts;

/* Divide triangles of a mesh, given in ascending order, into tiles with equally many, by the
 * middles of their boxes. At most as many tiles as triangles. False when out of memory; release in
 * either case. O(n log tiles) expected. */
bool mw__tile_cuts_create(mw_tile_cuts *cuts, const mw_mesh *mesh, const uint32_t *triangles,
                          size_t count, uint32_t tiles);
void mw__tile_cuts_release(mw_tile_cuts *cuts);

#endif
