/* predicate_cases.h - input for the tests of predicates: random, nearly degenerate and degenerate points, at all
 * scales. MW_TEST_LONG=1 makes the tests run a hundred times as many cases, MW_TEST_SEED=n other ones. */
#ifndef MW_TESTS_PREDICATE_CASES_H
#define MW_TESTS_PREDICATE_CASES_H

#include "base/random.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t state;

/* The same cases every time, unless the environment asks for others. */
static void seed_cases(void)
{
    const char *text = getenv("MW_TEST_SEED");
    state = text ? strtoull(text, NULL, 10) : 1;
    fprintf(stderr, "seed %llu\n", (unsigned long long)state);
}

static long case_count(long n)
{
    const char *text = getenv("MW_TEST_LONG");
    return text && strcmp(text, "0") != 0 ? 100 * n : n;
}

/* ---- random numbers ---- */

static uint32_t below(uint32_t n)
{
    return mw__random_below(&state, n);
}

static double uniform(void) /* in [-1, 1) */
{
    return (double)(int64_t)mw__random(&state) * 0x1p-63;
}

static double any_finite(void)
{
    double v;
    do {
        uint64_t bits = mw__random(&state);
        memcpy(&v, &bits, sizeof v);
    } while (!isfinite(v));
    return v;
}

static double from_pool(void)
{
    static const double pool[] = {0,
                                  -0.0,
                                  DBL_TRUE_MIN,
                                  3 * DBL_TRUE_MIN,
                                  DBL_MIN,
                                  DBL_MIN - DBL_TRUE_MIN,
                                  1e-300,
                                  1e-160,
                                  1e-100,
                                  0.1,
                                  1,
                                  1 + DBL_EPSILON,
                                  1e15,
                                  1e100,
                                  1e153,
                                  1e160,
                                  1e300,
                                  1.7e308,
                                  DBL_MAX,
                                  DBL_MAX,
                                  DBL_MAX / 2,
                                  DBL_MAX * (1 - 1e-9)};
    double v = pool[below(sizeof pool / sizeof pool[0])];
    return below(2) ? v : -v;
}

static double clamped(double v)
{
    return fmax(-DBL_MAX, fmin(DBL_MAX, v));
}

/* ---- generators: n values of points of `dimension` coordinates ---- */

static void random_uniform(double *p, int n, int dimension)
{
    (void)dimension;
    for (int i = 0; i < n; i++) p[i] = uniform();
}

static void random_exponents(double *p, int n, int dimension)
{
    (void)dimension;
    int spread = 1 << below(10);
    for (int i = 0; i < n; i++) p[i] = ldexp(uniform(), (int)below((uint32_t)spread) - spread / 2);
}

static void random_bits(double *p, int n, int dimension)
{
    (void)dimension;
    for (int i = 0; i < n; i++) p[i] = below(3) ? any_finite() : from_pool();
}

static void extremes(double *p, int n, int dimension)
{
    (void)dimension;
    for (int i = 0; i < n; i++) p[i] = from_pool();
}

/* Integers on a small grid: many exact zeros. */
static void grid(double *p, int n, int dimension)
{
    uint32_t size = 2 + below(9);
    double offset[3], step = below(2) ? 1 : 30;
    for (int k = 0; k < 3; k++) offset[k] = below(2) ? 0 : 500000 + 100 * (double)below(40000);
    for (int i = 0; i < n; i++) p[i] = offset[i % dimension] + step * (double)below(size);
}

/* The last point is an affine combination of the others, rounded: collinear in the plane, coplanar in space. */
static void dependent(double *p, int n, int dimension)
{
    double offset = below(3) ? 0 : below(2) ? 5e6 : 1e15, size = below(2) ? 1 : 1000;
    int count = n / dimension;
    for (int i = 0; i < n; i++) p[i] = offset + size * uniform();
    for (int i = dimension; i < count; i++) { /* point i depends on points 0 to dimension - 1 */
        double weight[3] = {0}, rest = 1;
        for (int k = 1; k < dimension; k++) rest -= weight[k] = 3 * uniform();
        weight[0] = rest;
        for (int k = 0; k < dimension; k++) {
            p[i * dimension + k] = 0;
            for (int j = 0; j < dimension; j++) p[i * dimension + k] += weight[j] * p[j * dimension + k];
        }
    }
}

/* The same, exactly, on integers. */
static void exactly_dependent(double *p, int n, int dimension)
{
    double direction[2][3], origin[3];
    for (int k = 0; k < dimension; k++) {
        origin[k] = (double)(int32_t)mw__random(&state);
        for (int j = 0; j < 2; j++) direction[j][k] = (double)below(1 << 20);
    }
    for (int i = 0; i < n; i += dimension) {
        double s = (double)below(1000), t = dimension == 3 ? (double)below(1000) : 0;
        for (int k = 0; k < dimension; k++) p[i + k] = origin[k] + s * direction[0][k] + t * direction[1][k];
    }
}

/* Integer points on the circle of radius 65. */
static void cocircular(double *p, int n, int dimension)
{
    static const int on[9][2] = {{65, 0},  {16, 63}, {33, 56}, {25, 60}, {39, 52},
                                 {63, 16}, {56, 33}, {60, 25}, {52, 39}};
    double centre = below(2) ? 0 : 1000 * (double)(int32_t)mw__random(&state), radius = below(2) ? 1 : 0x1p-20;
    for (int i = 0; i + 1 < n; i += dimension) {
        const int *v = on[below(9)];
        p[i] = centre + radius * (below(2) ? v[0] : -v[0]);
        p[i + 1] = centre + radius * (below(2) ? v[1] : -v[1]);
    }
}

static void nearly_cocircular(double *p, int n, int dimension)
{
    double centre = below(3) ? 0 : below(2) ? 5e6 : 1e15, radius = below(2) ? 1 : 1000;
    for (int i = 0; i + 1 < n; i += dimension) {
        double angle = 3.2 * uniform();
        p[i] = centre + radius * cos(angle);
        p[i + 1] = centre + radius * sin(angle);
    }
}

/* As in the classic picture of orient2d: points of a grid of 2^-53 beside a line through two points far away. */
static void beside_line(double *p, int n, int dimension)
{
    for (int i = 0; i < n; i++) p[i] = i < dimension ? 0.5 + (double)below(256) * 0x1p-53 : i < 2 * dimension ? 12 : 24;
    for (int i = 3 * dimension; i < n; i++) p[i] = below(2) ? 12 : 6;
}

/* Differences and products just above a power of two, where rounding errors are largest, and a determinant of some
 * units in the last place: nothing is wasted in the bounds of the filters. */
static void largest_errors(double *p, int n, int dimension)
{
    static const double corner[4][3] = {{1, 1, 1}, {1, -1, 1}, {2, 0, 1}, {0, 0, 0}};
    double noise = ldexp(1, -46 - (int)below(10));
    int points = n / dimension, last = points - 1;
    for (int i = 0; i < points; i++) {
        const double *v = corner[i == last ? 3 : dimension == 2 && last == 2 ? 0 : i % 3];
        for (int k = 0; k < dimension; k++) p[i * dimension + k] = v[k] + noise * uniform();
    }
}

typedef void generator(double *p, int n, int dimension);
static generator *const generators[] = {random_uniform,
                                        random_exponents,
                                        random_exponents,
                                        random_bits,
                                        extremes,
                                        grid,
                                        grid,
                                        dependent,
                                        dependent,
                                        dependent,
                                        dependent,
                                        dependent,
                                        exactly_dependent,
                                        exactly_dependent,
                                        exactly_dependent,
                                        nearly_cocircular,
                                        nearly_cocircular,
                                        cocircular,
                                        cocircular,
                                        beside_line,
                                        largest_errors};

/* Move some coordinates by some units in the last place. */
static void perturb(double *p, int n)
{
    uint32_t most = 1 + below(4);
    for (int i = 0; i < n; i++) {
        double target = below(2) ? DBL_MAX : -DBL_MAX;
        for (uint32_t k = below(most); k > 0; k--) p[i] = nextafter(p[i], target);
    }
}

/* To anywhere between the smallest and the largest doubles; most often to the ends of the range of expansions, which
 * are 2^-485 to 2^509 (orient2d), 2^-306 to 2^339 (orient3d), 2^-216 to 2^253 (incircle). */
static void rescale(double *p, int n)
{
    static const int exponents[] = {-485, 509, -306, 339, -216, 253};
    int exponent = below(2) ? exponents[below(6)] + (int)below(5) - 2 : (int)below(2100) - 1050;
    for (int i = 0; i < n; i++) p[i] = clamped(ldexp(p[i], exponent));
}

__attribute__((unused)) static void generate(double *p, int n, int dimension)
{
    generators[below(sizeof generators / sizeof generators[0])](p, n, dimension);
    if (below(2)) perturb(p, n);
    if (below(4) == 0) rescale(p, n);
    if (below(40) == 0) p[below((uint32_t)n)] = from_pool();
    if (below(16) == 0) p[below((uint32_t)n)] = below(2) ? -0.0 : 0.0;
}

#endif
