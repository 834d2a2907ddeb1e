/* big.h - integers of any size that the predicates need, for coordinates out of the range of
 * expansions. Private.
 *
 * A set of doubles is written as integers times one power of two, 2^base, the largest that divides
 * them all. Finite doubles give integers of at most 2098 bits then, and few bits for doubles of
 * similar size. */
#ifndef MW_SRC_PREDICATES_BIG_H
#define MW_SRC_PREDICATES_BIG_H

#include "base/base.h"

/* Room for the largest number that occurs, of degree 8 in differences of 33 limbs (line.c): 264
 * limbs, and one to carry. */
#define MW_BIG_LIMBS 265

typedef struct mw_big {
    int sign;                    /* -1, 0, 1 */
    int n;                       /* limbs in use, the last one not 0; 0 for the number 0 */
    uint64_t limb[MW_BIG_LIMBS]; /* the lowest first */
} mw_big;

/* The largest base such that v[0..n) are integers times 2^base; 0 if all of them are 0. */
int mw__big_base(const double *v, int n);

/* r = (a - b) / 2^base. */
void mw__big_difference(mw_big *r, double a, double b, int base);

/* r = 1. */
void mw__big_unit(mw_big *r);

/* r may be a or b. */
void mw__big_add(mw_big *r, const mw_big *a, const mw_big *b);
void mw__big_subtract(mw_big *r, const mw_big *a, const mw_big *b);
/* r must not be a or b; a and b may be the same. */
void mw__big_multiply(mw_big *r, const mw_big *a, const mw_big *b);

/* r = a*d - b*c. */
void mw__big_cross(mw_big *r, const mw_big *a, const mw_big *b, const mw_big *c, const mw_big *d);

/* a = fraction * 2^*exponent, rounded, with the fraction's magnitude from 1/2 to 1, or 0. */
double mw__big_fraction(const mw_big *a, int *exponent);

/* a * 2^exponent, rounded; where that is not 0 and no normal double, +-DBL_MAX or +-DBL_MIN. */
double mw__big_double(const mw_big *a, int exponent);

#endif
