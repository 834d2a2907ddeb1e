/* brio.h - an order of insertion: random rounds, each about twice as large as the one before.
 * Private. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_BRIO_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_BRIO_H

#include "base/base.h"

/* The numbers 0 .. n - 1 in random rounds [Amenta, Choi, Rote 2003]: each belongs to the last with
 * probability 1/2, to the one before with 1/4, and so on; within a round they ascend. The same in
 * every run. Released with free(); NULL when out of memory. */
uint32_t *mw__brio_order(uint32_t n);

#endif
