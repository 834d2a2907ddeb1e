/* Numbers of 128 bits in two words, as compilers for machines of 32 bits get them, against GMP. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#define MW_NO_INT128
#include "base/random.h"
#include "base/wide.h"
#include "support/environment.h"

#include <gmp.h>
#include <math.h>
#include <string.h>

static uint64_t seed;

/* Of any length, often with long runs of equal bits. */
static uint64_t random_word(void)
{
    uint64_t word = mw__random(&seed), cut = mw__random(&seed) % 64;
    if (mw__random(&seed) % 2) return word >> cut;
    return (mw__random(&seed) % 2 ? UINT64_MAX << cut : UINT64_MAX >> cut) ^ (word >> 63);
}

static void set_words(mpz_t r, mw_wide w)
{
    uint64_t words[] = {w.high, w.low};
    mpz_import(r, 2, 1, sizeof *words, 0, 0, words);
}

static bool equals(const mpz_t a, mw_wide w)
{
    mpz_t b;
    mpz_init(b);
    set_words(b, w);
    bool equal = mpz_cmp(a, b) == 0;
    mpz_clear(b);
    return equal;
}

static void test_products_and_quotients(void **unused)
{
    (void)unused;
    mpz_t x, y, product, rest;
    mpz_inits(x, y, product, rest, NULL);
    for (int i = 0; i < 100000; i++) {
        uint64_t a = random_word(), b = random_word(), left;
        mw_wide w = mw__wide_product(a, b);
        set_words(x, (mw_wide){0, a});
        set_words(y, (mw_wide){0, b});
        mpz_mul(product, x, y);
        assert_true(equals(product, w));

        w = (mw_wide){random_word(), random_word()};
        if (b == 0) continue;
        w.high %= b;
        uint64_t quotient = mw__wide_divide(w, b, &left);
        set_words(product, w);
        mpz_tdiv_qr(x, rest, product, y);
        assert_true(equals(x, (mw_wide){0, quotient}));
        assert_true(equals(rest, (mw_wide){0, left}));
    }
    mpz_clears(x, y, product, rest, NULL);
}

static void test_shifts(void **unused)
{
    (void)unused;
    mpz_t x, y;
    mpz_inits(x, y, NULL);
    for (int i = 0; i < 100000; i++) {
        int by = i % 128;
        uint64_t n = by < 64 ? random_word() : random_word() >> (by - 64);
        set_words(x, (mw_wide){0, n});
        mpz_mul_2exp(x, x, (mp_bitcnt_t)by);
        assert_true(equals(x, mw__wide_shifted(n, by)));

        mw_wide w = {random_word(), random_word()};
        set_words(x, w);
        mpz_tdiv_r_2exp(y, x, (mp_bitcnt_t)by);
        assert_int_equal(mpz_sgn(y) != 0, mw__wide_any(w, by));
        mpz_tdiv_q_2exp(x, x, (mp_bitcnt_t)by);
        mpz_tdiv_r_2exp(x, x, 64);
        assert_true(equals(x, (mw_wide){0, mw__wide_right(w, by)}));
    }
    mpz_clears(x, y, NULL);
}

/* |a - v|, exactly. */
static void distance(mpz_t r, const mpz_t a, double v)
{
    mpz_set_d(r, v);
    mpz_sub(r, a, r);
    mpz_abs(r, r);
}

/* No double is nearer, and of two as near the even one is taken. */
static void test_doubles(void **unused)
{
    (void)unused;
    mpz_t x, own, other;
    mpz_inits(x, own, other, NULL);
    for (int i = 0; i < 100000; i++) {
        mw_wide w = {i % 4 ? random_word() : 0, random_word()};
        if (i % 3 == 0) { /* a tie, or one beside it: 54 bits, and perhaps the last of all */
            w = mw__wide_shifted(random_word() | UINT64_C(1) << 63, i / 3 % 65);
            w.low |= mw__random(&seed) % 2;
        }
        double v = mw__wide_double(w);
        uint64_t bits;
        memcpy(&bits, &v, sizeof bits);
        set_words(x, w);
        distance(own, x, v);
        for (int side = -1; side <= 1; side += 2) {
            distance(other, x, nextafter(v, side < 0 ? -INFINITY : INFINITY));
            int order = mpz_cmp(own, other);
            assert_true(order < 0 || (order == 0 && bits % 2 == 0));
        }
    }
    mpz_clears(x, own, other, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_products_and_quotients),
        cmocka_unit_test(test_shifts),
        cmocka_unit_test(test_doubles),
    };
    seed = environment_print_seed("test_wide", 128);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
