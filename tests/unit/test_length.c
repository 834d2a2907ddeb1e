/* The comparison of two lengths, exact and filtered, against GMP. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "predicates/predicates.h"
#include "support/predicate_cases.h"

#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

static mw_point at(const double *p, int i)
{
    return (mw_point){p[2 * i], p[2 * i + 1]};
}

static void fail_case(const char *what, const double *p, int n, double value)
{
    fprintf(stderr, "%s: %a is wrong for", what, value);
    for (int i = 0; i < n; i++) fprintf(stderr, " %a", p[i]);
    fprintf(stderr, "\n");
    fail();
}

/* The sign of |p1 - p0|^2 - |p3 - p2|^2, in rationals. */
static int oracle_compare_length(const double p[8])
{
    mpq_t sum, a, b;
    mpq_inits(sum, a, b, NULL);
    for (int i = 0; i < 4; i++) {
        int k = i < 2 ? i : i + 2;
        mpq_set_d(a, p[k]);
        mpq_set_d(b, p[k + 2]);
        mpq_sub(a, a, b);
        mpq_mul(a, a, a);
        if (i < 2)
            mpq_add(sum, sum, a);
        else
            mpq_sub(sum, sum, a);
    }
    int sign = mpq_sgn(sum);
    mpq_clears(sum, a, b, NULL);
    return sign;
}

/* Half of the cases: the second segment is the first one, turned or mirrored, and moved by what
 * rounding may spoil. */
static void generate_lengths(double p[8])
{
    cases_generate(p, 8, 2);
    if (cases_below(2)) return;
    bool turned = cases_below(2), integers = cases_below(2);
    for (int i = 0; i < 4 && integers; i++) p[i] = (double)cases_below(1 << 30);
    double x = cases_clamped(p[2] - p[0]), y = cases_clamped(p[3] - p[1]);
    if (integers)
        for (int i = 4; i < 6; i++) p[i] = (double)cases_below(1 << 30);
    p[6] = cases_clamped(p[4] + (turned ? y : x));
    p[7] = cases_clamped(p[5] - (turned ? x : y));
    if (cases_below(4) == 0) cases_perturb(p, 8);
    if (cases_below(4) == 0) cases_rescale(p, 8);
}

static void test_compare_length(void **unused)
{
    (void)unused;
    cases_seed();
    double p[8];
    long equal = 0, decided = 0;
    for (long i = cases_count(200000); i > 0; i--) {
        generate_lengths(p);
        int order = mw__compare_length_exact(at(p, 0), at(p, 1), at(p, 2), at(p, 3));
        if (order != oracle_compare_length(p)) fail_case("compare_length", p, 8, order);
        assert_int_equal(mw__compare_length_exact(at(p, 3), at(p, 2), at(p, 0), at(p, 1)), -order);
        double s = mw__square_length(at(p, 0), at(p, 1)), t = mw__square_length(at(p, 2), at(p, 3));
        bool shorter = mw__surely_shorter(s, t), longer = mw__surely_shorter(t, s);
        if ((shorter && order >= 0) || (longer && order <= 0))
            fail_case("surely_shorter", p, 8, order);
        equal += order == 0;
        decided += shorter || longer;
    }
    assert_true(equal > cases_count(20000) && decided > cases_count(80000));
}

/* Where the filter has no room to spare: squares that differ by a few units in the last place. */
static void test_filter_is_tight(void **unused)
{
    (void)unused;
    mw_point o = {0, 0}, a = {1, 0}, b = {1 + 0x1p-50, 0};
    assert_true(mw__surely_shorter(1, mw__square_length(o, b)));
    assert_false(mw__surely_shorter(1, 1 + 0x1p-51));
    assert_int_equal(mw__compare_length_exact(o, a, o, b), -1);
    assert_int_equal(mw__compare_length_exact(o, (mw_point){INFINITY, 0}, o, b), 0);
    assert_false(mw__surely_shorter(INFINITY, INFINITY) || mw__surely_shorter(1, INFINITY));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_compare_length),
        cmocka_unit_test(test_filter_is_tight),
    };
    return cmocka_run_group_tests_name("length", tests, NULL, NULL);
}
