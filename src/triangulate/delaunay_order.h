/* delaunay_order.h - the order in which points are numbered, and the order in which they are inserted. Private. */
#ifndef MW_SRC_DELAUNAY_ORDER_H
#define MW_SRC_DELAUNAY_ORDER_H

#include "predicates/predicates.h"

/* The extent of finite points, n > 0. */
typedef struct mw_extent {
    double low[2], high[2];
} mw_extent;

/* Fill order[n] with the numbers of the points along a Hilbert curve. Returns false when out of memory. */
bool mw__hilbert_order(const mw_point *points, uint32_t n, const mw_extent *extent, uint32_t *order);

/* Fill sequence[n] with 0 .. n - 1 in rounds, each about eight times as large as the one before and a random sample of
 * what is left; within a round the numbers ascend. */
void mw__insertion_sequence(uint32_t n, uint32_t *sequence);

#endif
