/* delaunay_order.h - the order in which points are numbered, and the order in which they are inserted. Private. */
#ifndef MW_SRC_DELAUNAY_ORDER_H
#define MW_SRC_DELAUNAY_ORDER_H

#include "base/hilbert.h"
#include "predicates/predicates.h"

/* More points than this with one key are sorted again, on a finer curve through their own extent. */
#define MW_LONG_RUN 256

/* The extent of finite points, n > 0. */
typedef struct mw_extent {
    double low[2], high[2];
} mw_extent;

/* Sort the numbers of n points, in keys[i].item, along a Hilbert curve through their extent. `scratch` has room for n keys
 * too. Threads: 0 as OpenMP gives. Returns false when out of memory. */
bool mw__hilbert_order(const mw_point *points, uint32_t n, const mw_extent *extent, uint32_t threads, mw_key *keys,
                       mw_key *scratch);

/* The keys of the points keys[i].item along the curve through the extent of these points. */
void mw__set_keys(const mw_point *points, mw_key *keys, size_t n);

/* Fill sequence[n] with first .. first + n - 1 in rounds, each about eight times as large as the one before and a random
 * sample of what is left; within a round the numbers ascend. */
void mw__insertion_sequence(uint32_t first, uint32_t n, uint32_t *sequence);

#endif
