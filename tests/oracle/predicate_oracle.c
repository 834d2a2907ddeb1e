/* predicate_oracle.c - the predicates in GMP integers, by other formulas than the library's
 * where there are any. */
#include "oracle/predicate_oracle.h"

#include <float.h>
#include <math.h>

void predicate_oracle_init(predicate_oracle *o)
{
    for (int i = 0; i < 12; i++) mpz_inits(o->v[i], o->d[i], NULL);
    for (int i = 0; i < 2; i++) mpz_inits(o->numerator[i], o->denominator[i], NULL);
    mpz_inits(o->s, o->t, o->result, NULL);
}

void predicate_oracle_clear(predicate_oracle *o)
{
    for (int i = 0; i < 12; i++) mpz_clears(o->v[i], o->d[i], NULL);
    for (int i = 0; i < 2; i++) mpz_clears(o->numerator[i], o->denominator[i], NULL);
    mpz_clears(o->s, o->t, o->result, NULL);
}

long predicate_oracle_load(predicate_oracle *o, const double *p, int n)
{
    int exponent, base = 2000;
    for (int i = 0; i < n; i++) {
        frexp(p[i], &exponent);
        if (p[i] != 0 && exponent - 53 < base) base = exponent - 53;
    }
    for (int i = 0; i < n; i++) {
        double fraction = frexp(p[i], &exponent);
        mpz_set_d(o->v[i], ldexp(fraction, 53)); /* a whole number */
        if (p[i] != 0) mpz_mul_2exp(o->v[i], o->v[i], (mp_bitcnt_t)(exponent - 53 - base));
    }
    return base;
}

void predicate_oracle_cross(predicate_oracle *o, mpz_t r, mpz_t a, mpz_t b, mpz_t c, mpz_t d)
{
    mpz_mul(o->s, a, d);
    mpz_mul(o->t, b, c);
    mpz_sub(r, o->s, o->t);
}

/* --- values ----------------------------------------------------------------------------------- */

long predicate_oracle_orient2d(predicate_oracle *o, const double *p)
{
    long base = predicate_oracle_load(o, p, 6);
    for (int i = 0; i < 4; i++) mpz_sub(o->d[i], o->v[2 + i], o->v[i % 2]); /* b - a, c - a */
    predicate_oracle_cross(o, o->result, o->d[0], o->d[1], o->d[2], o->d[3]);
    return 2 * base;
}

long predicate_oracle_dot2d(predicate_oracle *o, const double *p)
{
    long base = predicate_oracle_load(o, p, 6);
    for (int i = 0; i < 4; i++) mpz_sub(o->d[i], o->v[2 + i], o->v[i % 2]);
    mpz_mul(o->result, o->d[0], o->d[2]);
    mpz_addmul(o->result, o->d[1], o->d[3]);
    return 2 * base;
}

long predicate_oracle_orient3d(predicate_oracle *o, const double *p)
{
    long base = predicate_oracle_load(o, p, 12);
    for (int i = 0; i < 9; i++) mpz_sub(o->d[i], o->v[3 + i], o->v[i % 3]);
    mpz_set_ui(o->result, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_t *minor = &o->d[9];
        predicate_oracle_cross(o, *minor, o->d[3 + j], o->d[3 + k], o->d[6 + j], o->d[6 + k]);
        mpz_addmul(o->result, o->d[i], *minor);
    }
    return 3 * base;
}

/* -x (y bar z - z bar y) + ... of the rows b - a, c - a, d - a lifted: a is taken for the origin,
 * unlike in the library. */
long predicate_oracle_incircle(predicate_oracle *o, const double *p)
{
    long base = predicate_oracle_load(o, p, 8);
    for (int i = 0; i < 6; i++) mpz_sub(o->d[i], o->v[2 + i], o->v[i % 2]);
    mpz_set_ui(o->result, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_t *minor = &o->d[9], *lift = &o->d[10];
        predicate_oracle_cross(o, *minor, o->d[2 * j], o->d[2 * j + 1], o->d[2 * k],
                               o->d[2 * k + 1]);
        mpz_mul(*lift, o->d[2 * i], o->d[2 * i]);
        mpz_addmul(*lift, o->d[2 * i + 1], o->d[2 * i + 1]);
        mpz_submul(o->result, *lift, *minor);
    }
    return 4 * base;
}

bool predicate_oracle_agrees(predicate_oracle *o, long exponent, double value)
{
    if (predicate_oracle_sign(mpz_sgn(o->result)) != (value > 0) - (value < 0)) return false;
    if (value == 0) return true;
    long result_exponent;
    int value_exponent;
    double expected = mpz_get_d_2exp(&result_exponent, o->result),
           given = frexp(value, &value_exponent);
    result_exponent += exponent;
    if (result_exponent > DBL_MAX_EXP)
        return fabs(value) >= DBL_MAX * (1 - 0x1p-50) && fabs(value) <= DBL_MAX;
    if (result_exponent < DBL_MIN_EXP) return fabs(value) <= DBL_MIN * (1 + 0x1p-50);
    given = ldexp(given, value_exponent - (int)result_exponent);
    return fabs(given - expected) <= 0x1p-50 * fabs(expected);
}

/* --- comparisons ------------------------------------------------------------------------------ */

/* The squared distance of q to the segment from v[at] on, as numerator[to] / denominator[to]:
 * with t = (q - a).(b - a) and l = |b - a|^2 it is |q - a|^2, |q - b|^2 or (|q - a|^2 l - t^2) /
 * l. */
static void oracle_distance(predicate_oracle *o, int at, int to)
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

static int oracle_compare_ratios(predicate_oracle *o)
{
    mpz_mul(o->s, o->numerator[0], o->denominator[1]);
    mpz_mul(o->t, o->numerator[1], o->denominator[0]);
    return predicate_oracle_sign(mpz_cmp(o->s, o->t));
}

int predicate_oracle_compare_distance(predicate_oracle *o, const double *p)
{
    predicate_oracle_load(o, p, 10);
    oracle_distance(o, 2, 0);
    oracle_distance(o, 6, 1);
    return oracle_compare_ratios(o);
}

int predicate_oracle_compare_distance_to(predicate_oracle *o, const double *p)
{
    predicate_oracle_load(o, p, 7);
    oracle_distance(o, 2, 0);
    mpz_mul(o->numerator[1], o->v[6], o->v[6]);
    mpz_set_ui(o->denominator[1], 1);
    return oracle_compare_ratios(o);
}

/* --- signs in the plane, fast ----------------------------------------------------------------- */

static int sign_of(double value)
{
    return (value > 0) - (value < 0);
}

static predicate_oracle *big_numbers(void)
{
    static predicate_oracle numbers;
    static bool ready;
    if (!ready) predicate_oracle_init(&numbers);
    ready = true;
    return &numbers;
}

int plane_orient(const double *a, const double *b, const double *c)
{
    double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]),
           sum = fabs(left) + fabs(right);
    if (sum > 1e-280 && sum < 1e280 && fabs(left - right) > 1e-14 * sum)
        return sign_of(left - right);
    const double p[6] = {a[0], a[1], b[0], b[1], c[0], c[1]};
    predicate_oracle_orient2d(big_numbers(), p);
    return predicate_oracle_sign(mpz_sgn(big_numbers()->result));
}

int plane_incircle(const double *a, const double *b, const double *c, const double *d)
{
    const double *corner[3] = {a, b, c};
    double x[3], y[3], sum = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = corner[i][0] - d[0];
        y[i] = corner[i][1] - d[1];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double lift = x[i] * x[i] + y[i] * y[i];
        sum += lift * (x[j] * y[k] - x[k] * y[j]);
        size += lift * (fabs(x[j] * y[k]) + fabs(x[k] * y[j]));
    }
    if (size > 1e-270 && size < 1e270 && fabs(sum) > 1e-13 * size) return sign_of(sum);
    const double p[8] = {a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]};
    predicate_oracle_incircle(big_numbers(), p);
    return predicate_oracle_sign(mpz_sgn(big_numbers()->result));
}

bool plane_is_between(const double *a, const double *m, const double *b)
{
    return a[0] != b[0] ? (a[0] < m[0]) != (b[0] < m[0]) && m[0] != a[0] && m[0] != b[0]
                        : (a[1] < m[1]) != (b[1] < m[1]) && m[1] != a[1] && m[1] != b[1];
}

bool plane_is_on_segment(const double *a, const double *b, const double *q)
{
    return plane_is_between(a, q, b) && plane_orient(a, b, q) == 0;
}

bool plane_is_crossing(const double *a, const double *b, const double *c, const double *d)
{
    return plane_orient(a, b, c) * plane_orient(a, b, d) < 0 &&
           plane_orient(c, d, a) * plane_orient(c, d, b) < 0;
}
