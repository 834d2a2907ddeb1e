/* hilbert.c - the Hilbert curve of order 16 by a table of 4 states, two bits of key a step and four steps at a time, and
 * a radix sort of the 32-bit keys. */
#include "base/hilbert.h"

#include <string.h>

enum { CELLS = 1 << 16 };

/* The curve in a quadrant is the curve mirrored at a diagonal or not: state 0 starts at the lower left and ends at the
 * lower right, 1 is its mirror image at the diagonal, 2 and 3 are 0 and 1 turned by 180 degrees.
 * step[state][2 * x + y] = 4 * next state + rank of the quadrant on the curve. */
static const uint8_t step[4][4] = {
    {4 * 1 + 0, 4 * 0 + 1, 4 * 3 + 3, 4 * 0 + 2},
    {4 * 0 + 0, 4 * 2 + 3, 4 * 1 + 1, 4 * 1 + 2},
    {4 * 2 + 2, 4 * 1 + 3, 4 * 2 + 1, 4 * 3 + 0},
    {4 * 3 + 2, 4 * 3 + 1, 4 * 0 + 3, 4 * 2 + 0},
};

/* Four steps of the curve for four bits of x and y. */
static uint16_t leap(uint32_t state, uint32_t x, uint32_t y)
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
    double scale = half > 0 ? CELLS / 2 / half : 0;
    mw_hilbert hilbert = {.x0 = low[0], .y0 = low[1], .scale = scale < 1e300 ? scale : 0};
    for (uint32_t state = 0; state < 4; state++)
        for (uint32_t cell = 0; cell < 256; cell++) hilbert.leap[state][cell] = leap(state, cell >> 4, cell & 15);
    return hilbert;
}

static MW_INLINE uint32_t cell(double offset)
{
    /* written so that NaN goes to 0 */
    return offset > 0 ? offset < CELLS - 1 ? (uint32_t)offset : CELLS - 1 : 0;
}

uint32_t mw__hilbert_key(const mw_hilbert *hilbert, double x, double y)
{
    uint32_t column = cell((x - hilbert->x0) * hilbert->scale);
    uint32_t row = cell((y - hilbert->y0) * hilbert->scale);
    uint32_t key = 0, state = 0;
    for (int bits = 12; bits >= 0; bits -= 4) {
        uint32_t next = hilbert->leap[state][(column >> bits & 15) << 4 | (row >> bits & 15)];
        key = key << 8 | (next & 255);
        state = next >> 8;
    }
    return key;
}

void mw__sort_keys(mw_key *keys, mw_key *scratch, size_t n)
{
    enum { DIGITS = 3, BITS = 11, BUCKETS = 1 << BITS };
    size_t count[DIGITS][BUCKETS];
    memset(count, 0, sizeof count);
    for (size_t i = 0; i < n; i++)
        for (int d = 0; d < DIGITS; d++) count[d][keys[i].key >> (d * BITS) & (BUCKETS - 1)]++;
    mw_key *from = keys, *to = scratch;
    for (int d = 0; d < DIGITS; d++) {
        size_t sum = 0;
        for (int b = 0; b < BUCKETS; b++) {
            size_t here = count[d][b];
            count[d][b] = sum;
            sum += here;
        }
        for (size_t i = 0; i < n; i++) to[count[d][from[i].key >> (d * BITS) & (BUCKETS - 1)]++] = from[i];
        mw_key *swap = from;
        from = to;
        to = swap;
    }
    memcpy(keys, from, n * sizeof *keys); /* three passes end in the scratch array */
}
