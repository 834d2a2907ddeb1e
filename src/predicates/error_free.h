/* error_free.h - sums and products of doubles with what rounding leaves: [Shewchuk 1997, sec. 2].
 * Private. Neither result may overflow, nor a tail underflow. */
#ifndef MW_SRC_PREDICATES_ERROR_FREE_H
#define MW_SRC_PREDICATES_ERROR_FREE_H

#include "base/base.h"

/* a + b = the returned double + *tail [Knuth]. */
static MW_INLINE double mw__two_sum(double a, double b, double *tail)
{
    double sum = a + b, b_part = sum - a, a_part = sum - b_part;
    *tail = (a - a_part) + (b - b_part);
    return sum;
}

/* The same where |a| >= |b| or a is 0 [Dekker]. */
static MW_INLINE double mw__fast_two_sum(double a, double b, double *tail)
{
    double sum = a + b;
    *tail = b - (sum - a);
    return sum;
}

/* a = high + low, each of at most 26 bits, so that products of halves are exact [Dekker]. */
static MW_INLINE void mw__split(double a, double *high, double *low)
{
    double c = 0x1.0000002p27 * a; /* 2^27 + 1 */
    *high = c - (c - a);
    *low = a - *high;
}

/* a * b = the returned double + *tail [Dekker, Veltkamp]. */
static MW_INLINE double mw__two_product(double a, double b, double *tail)
{
    double product = a * b, a_high, a_low, b_high, b_low;
    mw__split(a, &a_high, &a_low);
    mw__split(b, &b_high, &b_low);
    double rest = ((product - a_high * b_high) - a_low * b_high) - a_high * b_low;
    *tail = a_low * b_low - rest;
    return product;
}

#endif
