/* index.h - what a start has built beside the mesh. Private. */
#ifndef MW_SRC_LOCATE_INDEX_H
#define MW_SRC_LOCATE_INDEX_H

#include "start/chains.h"
#include "start/curve.h"
#include "start/grid.h"
#include "start/kd_tree.h"
#include "start/layers.h"
#include "start/triangle_buckets.h"
#include "start/two_level_grid.h"
#include "start/vertex_buckets.h"
#include "walk/walk.h"

#include <meshwalk/locate.h>

struct mw_index {
    mw_start_kind start; /* tells which member of the union is in use */
    double seconds;      /* it took to build                        */
    /* of a guide: large batches are sorted, and a query begins where the one before it ended */
    bool sort_batches;
    union {
        mw_grid grid;
        mw_two_level_grid two_level_grid;
        mw_layers layers;
        mw_curve curve;
        mw_vertex_buckets vertex_buckets;
        mw_triangle_buckets triangle_buckets;
        mw_kd_tree kd_tree;
        mw_chains chains;
    };
};

/* Build what the start of an index, which is set, is made of, for a tiling of this extent; on
 * failure it may be released. Stages of the present part of the job. */
mw_status mw__index_build(mw_index *index, const mw_tiling *tiling, const double low[2],
                          const double high[2], const mw_index_options *options, mw_job *job,
                          mw_error *error);

/* Release what an index holds, or count its bytes. */
void mw__index_release(mw_index *index);
size_t mw__index_bytes(const mw_index *index);

/* Does a look into the index make tests that are counted? */
static MW_INLINE bool mw__index_counts(const mw_index *index)
{
    return index->start == MW_START_LAYERS || index->start == MW_START_TRIANGLE_BUCKETS;
}

/* The first tile for q: a tile of this tiling, whatever mesh the index was made from. Not for those
 * that count. */
uint32_t mw__index_tile(const mw_tiling *tiling, const mw_index *index, mw_point q);
/* The same without reading that tile, for callers that prefetch it and read it later. */
uint32_t mw__index_tile_ahead(const mw_tiling *tiling, const mw_index *index, mw_point q);

/* The first tile for q by the cursor's index: a tile of this tiling, whatever mesh the index was
 * made from. What walking through the index did is added to *work, if the cursor counts. */
uint32_t mw__index_first(const mw_tiling *tiling, const mw_cursor *cursor, mw_point q,
                         uint64_t *random, mw_work *work);

#define MW_INDEX_MANY 64

/* The first tiles for n points, at most MW_INDEX_MANY. The look-ups wait for memory together, not
 * one after the other. Not for indices that count. */
void mw__index_first_many(const mw_tiling *tiling, const mw_index *index, const mw_point *q,
                          uint32_t n, uint32_t *t);

#endif
