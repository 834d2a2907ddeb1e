/* The predicates against GMP: random, nearly degenerate and degenerate input, the ends of the range of expansions, and
 * what lies beyond it. MW_TEST_LONG=1 runs a hundred times as many cases, MW_TEST_SEED=n other ones. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "predicate_oracle.h"
#include "predicates/big.h"
#include "predicates/expansion.h"

#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t state;
static oracle truth;

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

/* Differences and products just above a power of two, where rounding errors are largest, and a determinant of some units
 * in the last place: nothing is wasted in the bounds of the filters. */
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

static void generate(double *p, int n, int dimension)
{
    generators[below(sizeof generators / sizeof generators[0])](p, n, dimension);
    if (below(2)) perturb(p, n);
    if (below(4) == 0) rescale(p, n);
    if (below(40) == 0) p[below((uint32_t)n)] = from_pool();
    if (below(16) == 0) p[below((uint32_t)n)] = below(2) ? -0.0 : 0.0;
}

/* ---- comparing ---- */

static long case_count(long n)
{
    const char *text = getenv("MW_TEST_LONG");
    return text && strcmp(text, "0") != 0 ? 100 * n : n;
}

static void fail_case(const char *what, const double *p, int n, double value)
{
    fprintf(stderr, "%s: %a is wrong for", what, value);
    for (int i = 0; i < n; i++) fprintf(stderr, " %a", p[i]);
    fprintf(stderr, "\n");
    fail();
}

/* One predicate of `dimension` * n coordinates: as users call it, its exact stage alone, and the truth. */
typedef struct predicate {
    const char *name;
    int coordinates, dimension;
    double (*filtered)(const double *p);
    double (*exact)(const double *p);
    long (*truth)(oracle *o, const double *p);
} predicate;

static mw_point at(const double *p, int i)
{
    return (mw_point){p[2 * i], p[2 * i + 1]};
}

static double filtered_orient2d(const double *p)
{
    return mw_orient2d(p, p + 2, p + 4);
}
static double exact_orient2d(const double *p)
{
    return mw__orient2d_exact(at(p, 0), at(p, 1), at(p, 2));
}
static double filtered_dot2d(const double *p)
{
    return mw__dot2d(at(p, 0), at(p, 1), at(p, 2));
}
static double exact_dot2d(const double *p)
{
    return mw__dot2d_exact(at(p, 0), at(p, 1), at(p, 2));
}
static double filtered_orient3d(const double *p)
{
    return mw_orient3d(p, p + 3, p + 6, p + 9);
}
static double exact_orient3d(const double *p)
{
    return mw__orient3d_exact(p, p + 3, p + 6, p + 9);
}
static double filtered_incircle(const double *p)
{
    return mw_incircle(p, p + 2, p + 4, p + 6);
}
static double exact_incircle(const double *p)
{
    return mw__incircle_exact(at(p, 0), at(p, 1), at(p, 2), at(p, 3));
}

static const predicate orient2d = {"orient2d", 6, 2, filtered_orient2d, exact_orient2d, oracle_orient2d};
static const predicate dot2d = {"dot2d", 6, 2, filtered_dot2d, exact_dot2d, oracle_dot2d};
static const predicate orient3d = {"orient3d", 12, 3, filtered_orient3d, exact_orient3d, oracle_orient3d};
static const predicate incircle = {"incircle", 8, 2, filtered_incircle, exact_incircle, oracle_incircle};

static int sign(double v)
{
    return (v > 0) - (v < 0);
}

static void check(const predicate *t, const double *p)
{
    long exponent = t->truth(&truth, p);
    double value = t->filtered(p);
    if (sign(value) != mpz_sgn(truth.result)) fail_case(t->name, p, t->coordinates, value);
    value = t->exact(p);
    if (!oracle_agrees(&truth, exponent, value)) fail_case(t->name, p, t->coordinates, value);
}

static void check_random(const predicate *t, long n)
{
    double p[12];
    for (long i = case_count(n); i > 0; i--) {
        generate(p, t->coordinates, t->dimension);
        check(t, p);
    }
}

/* ---- tests ---- */

static void test_environment(void **unused)
{
    (void)unused;
    assert_int_equal(fegetround(), FE_TONEAREST);
    volatile double one = 1, small = 0x1p-53, third = 3, least = DBL_MIN;
    assert_true(one + small == 1);                              /* ties to even ...                       */
    assert_true((one + DBL_EPSILON) + small > 1 + DBL_EPSILON); /* ... in both directions                  */
    assert_true(one / third * third == 1);                      /* no excess precision: 1/3 rounds down   */
    assert_true(one + small * 1.5 - one == DBL_EPSILON);
    assert_true(least / 2 > 0); /* gradual underflow: no flush to zero */
    volatile double x = 1 + 0x1p-30, y = 1 - 0x1p-30;
    assert_true(x * y - one == 0); /* no fused multiply-add: that would give -2^-60 */
}

static void test_known_signs(void **unused)
{
    (void)unused;
    const double a[2] = {0, 0}, b[2] = {4, 0}, c[2] = {0, 3}, inside[2] = {1, 1}, on[2] = {4, 3}, far[2] = {9, 9};
    assert_true(mw_orient2d(a, b, c) == 12);
    assert_true(mw_orient2d(b, a, c) == -12);
    assert_true(mw_orient2d(a, b, (const double[2]){7, 0}) == 0);
    assert_true(mw_incircle(a, b, c, inside) > 0);
    assert_true(mw_incircle(a, b, c, on) == 0);
    assert_true(mw_incircle(a, b, c, far) < 0);
    assert_true(mw_incircle(b, a, c, far) > 0);
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, above[3] = {.3, .3, 2}, under[3] = {5, 5, -1};
    assert_true(mw_orient3d(o, x, y, above) == 2);
    assert_true(mw_orient3d(o, x, y, under) == -1);
    assert_true(mw_orient3d(o, x, y, (const double[3]){5, 5, 0}) == 0);
    assert_true(mw__dot2d(at(a, 0), at(b, 0), at(on, 0)) == 16);
    assert_true(mw__dot2d(at(a, 0), at(b, 0), at(c, 0)) == 0);
}

static void test_orient2d(void **unused)
{
    (void)unused;
    check_random(&orient2d, 1000000);
}

static void test_dot2d(void **unused)
{
    (void)unused;
    check_random(&dot2d, 300000);
    /* right angles, exact and nearly so */
    for (long i = case_count(200000); i > 0; i--) {
        double x = (double)below(1 << 22), y = (double)below(1 << 22), s = below(2) ? 3 : -7, u = uniform(),
               v = uniform();
        double p[6] = {u, v, u + x, v + y, u - s * y, v + s * x};
        if (below(2)) p[0] = p[1] = 0, p[2] = x, p[3] = y, p[4] = -s * y, p[5] = s * x;
        if (below(2)) perturb(p, 6);
        check(&dot2d, p);
    }
}

static void test_orient3d(void **unused)
{
    (void)unused;
    check_random(&orient3d, 400000);
}

static void test_incircle(void **unused)
{
    (void)unused;
    check_random(&incircle, 400000);
}

/* How much of its bound the error of a rounded determinant takes: |det - truth| / (bound + u |det|), at most 1. */
static double error_share(double det, double bound, long exponent)
{
    mpq_t value, exact;
    mpq_inits(value, exact, NULL);
    mpq_set_d(value, det);
    mpq_set_z(exact, truth.result);
    if (exponent < 0)
        mpq_div_2exp(exact, exact, (mp_bitcnt_t)-exponent);
    else
        mpq_mul_2exp(exact, exact, (mp_bitcnt_t)exponent);
    mpq_sub(value, value, exact);
    double error = fabs(mpq_get_d(value));
    mpq_clears(value, exact, NULL);
    return error / (bound + 0x1p-53 * fabs(det));
}

/* The bounds of the filters hold for every determinant, not only where a sign is at stake; and the worst case tried here,
 * differences and products just above a power of two, comes near enough to tell if one were too small. */
static void test_bounds(void **unused)
{
    (void)unused;
    double worst[3] = {0};
    for (long i = case_count(100000); i > 0; i--) {
        static const double corner[12] = {1, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0};
        double p[12], bound, det, noise = ldexp(1, -(int)below(20));
        for (int k = 0; k < 12; k++) p[k] = corner[k] + noise * uniform();
        if (below(2)) p[4] = p[5] = ldexp(uniform(), -52), p[1] = p[2] = 0;
        det = mw__orient2d_rounded(at(p, 0), at(p, 1), at(p, 2), &bound);
        worst[0] = fmax(worst[0], error_share(det, bound, oracle_orient2d(&truth, p)));
        det = mw__incircle_rounded(at(p, 0), at(p, 1), at(p, 2), at(p, 3), &bound);
        worst[1] = fmax(worst[1], error_share(det, bound, oracle_incircle(&truth, p)));
        for (int k = 0; k < 9; k++) p[k] = (k % 4 == 0) + noise * uniform();
        for (int k = 9; k < 12; k++) p[k] = ldexp(uniform(), -52);
        det = mw__orient3d_rounded(p, p + 3, p + 6, p + 9, &bound);
        worst[2] = fmax(worst[2], error_share(det, bound, oracle_orient3d(&truth, p)));
    }
    static const double enough[3] = {0.8, 0.4, 0.55};
    for (int i = 0; i < 3; i++) assert_true(worst[i] > enough[i] && worst[i] <= 1);
}

/* All 256 x 256 points near (0.5, 0.5) against the line through (12, 12) and (24, 24), and the same near (1, 1) and far
 * from the origin. */
static void test_classic_picture(void **unused)
{
    (void)unused;
    const double corner[3] = {0.5, 1, 5e6};
    for (int k = 0; k < 3; k++) {
        double step = corner[k] * DBL_EPSILON;
        for (int i = 0; i < 256 * 256; i++) {
            double p[6] = {corner[k] + i % 256 * step, corner[k] + i / 256 * step, 12, 12, 24, 24};
            check(&orient2d, p);
        }
    }
}

/* The ends of the ranges in which expansions are used: both just inside and just outside, all bits of the mantissa set
 * or few of them. */
static void check_range_ends(const predicate *t, int low, int high)
{
    double p[12];
    for (long i = case_count(20000); i > 0; i--) {
        int top = below(2) ? high : low + (int)below(60);
        uint32_t kinds = below(2) ? 3 : 7; /* 3: differences of one unit in the last place */
        for (int k = 0; k < t->coordinates; k++) {
            double unit = ldexp(1, below(2) ? low : top), up = nextafter(unit, DBL_MAX), down = nextafter(unit, 0);
            const double choice[] = {unit, up, down, 0, unit * 1.5, unit * (2 - DBL_EPSILON), unit / 2};
            p[k] = choice[below(kinds)] * (kinds == 7 && below(2) ? -1 : 1);
        }
        check(t, p);
    }
}

static void test_range_ends(void **unused)
{
    (void)unused;
    check_range_ends(&orient2d, -485, 509);
    check_range_ends(&dot2d, -485, 509);
    check_range_ends(&orient3d, -306, 339);
    check_range_ends(&incircle, -216, 253);
}

static void test_beyond_range(void **unused)
{
    (void)unused;
    const double big = 1.7e308, tiny = DBL_TRUE_MIN;
    assert_true(mw_orient2d((double[]){-big, -big}, (double[]){big, -big}, (double[]){0, big}) == DBL_MAX);
    assert_true(mw_orient2d((double[]){big, -big}, (double[]){-big, -big}, (double[]){0, big}) == -DBL_MAX);
    assert_true(mw_orient2d((double[]){-big, -big}, (double[]){big, big}, (double[]){0, 0}) == 0);
    assert_true(mw_orient2d((double[]){-big, -big}, (double[]){big, big}, (double[]){0, tiny}) > 0);
    assert_true(mw_orient2d((double[]){0, 0}, (double[]){tiny, 0}, (double[]){0, tiny}) == DBL_MIN);
    assert_true(mw_incircle((double[]){-big, 0}, (double[]){big, 0}, (double[]){0, big}, (double[]){0, -big}) == 0);
    assert_true(mw_incircle((double[]){-big, 0}, (double[]){big, 0}, (double[]){0, big}, (double[]){tiny, -big}) < 0);
    assert_true(mw_incircle((double[]){-tiny, 0}, (double[]){tiny, 0}, (double[]){0, tiny}, (double[]){0, 0}) > 0);
    assert_true(
        mw_orient3d((double[]){-big, 0, 0}, (double[]){big, 0, 0}, (double[]){0, big, 0}, (double[]){0, 0, tiny}) > 0);
}

/* Exchanging two points changes the sign and nothing else; -0.0 is 0. */
static void test_antisymmetry(void **unused)
{
    (void)unused;
    const predicate *all[] = {&orient2d, &orient3d, &incircle};
    for (long i = case_count(60000); i > 0; i--) {
        const predicate *t = all[below(3)];
        double p[12], swapped[12];
        size_t size = (size_t)t->dimension * sizeof(double);
        int points = t->coordinates / t->dimension, j = (int)below((uint32_t)points), k = (int)below((uint32_t)points);
        generate(p, t->coordinates, t->dimension);
        memcpy(swapped, p, sizeof p);
        memcpy(swapped + j * t->dimension, p + k * t->dimension, size);
        memcpy(swapped + k * t->dimension, p + j * t->dimension, size);
        for (int c = 0; c < t->coordinates; c++) swapped[c] = swapped[c] == 0 ? -swapped[c] : swapped[c];
        int expected = sign(t->filtered(p));
        if (j != k) expected = -expected;
        if (sign(t->filtered(swapped)) != expected) fail_case(t->name, p, t->coordinates, expected);
    }
}

static void test_not_finite(void **unused)
{
    (void)unused;
    const predicate *all[] = {&orient2d, &dot2d, &orient3d, &incircle};
    const double bad[] = {INFINITY, -INFINITY, NAN};
    for (int i = 0; i < 100000; i++) {
        const predicate *t = all[below(4)];
        double p[12];
        generate(p, t->coordinates, t->dimension);
        for (uint32_t k = below(3) + 1; k > 0; k--) p[below((uint32_t)t->coordinates)] = bad[below(3)];
        assert_true(t->filtered(p) == 0);
    }
    const mw_point o = {0, 0}, far = {INFINITY, 1}, none = {NAN, NAN};
    mw__compare_distance(far, o, none, far, o); /* comes back */
    assert_int_equal(mw__compare_distance_to(o, o, o, NAN), 0);
    assert_int_equal(mw__compare_distance_to(o, o, (mw_point){DBL_MAX, 1}, INFINITY), -1);
}

/* ---- distances ---- */

static mw_point reflected(mw_point p, int how) /* symmetries of the square: distances from the origin stay */
{
    if (how & 1) p = (mw_point){p.y, p.x};
    if (how & 2) p.x = -p.x;
    if (how & 4) p.y = -p.y;
    return p;
}

/* p: q, a, b, c, d. Half of the cases: cd is ab, mirrored in q, or has the same nearest vertex, or lies on the same line. */
static void generate_distances(double p[10])
{
    generate(p, 10, 2);
    if (below(2)) return;
    mw_point q = at(p, 0), a = {(double)below(64) - 32, (double)below(64) - 32},
             b = {(double)below(64) - 32, (double)below(64) - 32};
    int how = (int)below(8);
    mw_point c = reflected(a, how), d = reflected(b, how);
    if (below(3) == 0) c = a;
    if (below(3) == 0) d = (mw_point){c.x + 4 * (b.x - a.x), c.y + 4 * (b.y - a.y)};
    if (below(2)) q = (mw_point){(double)below(1000), (double)below(1000)};
    const double v[10] = {0, 0, a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y};
    for (int i = 0; i < 10; i++) p[i] = clamped(v[i] + (i % 2 ? q.y : q.x));
    if (below(4) == 0) perturb(p, 10);
    if (below(4) == 0) rescale(p, 10);
}

static void test_compare_distance(void **unused)
{
    (void)unused;
    double p[10];
    for (long i = case_count(300000); i > 0; i--) {
        generate_distances(p);
        int order = mw__compare_distance(at(p, 0), at(p, 1), at(p, 2), at(p, 3), at(p, 4));
        if (order != oracle_compare_distance(&truth, p)) fail_case("compare_distance", p, 10, order);
        int other = mw__compare_distance(at(p, 0), at(p, 4), at(p, 3), at(p, 2), at(p, 1));
        if (other != -order) fail_case("compare_distance, exchanged", p, 10, order);
    }
}

/* A length near the distance, or equal to it (Pythagorean triples), or anything. */
static void generate_length(double p[7])
{
    generate(p, 6, 2);
    mw_point q = at(p, 0), a = at(p, 1), b = at(p, 2);
    p[6] = below(2) ? any_finite() : from_pool();
    if (below(2)) p[6] = clamped(hypot(a.x - q.x, a.y - q.y));
    if (below(4) == 0)
        p[6] = clamped(fabs((a.x - q.x) * (b.y - q.y) - (a.y - q.y) * (b.x - q.x)) / hypot(b.x - a.x, b.y - a.y));
    if (!isfinite(p[6])) p[6] = 0;
    if (below(4) == 0) { /* the foot is q + k (-4, 3), the direction (3, 4): distance 5 k */
        double k = (double)below(1000), s = 1 + (double)below(100);
        const double v[6] = {0, 0, -4 * k - 3 * s, 3 * k - 4 * s, -4 * k + 3 * s, 3 * k + 4 * s};
        q = (mw_point){(double)below(1 << 30), -(double)below(1 << 30)};
        for (int i = 0; i < 6; i++) p[i] = v[i] + (i % 2 ? q.y : q.x);
        p[6] = 5 * k;
        if (below(4) == 0) rescale(p, 7);
    }
    if (below(4) == 0) perturb(p, 7);
}

static void test_compare_distance_to(void **unused)
{
    (void)unused;
    double p[7];
    for (long i = case_count(200000); i > 0; i--) {
        generate_length(p);
        int order = mw__compare_distance_to(at(p, 0), at(p, 1), at(p, 2), p[6]);
        if (order != oracle_compare_distance_to(&truth, p)) fail_case("compare_distance_to", p, 7, order);
    }
}

/* ---- the arithmetic itself ---- */

/* The number of an expansion, times 2^400, for parts whose lowest bits are above 2^-400. */
static void exact_value(mpz_t r, mw_expansion e)
{
    mpz_t part;
    mpz_init(part);
    mpz_set_ui(r, 0);
    for (int i = 0; i < e.n; i++) {
        mpz_set_d(part, ldexp(e.part[i], 400));
        mpz_add(r, r, part);
    }
    mpz_clear(part);
}

/* Each part is nonzero and below the lowest bit of the next. */
static void check_form(mw_expansion e)
{
    for (int i = 0; i < e.n; i++) {
        assert_true(e.part[i] != 0);
        if (i == 0) continue;
        int exponent;
        uint64_t mantissa = (uint64_t)fabs(ldexp(frexp(e.part[i], &exponent), 53));
        assert_true(fabs(e.part[i - 1]) < ldexp(1, exponent - 53 + __builtin_ctzll(mantissa)));
    }
}

static double short_number(void) /* few bits, so that parts touch each other and cancel */
{
    return ldexp((double)below(8) - 4, (int)below(120) - 60) + (below(2) ? ldexp((double)below(4), (int)below(50)) : 0);
}

static void test_expansions(void **unused)
{
    (void)unused;
    mpz_t x, y, z;
    mpz_inits(x, y, z, NULL);
    for (long i = case_count(50000); i > 0; i--) {
        double room[600];
        mw_arena arena = {room};
        mw_expansion e[4], cross[2];
        for (int k = 0; k < 4; k++) {
            double a = below(2) ? uniform() : short_number(), b = below(2) ? uniform() : short_number();
            e[k] = mw__expansion_difference(&arena, a, b);
            exact_value(x, e[k]);
            mpz_set_d(y, ldexp(a, 400));
            mpz_set_d(z, ldexp(b, 400));
            mpz_sub(y, y, z);
            assert_int_equal(mpz_cmp(x, y), 0);
        }
        for (int k = 0; k < 2; k++) cross[k] = mw__expansion_cross(&arena, e[k], e[1], e[2 - k], e[3]);
        mw_expansion sum = mw__expansion_add(&arena, cross[0], cross[1]);
        mw_expansion difference = mw__expansion_subtract(&arena, cross[0], cross[1]);
        mw_expansion product = mw__expansion_multiply(&arena, e[0], cross[1]);
        check_form(sum);
        check_form(difference);
        check_form(product);
        exact_value(x, cross[0]);
        exact_value(y, cross[1]);
        exact_value(z, sum);
        mpz_add(x, x, y); /* x: the sum */
        assert_int_equal(mpz_cmp(x, z), 0);
        mpz_submul_ui(x, y, 2); /* x: the difference */
        exact_value(z, difference);
        assert_int_equal(mpz_cmp(x, z), 0);
        exact_value(x, e[0]);
        mpz_mul(x, x, y); /* times 2^800 */
        exact_value(z, product);
        mpz_mul_2exp(z, z, 400);
        assert_int_equal(mpz_cmp(x, z), 0);
    }
    mpz_clears(x, y, z, NULL);
}

static void import(mpz_t r, const mw_big *a)
{
    mpz_import(r, (size_t)a->n, -1, sizeof a->limb[0], 0, 0, a->limb);
    if (a->sign < 0) mpz_neg(r, r);
    assert_int_equal(mpz_sgn(r), a->sign);
    assert_true(a->n == 0 || a->limb[a->n - 1] != 0);
}

/* Limbs of all ones and of zeros, so that carries and borrows run through. */
static void random_big(mw_big *a)
{
    a->n = (int)below(8);
    a->sign = a->n == 0 ? 0 : below(2) ? 1 : -1;
    for (int i = 0; i < a->n; i++) {
        uint64_t choice[4] = {0, UINT64_MAX, UINT64_MAX - 1, mw__random(&state)};
        a->limb[i] = choice[below(4)];
    }
    if (a->n > 0 && a->limb[a->n - 1] == 0) a->limb[a->n - 1] = 1;
}

static void test_integers(void **unused)
{
    (void)unused;
    mpz_t x, y, z;
    mpz_inits(x, y, z, NULL);
    for (long i = case_count(100000); i > 0; i--) {
        mw_big a, b, r;
        random_big(&a);
        random_big(&b);
        if (below(8) == 0) memcpy(&b, &a, sizeof b), b.sign = below(2) ? a.sign : -a.sign;
        import(x, &a);
        import(y, &b);
        mw__big_multiply(&r, &a, &b);
        import(z, &r);
        mpz_submul(z, x, y);
        assert_int_equal(mpz_sgn(z), 0);
        mw__big_subtract(&r, &a, &b);
        import(z, &r);
        mpz_add(z, z, y);
        assert_int_equal(mpz_cmp(z, x), 0);
        mw__big_add(&a, &a, &b);
        import(z, &a);
        mpz_sub(z, z, x);
        assert_int_equal(mpz_cmp(z, y), 0);
    }
    mpz_clears(x, y, z, NULL);
}

static int setup(void **unused)
{
    (void)unused;
    const char *text = getenv("MW_TEST_SEED");
    state = text ? strtoull(text, NULL, 10) : 1;
    fprintf(stderr, "seed %llu\n", (unsigned long long)state);
    oracle_init(&truth);
    return 0;
}

static int teardown(void **unused)
{
    (void)unused;
    oracle_clear(&truth);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_environment),      cmocka_unit_test(test_known_signs),
        cmocka_unit_test(test_expansions),       cmocka_unit_test(test_integers),
        cmocka_unit_test(test_orient2d),         cmocka_unit_test(test_dot2d),
        cmocka_unit_test(test_orient3d),         cmocka_unit_test(test_incircle),
        cmocka_unit_test(test_bounds),           cmocka_unit_test(test_classic_picture),
        cmocka_unit_test(test_range_ends),       cmocka_unit_test(test_beyond_range),
        cmocka_unit_test(test_antisymmetry),     cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_compare_distance), cmocka_unit_test(test_compare_distance_to),
    };
    return cmocka_run_group_tests_name("predicates", tests, setup, teardown);
}
