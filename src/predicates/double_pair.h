/* double_pair.h - numbers of twice the precision of a double, as a sum of two [Dekker 1971; Joldes,
 * Muller, Popescu 2017]. Private.
 *
 * `low` is at most half a unit in the last place of `high`. Each operation is off by less than
 * MW_PAIR_ERROR of its result. Results may neither over- nor underflow. */
#ifndef MW_SRC_PREDICATES_DOUBLE_PAIR_H
#define MW_SRC_PREDICATES_DOUBLE_PAIR_H

#include "predicates/error_free.h"

#define MW_PAIR_ERROR 0x1p-101

typedef struct mw_pair {
    double high, low;
} mw_pair;

/* a - b, exact. */
static MW_INLINE mw_pair mw__pair_difference(double a, double b)
{
    mw_pair r;
    r.high = mw__two_sum(a, -b, &r.low);
    return r;
}

static MW_INLINE mw_pair mw__pair_negative(mw_pair a)
{
    return (mw_pair){-a.high, -a.low};
}

/* Off by 3 2^-106 and terms of higher order, also where the two cancel. */
static MW_INLINE mw_pair mw__pair_add(mw_pair a, mw_pair b)
{
    double high_tail, low_tail, tail;
    double high = mw__two_sum(a.high, b.high, &high_tail),
           low = mw__two_sum(a.low, b.low, &low_tail);
    high = mw__fast_two_sum(high, high_tail + low, &tail);
    mw_pair r;
    r.high = mw__fast_two_sum(high, low_tail + tail, &r.low);
    return r;
}

/* Off by 7 2^-106. */
static MW_INLINE mw_pair mw__pair_multiply(mw_pair a, mw_pair b)
{
    double tail, product = mw__two_product(a.high, b.high, &tail);
    mw_pair r;
    r.high = mw__fast_two_sum(product, tail + (a.high * b.low + a.low * b.high), &r.low);
    return r;
}

/* Off by less than 20 2^-106. */
static MW_INLINE mw_pair mw__pair_divide(mw_pair a, mw_pair b)
{
    double first = a.high / b.high, tail;
    mw_pair product = mw__pair_multiply((mw_pair){first, 0}, b);
    double rest = (a.high - product.high) + (a.low - product.low);
    mw_pair r;
    r.high = mw__fast_two_sum(first, rest / b.high, &tail);
    r.low = tail;
    return r;
}

#endif
