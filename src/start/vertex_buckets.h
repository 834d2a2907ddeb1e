/* vertex_buckets.h - a uniform grid of buckets as published, searched in a spiral. Private. */
#ifndef MW_SRC_START_VERTEX_BUCKETS_H
#define MW_SRC_START_VERTEX_BUCKETS_H

#include "start/lattice.h"

typedef struct mw_vertex_buckets {
    mw_lattice lattice;
    /* of each bucket: the name of a tile that has a vertex in it; MW_NONE: it is empty */
    uint32_t *tile;
} mw_vertex_buckets;

/* About `cells` buckets (0: by the number of vertices, at most MW_MAX_CELLS) over low..high, the
 * extent of the tiling. A stage that takes the present part of the job. Returns false
 * when out of memory, or cancelled. */
bool mw__vertex_buckets_create(mw_vertex_buckets *buckets, const mw_tiling *tiling,
                               const double low[2], const double high[2], uint32_t cells,
                               mw_job *job);
void mw__vertex_buckets_release(mw_vertex_buckets *buckets);
size_t mw__vertex_buckets_bytes(const mw_vertex_buckets *buckets);

/* The name of the tile in the bucket of q, or else in the first bucket of a spiral round it that
 * has one. */
uint32_t mw__vertex_buckets_first(const mw_vertex_buckets *buckets, mw_point q);

/* The first cell, along a spiral round the cell of q, for which `holds` is true; MW_NONE: there is
 * none. */
typedef bool mw_cell_holds(const void *self, uint32_t cell);
uint32_t mw__lattice_spiral(const mw_lattice *lattice, mw_point q, mw_cell_holds *holds,
                            const void *self);

#endif
