/* hilbert.c - the Hilbert curve of order 16 by a table of 4 states, two bits of key a step and four
 * steps at a time, and a radix sort of the 32-bit keys. */
#include "base/hilbert.h"

#include <string.h>

/* The curve in a quadrant is the curve mirrored at a diagonal or not: state 0 starts at the lower
 * left and ends at the lower right, 1 is its mirror image at the diagonal, 2 and 3 are 0 and 1
 * turned by 180 degrees. step[state][2 * x + y] = 4 * next state + rank of the quadrant on the
 * curve. */
static const uint8_t step[4][4] = {
    {4 * 1 + 0, 4 * 0 + 1, 4 * 3 + 3, 4 * 0 + 2},
    {4 * 0 + 0, 4 * 2 + 3, 4 * 1 + 1, 4 * 1 + 2},
    {4 * 2 + 2, 4 * 1 + 3, 4 * 2 + 1, 4 * 3 + 0},
    {4 * 3 + 2, 4 * 3 + 1, 4 * 0 + 3, 4 * 2 + 0},
};

/* Four steps of the curve for four bits of x and y. */
static uint16_t hilbert_leap(uint32_t state, uint32_t x, uint32_t y)
{
    uint32_t rank = 0;
    for (int bit = 3; bit >= 0; bit--) {
        uint32_t next = step[state][2 * (x >> bit & 1) + (y >> bit & 1)];
        rank = rank << 2 | (next & 3);
        state = next >> 2;
    }
    return (uint16_t)(state << 8 | rank);
}

mw_hilbert mw__hilbert(const double low[2], const double high[2])
{
    /* halves, so that an extent of the whole range of doubles does not overflow */
    double half_x = high[0] / 2 - low[0] / 2, half_y = high[1] / 2 - low[1] / 2;
    double half = half_x > half_y ? half_x : half_y;
    double scale = half > 0 ? MW_HILBERT_CELLS / 2 / half : 0;
    mw_hilbert hilbert = {.x0 = low[0], .y0 = low[1], .scale = scale < 1e300 ? scale : 0};
    for (uint32_t state = 0; state < 4; state++)
        for (uint32_t cell = 0; cell < 256; cell++)
            hilbert.leap[state][cell] = hilbert_leap(state, cell >> 4, cell & 15);
    return hilbert;
}

/* Sort by `digits` digits of `bits` bits each, the lowest digit first. Both are constants. */
static MW_INLINE void sort_digits(mw_key *keys, mw_key *scratch, size_t n, uint32_t digits,
                                  uint32_t bits)
{
    enum { DIGITS = 3, BUCKETS = 1 << 12 };
    uint32_t next[DIGITS][BUCKETS], mask = (UINT32_C(1) << bits) - 1;
    for (uint32_t d = 0; d < digits; d++) memset(next[d], 0, sizeof(uint32_t) << bits);
    for (size_t i = 0; i < n; i++)
        for (uint32_t d = 0; d < digits; d++) next[d][keys[i].key >> (d * bits) & mask]++;
    mw_key *from = keys, *to = scratch;
    for (uint32_t d = 0; d < digits; d++) {
        uint32_t sum = 0;
        for (uint32_t b = 0; b <= mask; b++) {
            uint32_t here = next[d][b];
            next[d][b] = sum;
            sum += here;
        }
        for (size_t i = 0; i < n; i++) to[next[d][from[i].key >> (d * bits) & mask]++] = from[i];
        mw_key *swap = from;
        from = to;
        to = swap;
    }
    if (from != keys) memcpy(keys, from, n * sizeof *keys);
}

void mw__sort_keys(mw_key *keys, mw_key *scratch, size_t n)
{
    sort_digits(keys, scratch, n, 3, 11);
}

void mw__sort_keys_by(mw_key *keys, mw_key *scratch, size_t n, uint32_t bits)
{
    if (bits <= 22)
        sort_digits(keys, scratch, n, 2, 11);
    else if (bits <= 24)
        sort_digits(keys, scratch, n, 2, 12);
    else
        sort_digits(keys, scratch, n, 3, 11);
}
