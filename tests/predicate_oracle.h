/* predicate_oracle.h - the predicates by brute force in GMP integers, for the tests and the fuzz target.
 *
 * Coordinates become integers times 2^base; each function returns the exponent of two that its result is to be
 * multiplied with. Not thread-safe: the numbers are kept between calls, because setting them up would take longer
 * than using them. */
#ifndef MW_TESTS_PREDICATE_ORACLE_H
#define MW_TESTS_PREDICATE_ORACLE_H

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct oracle {
    mpz_t v[12], d[12]; /* coordinates, differences of them */
    mpz_t s, t, result; /* result: the determinant         */
    mpz_t numerator[2], denominator[2];
} oracle;

static void oracle_init(oracle *o)
{
    for (int i = 0; i < 12; i++) mpz_inits(o->v[i], o->d[i], NULL);
    for (int i = 0; i < 2; i++) mpz_inits(o->numerator[i], o->denominator[i], NULL);
    mpz_inits(o->s, o->t, o->result, NULL);
}

__attribute__((unused)) static void oracle_clear(oracle *o)
{
    for (int i = 0; i < 12; i++) mpz_clears(o->v[i], o->d[i], NULL);
    for (int i = 0; i < 2; i++) mpz_clears(o->numerator[i], o->denominator[i], NULL);
    mpz_clears(o->s, o->t, o->result, NULL);
}

/* o->v = p[0..n) / 2^base, returns base. */
static long oracle_load(oracle *o, const double *p, int n)
{
    int exponent, base = 2000;
    for (int i = 0; i < n; i++) {
        frexp(p[i], &exponent);
        if (p[i] != 0 && exponent - 53 < base) base = exponent - 53;
    }
    for (int i = 0; i < n; i++) {
        double fraction = frexp(p[i], &exponent);
        mpz_set_si(o->v[i], (long)ldexp(fraction, 53));
        if (p[i] != 0) mpz_mul_2exp(o->v[i], o->v[i], (mp_bitcnt_t)(exponent - 53 - base));
    }
    return base;
}

/* r = a*d - b*c */
static void oracle_cross(oracle *o, mpz_t r, mpz_t a, mpz_t b, mpz_t c, mpz_t d)
{
    mpz_mul(o->s, a, d);
    mpz_mul(o->t, b, c);
    mpz_sub(r, o->s, o->t);
}

__attribute__((unused)) static long oracle_orient2d(oracle *o, const double *p)
{
    long base = oracle_load(o, p, 6);
    for (int i = 0; i < 4; i++) mpz_sub(o->d[i], o->v[2 + i], o->v[i % 2]); /* b - a, c - a */
    oracle_cross(o, o->result, o->d[0], o->d[1], o->d[2], o->d[3]);
    return 2 * base;
}

/* (b - a) . (c - a) */
__attribute__((unused)) static long oracle_dot2d(oracle *o, const double *p)
{
    long base = oracle_load(o, p, 6);
    for (int i = 0; i < 4; i++) mpz_sub(o->d[i], o->v[2 + i], o->v[i % 2]);
    mpz_mul(o->result, o->d[0], o->d[2]);
    mpz_addmul(o->result, o->d[1], o->d[3]);
    return 2 * base;
}

/* The determinant of b - a, c - a, d - a. */
__attribute__((unused)) static long oracle_orient3d(oracle *o, const double *p)
{
    long base = oracle_load(o, p, 12);
    for (int i = 0; i < 9; i++) mpz_sub(o->d[i], o->v[3 + i], o->v[i % 3]);
    mpz_set_ui(o->result, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_t *minor = &o->d[9];
        oracle_cross(o, *minor, o->d[3 + j], o->d[3 + k], o->d[6 + j], o->d[6 + k]);
        mpz_addmul(o->result, o->d[i], *minor);
    }
    return 3 * base;
}

/* -x (y bar z - z bar y) + ... of the rows b - a, c - a, d - a lifted: a is taken for the origin, unlike in the
 * library. */
__attribute__((unused)) static long oracle_incircle(oracle *o, const double *p)
{
    long base = oracle_load(o, p, 8);
    for (int i = 0; i < 6; i++) mpz_sub(o->d[i], o->v[2 + i], o->v[i % 2]);
    mpz_set_ui(o->result, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_t *minor = &o->d[9], *lift = &o->d[10];
        oracle_cross(o, *minor, o->d[2 * j], o->d[2 * j + 1], o->d[2 * k], o->d[2 * k + 1]);
        mpz_mul(*lift, o->d[2 * i], o->d[2 * i]);
        mpz_addmul(*lift, o->d[2 * i + 1], o->d[2 * i + 1]);
        mpz_submul(o->result, *lift, *minor);
    }
    return 4 * base;
}

/* The squared distance of q to the segment from v[at] on, as numerator[to] / denominator[to]: with t = (q - a).(b - a)
 * and l = |b - a|^2 it is |q - a|^2, |q - b|^2 or (|q - a|^2 l - t^2) / l. */
static void oracle_distance(oracle *o, int at, int to)
{
    mpz_t *a = &o->v[at], *b = &o->v[at + 2], *q = &o->v[0], *numerator = &o->numerator[to];
    mpz_t *l = &o->denominator[to], *t = &o->s;
    mpz_set_ui(*numerator, 0);
    mpz_set_ui(*l, 0);
    mpz_set_ui(*t, 0);
    for (int k = 0; k < 2; k++) {
        mpz_sub(o->d[0], q[k], a[k]);
        mpz_sub(o->d[1], b[k], a[k]);
        mpz_addmul(*numerator, o->d[0], o->d[0]);
        mpz_addmul(*l, o->d[1], o->d[1]);
        mpz_addmul(*t, o->d[0], o->d[1]);
    }
    if (mpz_sgn(*t) > 0 && mpz_cmp(*t, *l) < 0) {
        mpz_mul(*numerator, *numerator, *l);
        mpz_submul(*numerator, *t, *t);
        return;
    }
    if (mpz_sgn(*t) > 0) {
        mpz_set_ui(*numerator, 0);
        for (int k = 0; k < 2; k++) {
            mpz_sub(o->d[0], q[k], b[k]);
            mpz_addmul(*numerator, o->d[0], o->d[0]);
        }
    }
    mpz_set_ui(*l, 1);
}

static int oracle_sign(int comparison)
{
    return (comparison > 0) - (comparison < 0);
}

static int oracle_compare_ratios(oracle *o)
{
    mpz_mul(o->s, o->numerator[0], o->denominator[1]);
    mpz_mul(o->t, o->numerator[1], o->denominator[0]);
    return oracle_sign(mpz_cmp(o->s, o->t));
}

/* p: q, a, b, c, d */
__attribute__((unused)) static int oracle_compare_distance(oracle *o, const double *p)
{
    oracle_load(o, p, 10);
    oracle_distance(o, 2, 0);
    oracle_distance(o, 6, 1);
    return oracle_compare_ratios(o);
}

/* p: q, a, b, then the length */
__attribute__((unused)) static int oracle_compare_distance_to(oracle *o, const double *p)
{
    oracle_load(o, p, 7);
    oracle_distance(o, 2, 0);
    mpz_mul(o->numerator[1], o->v[6], o->v[6]);
    mpz_set_ui(o->denominator[1], 1);
    return oracle_compare_ratios(o);
}

/* Does value stand for the exact number result * 2^exponent: the same sign, and a relative error of at most 2^-50 where
 * the number is within the normal doubles? Beyond them, DBL_MAX and at most DBL_MIN are what is expected, up to the
 * same error. */
__attribute__((unused)) static bool oracle_agrees(oracle *o, long exponent, double value)
{
    if (oracle_sign(mpz_sgn(o->result)) != (value > 0) - (value < 0)) return false;
    if (value == 0) return true;
    long result_exponent;
    int value_exponent;
    double expected = mpz_get_d_2exp(&result_exponent, o->result), given = frexp(value, &value_exponent);
    result_exponent += exponent;
    if (result_exponent > DBL_MAX_EXP) return fabs(value) >= DBL_MAX * (1 - 0x1p-50) && fabs(value) <= DBL_MAX;
    if (result_exponent < DBL_MIN_EXP) return fabs(value) <= DBL_MIN * (1 + 0x1p-50);
    given = ldexp(given, value_exponent - (int)result_exponent);
    return fabs(given - expected) <= 0x1p-50 * fabs(expected);
}

#endif
