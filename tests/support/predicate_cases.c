/* predicate_cases.c - one stream of random numbers, and the kinds of points made of it. */
#include "support/predicate_cases.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/random.h"
#include "support/environment.h"

uint64_t cases_random;

void cases_seed(void)
{
    cases_random = environment_print_seed("predicate cases", 1);
}

long cases_count(long n)
{
    if (environment_is_long()) return 100 * n;
    return environment_is_short() ? n / 20 : n;
}

/* --- random numbers --------------------------------------------------------------------------- */

uint32_t cases_below(uint32_t n)
{
    return mw__random_below(&cases_random, n);
}

double cases_uniform(void)
{
    return (double)(int64_t)mw__random(&cases_random) * 0x1p-63;
}

double cases_finite(void)
{
    double v;
    do {
        uint64_t bits = mw__random(&cases_random);
        memcpy(&v, &bits, sizeof v);
    } while (!isfinite(v));
    return v;
}

double cases_extreme(void)
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
    double v = pool[cases_below(sizeof pool / sizeof pool[0])];
    return cases_below(2) ? v : -v;
}

double cases_clamped(double v)
{
    return fmax(-DBL_MAX, fmin(DBL_MAX, v));
}

/* --- kinds: n numbers, of points of `dimension` coordinates ----------------------------------- */

static void random_uniform(double *p, int n, int dimension)
{
    (void)dimension;
    for (int i = 0; i < n; i++) p[i] = cases_uniform();
}

static void random_exponents(double *p, int n, int dimension)
{
    (void)dimension;
    int spread = 1 << cases_below(10);
    for (int i = 0; i < n; i++)
        p[i] = ldexp(cases_uniform(), (int)cases_below((uint32_t)spread) - spread / 2);
}

static void random_bits(double *p, int n, int dimension)
{
    (void)dimension;
    for (int i = 0; i < n; i++) p[i] = cases_below(3) ? cases_finite() : cases_extreme();
}

static void extremes(double *p, int n, int dimension)
{
    (void)dimension;
    for (int i = 0; i < n; i++) p[i] = cases_extreme();
}

/* Integers on a small grid: many exact zeros. */
static void grid(double *p, int n, int dimension)
{
    uint32_t size = 2 + cases_below(9);
    double offset[3], step = cases_below(2) ? 1 : 30;
    for (int k = 0; k < 3; k++)
        offset[k] = cases_below(2) ? 0 : 500000 + 100 * (double)cases_below(40000);
    for (int i = 0; i < n; i++) p[i] = offset[i % dimension] + step * (double)cases_below(size);
}

/* The last point is an affine combination of the others, rounded: collinear in the plane,
 * coplanar in space. */
static void dependent(double *p, int n, int dimension)
{
    double offset = cases_below(3)   ? 0
                    : cases_below(2) ? 5e6
                                     : 1e15,
           size = cases_below(2) ? 1 : 1000;
    int count = n / dimension;
    for (int i = 0; i < n; i++) p[i] = offset + size * cases_uniform();
    for (int i = dimension; i < count; i++) { /* point i depends on points 0 to dimension - 1 */
        double weight[3] = {0}, rest = 1;
        for (int k = 1; k < dimension; k++) rest -= weight[k] = 3 * cases_uniform();
        weight[0] = rest;
        for (int k = 0; k < dimension; k++) {
            p[i * dimension + k] = 0;
            for (int j = 0; j < dimension; j++)
                p[i * dimension + k] += weight[j] * p[j * dimension + k];
        }
    }
}

/* The same, exactly, on integers. */
static void exactly_dependent(double *p, int n, int dimension)
{
    double direction[2][3], origin[3];
    for (int k = 0; k < dimension; k++) {
        origin[k] = (double)(int32_t)mw__random(&cases_random);
        for (int j = 0; j < 2; j++) direction[j][k] = (double)cases_below(1 << 20);
    }
    for (int i = 0; i < n; i += dimension) {
        double s = (double)cases_below(1000), t = dimension == 3 ? (double)cases_below(1000) : 0;
        for (int k = 0; k < dimension; k++)
            p[i + k] = origin[k] + s * direction[0][k] + t * direction[1][k];
    }
}

/* Integer points on the circle of radius 65. */
static void cocircular(double *p, int n, int dimension)
{
    static const int on[9][2] = {{65, 0},  {16, 63}, {33, 56}, {25, 60}, {39, 52},
                                 {63, 16}, {56, 33}, {60, 25}, {52, 39}};
    double centre = cases_below(2) ? 0 : 1000 * (double)(int32_t)mw__random(&cases_random),
           radius = cases_below(2) ? 1 : 0x1p-20;
    for (int i = 0; i + 1 < n; i += dimension) {
        const int *v = on[cases_below(9)];
        p[i] = centre + radius * (cases_below(2) ? v[0] : -v[0]);
        p[i + 1] = centre + radius * (cases_below(2) ? v[1] : -v[1]);
    }
}

static void nearly_cocircular(double *p, int n, int dimension)
{
    double centre = cases_below(3)   ? 0
                    : cases_below(2) ? 5e6
                                     : 1e15,
           radius = cases_below(2) ? 1 : 1000;
    for (int i = 0; i + 1 < n; i += dimension) {
        double angle = 3.2 * cases_uniform();
        p[i] = centre + radius * cos(angle);
        p[i + 1] = centre + radius * sin(angle);
    }
}

/* As in the classic picture of orient2d: points of a grid of 2^-53 beside a line through two
 * points far away. */
static void beside_line(double *p, int n, int dimension)
{
    for (int i = 0; i < n; i++)
        p[i] = i < dimension       ? 0.5 + (double)cases_below(256) * 0x1p-53
               : i < 2 * dimension ? 12
                                   : 24;
    for (int i = 3 * dimension; i < n; i++) p[i] = cases_below(2) ? 12 : 6;
}

/* Differences and products just above a power of two, where rounding errors are largest, and a
 * determinant of some units in the last place: nothing is wasted in the bounds of the filters. */
static void largest_errors(double *p, int n, int dimension)
{
    static const double corner[4][3] = {{1, 1, 1}, {1, -1, 1}, {2, 0, 1}, {0, 0, 0}};
    double noise = ldexp(1, -46 - (int)cases_below(10));
    int points = n / dimension, last = points - 1;
    for (int i = 0; i < points; i++) {
        const double *v = corner[i == last ? 3 : dimension == 2 && last == 2 ? 0 : i % 3];
        for (int k = 0; k < dimension; k++) p[i * dimension + k] = v[k] + noise * cases_uniform();
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

void cases_perturb(double *p, int n)
{
    uint32_t most = 1 + cases_below(4);
    for (int i = 0; i < n; i++) {
        double target = cases_below(2) ? DBL_MAX : -DBL_MAX;
        for (uint32_t k = cases_below(most); k > 0; k--) p[i] = nextafter(p[i], target);
    }
}

void cases_rescale(double *p, int n)
{
    static const int exponents[] = {-485, 509, -306, 339, -216, 253};
    int exponent = cases_below(2) ? exponents[cases_below(6)] + (int)cases_below(5) - 2
                                  : (int)cases_below(2100) - 1050;
    for (int i = 0; i < n; i++) p[i] = cases_clamped(ldexp(p[i], exponent));
}

void cases_generate(double *p, int n, int dimension)
{
    generators[cases_below(sizeof generators / sizeof generators[0])](p, n, dimension);
    if (cases_below(2)) cases_perturb(p, n);
    if (cases_below(4) == 0) cases_rescale(p, n);
    if (cases_below(40) == 0) p[cases_below((uint32_t)n)] = cases_extreme();
    if (cases_below(16) == 0) p[cases_below((uint32_t)n)] = cases_below(2) ? -0.0 : 0.0;
}
