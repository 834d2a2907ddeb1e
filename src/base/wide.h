/* wide.h - unsigned numbers of 128 bits: products of two of 64, and what is done with them.
 * Private.
 *
 * Compilers for machines of 32 bits have no type of 128 bits. MW_NO_INT128 avoids that type on
 * other machines, too, so that a test can compare both ways. */
#ifndef MW_SRC_BASE_WIDE_H
#define MW_SRC_BASE_WIDE_H

#include "base/base.h"

typedef struct mw_wide {
    uint64_t high, low;
} mw_wide;

#if defined(__SIZEOF_INT128__) && !defined(MW_NO_INT128)

__extension__ typedef unsigned __int128 mw_native_wide;

static MW_INLINE mw_wide mw__wide_product(uint64_t a, uint64_t b)
{
    mw_native_wide product = (mw_native_wide)a * b;
    return (mw_wide){(uint64_t)(product >> 64), (uint64_t)product};
}

/* The quotient has 64 bits at most; *rest may be NULL. */
static MW_INLINE uint64_t mw__wide_divide(mw_wide w, uint64_t divisor, uint64_t *rest)
{
    mw_native_wide number = (mw_native_wide)w.high << 64 | w.low;
    uint64_t quotient = (uint64_t)(number / divisor);
    if (rest) *rest = w.low - quotient * divisor;
    return quotient;
}

#else

static MW_INLINE mw_wide mw__wide_product(uint64_t a, uint64_t b)
{
    uint64_t half = UINT32_MAX, low = (a & half) * (b & half);
    uint64_t left = (a >> 32) * (b & half) + (low >> 32);
    uint64_t right = (a & half) * (b >> 32) + (left & half);
    return (mw_wide){(a >> 32) * (b >> 32) + (left >> 32) + (right >> 32),
                     right << 32 | (low & half)};
}

/* Bit by bit. The quotient has 64 bits at most, so w.high is below the divisor; *rest may be
 * NULL. */
static inline uint64_t mw__wide_divide(mw_wide w, uint64_t divisor, uint64_t *rest)
{
    uint64_t quotient = 0;
    for (int i = 0; i < 64; i++) {
        bool carry = w.high >> 63;
        w.high = w.high << 1 | w.low >> 63;
        w.low <<= 1;
        quotient <<= 1;
        if (carry || w.high >= divisor) {
            w.high -= divisor;
            quotient |= 1;
        }
    }
    if (rest) *rest = w.high;
    return quotient;
}

#endif

/* n * 2^by, for `by` of 0 to 127. */
static MW_INLINE mw_wide mw__wide_shifted(uint64_t n, int by)
{
    if (by >= 64) return (mw_wide){n << (by - 64), 0};
    return (mw_wide){by ? n >> (64 - by) : 0, n << by};
}

/* The lowest 64 bits of w / 2^by, rounded down, for `by` of 0 to 127. */
static MW_INLINE uint64_t mw__wide_right(mw_wide w, int by)
{
    if (by >= 64) return w.high >> (by - 64);
    return by ? w.high << (64 - by) | w.low >> by : w.low;
}

/* Is one of the lowest `by` bits 1? `by` is 0 to 127. */
static MW_INLINE bool mw__wide_any(mw_wide w, int by)
{
    if (by >= 64) return w.low != 0 || (w.high & ((UINT64_C(1) << (by - 64)) - 1)) != 0;
    return (w.low & ((UINT64_C(1) << by) - 1)) != 0;
}

/* w, rounded to the nearest double: of its first 64 bits the last stands for all that follow. */
static MW_INLINE double mw__wide_double(mw_wide w)
{
    if (w.high == 0) return (double)w.low;
    int up = __builtin_clzll(w.high), down = 64 - up;
    uint64_t top = mw__wide_right(w, down) | mw__wide_any(w, down);
    return (double)top * (double)(UINT64_C(1) << (down - 1)) * 2;
}

#endif
