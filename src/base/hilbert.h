/* hilbert.h - order along a Hilbert curve: keys, and a radix sort of them. Private. */
#ifndef MW_SRC_HILBERT_H
#define MW_SRC_HILBERT_H

#include "base/base.h"

/* Maps coordinates of an extent to the 2^16 x 2^16 cells of a curve. `leap` follows the curve four levels at a time:
 * leap[state][16 * x + y] = 256 * next state + rank, for four bits of x and of y. */
typedef struct mw_hilbert {
    double x0, y0, scale;
    uint16_t leap[4][256];
} mw_hilbert;

/* Extent low..high; a flat or empty extent is allowed. */
mw_hilbert mw__hilbert(const double low[2], const double high[2]);

/* Position of the cell of x, y along the curve; points outside the extent, and NaN, are moved to its rim. */
uint32_t mw__hilbert_key(const mw_hilbert *hilbert, double x, double y);

typedef struct mw_key {
    uint32_t key, item;
} mw_key;

/* Sort by key; items of equal keys keep their order. `scratch` has room for n too. */
void mw__sort_keys(mw_key *keys, mw_key *scratch, size_t n);

#endif
