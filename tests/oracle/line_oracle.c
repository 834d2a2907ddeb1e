/* line_oracle.c - a line in space and two planes, in GMP integers. */
#include "oracle/line_oracle.h"

#include <math.h>

void line_oracle_init(line_oracle *o)
{
    for (int i = 0; i < LINE_ORACLE_COORDINATES; i++) mpz_init(o->v[i]);
    for (int i = 0; i < 3; i++) mpz_init(o->normal[i]);
    for (int i = 0; i < 2; i++) mpz_inits(o->n[i], o->m[i], NULL);
    mpz_inits(o->s, o->t, o->square, NULL);
}

void line_oracle_clear(line_oracle *o)
{
    for (int i = 0; i < LINE_ORACLE_COORDINATES; i++) mpz_clear(o->v[i]);
    for (int i = 0; i < 3; i++) mpz_clear(o->normal[i]);
    for (int i = 0; i < 2; i++) mpz_clears(o->n[i], o->m[i], NULL);
    mpz_clears(o->s, o->t, o->square, NULL);
}

/* n and m of the triangle whose corners are a[0..9). */
static void line_oracle_hit(line_oracle *o, mpz_t *a, int to)
{
    mpz_set_ui(o->n[to], 0);
    mpz_set_ui(o->m[to], 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_set_ui(o->normal[i], 0); /* a x b + b x c + c x a, unlike in the library */
        for (int c = 0; c < 3; c++) {
            mpz_addmul(o->normal[i], a[3 * c + j], a[3 * ((c + 1) % 3) + k]);
            mpz_submul(o->normal[i], a[3 * c + k], a[3 * ((c + 1) % 3) + j]);
        }
        mpz_sub(o->s, a[i], o->v[i]);
        mpz_addmul(o->n[to], o->normal[i], o->s);
        mpz_addmul(o->m[to], o->normal[i], o->v[3 + i]);
    }
}

void line_oracle_load(line_oracle *o, const double p[LINE_ORACLE_COORDINATES])
{
    int exponent;
    o->base = 2000;
    for (int i = 0; i < LINE_ORACLE_COORDINATES; i++) {
        frexp(p[i], &exponent);
        if (p[i] != 0 && exponent - 53 < o->base) o->base = exponent - 53;
    }
    for (int i = 0; i < LINE_ORACLE_COORDINATES; i++) {
        double fraction = frexp(p[i], &exponent);
        mpz_set_d(o->v[i], ldexp(fraction, 53)); /* a whole number */
        if (p[i] != 0) mpz_mul_2exp(o->v[i], o->v[i], (mp_bitcnt_t)(exponent - 53 - o->base));
    }
    line_oracle_hit(o, o->v + 6, 0);
    line_oracle_hit(o, o->v + 15, 1);
    mpz_set_ui(o->square, 0);
    for (int i = 3; i < 6; i++) mpz_addmul(o->square, o->v[i], o->v[i]);
}

bool line_oracle_ready(const line_oracle *o)
{
    return mpz_sgn(o->m[0]) != 0 && mpz_sgn(o->m[1]) != 0;
}

int line_oracle_compare_hits(line_oracle *o)
{
    mpz_mul(o->s, o->n[0], o->m[1]);
    mpz_mul(o->t, o->n[1], o->m[0]);
    return predicate_oracle_sign(mpz_cmpabs(o->s, o->t));
}

int line_oracle_compare_hit_to(line_oracle *o)
{
    mpz_mul(o->s, o->n[0], o->n[0]);
    mpz_mul(o->s, o->s, o->square);
    mpz_mul(o->t, o->v[24], o->m[0]);
    mpz_mul(o->t, o->t, o->t);
    return predicate_oracle_sign(mpz_cmp(o->s, o->t));
}

long line_oracle_side(predicate_oracle *o, const double *p)
{
    long base = predicate_oracle_load(o, p, 12);
    for (int i = 0; i < 6; i++) mpz_sub(o->d[i], o->v[6 + i], o->v[i % 3]);
    mpz_set_ui(o->result, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        predicate_oracle_cross(o, o->d[6], o->d[j], o->d[k], o->d[3 + j], o->d[3 + k]);
        mpz_addmul(o->result, o->v[3 + i], o->d[6]);
    }
    return 3 * base;
}
