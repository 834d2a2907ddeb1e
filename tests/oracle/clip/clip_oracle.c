/* clip_oracle.c - Sutherland and Hodgman's clipping in rationals, corner by corner. */
#include "oracle/clip/clip_oracle.h"

#include <gmp.h>
#include <stdbool.h>

enum { ROOM = 16 };

typedef struct corner {
    mpq_t c[3]; /* x, y, f - g */
} corner;

typedef struct polygon {
    corner at[ROOM];
    uint32_t count;
} polygon;

static void polygon_init(polygon *a)
{
    a->count = 0;
    for (int i = 0; i < ROOM; i++)
        for (int k = 0; k < 3; k++) mpq_init(a->at[i].c[k]);
}

static void polygon_clear(polygon *a)
{
    for (int i = 0; i < ROOM; i++)
        for (int k = 0; k < 3; k++) mpq_clear(a->at[i].c[k]);
}

static void corner_copy(corner *to, const corner *from)
{
    for (int k = 0; k < 3; k++) mpq_set(to->c[k], from->c[k]);
}

/* area = (b - a) x (c - a) */
static void area_of(mpq_t area, const mpq_t *a, const mpq_t *b, const mpq_t *c)
{
    mpq_t u, v;
    mpq_inits(u, v, NULL);
    mpq_sub(u, b[0], a[0]);
    mpq_sub(v, c[1], a[1]);
    mpq_mul(area, u, v);
    mpq_sub(u, b[1], a[1]);
    mpq_sub(v, c[0], a[0]);
    mpq_mul(u, u, v);
    mpq_sub(area, area, u);
    mpq_clears(u, v, NULL);
}

/* Keeps what has a value of at least 0; value[i] is that of corner i, linear between. */
static void polygon_keep(polygon *a, mpq_t *value)
{
    polygon kept;
    mpq_t t, u;
    mpq_inits(t, u, NULL);
    polygon_init(&kept);
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t j = (i + 1) % a->count;
        int s = mpq_sgn(value[i]), after = mpq_sgn(value[j]);
        if (s >= 0) corner_copy(&kept.at[kept.count++], &a->at[i]);
        if (s * after >= 0) continue;
        mpq_sub(t, value[i], value[j]);
        mpq_div(t, value[i], t);
        for (int k = 0; k < 3; k++) {
            mpq_t *c = &kept.at[kept.count].c[k];
            mpq_sub(u, a->at[j].c[k], a->at[i].c[k]);
            mpq_mul(u, u, t);
            mpq_add(*c, a->at[i].c[k], u);
        }
        kept.count++;
    }
    a->count = kept.count;
    for (uint32_t i = 0; i < kept.count; i++) corner_copy(&a->at[i], &kept.at[i]);
    polygon_clear(&kept);
    mpq_clears(t, u, NULL);
}

static void values_init(mpq_t *value)
{
    for (int i = 0; i < ROOM; i++) mpq_init(value[i]);
}

static void values_clear(mpq_t *value)
{
    for (int i = 0; i < ROOM; i++) mpq_clear(value[i]);
}

/* The integral of coordinate k, or of 1 for k = -1, as a sum over the triangles at corner 0. */
static double polygon_integral(const polygon *a, int k)
{
    mpq_t sum, area, mean;
    mpq_inits(sum, area, mean, NULL);
    for (uint32_t i = 1; i + 1 < a->count; i++) {
        area_of(area, a->at[0].c, a->at[i].c, a->at[i + 1].c);
        mpq_set_ui(mean, 1, 2);
        if (k >= 0) {
            mpq_add(mean, a->at[0].c[k], a->at[i].c[k]);
            mpq_add(mean, mean, a->at[i + 1].c[k]);
            mpq_t six;
            mpq_init(six);
            mpq_set_ui(six, 6, 1);
            mpq_div(mean, mean, six);
            mpq_clear(six);
        }
        mpq_mul(area, area, mean);
        mpq_add(sum, sum, area);
    }
    double rounded = mpq_get_d(sum);
    mpq_clears(sum, area, mean, NULL);
    return rounded;
}

/* The part where f - g times `sign` is at least 0. */
static double polygon_side(const polygon *whole, int sign)
{
    polygon a;
    mpq_t value[ROOM];
    polygon_init(&a);
    values_init(value);
    a.count = whole->count;
    for (uint32_t i = 0; i < a.count; i++) {
        corner_copy(&a.at[i], &whole->at[i]);
        if (sign < 0) mpq_neg(a.at[i].c[2], a.at[i].c[2]);
        mpq_set(value[i], a.at[i].c[2]);
    }
    polygon_keep(&a, value);
    double integral = polygon_integral(&a, 2);
    values_clear(value);
    polygon_clear(&a);
    return integral;
}

/* minus = the value at `at` of the linear function that is g[k] at frame[k]. */
static void plane_value(mpq_t value, corner frame[3], const double *g, const corner *at)
{
    mpq_t area, whole, part;
    mpq_inits(area, whole, part, NULL);
    area_of(whole, frame[0].c, frame[1].c, frame[2].c);
    mpq_set_ui(value, 0, 1);
    for (int k = 0; k < 3; k++) {
        area_of(area, at->c, frame[(k + 1) % 3].c, frame[(k + 2) % 3].c);
        mpq_set_d(part, g[k]);
        mpq_mul(part, part, area);
        mpq_div(part, part, whole);
        mpq_add(value, value, part);
    }
    mpq_clears(area, whole, part, NULL);
}

static void corners_set(corner *at, const double *xy, const uint32_t *which, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < 2; k++) mpq_set_d(at[i].c[k], xy[2 * (which ? which[i] : i) + k]);
}

clip_sums clip_oracle_sums(const double *p, const double *f, const double *q, uint32_t m,
                           const double *g)
{
    polygon a, b, frame;
    mpq_t value[ROOM];
    const uint32_t which[3] = {0, 1, m - 1};
    polygon_init(&a);
    polygon_init(&b);
    polygon_init(&frame);
    values_init(value);
    a.count = 3;
    corners_set(a.at, p, NULL, 3);
    for (int i = 0; i < 3; i++) mpq_set_d(a.at[i].c[2], f ? f[i] : 0);
    corners_set(b.at, q, NULL, m);
    corners_set(frame.at, q, which, 3);
    for (uint32_t j = 0; j < m && a.count; j++) {
        for (uint32_t i = 0; i < a.count; i++)
            area_of(value[i], b.at[j].c, b.at[(j + 1) % m].c, a.at[i].c);
        polygon_keep(&a, value);
    }
    for (uint32_t i = 0; i < a.count && g; i++) {
        plane_value(value[0], frame.at, g, &a.at[i]);
        mpq_sub(a.at[i].c[2], a.at[i].c[2], value[0]);
    }
    clip_sums sums = {polygon_integral(&a, -1), polygon_integral(&a, 0), polygon_integral(&a, 1),
                      polygon_side(&a, 1), polygon_side(&a, -1)};
    values_clear(value);
    polygon_clear(&frame);
    polygon_clear(&b);
    polygon_clear(&a);
    return sums;
}
