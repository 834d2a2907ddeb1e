/* star_oracle.c - brute force over all facets in exact rationals. */
#include "oracle/star_oracle.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <string.h>

typedef struct star_oracle {
    mpq_t v[4][3], area[3], volume, s, t;
} star_oracle;

static void star_oracle_each(star_oracle *o, void (*each)(mpq_t))
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) each(o->v[i][k]);
    for (int k = 0; k < 3; k++) each(o->area[k]);
    each(o->volume);
    each(o->s);
    each(o->t);
}

static void star_oracle_init_one(mpq_t q)
{
    mpq_init(q);
}

static void star_oracle_clear_one(mpq_t q)
{
    mpq_clear(q);
}

/* r = det(v[a], v[b], v[c]) */
static void star_oracle_det(star_oracle *o, mpq_t r, int a, int b, int c)
{
    static const int plus[3][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}},
                     minus[3][3] = {{2, 1, 0}, {1, 0, 2}, {0, 2, 1}};
    mpq_set_ui(r, 0, 1);
    for (int i = 0; i < 3; i++) {
        mpq_mul(o->s, o->v[a][plus[i][0]], o->v[b][plus[i][1]]);
        mpq_mul(o->s, o->s, o->v[c][plus[i][2]]);
        mpq_add(r, r, o->s);
        mpq_mul(o->s, o->v[a][minus[i][0]], o->v[b][minus[i][1]]);
        mpq_mul(o->s, o->s, o->v[c][minus[i][2]]);
        mpq_sub(r, r, o->s);
    }
}

/* Does the ray from c through q meet the triangle t, which has an area seen from c? Fills in the
 * location, rounded weights included, then. */
static int star_oracle_meets(star_oracle *o, const double *points, const uint32_t *t,
                             const double c[3], const double q[3], mw_location *location)
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            mpq_set_d(o->v[i][k], i < 3 ? points[3 * (size_t)t[i] + (size_t)k] : q[k]);
            mpq_set_d(o->t, c[k]);
            mpq_sub(o->v[i][k], o->v[i][k], o->t);
        }
    star_oracle_det(o, o->volume, 0, 1, 2);
    int turn = mpq_sgn(o->volume), zeros = 0, on = 0, at = 0;
    if (turn == 0) return 0;
    mpq_set_ui(o->volume, 0, 1);
    for (int k = 0; k < 3; k++) {
        star_oracle_det(o, o->area[k], (k + 1) % 3, (k + 2) % 3, 3);
        int side = mpq_sgn(o->area[k]) * turn;
        if (side < 0) return 0;
        if (side == 0) {
            zeros++;
            on = (k + 1) % 3;
        } else {
            at = k;
        }
        mpq_add(o->volume, o->volume, o->area[k]);
    }
    if (zeros == 3) return 0; /* q is c */
    for (int k = 0; k < 3; k++) {
        mpq_div(o->s, o->area[k], o->volume);
        location->weight[k] = mpq_get_d(o->s);
    }
    location->where = zeros == 0 ? MW_INSIDE : zeros == 1 ? MW_ON_EDGE : MW_ON_VERTEX;
    location->local = (uint8_t)(zeros == 0 ? 255 : zeros == 1 ? on : at);
    return 1;
}

mw_location star_oracle_locate(const double *points, const uint32_t *triangles, uint32_t count,
                               const double c[3], const double q[3])
{
    star_oracle o;
    mw_location location = {.triangle = MW_NONE, .where = MW_BAD, .local = 255};
    star_oracle_each(&o, star_oracle_init_one);
    for (uint32_t t = 0; t < count && location.triangle == MW_NONE; t++)
        if (star_oracle_meets(&o, points, triangles + 3 * (size_t)t, c, q, &location))
            location.triangle = t;
    star_oracle_each(&o, star_oracle_clear_one);
    return location;
}

/* --- where a ray meets a facet --- */

static int star_oracle_is_odd(double r)
{
    uint64_t bits;
    memcpy(&bits, &r, sizeof bits);
    return (int)(bits & 1);
}

/* Is r as near to x as its neighbour on one side, and nearer where r is odd? Uses s and t. */
static int star_oracle_is_nearer(star_oracle *o, const mpq_t x, double r, double neighbour)
{
    if (fabs(neighbour) > DBL_MAX) return 1;
    mpq_set_d(o->s, r);
    mpq_set_d(o->t, neighbour);
    mpq_add(o->s, o->s, o->t);
    mpq_div_2exp(o->s, o->s, 1);
    const int side = mpq_cmp(x, o->s);
    return side == 0 ? !star_oracle_is_odd(r) : neighbour > r ? side < 0 : side > 0;
}

/* v[0] to v[2]: the corners relative to c, v[3]: q relative to c. The meeting point is c + f v[3],
 * where f = det(v0, v1, v2) / (the sum of det(v_i, v_j, v3)). */
int star_oracle_is_meeting(const double *points, const uint32_t *t, const double c[3],
                           const double q[3], const double meeting[3])
{
    star_oracle o;
    mw_location location;
    int right = 1;
    star_oracle_each(&o, star_oracle_init_one);
    right = star_oracle_meets(&o, points, t, c, q, &location);
    if (right) { /* `volume` has the sum, the determinants have one sign */
        star_oracle_det(&o, o.area[0], 0, 1, 2);
        mpq_div(o.area[0], o.area[0], o.volume);
    }
    for (int k = 0; k < 3 && right; k++) {
        mpq_mul(o.area[1], o.area[0], o.v[3][k]);
        mpq_set_d(o.area[2], c[k]);
        mpq_add(o.area[1], o.area[1], o.area[2]);
        right = isfinite(meeting[k]) &&
                star_oracle_is_nearer(&o, o.area[1], meeting[k], nextafter(meeting[k], INFINITY)) &&
                star_oracle_is_nearer(&o, o.area[1], meeting[k], nextafter(meeting[k], -INFINITY));
    }
    star_oracle_each(&o, star_oracle_clear_one);
    return right;
}
