/* predicate_oracle.h - the predicates by brute force in GMP integers, for the tests and the fuzz
 * targets.
 *
 * Coordinates become integers times 2^base; each function whose value is wanted, not only its
 * sign, returns the exponent of two that o->result is to be multiplied with. The numbers are
 * kept between calls, because setting them up would take longer than using them: one
 * predicate_oracle for each thread. */
#ifndef MW_TESTS_ORACLE_PREDICATE_ORACLE_H
#define MW_TESTS_ORACLE_PREDICATE_ORACLE_H

#include <gmp.h>
#include <stdbool.h>

typedef struct predicate_oracle {
    mpz_t v[12], d[12]; /* coordinates, differences of them */
    mpz_t s, t, result; /* result: the determinant         */
    mpz_t numerator[2], denominator[2];
} predicate_oracle;

void predicate_oracle_init(predicate_oracle *o);
void predicate_oracle_clear(predicate_oracle *o);

/* --- values: of points one after the other in p ----------------------------------------------- */

/* Of a, b, c in the plane: twice the area. */
long predicate_oracle_orient2d(predicate_oracle *o, const double *p);

/* Of a, b, c in the plane: (b - a) . (c - a). */
long predicate_oracle_dot2d(predicate_oracle *o, const double *p);

/* Of a, b, c, d in space: the determinant of b - a, c - a, d - a. */
long predicate_oracle_orient3d(predicate_oracle *o, const double *p);

/* Of a, b, c, d in the plane: above 0 where d is in the circle of a, b, c, which turn left. */
long predicate_oracle_incircle(predicate_oracle *o, const double *p);

/* Does `value` stand for the exact number o->result * 2^exponent: the same sign, and a relative
 * error of at most 2^-50 where the number is within the normal doubles? Beyond them, DBL_MAX and
 * at most DBL_MIN are what is expected, up to the same error. */
bool predicate_oracle_agrees(predicate_oracle *o, long exponent, double value);

/* --- comparisons: -1, 0 or 1 ------------------------------------------------------------------ */

/* p: q, a, b, c, d in the plane. The distance of q to the segment ab against that to cd. */
int predicate_oracle_compare_distance(predicate_oracle *o, const double *p);

/* p: q, a, b in the plane, then a length. The distance of q to the segment ab against the
 * length. */
int predicate_oracle_compare_distance_to(predicate_oracle *o, const double *p);

/* --- signs in the plane ----------------------------------------------------------------------- */

/* Faster: in doubles where a bound that is far too large says that they are right, else exactly.
 * Not for several threads. */

/* The sign of the area of abc: 1 if it turns left. */
int plane_orient(const double *a, const double *b, const double *c);

/* 1 if d is in the circle of a, b, c, which turn left; 0 on it. */
int plane_incircle(const double *a, const double *b, const double *c, const double *d);

/* Of three places on a line: is m strictly between a and b? */
bool plane_is_between(const double *a, const double *m, const double *b);

/* Is q on the segment ab, and none of its ends? */
bool plane_is_on_segment(const double *a, const double *b, const double *q);

/* Do the insides of the segments ab and cd cross in one point that is an end of neither? */
bool plane_is_crossing(const double *a, const double *b, const double *c, const double *d);

/* --- for other oracles ------------------------------------------------------------------------ */

/* o->v = p[0..n) / 2^base, at most 12 numbers. Returns base. */
long predicate_oracle_load(predicate_oracle *o, const double *p, int n);

/* r = a d - b c */
void predicate_oracle_cross(predicate_oracle *o, mpz_t r, mpz_t a, mpz_t b, mpz_t c, mpz_t d);

/* -1, 0 or 1, as the number is below, equal to or above 0. */
static inline int predicate_oracle_sign(int comparison)
{
    return (comparison > 0) - (comparison < 0);
}

#endif
