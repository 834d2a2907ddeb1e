/* expansion.h - exact sums and products of doubles [Shewchuk 1997, sec. 2]. Private.
 *
 * An expansion is a number written as an unevaluated sum of doubles that do not overlap, in order
 * of increasing magnitude and without zeros; the number zero has no parts. Its last part has its
 * sign. Rounding to nearest, ties to even, is taken for granted, as are results that neither
 * overflow nor need bits below 2^-1074: the predicates check the range of their arguments first
 * (mw__within).
 *
 * Results are put one after the other into an arena, an array of the caller's on the stack; each
 * function says how many doubles it may need there. */
#ifndef MW_SRC_PREDICATES_EXPANSION_H
#define MW_SRC_PREDICATES_EXPANSION_H

#include "predicates/predicates.h"

typedef struct mw_expansion {
    const double *part;
    int n;
} mw_expansion;

typedef struct mw_arena {
    double *next;
} mw_arena;

/* a - b. Takes 2 doubles. */
mw_expansion mw__expansion_difference(mw_arena *arena, double a, double b);
/* e + f and e - f. Take e.n + f.n doubles. */
mw_expansion mw__expansion_add(mw_arena *arena, mw_expansion e, mw_expansion f);
mw_expansion mw__expansion_subtract(mw_arena *arena, mw_expansion e, mw_expansion f);
/* e * f. Takes 2 * e.n * f.n doubles, and as many again while it works. */
mw_expansion mw__expansion_multiply(mw_arena *arena, mw_expansion e, mw_expansion f);
/* The expansion as one double, with its sign: off by a few units in the last place. */
double mw__expansion_estimate(mw_expansion e);

/* a*d - b*c for expansions of at most two parts (differences): at most 16 parts. Takes 48
 * doubles. */
#define MW_CROSS_ROOM 48
mw_expansion mw__expansion_cross(mw_arena *arena, mw_expansion a, mw_expansion b, mw_expansion c,
                                 mw_expansion d);

/* d[0] d[1] - d[2] d[3] of four doubles, into *det with a relative error below 2^-50 and its sign.
 * False where that takes more than a few sums, or a product is not of a magnitude from 2^-900 to
 * 2^900 or 0. */
bool mw__double_cross(const double d[4], double *det);

/* a - b. False where it is rounded. */
bool mw__difference_is_exact(double a, double b, double *difference);

/* Scale v[0..n) by 2^shift, so that the largest is about 2^200: *shift is returned. False where one
 * of them is not finite, all are 0, or the smallest would leave low. */
bool mw__scale_within(const double *v, int n, double low, double *scaled, int *shift);

/* Is each of v[0..n) zero or of a magnitude from low to high? False for NaN. */
bool mw__within(const double *v, int n, double low, double high);

/* Is each of v[0..n) finite? */
bool mw__all_finite(const double *v, int n);

#endif
