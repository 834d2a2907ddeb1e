/* The predicates against GMP: random, nearly degenerate and degenerate input, the ends of the
 * range of expansions, and what lies beyond it. MW_TEST_LONG=1 runs a hundred times as many cases,
 * MW_TEST_SEED=n other ones. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/predicate_oracle.h"
#include "predicates/predicates.h"
#include "support/predicate_cases.h"

#include <fenv.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static predicate_oracle truth;

static void fail_case(const char *what, const double *p, int n, double value)
{
    fprintf(stderr, "%s: %a is wrong for", what, value);
    for (int i = 0; i < n; i++) fprintf(stderr, " %a", p[i]);
    fprintf(stderr, "\n");
    fail();
}

/* One predicate of `dimension` * n coordinates: as users call it, its exact stage alone, and the
 * truth. */
typedef struct predicate {
    const char *name;
    int coordinates, dimension;
    double (*filtered)(const double *p);
    double (*exact)(const double *p);
    long (*truth)(predicate_oracle *o, const double *p);
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

static const predicate orient2d = {
    "orient2d", 6, 2, filtered_orient2d, exact_orient2d, predicate_oracle_orient2d};
static const predicate dot2d = {"dot2d", 6, 2, filtered_dot2d, exact_dot2d, predicate_oracle_dot2d};
static const predicate orient3d = {
    "orient3d", 12, 3, filtered_orient3d, exact_orient3d, predicate_oracle_orient3d};
static const predicate incircle = {
    "incircle", 8, 2, filtered_incircle, exact_incircle, predicate_oracle_incircle};

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
    if (!predicate_oracle_agrees(&truth, exponent, value))
        fail_case(t->name, p, t->coordinates, value);
}

static void check_random(const predicate *t, long n)
{
    double p[12];
    for (long i = cases_count(n); i > 0; i--) {
        cases_generate(p, t->coordinates, t->dimension);
        check(t, p);
    }
}

/* ---- tests ---- */

static void test_environment(void **unused)
{
    (void)unused;
    assert_int_equal(fegetround(), FE_TONEAREST);
    volatile double one = 1, small = 0x1p-53, third = 3, least = DBL_MIN;
    /* ties to even ... */
    assert_true(one + small == 1);
    /* ... in both directions */
    assert_true((one + DBL_EPSILON) + small > 1 + DBL_EPSILON);
    /* no excess precision: 1/3 rounds down */
    assert_true(one / third * third == 1);
    assert_true(one + small * 1.5 - one == DBL_EPSILON);
    assert_true(least / 2 > 0); /* gradual underflow: no flush to zero */
    volatile double x = 1 + 0x1p-30, y = 1 - 0x1p-30;
    assert_true(x * y - one == 0); /* no fused multiply-add: that would give -2^-60 */
}

static void test_known_signs(void **unused)
{
    (void)unused;
    const double a[2] = {0, 0}, b[2] = {4, 0}, c[2] = {0, 3}, inside[2] = {1, 1}, on[2] = {4, 3},
                 far[2] = {9, 9};
    assert_true(mw_orient2d(a, b, c) == 12);
    assert_true(mw_orient2d(b, a, c) == -12);
    assert_true(mw_orient2d(a, b, (const double[2]){7, 0}) == 0);
    assert_true(mw_incircle(a, b, c, inside) > 0);
    assert_true(mw_incircle(a, b, c, on) == 0);
    assert_true(mw_incircle(a, b, c, far) < 0);
    assert_true(mw_incircle(b, a, c, far) > 0);
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, above[3] = {.3, .3, 2},
                 under[3] = {5, 5, -1};
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
    for (long i = cases_count(200000); i > 0; i--) {
        double x = (double)cases_below(1 << 22), y = (double)cases_below(1 << 22),
               s = cases_below(2) ? 3 : -7, u = cases_uniform(), v = cases_uniform();
        double p[6] = {u, v, u + x, v + y, u - s * y, v + s * x};
        if (cases_below(2)) p[0] = p[1] = 0, p[2] = x, p[3] = y, p[4] = -s * y, p[5] = s * x;
        if (cases_below(2)) cases_perturb(p, 6);
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

/* How much of its bound the error of a rounded determinant takes: |det - truth| / (bound + u
 * |det|), at most 1. */
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

/* The bounds of the filters hold for every determinant, not only where a sign is at stake; and the
 * worst case tried here, differences and products just above a power of two, comes near enough to
 * tell if one were too small. */
static void test_bounds(void **unused)
{
    (void)unused;
    double worst[3] = {0};
    for (long i = cases_count(100000); i > 0; i--) {
        static const double corner[12] = {1, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0};
        double p[12], bound, det, noise = ldexp(1, -(int)cases_below(20));
        for (int k = 0; k < 12; k++) p[k] = corner[k] + noise * cases_uniform();
        if (cases_below(2)) p[4] = p[5] = ldexp(cases_uniform(), -52), p[1] = p[2] = 0;
        det = mw__orient2d_rounded(at(p, 0), at(p, 1), at(p, 2), &bound);
        worst[0] = fmax(worst[0], error_share(det, bound, predicate_oracle_orient2d(&truth, p)));
        det = mw__incircle_rounded(at(p, 0), at(p, 1), at(p, 2), at(p, 3), &bound);
        worst[1] = fmax(worst[1], error_share(det, bound, predicate_oracle_incircle(&truth, p)));
        for (int k = 0; k < 9; k++) p[k] = (k % 4 == 0) + noise * cases_uniform();
        for (int k = 9; k < 12; k++) p[k] = ldexp(cases_uniform(), -52);
        det = mw__orient3d_rounded(p, p + 3, p + 6, p + 9, &bound);
        worst[2] = fmax(worst[2], error_share(det, bound, predicate_oracle_orient3d(&truth, p)));
    }
    static const double enough[3] = {0.8, 0.4, 0.55};
    for (int i = 0; i < 3; i++) assert_true(worst[i] > enough[i] && worst[i] <= 1);
}

/* All 256 x 256 points near (0.5, 0.5) against the line through (12, 12) and (24, 24), and the
 * same near (1, 1) and far from the origin. */
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

/* The ends of the ranges in which expansions are used: both just inside and just outside, all bits
 * of the mantissa set or few of them. */
static void check_range_ends(const predicate *t, int low, int high)
{
    double p[12];
    for (long i = cases_count(20000); i > 0; i--) {
        int top = cases_below(2) ? high : low + (int)cases_below(60);
        uint32_t kinds = cases_below(2) ? 3 : 7; /* 3: differences of one unit in the last place */
        for (int k = 0; k < t->coordinates; k++) {
            double unit = ldexp(1, cases_below(2) ? low : top), up = nextafter(unit, DBL_MAX),
                   down = nextafter(unit, 0);
            const double choice[] = {unit,    up, down, 0, unit * 1.5, unit * (2 - DBL_EPSILON),
                                     unit / 2};
            p[k] = choice[cases_below(kinds)] * (kinds == 7 && cases_below(2) ? -1 : 1);
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
    assert_true(mw_orient2d((double[]){-big, -big}, (double[]){big, -big}, (double[]){0, big}) ==
                DBL_MAX);
    assert_true(mw_orient2d((double[]){big, -big}, (double[]){-big, -big}, (double[]){0, big}) ==
                -DBL_MAX);
    assert_true(mw_orient2d((double[]){-big, -big}, (double[]){big, big}, (double[]){0, 0}) == 0);
    assert_true(mw_orient2d((double[]){-big, -big}, (double[]){big, big}, (double[]){0, tiny}) > 0);
    assert_true(mw_orient2d((double[]){0, 0}, (double[]){tiny, 0}, (double[]){0, tiny}) == DBL_MIN);
    assert_true(mw_incircle((double[]){-big, 0}, (double[]){big, 0}, (double[]){0, big},
                            (double[]){0, -big}) == 0);
    assert_true(mw_incircle((double[]){-big, 0}, (double[]){big, 0}, (double[]){0, big},
                            (double[]){tiny, -big}) < 0);
    assert_true(mw_incircle((double[]){-tiny, 0}, (double[]){tiny, 0}, (double[]){0, tiny},
                            (double[]){0, 0}) > 0);
    assert_true(mw_orient3d((double[]){-big, 0, 0}, (double[]){big, 0, 0}, (double[]){0, big, 0},
                            (double[]){0, 0, tiny}) > 0);
}

/* Exchanging two points changes the sign and nothing else; -0.0 is 0. */
static void test_antisymmetry(void **unused)
{
    (void)unused;
    const predicate *all[] = {&orient2d, &orient3d, &incircle};
    for (long i = cases_count(60000); i > 0; i--) {
        const predicate *t = all[cases_below(3)];
        double p[12], swapped[12];
        size_t size = (size_t)t->dimension * sizeof(double);
        int points = t->coordinates / t->dimension, j = (int)cases_below((uint32_t)points),
            k = (int)cases_below((uint32_t)points);
        cases_generate(p, t->coordinates, t->dimension);
        memcpy(swapped, p, sizeof p);
        memcpy(swapped + j * t->dimension, p + k * t->dimension, size);
        memcpy(swapped + k * t->dimension, p + j * t->dimension, size);
        for (int c = 0; c < t->coordinates; c++)
            swapped[c] = swapped[c] == 0 ? -swapped[c] : swapped[c];
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
        const predicate *t = all[cases_below(4)];
        double p[12];
        cases_generate(p, t->coordinates, t->dimension);
        for (uint32_t k = cases_below(3) + 1; k > 0; k--)
            p[cases_below((uint32_t)t->coordinates)] = bad[cases_below(3)];
        assert_true(t->filtered(p) == 0);
    }
    const mw_point o = {0, 0}, far = {INFINITY, 1}, none = {NAN, NAN};
    mw__compare_distance(far, o, none, far, o); /* comes back */
    assert_int_equal(mw__compare_distance_to(o, o, o, NAN), 0);
    assert_int_equal(mw__compare_distance_to(o, o, (mw_point){DBL_MAX, 1}, INFINITY), -1);
}

/* ---- distances ---- */

static mw_point reflected(mw_point p,
                          int how) /* symmetries of the square: distances from the origin stay */
{
    if (how & 1) p = (mw_point){p.y, p.x};
    if (how & 2) p.x = -p.x;
    if (how & 4) p.y = -p.y;
    return p;
}

/* p: q, a, b, c, d. Half of the cases: cd is ab, mirrored in q, or has the same nearest vertex, or
 * lies on the same line. */
static void generate_distances(double p[10])
{
    cases_generate(p, 10, 2);
    if (cases_below(2)) return;
    mw_point q = at(p, 0), a = {(double)cases_below(64) - 32, (double)cases_below(64) - 32},
             b = {(double)cases_below(64) - 32, (double)cases_below(64) - 32};
    int how = (int)cases_below(8);
    mw_point c = reflected(a, how), d = reflected(b, how);
    if (cases_below(3) == 0) c = a;
    if (cases_below(3) == 0) d = (mw_point){c.x + 4 * (b.x - a.x), c.y + 4 * (b.y - a.y)};
    if (cases_below(2)) q = (mw_point){(double)cases_below(1000), (double)cases_below(1000)};
    const double v[10] = {0, 0, a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y};
    for (int i = 0; i < 10; i++) p[i] = cases_clamped(v[i] + (i % 2 ? q.y : q.x));
    if (cases_below(4) == 0) cases_perturb(p, 10);
    if (cases_below(4) == 0) cases_rescale(p, 10);
}

static void test_compare_distance(void **unused)
{
    (void)unused;
    double p[10];
    for (long i = cases_count(300000); i > 0; i--) {
        generate_distances(p);
        int order = mw__compare_distance(at(p, 0), at(p, 1), at(p, 2), at(p, 3), at(p, 4));
        if (order != predicate_oracle_compare_distance(&truth, p))
            fail_case("compare_distance", p, 10, order);
        int other = mw__compare_distance(at(p, 0), at(p, 4), at(p, 3), at(p, 2), at(p, 1));
        if (other != -order) fail_case("compare_distance, exchanged", p, 10, order);
    }
}

/* A length near the distance, or equal to it (Pythagorean triples), or anything. */
static void generate_length(double p[7])
{
    cases_generate(p, 6, 2);
    mw_point q = at(p, 0), a = at(p, 1), b = at(p, 2);
    p[6] = cases_below(2) ? cases_finite() : cases_extreme();
    if (cases_below(2)) p[6] = cases_clamped(hypot(a.x - q.x, a.y - q.y));
    if (cases_below(4) == 0)
        p[6] = cases_clamped(fabs((a.x - q.x) * (b.y - q.y) - (a.y - q.y) * (b.x - q.x)) /
                             hypot(b.x - a.x, b.y - a.y));
    if (!isfinite(p[6])) p[6] = 0;
    if (cases_below(4) == 0) { /* the foot is q + k (-4, 3), the direction (3, 4): distance 5 k */
        double k = (double)cases_below(1000), s = 1 + (double)cases_below(100);
        const double v[6] = {0, 0, -4 * k - 3 * s, 3 * k - 4 * s, -4 * k + 3 * s, 3 * k + 4 * s};
        q = (mw_point){(double)cases_below(1 << 30), -(double)cases_below(1 << 30)};
        for (int i = 0; i < 6; i++) p[i] = v[i] + (i % 2 ? q.y : q.x);
        p[6] = 5 * k;
        if (cases_below(4) == 0) cases_rescale(p, 7);
    }
    if (cases_below(4) == 0) cases_perturb(p, 7);
}

static void test_compare_distance_to(void **unused)
{
    (void)unused;
    double p[7];
    for (long i = cases_count(200000); i > 0; i--) {
        generate_length(p);
        int order = mw__compare_distance_to(at(p, 0), at(p, 1), at(p, 2), p[6]);
        if (order != predicate_oracle_compare_distance_to(&truth, p))
            fail_case("compare_distance_to", p, 7, order);
    }
}

static int setup(void **unused)
{
    (void)unused;
    cases_seed();
    predicate_oracle_init(&truth);
    return 0;
}

static int teardown(void **unused)
{
    (void)unused;
    predicate_oracle_clear(&truth);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_environment),      cmocka_unit_test(test_known_signs),
        cmocka_unit_test(test_orient2d),         cmocka_unit_test(test_dot2d),
        cmocka_unit_test(test_orient3d),         cmocka_unit_test(test_incircle),
        cmocka_unit_test(test_bounds),           cmocka_unit_test(test_classic_picture),
        cmocka_unit_test(test_range_ends),       cmocka_unit_test(test_beyond_range),
        cmocka_unit_test(test_antisymmetry),     cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_compare_distance), cmocka_unit_test(test_compare_distance_to),
    };
    return cmocka_run_group_tests_name("predicates", tests, setup, teardown);
}
