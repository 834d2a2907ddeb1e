/* segment_parameter.c - parameters where doubles would over- or underflow, and at vertices. */
#include "segment/segment_parameter.h"

double mw__segment_parameter_far(mw_point p, mw_point q, mw_point a, mw_point b)
{
    int of_a, of_b;
    double area_a = fabs(mw__orient2d_fraction(p, q, a, &of_a)),
           area_b = fabs(mw__orient2d_fraction(p, q, b, &of_b));
    if (of_a >= of_b) return area_a / (area_a + ldexp(area_b, of_b - of_a));
    /* A quotient first: it may be less than the normal doubles, and its terms need not be. */
    double sum = ldexp(area_a, of_a - of_b) + area_b;
    return ldexp(area_a / sum, of_a - of_b);
}

double mw__segment_parameter_at(mw_point a, mw_point b, mw_point v)
{
    double x = b.x - a.x, y = b.y - a.y;
    if (MW_LIKELY(fabs(x) < DBL_MAX && fabs(y) < DBL_MAX))
        return fabs(x) >= fabs(y) ? (v.x - a.x) / x : (v.y - a.y) / y;
    return fabs(x) >= fabs(y) ? (v.x / 2 - a.x / 2) / (b.x / 2 - a.x / 2)
                              : (v.y / 2 - a.y / 2) / (b.y / 2 - a.y / 2);
}
