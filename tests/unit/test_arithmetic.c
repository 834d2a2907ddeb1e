/* The arithmetic of the exact stages against GMP: expansions and big integers. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "predicates/big.h"
#include "predicates/expansion.h"
#include "support/predicate_cases.h"

#include <gmp.h>
#include <math.h>
#include <string.h>

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
    return ldexp((double)cases_below(8) - 4, (int)cases_below(120) - 60) +
           (cases_below(2) ? ldexp((double)cases_below(4), (int)cases_below(50)) : 0);
}

static void test_expansions(void **unused)
{
    (void)unused;
    mpz_t x, y, z;
    mpz_inits(x, y, z, NULL);
    for (long i = cases_count(50000); i > 0; i--) {
        double room[600];
        mw_arena arena = {room};
        mw_expansion e[4], cross[2];
        for (int k = 0; k < 4; k++) {
            double a = cases_below(2) ? cases_uniform() : short_number(),
                   b = cases_below(2) ? cases_uniform() : short_number();
            e[k] = mw__expansion_difference(&arena, a, b);
            exact_value(x, e[k]);
            mpz_set_d(y, ldexp(a, 400));
            mpz_set_d(z, ldexp(b, 400));
            mpz_sub(y, y, z);
            assert_int_equal(mpz_cmp(x, y), 0);
        }
        for (int k = 0; k < 2; k++)
            cross[k] = mw__expansion_cross(&arena, e[k], e[1], e[2 - k], e[3]);
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
    a->n = (int)cases_below(8);
    a->sign = a->n == 0 ? 0 : cases_below(2) ? 1 : -1;
    for (int i = 0; i < a->n; i++) {
        uint64_t choice[4] = {0, UINT64_MAX, UINT64_MAX - 1, mw__random(&cases_random)};
        a->limb[i] = choice[cases_below(4)];
    }
    if (a->n > 0 && a->limb[a->n - 1] == 0) a->limb[a->n - 1] = 1;
}

static void test_integers(void **unused)
{
    (void)unused;
    mpz_t x, y, z;
    mpz_inits(x, y, z, NULL);
    for (long i = cases_count(100000); i > 0; i--) {
        mw_big a, b, r;
        random_big(&a);
        random_big(&b);
        if (cases_below(8) == 0)
            memcpy(&b, &a, sizeof b), b.sign = cases_below(2) ? a.sign : -a.sign;
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
    cases_seed();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_expansions),
        cmocka_unit_test(test_integers),
    };
    return cmocka_run_group_tests_name("arithmetic", tests, setup, NULL);
}
