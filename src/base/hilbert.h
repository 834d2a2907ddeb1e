/* hilbert.h - order along a Hilbert curve: keys, and a radix sort of them. Private. */
#ifndef MW_SRC_BASE_HILBERT_H
#define MW_SRC_BASE_HILBERT_H

#include "base/base.h"

#define MW_HILBERT_CELLS (1 << 16) /* along each side */

/* Maps coordinates of an extent to the 2^16 x 2^16 cells of a curve. `leap` follows the curve four
 * levels at a time: leap[state][16 * x + y] = 256 * next state + rank, for four bits of x and of
 * y. */
typedef struct mw_hilbert {
    double x0, y0, scale;
    uint16_t leap[4][256];
} mw_hilbert;

/* Extent low..high; a flat or empty extent is allowed. */
mw_hilbert mw__hilbert(const double low[2], const double high[2]);

static MW_INLINE uint32_t mw__hilbert_cell(double offset)
{
    /* written so that NaN goes to 0 */
    return offset > 0 ? offset < MW_HILBERT_CELLS - 1 ? (uint32_t)offset : MW_HILBERT_CELLS - 1 : 0;
}

/* Position of the cell of x, y along the curve; points outside the extent, and NaN, are moved to
 * its border. */
static MW_INLINE uint32_t mw__hilbert_key(const mw_hilbert *hilbert, double x, double y)
{
    uint32_t column = mw__hilbert_cell((x - hilbert->x0) * hilbert->scale);
    uint32_t row = mw__hilbert_cell((y - hilbert->y0) * hilbert->scale);
    uint32_t key = 0, state = 0;
    for (int bits = 12; bits >= 0; bits -= 4) {
        uint32_t next = hilbert->leap[state][(column >> bits & 15) << 4 | (row >> bits & 15)];
        key = key << 8 | (next & 255);
        state = next >> 8;
    }
    return key;
}

typedef struct mw_key {
    uint32_t key, item;
} mw_key;

/* Sort by key; items of equal keys keep their order. `scratch` has room for n too. */
void mw__sort_keys(mw_key *keys, mw_key *scratch, size_t n);
/* The same for keys that are equal but for their lowest `bits` bits, which takes less time. */
void mw__sort_keys_by(mw_key *keys, mw_key *scratch, size_t n, uint32_t bits);

#endif
