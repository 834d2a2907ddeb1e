/* predicate_cases.h - input for tests of predicates: random, nearly degenerate and degenerate
 * points, at all scales. All come from one stream of random numbers. MW_TEST_LONG=1 makes the
 * tests run a hundred times as many cases, MW_TEST_SEED=n other ones. */
#ifndef MW_TESTS_SUPPORT_PREDICATE_CASES_H
#define MW_TESTS_SUPPORT_PREDICATE_CASES_H

#include <stdint.h>

/* The state of the stream (base/random.h). */
extern uint64_t cases_random;

/* Begins the stream anew: the same cases every time, unless the environment asks for others. */
void cases_seed(void);

/* How many cases to run where n are the usual number. */
long cases_count(long n);

/* --- random numbers --------------------------------------------------------------------------- */

/* An integer in [0, n). */
uint32_t cases_below(uint32_t n);

/* In [-1, 1). */
double cases_uniform(void);

/* A finite number of random bits. */
double cases_finite(void);

/* A number that is special: zero, the smallest, the largest, some between; of either sign. */
double cases_extreme(void);

/* v, or the finite number that is nearest to it. */
double cases_clamped(double v);

/* --- points: n numbers, of points of `dimension` coordinates (2 or 3) ------------------------- */

/* Writes points of a kind that chance chooses, sometimes perturbed or scaled as follow. */
void cases_generate(double *p, int n, int dimension);

/* Moves some numbers by some units in the last place. */
void cases_perturb(double *p, int n);

/* Scales all numbers to anywhere between the smallest and the largest doubles; most often to the
 * ends of the range of expansions, which are 2^-485 to 2^509 (orient2d), 2^-306 to 2^339
 * (orient3d), 2^-216 to 2^253 (incircle). */
void cases_rescale(double *p, int n);

#endif
