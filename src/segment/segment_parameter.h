/* segment_parameter.h - where along a segment a point of it lies: parameters as doubles. Private.
 *
 * A segment ab crosses an edge pq at t = A / (A - B), where A and B are the areas (twice) of pqa
 * and pqb. They have different signs, so nothing cancels: with areas off by less than 2^-42 of
 * themselves, t is off by less than 2^-41 + 2^-50 of itself. At a vertex on the segment, t is a
 * quotient of differences of coordinates, off by less than 2^-51 of itself. */
#ifndef MW_SRC_SEGMENT_SEGMENT_PARAMETER_H
#define MW_SRC_SEGMENT_SEGMENT_PARAMETER_H

#include "predicates/predicates.h"

#define MW_PARAMETER_ERROR 0x1p-42

/* Areas between these give a quotient that neither over- nor underflows. */
#define MW_AREA_LEAST 0x1p-900
#define MW_AREA_MOST 0x1p1000

/* Twice the area of pqr, sign-exact, off by less than MW_PARAMETER_ERROR of itself; beyond the
 * normal doubles as mw__orient2d_exact. */
static MW_INLINE double mw__segment_area(mw_point p, mw_point q, mw_point r)
{
    double bound, area = mw__orient2d_rounded(p, q, r, &bound);
    return MW_LIKELY(MW_PARAMETER_ERROR * fabs(area) > bound) ? area : mw__orient2d_exact(p, q, r);
}

/* The same parameter where the areas are beyond the normal doubles. */
double mw__segment_parameter_far(mw_point p, mw_point q, mw_point a, mw_point b);

/* Where ab crosses pq. Areas from mw__segment_area, of different signs and not 0. */
static MW_INLINE double mw__segment_crossing(mw_point p, mw_point q, mw_point a, mw_point b,
                                             double area_a, double area_b)
{
    double sum = fabs(area_a) + fabs(area_b), least = fmin(fabs(area_a), fabs(area_b));
    if (MW_LIKELY(least > MW_AREA_LEAST && sum < MW_AREA_MOST)) return fabs(area_a) / sum;
    return mw__segment_parameter_far(p, q, a, b);
}

/* Where on ab the point v of it lies. a and b differ. */
double mw__segment_parameter_at(mw_point a, mw_point b, mw_point v);

#endif
