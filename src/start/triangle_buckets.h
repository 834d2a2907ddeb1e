/* triangle_buckets.h - a uniform grid whose buckets know all triangles that reach into them.
 * Private. */
#ifndef MW_SRC_START_TRIANGLE_BUCKETS_H
#define MW_SRC_START_TRIANGLE_BUCKETS_H

#include "start/lattice.h"
#include "walk/walk.h"

typedef struct mw_triangle_buckets {
    mw_lattice lattice;
    uint32_t *from; /* from[c] .. from[c + 1]: the tiles of bucket c, in: */
    uint32_t *tile; /* their names */
} mw_triangle_buckets;

/* About `cells` buckets (0: by the number of vertices, at most MW_MAX_CELLS) over low..high, the
 * extent of the tiling; fewer where tiles would be in many each. Stages of the present part of
 * the job. Returns false when out of memory, or cancelled. */
bool mw__triangle_buckets_create(mw_triangle_buckets *buckets, const mw_tiling *tiling,
                                 const double low[2], const double high[2], uint32_t cells,
                                 mw_job *job);
void mw__triangle_buckets_release(mw_triangle_buckets *buckets);
size_t mw__triangle_buckets_bytes(const mw_triangle_buckets *buckets);

/* The name of the tile in the bucket of q that has q, as far as doubles tell; else of one near. The
 * tests that this takes are counted in *work, unless that is NULL. */
uint32_t mw__triangle_buckets_first(const mw_triangle_buckets *buckets, const mw_tiling *tiling,
                                    mw_point q, mw_work *work);

#endif
