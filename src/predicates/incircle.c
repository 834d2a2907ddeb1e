/* incircle.c - the exact stage of incircle: the determinant of the rows x, y, x^2 + y^2 of a - d, b
 * - d, c - d. */
#include "predicates/big.h"
#include "predicates/error_free.h"
#include "predicates/expansion.h"

/* Expansions are exact for nonzero coordinates of magnitude 2^-216 to 2^253: products of four
 * differences are multiples of 2^(4 * (-216 - 52)) = 2^-1072, and the twelve of them are at most 12
 * * 2^(4 * 254) < 2^1020. */
#define LOW 0x1p-216
#define HIGH 0x1p253

/* A term, lift times minor, has 16 * 16 * 2 = 512 parts, and takes room for both and twice its
 * own. */
#define TERM_PARTS 512
#define TERM_ROOM (2 * MW_CROSS_ROOM + 2 * TERM_PARTS)

typedef struct row {
    mw_expansion x, y;
} row;

#ifdef __SIZEOF_INT128__
__extension__ typedef __int128 incircle_wide;
#define LOW_BITS (((incircle_wide)1 << 42) - 1)

/* Is x * scale, of magnitude below 2^41, an integer? */
static bool to_integer(mw_expansion x, double scale, int64_t *n)
{
    if (x.n > 1) return false;
    double scaled = x.n == 0 ? 0 : x.part[0] * scale;
    *n = (int64_t)scaled;
    return (double)*n == scaled;
}

/* A short cut for points of a grid, of which many lie on one circle, and for points that lie close
 * together far from the origin: all differences are integers below 2^41 times one power of two.
 * Then lifts and minors are below 2^83; each lift is cut into high * 2^42 + low, and the sums of
 * high * minor and of low * minor stay below 3 * 2^125. Two (grid) to eight times as fast as
 * expansions. False for other points, and where compilers have no integers of 128 bits. */
static bool incircle_on_grid(const row p[3], double *det)
{
    double largest = 0;
    int64_t x[3], y[3];
    incircle_wide high = 0, low = 0;
    for (int i = 0; i < 3; i++) {
        if (p[i].x.n == 1) largest = fmax(largest, fabs(p[i].x.part[0]));
        if (p[i].y.n == 1) largest = fmax(largest, fabs(p[i].y.part[0]));
    }
    double scale = largest > 0 ? ldexp(1, 40 - ilogb(largest)) : 1, unit = 1 / scale;
    for (int i = 0; i < 3; i++) {
        if (!to_integer(p[i].x, scale, &x[i]) || !to_integer(p[i].y, scale, &y[i])) return false;
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        incircle_wide lift = (incircle_wide)x[i] * x[i] + (incircle_wide)y[i] * y[i],
                      minor = (incircle_wide)x[j] * y[k] - (incircle_wide)x[k] * y[j];
        high += (lift >> 42) * minor;
        low += (lift & LOW_BITS) * minor;
    }
    high += low >> 42; /* rounded down, so that what is left of low is not negative */
    low &= LOW_BITS;
    *det = ((double)high * 0x1p42 + (double)low) * unit * unit * unit * unit;
    return true;
}
#else
static bool incircle_on_grid(const row p[3], double *det)
{
    (void)p, (void)det;
    return false;
}
#endif

static mw_expansion expansion_term(mw_arena *arena, const row *p, const row *q, const row *r)
{
    mw_expansion x = mw__expansion_multiply(arena, p->x, p->x),
                 y = mw__expansion_multiply(arena, p->y, p->y);
    mw_expansion lift = mw__expansion_add(arena, x, y);
    mw_expansion minor = mw__expansion_cross(arena, q->x, q->y, r->x, r->y);
    return mw__expansion_multiply(arena, lift, minor);
}

/* A number of twice the bits of a double: the sum of two. */
typedef struct incircle_pair {
    double high, low;
} incircle_pair;

/* a b + c d */
static incircle_pair pair_of_products(double a, double b, double c, double d)
{
    double ab_tail, cd_tail, tail, ab = mw__two_product(a, b, &ab_tail),
                                   cd = mw__two_product(c, d, &cd_tail);
    incircle_pair r;
    double sum = mw__two_sum(ab, cd, &tail);
    r.high = mw__two_sum(sum, (ab_tail + cd_tail) + tail, &r.low);
    return r;
}

static incircle_pair pair_multiply(incircle_pair a, incircle_pair b)
{
    incircle_pair r;
    double tail, product = mw__two_product(a.high, b.high, &tail);
    r.high = mw__two_sum(product, (a.high * b.low + a.low * b.high) + tail, &r.low);
    return r;
}

static incircle_pair pair_add(incircle_pair a, incircle_pair b)
{
    incircle_pair r;
    double tail, sum = mw__two_sum(a.high, b.high, &tail);
    r.high = mw__two_sum(sum, (a.low + b.low) + tail, &r.low);
    return r;
}

/* Computes with pairs of doubles, if differences are exact. That decides most of what a filter
 * leaves open, except for points that really are on one circle. With u = 2^-53, and P for a
 * permanent: lifts and minors are off by less than 4 u^2 P each, since tails are at most u of their
 * products and rounded once or twice; a term by that of either factor times the other, and by 8 u^2
 * of its own, less than 20 u^2 P in all; the two sums by 4 u^2 P each. So the sign is sure beyond
 * 28 u^2 P, and 128 u^2 is more than that with the rounding of P itself. What underflows is off by
 * 2^-1070 times a lift or a minor, at most 2^-970; 128 u^2 P is more. */
#define PAIRS_ERROR 0x1p-99
#define PAIRS_LEAST 0x1p-700
static bool incircle_with_pairs(const row p[3], double *det)
{
    double x[3], y[3], lifts = 0, permanent = 0;
    incircle_pair lift[3], sum = {0, 0};
    for (int i = 0; i < 3; i++) {
        if (p[i].x.n > 1 || p[i].y.n > 1) return false;
        x[i] = p[i].x.n ? p[i].x.part[0] : 0;
        y[i] = p[i].y.n ? p[i].y.part[0] : 0;
        lifts += x[i] * x[i] + y[i] * y[i];
    }
    if (!(lifts < MW_INCIRCLE_LIFTS)) return false;
    for (int i = 0; i < 3; i++) lift[i] = pair_of_products(x[i], x[i], y[i], y[i]);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        incircle_pair minor = pair_of_products(x[j], y[k], -x[k], y[j]);
        sum = pair_add(sum, pair_multiply(lift[i], minor));
        permanent += lift[i].high * (fabs(x[j] * y[k]) + fabs(x[k] * y[j]));
    }
    *det = sum.high;
    return permanent > PAIRS_LEAST && fabs(sum.high) > PAIRS_ERROR * permanent;
}

/* v: a, b, c, d, two coordinates each. */
static double incircle_with_expansions(const double v[8])
{
    double room[12 + 3 * TERM_ROOM + 5 * TERM_PARTS], det;
    mw_arena arena = {room};
    row p[3];
    mw_expansion term[3];
    for (int i = 0; i < 3; i++) {
        p[i].x = mw__expansion_difference(&arena, v[2 * i], v[6]);
        p[i].y = mw__expansion_difference(&arena, v[2 * i + 1], v[7]);
    }
    if (incircle_on_grid(p, &det)) return det;
    for (int i = 0; i < 3; i++)
        term[i] = expansion_term(&arena, &p[i], &p[(i + 1) % 3], &p[(i + 2) % 3]);
    mw_expansion sum = mw__expansion_add(&arena, term[0], term[1]);
    return mw__expansion_estimate(mw__expansion_add(&arena, sum, term[2]));
}

static double incircle_with_integers(const double v[8])
{
    mw_big x[3], y[3], square, lift, minor, term, sum = {0};
    int base = mw__big_base(v, 8);
    for (int i = 0; i < 3; i++) {
        mw__big_difference(&x[i], v[2 * i], v[6], base);
        mw__big_difference(&y[i], v[2 * i + 1], v[7], base);
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mw__big_multiply(&lift, &x[i], &x[i]);
        mw__big_multiply(&square, &y[i], &y[i]);
        mw__big_add(&lift, &lift, &square);
        mw__big_cross(&minor, &x[j], &y[j], &x[k], &y[k]);
        mw__big_multiply(&term, &lift, &minor);
        mw__big_add(&sum, &sum, &term);
    }
    return mw__big_double(&sum, 4 * base);
}

/* det 2^-exponent; where that is not 0 and no normal double, +-DBL_MAX or +-DBL_MIN. */
static double incircle_scaled_back(double det, int exponent)
{
    double value = ldexp(det, -exponent), magnitude = fabs(value);
    if (det == 0 || (magnitude >= DBL_MIN && magnitude <= DBL_MAX)) return value;
    return copysign(magnitude > DBL_MAX ? DBL_MAX : DBL_MIN, det);
}

double mw__incircle_exact(mw_point a, mw_point b, mw_point c, mw_point d)
{
    const double v[8] = {a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y};
    double scaled[8];
    int shift;
    if (MW_LIKELY(mw__within(v, 8, LOW, HIGH))) return incircle_with_expansions(v);
    if (mw__scale_within(v, 8, LOW, scaled, &shift))
        return incircle_scaled_back(incircle_with_expansions(scaled), 4 * shift);
    return mw__all_finite(v, 8) ? incircle_with_integers(v) : 0;
}

double mw__incircle_sign(mw_point a, mw_point b, mw_point c, mw_point d)
{
    const double v[8] = {a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y};
    double room[12], det;
    mw_arena arena = {room};
    row p[3];
    if (MW_UNLIKELY(!mw__within(v, 8, LOW, HIGH))) return mw__incircle_exact(a, b, c, d);
    for (int i = 0; i < 3; i++) {
        p[i].x = mw__expansion_difference(&arena, v[2 * i], v[6]);
        p[i].y = mw__expansion_difference(&arena, v[2 * i + 1], v[7]);
    }
    if (incircle_on_grid(p, &det) || incircle_with_pairs(p, &det)) return det;
    return mw__incircle_exact(a, b, c, d);
}

double mw_incircle(const double a[2], const double b[2], const double c[2], const double d[2])
{
    return mw__incircle((mw_point){a[0], a[1]}, (mw_point){b[0], b[1]}, (mw_point){c[0], c[1]},
                        (mw_point){d[0], d[1]});
}
