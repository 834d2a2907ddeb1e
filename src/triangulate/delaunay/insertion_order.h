/* insertion_order.h - the order in which points are inserted. Private. */
#ifndef MW_SRC_TRIANGULATE_DELAUNAY_INSERTION_ORDER_H
#define MW_SRC_TRIANGULATE_DELAUNAY_INSERTION_ORDER_H

#include "base/base.h"

/* Fill sequence[n] with first .. first + n - 1 in rounds, each about eight times as large as the
 * one before and a random sample of what is left; within a round the numbers ascend. */
void mw__insertion_sequence(uint32_t first, uint32_t n, uint32_t *sequence);

#endif
