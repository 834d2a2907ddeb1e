/* line_plane.c - the line through c and q meets the plane of a, b, e at c + N / D (q - c), where
 *
 *     n = (b - a) x (e - a),   N = n . (a - c),   D = n . (q - c).
 *
 * Numbers of twice the precision of doubles nearly always tell to which double a coordinate has to
 * be rounded; a bound of their error says when they do not. Then integers do, which are exact. */
#include "predicates/line_plane.h"

#include "predicates/big.h"
#include "predicates/double_pair.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The line and the plane, relative to c and a. */
typedef struct line_and_plane {
    const double *a, *b, *e, *c, *q;
} line_and_plane;

/* --- by pairs of doubles --- */

/* Differences are at most LARGE. So nothing overflows: N and D are at most 12 LARGE^3. Products
 * that underflow add less than 2^-1070 LARGE = 2^-770 to N and D; their error bound is at least
 * 2^-98 SMALL = 2^-398. */
#define LARGE 0x1p300
#define SMALL 0x1p-300
/* N and D must not lose more than 40 bits by cancellation. */
#define LOST 0x1p40
/* A coordinate's product must not underflow. */
#define LEAST 0x1p-900

/* A determinant n . v and the sum of the magnitudes of its terms. */
typedef struct pair_volume {
    mw_pair value;
    double magnitude;
} pair_volume;

/* n = u x v; size: the sums of the magnitudes of its two products. */
static MW_INLINE void pair_cross(const mw_pair u[3], const mw_pair v[3], mw_pair n[3],
                                 double size[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const mw_pair left = mw__pair_multiply(u[i], v[j]), right = mw__pair_multiply(u[j], v[i]);
        n[k] = mw__pair_add(left, mw__pair_negative(right));
        size[k] = fabs(left.high) + fabs(right.high);
    }
}

static MW_INLINE pair_volume pair_dot(const mw_pair n[3], const double size[3], const mw_pair v[3])
{
    const mw_pair first = mw__pair_multiply(n[0], v[0]), second = mw__pair_multiply(n[1], v[1]),
                  third = mw__pair_multiply(n[2], v[2]);
    return (pair_volume){mw__pair_add(mw__pair_add(first, second), third),
                         size[0] * fabs(v[0].high) + size[1] * fabs(v[1].high) +
                             size[2] * fabs(v[2].high)};
}

static MW_INLINE bool pairs_in_range(const mw_pair v[3])
{
    return fabs(v[0].high) <= LARGE && fabs(v[1].high) <= LARGE && fabs(v[2].high) <= LARGE;
}

/* Let E be MW_PAIR_ERROR. A component of n is off by 2.01 E of its size, a term of N by 3.02 E of
 * its magnitude, and N by 5.1 E of N's magnitude, which is computed with an error that 8 E covers;
 * so is D. */
static MW_INLINE bool volume_is_sure(const pair_volume *v)
{
    return v->magnitude >= SMALL && fabs(v->value.high) * LOST > v->magnitude;
}

static MW_INLINE double volume_error(const pair_volume *v)
{
    return 8 * MW_PAIR_ERROR * v->magnitude / fabs(v->value.high);
}

/* t = N / D. *error: how far it is off, relative to itself. Returns false where that is too far. */
static MW_INLINE bool pair_ratio(const line_and_plane *l, const mw_pair away[3], mw_pair *t,
                                 double *error)
{
    mw_pair u[3], v[3], height[3], n[3];
    double size[3];
    for (int k = 0; k < 3; k++) {
        u[k] = mw__pair_difference(l->b[k], l->a[k]);
        v[k] = mw__pair_difference(l->e[k], l->a[k]);
        height[k] = mw__pair_difference(l->a[k], l->c[k]);
    }
    if (!pairs_in_range(u) || !pairs_in_range(v) || !pairs_in_range(height) ||
        !pairs_in_range(away))
        return false;
    pair_cross(u, v, n, size);
    const pair_volume above = pair_dot(n, size, height), below = pair_dot(n, size, away);
    if (!volume_is_sure(&above) || !volume_is_sure(&below)) return false;
    *t = mw__pair_divide(above.value, below.value);
    *error = volume_error(&above) + volume_error(&below) + MW_PAIR_ERROR;
    return true;
}

/* The double nearest to c + t away. t away is off by `error` and E of itself, and the sum by E of
 * the sum; twice that covers the rounding of the bound. Returns false where the doubles on both
 * sides of a bound differ. */
static MW_INLINE bool pair_coordinate(double c, mw_pair t, mw_pair away, double error,
                                      double *coordinate)
{
    const mw_pair way = mw__pair_multiply(t, away), p = mw__pair_add((mw_pair){c, 0}, way);
    if (!(fabs(way.high) > LEAST)) return false;
    const double off =
        2 * (fabs(way.high) * (error + MW_PAIR_ERROR) + fabs(p.high) * MW_PAIR_ERROR);
    *coordinate = p.high + 0.0;
    return p.high + (p.low + off) == p.high && p.high + (p.low - off) == p.high;
}

/* --- by integers --- */

/* The coordinate k of the point is over / under * 2^base. */
typedef struct big_coordinate {
    mw_big over, under;
    int base;
} big_coordinate;

static void big_dot(mw_big *r, const mw_big n[3], const mw_big v[3])
{
    mw_big term;
    *r = (mw_big){0};
    for (int k = 0; k < 3; k++) {
        mw__big_multiply(&term, &n[k], &v[k]);
        mw__big_add(r, r, &term);
    }
}

static void big_differences(mw_big r[3], const double *p, const double *q, int base)
{
    for (int k = 0; k < 3; k++) mw__big_difference(&r[k], p[k], q[k], base);
}

/* `grain` must be a multiple of 2^base, too. */
static void coordinate_set(big_coordinate *x, const line_and_plane *l, int k, double grain)
{
    double all[16];
    const double *const point[5] = {l->a, l->b, l->e, l->c, l->q};
    mw_big u[3], v[3], n[3], above, way;
    for (int i = 0; i < 15; i++) all[i] = point[i / 3][i % 3];
    all[15] = grain;
    x->base = mw__big_base(all, 16);
    big_differences(u, l->b, l->a, x->base);
    big_differences(v, l->e, l->a, x->base);
    for (int i = 0; i < 3; i++)
        mw__big_cross(&n[i], &u[(i + 1) % 3], &u[(i + 2) % 3], &v[(i + 1) % 3], &v[(i + 2) % 3]);
    big_differences(u, l->a, l->c, x->base);
    big_differences(v, l->q, l->c, x->base);
    big_dot(&above, n, u);
    big_dot(&x->under, n, v);
    mw__big_multiply(&way, &above, &v[k]);
    mw__big_difference(&u[0], l->c[k], 0, x->base);
    mw__big_multiply(&x->over, &x->under, &u[0]);
    mw__big_add(&x->over, &x->over, &way);
}

/* Off by a few units in the last place. */
static double coordinate_guess(const big_coordinate *x)
{
    int over, under;
    const double a = mw__big_fraction(&x->over, &over), b = mw__big_fraction(&x->under, &under);
    const double guess = ldexp(a / b, over - under + x->base);
    return fmax(fmin(guess, DBL_MAX), -DBL_MAX);
}

/* The sign of the coordinate minus (r + s) / 2; both are multiples of 2^base. */
static int coordinate_compare(const big_coordinate *x, double r, double s)
{
    mw_big sum, other, twice;
    mw__big_difference(&sum, r, -s, x->base);
    mw__big_multiply(&other, &sum, &x->under);
    mw__big_add(&twice, &x->over, &x->over);
    mw__big_subtract(&other, &twice, &other);
    return other.sign * x->under.sign;
}

static bool double_is_odd(double r)
{
    uint64_t bits;
    memcpy(&bits, &r, sizeof bits);
    return bits & 1;
}

/* A quarter of a unit in the last place of r, of which the doubles near r are multiples. */
static double double_grain(double r)
{
    const double m = fabs(r), unit = m < DBL_MAX ? nextafter(m, INFINITY) - m : 0x1p971;
    return fmax(unit / 4, 0x1p-1074);
}

static double big_coordinate_rounded(const line_and_plane *l, int k)
{
    big_coordinate x;
    coordinate_set(&x, l, k, 0);
    double r = coordinate_guess(&x);
    coordinate_set(&x, l, k, double_grain(r));
    for (;;) {
        const double up = nextafter(r, INFINITY), down = nextafter(r, -INFINITY);
        const int over = up <= DBL_MAX ? coordinate_compare(&x, r, up) : -1,
                  under = down >= -DBL_MAX ? coordinate_compare(&x, r, down) : 1;
        if (over > 0 || (over == 0 && double_is_odd(r)))
            r = up;
        else if (under < 0 || (under == 0 && double_is_odd(r)))
            r = down;
        else
            return r + 0.0;
    }
}

/* --- */

void mw__line_meets_plane(const double *a, const double *b, const double *e, const double c[3],
                          const double q[3], double point[3])
{
    const line_and_plane l = {a, b, e, c, q};
    mw_pair away[3], t = {0, 0};
    double error = 0;
    for (int k = 0; k < 3; k++) away[k] = mw__pair_difference(q[k], c[k]);
    const bool sure = pair_ratio(&l, away, &t, &error);
    for (int k = 0; k < 3; k++) {
        if (a[k] == b[k] && a[k] == e[k])
            point[k] = a[k] + 0.0; /* the plane is one of equal coordinates */
        else if (away[k].high == 0)
            point[k] = c[k] + 0.0;
        else if (!sure || !pair_coordinate(c[k], t, away[k], error, &point[k]))
            point[k] = big_coordinate_rounded(&l, k);
    }
}
