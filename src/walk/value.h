/* value.h - orientation tests whose value counts: for the walks that compare areas. Private.
 *
 * The value is rounded. In exact arithmetic it comes with a bound on its error, so that a walk can
 * tell what is sure: one that crosses an edge only where q surely lies beyond it is not misled by
 * rounding. In plain doubles the bounds are 0. */
#ifndef MW_SRC_WALK_VALUE_H
#define MW_SRC_WALK_VALUE_H

#include "walk/step.h"

/* Twice the area of abc. Its sign is exact; adds to *off the most by which the value may be off:
 * what the filter says, or, from the exact stage, 2^-50 of it and what underflow takes. */
static MW_INLINE double area_value(mw_walk *w, mw_point a, mw_point b, mw_point c, double *off,
                                   mw_policy P)
{
    if (!P.exact) return orient(w, a, b, c, P);
    if (P.count) w->work->orient[w->stage]++;
    double bound, at = mw__orient2d_rounded(a, b, c, &bound);
    if (MW_UNLIKELY(!(fabs(at) > bound))) {
        at = mw__orient2d_exact(a, b, c);
        bound = fabs(at) < DBL_MAX ? 0x1p-50 * fabs(at) + MW_UNDERFLOW_ERROR : INFINITY;
    }
    *off += bound;
    return at;
}

/* The error bound of sums of three terms, relative to the sum of their magnitudes. Each rounding
 * adds at most u = 2^-53 of that sum; there are up to four in the terms and the sum, and as many in
 * the bound itself. 16 u is more than that. */
static MW_INLINE double sum_rounding(double a, double b, double c, mw_policy P)
{
    return P.exact ? 0x1p-49 * (fabs(a) + fabs(b) + fabs(c)) : 0;
}

/* The corner of the largest coordinate, where that opposite to corner k is at[k]. */
static MW_INLINE uint32_t heaviest_corner(double at0, double at1, double at2)
{
    if (at0 >= at1 && at0 >= at2) return 0;
    return at1 >= at2 ? 1 : 2;
}

#endif
