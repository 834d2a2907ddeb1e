/* predicates.h - exact predicates on internal points: inline filters, exact stages out of line.
 * Private.
 *
 * Every predicate is first evaluated in plain doubles. A bound on the rounding error [Shewchuk
 * 1997, sec. 4] decides nearly every call; the others go to an exact stage: expansions
 * (expansion.h), and big integers (big.h) where a coordinate is so large or so small that
 * expansions could over- or underflow. So the signs are right for all finite doubles. With a
 * coordinate that is NaN or infinite the result is 0.
 *
 * How the bounds are found. Let u = 2^-53. A sum or difference x of doubles is rounded to fl(x) =
 * x(1 + d), and also x = fl(x)(1 + e), with |d|, |e| <= u; so is a product, up to 2^-1075 where it
 * underflows. A bound is proportional to a permanent: the determinant with absolute values for all
 * products, computed in the same order. Rounding is monotone, so the permanent is never less than
 * the determinant: one that overflows has an infinite bound and is not trusted. */
#ifndef MW_SRC_PREDICATES_PREDICATES_H
#define MW_SRC_PREDICATES_PREDICATES_H

#include "base/base.h"

#include <float.h>
#include <math.h>
#include <meshwalk/predicates.h>

/* x87 arithmetic, which keeps more bits than a double has, breaks filters and expansions alike. */
_Static_assert(FLT_EVAL_METHOD == 0 && FLT_RADIX == 2 && DBL_MANT_DIG == 53 && DBL_MIN_EXP == -1021,
               "the exact predicates need IEEE double arithmetic without excess precision");

typedef struct mw_point {
    double x, y;
} mw_point;

/* The exact stages, for when a filter could not decide. Their value has a relative error below
 * 2^-50; a determinant beyond the range of doubles gives +-DBL_MAX; one below the normal doubles
 * gives a nonzero number of its sign, at most DBL_MIN. */
double mw__orient2d_exact(mw_point a, mw_point b, mw_point c);
double mw__dot2d_exact(mw_point a, mw_point b, mw_point c);
/* orient2d of finite points as fraction * 2^*exponent, which neither over- nor underflows: the
 * fraction's magnitude is from 1/2 to 1, or 0. Slow. */
double mw__orient2d_fraction(mw_point a, mw_point b, mw_point c, int *exponent);
double mw__incircle_exact(mw_point a, mw_point b, mw_point c, mw_point d);
/* The same, of which only the sign is right: sooner known. */
double mw__incircle_sign(mw_point a, mw_point b, mw_point c, mw_point d);
double mw__orient3d_exact(const double a[3], const double b[3], const double c[3],
                          const double d[3]);

/* What products that underflow can add to the error: at most 2^-970, see each filter. */
#define MW_UNDERFLOW_ERROR 0x1p-960

/* Bound for det = left - right, where left and right are products of two differences. Three
 * roundings each: the true values are off left and right by at most (3u + 3u^2 + u^3)(|left| +
 * |right|), and |left| + |right| <= sum (1 + u), |left - right| >= |det| (1 - u): the sign is right
 * when |det| > (3u + 9u^2 + ...) sum. Computing the bound rounds twice, which leaves (3u + 16u^2)(1
 * - u)^2, still more than 3u + 9u^2 + .... Underflow: 2 * 2^-1075. */
#define MW_ORIENT2D_ERROR ((3.0 + 16.0 * 0x1p-53) * 0x1p-53)
static MW_INLINE double mw__orient2d_bound(double left, double right)
{
    return MW_ORIENT2D_ERROR * (fabs(left) + fabs(right)) + MW_UNDERFLOW_ERROR;
}

/* Plain doubles: the determinant as rounded. */
static MW_INLINE double mw__orient2d_double(mw_point a, mw_point b, mw_point c)
{
    return (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
}

/* The same. Its sign is sure where its magnitude is above *bound. */
static MW_INLINE double mw__orient2d_rounded(mw_point a, mw_point b, mw_point c, double *bound)
{
    double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    *bound = mw__orient2d_bound(left, right);
    return left - right;
}

/* > 0: c lies to the left of a->b; < 0: to the right; 0: on the line. Sign-exact. */
static MW_INLINE double mw__orient2d(mw_point a, mw_point b, mw_point c)
{
    double bound, det = mw__orient2d_rounded(a, b, c, &bound);
    return MW_LIKELY(fabs(det) > bound) ? det : mw__orient2d_exact(a, b, c);
}

/* (b - a) . (c - a): > 0 where b and c lie less than 90 degrees apart, seen from a. Sign-exact; the
 * same form as orient2d, with the second product negated, and so the same bound. */
static MW_INLINE double mw__dot2d(mw_point a, mw_point b, mw_point c)
{
    double left = (b.x - a.x) * (c.x - a.x), right = (a.y - b.y) * (c.y - a.y), det = left - right;
    return MW_LIKELY(fabs(det) > mw__orient2d_bound(left, right)) ? det : mw__dot2d_exact(a, b, c);
}

/* Bound for incircle in terms of its permanent. A minor m of two products of differences is off by
 * (4u + 4u^2 + ...) times its permanent P, as above with its own rounding; a lift by the factor (1
 * + u)^4; their product, rounded once more, by (9u + 32u^2 + ...) lift P, which is (9u + 50u^2 +
 * ...) of its computed permanent. The first sum adds u and one more factor 1 + u: 10u + 59u^2; the
 * sum of the permanents and the last rounding of det make it 10u + 79u^2 + .... (10u + 128u^2)(1 -
 * u)^2 is more than that. Underflow: an error of 2^-1075 in a product is multiplied by a lift or a
 * minor. Both are below `lifts`, the sum of the lifts, so with lifts < 2^100 that is at most 12 *
 * 2^100 * 2^-1075 < 2^-971. */
#define MW_INCIRCLE_ERROR ((10.0 + 128.0 * 0x1p-53) * 0x1p-53)
#define MW_INCIRCLE_LIFTS 0x1p100

/* The determinant as rounded. Its sign is sure where its magnitude is above *bound. */
static MW_INLINE double mw__incircle_rounded(mw_point a, mw_point b, mw_point c, mw_point d,
                                             double *bound)
{
    double adx = a.x - d.x, ady = a.y - d.y, bdx = b.x - d.x, bdy = b.y - d.y, cdx = c.x - d.x,
           cdy = c.y - d.y;
    double bc = bdx * cdy, cb = cdx * bdy, ca = cdx * ady, ac = adx * cdy, ab = adx * bdy,
           ba = bdx * ady;
    double alift = adx * adx + ady * ady, blift = bdx * bdx + bdy * bdy,
           clift = cdx * cdx + cdy * cdy;
    double permanent = alift * (fabs(bc) + fabs(cb)) + blift * (fabs(ca) + fabs(ac)) +
                       clift * (fabs(ab) + fabs(ba));
    bool small = alift + blift + clift < MW_INCIRCLE_LIFTS;
    *bound = small ? MW_INCIRCLE_ERROR * permanent + MW_UNDERFLOW_ERROR : INFINITY;
    return alift * (bc - cb) + blift * (ca - ac) + clift * (ab - ba);
}

/* For a, b, c counter-clockwise: > 0: d lies inside their circle; < 0: outside; 0: on it.
 * Sign-exact. */
static MW_INLINE double mw__incircle(mw_point a, mw_point b, mw_point c, mw_point d)
{
    double bound, det = mw__incircle_rounded(a, b, c, d, &bound);
    return MW_LIKELY(fabs(det) > bound) ? det : mw__incircle_sign(a, b, c, d);
}

/* Bound for orient3d in terms of its permanent. A minor is off by (4u + 4u^2 + ...) P, as for
 * incircle; its product with a difference, rounded, by (6u + 11u^2 + ...) |difference| P, which is
 * (6u + 23u^2 + ...) of its computed permanent; the sums make it 7u + 43u^2 + .... (7u + 64u^2)(1 -
 * u)^2 is more. Underflow: an error of 2^-1075 in each of six products is multiplied by a z; with
 * the sum of the z below 2^100 that is less than 2^-970. */
#define MW_ORIENT3D_ERROR ((7.0 + 64.0 * 0x1p-53) * 0x1p-53)
#define MW_ORIENT3D_HEIGHTS 0x1p100

/* The determinant as rounded. Its sign is sure where its magnitude is above *bound. */
static MW_INLINE double mw__orient3d_rounded(const double a[3], const double b[3],
                                             const double c[3], const double d[3], double *bound)
{
    double ax = d[0] - a[0], ay = d[1] - a[1], az = d[2] - a[2];
    double bx = d[0] - b[0], by = d[1] - b[1], bz = d[2] - b[2];
    double cx = d[0] - c[0], cy = d[1] - c[1], cz = d[2] - c[2];
    double bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
    double permanent = fabs(az) * (fabs(bc) + fabs(cb)) + fabs(bz) * (fabs(ca) + fabs(ac)) +
                       fabs(cz) * (fabs(ab) + fabs(ba));
    bool small = fabs(az) + fabs(bz) + fabs(cz) < MW_ORIENT3D_HEIGHTS;
    *bound = small ? MW_ORIENT3D_ERROR * permanent + MW_UNDERFLOW_ERROR : INFINITY;
    return az * (bc - cb) + bz * (ca - ac) + cz * (ab - ba);
}

/* > 0: d lies on the side of the plane through a, b, c from which they turn counter-clockwise.
 * Sign-exact. */
static MW_INLINE double mw__orient3d(const double a[3], const double b[3], const double c[3],
                                     const double d[3])
{
    double bound, det = mw__orient3d_rounded(a, b, c, d, &bound);
    return MW_LIKELY(fabs(det) > bound) ? det : mw__orient3d_exact(a, b, c, d);
}

/* Compare the distance of q to the closed segment ab with its distance to the closed segment cd,
 * exactly: -1 where ab is nearer, 0 where they are equal, 1 where cd is nearer. A segment may be a
 * point (a equals b). All coordinates are finite. */
int mw__compare_distance(mw_point q, mw_point a, mw_point b, mw_point c, mw_point d);

/* Compare the distance of q to the closed segment ab with the length |d|, exactly. d may be
 * infinite, but not NaN. */
int mw__compare_distance_to(mw_point q, mw_point a, mw_point b, double d);

/* The angle between b->a and b->c, from 0 to pi, as two products with their permanents. */
typedef struct mw_angle {
    mw_point a, b, c;
    double cross, dot; /* rounded; cross as a magnitude */
    double cross_sum, dot_sum;
} mw_angle;

static MW_INLINE mw_angle mw__angle(mw_point a, mw_point b, mw_point c)
{
    double ux = a.x - b.x, uy = a.y - b.y, vx = c.x - b.x, vy = c.y - b.y;
    double left = ux * vy, right = uy * vx, x = ux * vx, y = uy * vy;
    return (mw_angle){
        a, b, c, fabs(left - right), x + y, fabs(left) + fabs(right), fabs(x) + fabs(y)};
}

/* Bound for cross(s) dot(t) - dot(s) cross(t). A product of two differences, cross or dot, is off
 * by (3u + 16u^2) times its permanent, see orient2d; so the product of two of them by (6u + 42u^2)
 * times the product of their permanents, and rounded once more by (7u + 52u^2); their difference,
 * rounded, and the rounding of the permanents' products and sum (one factor 1 + u each) make it 8u
 * + 80u^2. (8u + 128u^2)(1 - u)^3 is more. Underflow: an error of 2 * 2^-1075 in a factor is
 * multiplied by the other one, and 2^-1075 added; with the sum of the permanents below 2^100 that
 * is less than 2^-970. */
#define MW_ANGLE_ERROR ((8.0 + 128.0 * 0x1p-53) * 0x1p-53)
#define MW_ANGLE_SUMS 0x1p100

/* It as rounded, the sine of the difference of the angles times lengths. Its sign is sure where its
 * magnitude is above *bound. */
static MW_INLINE double mw__angle_difference_rounded(const mw_angle *s, const mw_angle *t,
                                                     double *bound)
{
    double permanent = s->cross_sum * t->dot_sum + s->dot_sum * t->cross_sum;
    bool small = s->cross_sum + s->dot_sum + t->cross_sum + t->dot_sum < MW_ANGLE_SUMS;
    *bound = small ? MW_ANGLE_ERROR * permanent + MW_UNDERFLOW_ERROR : INFINITY;
    return s->cross * t->dot - s->dot * t->cross;
}

int mw__compare_angles_exact(const mw_angle *s, const mw_angle *t);

/* Compare two angles, exactly: -1 where s is smaller, 0 where they are equal, 1 where s is larger.
 * All coordinates are finite, and a and c differ from b. */
static MW_INLINE int mw__compare_angles(const mw_angle *s, const mw_angle *t)
{
    double bound, difference = mw__angle_difference_rounded(s, t, &bound);
    if (MW_LIKELY(fabs(difference) > bound)) return difference > 0 ? 1 : -1;
    return mw__compare_angles_exact(s, t);
}

/* Bound for the difference of two squared lengths s and t. The differences of coordinates, the
 * squares and their sum are rounded: the true value is s (1 + e)^4 with |e| <= u, and the true
 * difference off s - t by at most (4u + 6u^2 + ...)(s + t). Rounding s - t and the bound, which is
 * rounded twice, leaves (4u + 32u^2)(1 - u)^3, more than 4u + 6u^2 + .... Underflow: 4 *
 * 2^-1075. */
#define MW_LENGTH_ERROR ((4.0 + 32.0 * 0x1p-53) * 0x1p-53)

/* |b - a|^2, rounded. */
static MW_INLINE double mw__square_length(mw_point a, mw_point b)
{
    double x = b.x - a.x, y = b.y - a.y;
    return x * x + y * y;
}

/* Is the squared length that was rounded to s surely less than the one rounded to t? */
static MW_INLINE bool mw__surely_shorter(double s, double t)
{
    return t - s > MW_LENGTH_ERROR * (s + t) + MW_UNDERFLOW_ERROR;
}

/* Compare the lengths of ab and cd, exactly, where rounded squares could not tell: -1 where ab is
 * shorter, 0 where they are equal, 1 where cd is. */
int mw__compare_length_exact(mw_point a, mw_point b, mw_point c, mw_point d);

#endif
