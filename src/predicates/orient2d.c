/* orient2d.c - the exact stage of the predicates that are two products of differences: orient2d and
 * dot2d. */
#include "predicates/big.h"
#include "predicates/expansion.h"

/* Expansions are exact for nonzero coordinates of magnitude 2^-485 to 2^509. Below: differences are
 * multiples of the lowest bit, 2^(-485 - 52), and their products of 2^-1074, the lowest bit of a
 * double. Above: differences are at most 2^510, the two products together 2^1021. */
#define LOW 0x1p-485
#define HIGH 0x1p509

/* (v0 - v1)(v2 - v3) - (v4 - v5)(v6 - v7) */
static double orient2d_with_expansions(const double v[8])
{
    double room[8 + MW_CROSS_ROOM];
    mw_arena arena = {room};
    mw_expansion difference[4];
    for (int i = 0; i < 4; i++)
        difference[i] = mw__expansion_difference(&arena, v[2 * i], v[2 * i + 1]);
    return mw__expansion_estimate(
        mw__expansion_cross(&arena, difference[0], difference[2], difference[3], difference[1]));
}

/* The same, where differences are exact and their products not far from 1: points that are near one
 * another, as seen from the origin, which is most of those that a filter leaves open. */
static bool orient2d_with_doubles(const double v[8], double *det)
{
    double d[4];
    bool exact = true;
    for (int i = 0; i < 4; i++)
        exact = mw__difference_is_exact(v[2 * i], v[2 * i + 1], &d[i]) && exact;
    return exact && mw__double_cross(d, det);
}

/* In the range of expansions. */
static double orient2d_within(const double v[8])
{
    double det;
    return orient2d_with_doubles(v, &det) ? det : orient2d_with_expansions(v);
}

/* det 2^-exponent; where that is not 0 and no normal double, +-DBL_MAX or +-DBL_MIN. */
static double orient2d_scaled_back(double det, int exponent)
{
    double value = ldexp(det, -exponent), magnitude = fabs(value);
    if (det == 0 || (magnitude >= DBL_MIN && magnitude <= DBL_MAX)) return value;
    return copysign(magnitude > DBL_MAX ? DBL_MAX : DBL_MIN, det);
}

/* The same over 2^(2 base), returned. */
static int orient2d_with_integers(const double v[8], mw_big *result)
{
    mw_big difference[4];
    int base = mw__big_base(v, 8);
    for (int i = 0; i < 4; i++) mw__big_difference(&difference[i], v[2 * i], v[2 * i + 1], base);
    mw__big_cross(result, &difference[0], &difference[2], &difference[3], &difference[1]);
    return base;
}

static double orient2d_exact(const double v[8])
{
    double scaled[8];
    int shift;
    if (MW_LIKELY(mw__within(v, 8, LOW, HIGH))) return orient2d_within(v);
    if (mw__scale_within(v, 8, LOW, scaled, &shift))
        return orient2d_scaled_back(orient2d_within(scaled), 2 * shift);
    if (!mw__all_finite(v, 8)) return 0;
    mw_big result;
    int base = orient2d_with_integers(v, &result);
    return mw__big_double(&result, 2 * base);
}

double mw__orient2d_exact(mw_point a, mw_point b, mw_point c)
{
    if ((a.x == c.x && a.y == c.y) || (b.x == c.x && b.y == c.y)) return 0; /* c is a vertex */
    return orient2d_exact((const double[8]){a.x, c.x, b.y, c.y, a.y, c.y, b.x, c.x});
}

double mw__orient2d_fraction(mw_point a, mw_point b, mw_point c, int *exponent)
{
    const double v[8] = {a.x, c.x, b.y, c.y, a.y, c.y, b.x, c.x};
    double scaled[8];
    int shift;
    if (mw__scale_within(v, 8, LOW, scaled, &shift)) {
        double det = frexp(orient2d_within(scaled), exponent);
        *exponent -= 2 * shift;
        return det;
    }
    mw_big result;
    int base = orient2d_with_integers(v, &result);
    double fraction = mw__big_fraction(&result, exponent);
    *exponent += 2 * base;
    return fraction;
}

double mw__dot2d_exact(mw_point a, mw_point b, mw_point c)
{
    return orient2d_exact((const double[8]){b.x, a.x, c.x, a.x, a.y, b.y, c.y, a.y});
}

double mw_orient2d(const double a[2], const double b[2], const double c[2])
{
    return mw__orient2d((mw_point){a[0], a[1]}, (mw_point){b[0], b[1]}, (mw_point){c[0], c[1]});
}
