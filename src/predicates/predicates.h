/* predicates.h - exact predicates on internal points: inline filters, exact stages out of line. Private. */
#ifndef MW_SRC_PREDICATES_H
#define MW_SRC_PREDICATES_H

#include "base/base.h"

#include <math.h>
#include <meshwalk/predicates.h>

typedef struct mw_point {
    double x, y;
} mw_point;

/* orient2d when the filter could not decide. */
double mw__orient2d_exact(mw_point a, mw_point b, mw_point c);
/* incircle when the filter could not decide. */
double mw__incircle_exact(mw_point a, mw_point b, mw_point c, mw_point d);

/* Plain doubles: the determinant as rounded. */
static MW_INLINE double mw__orient2d_double(mw_point a, mw_point b, mw_point c)
{
    return (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
}

/* Sign-exact. The filter [Shewchuk 1997, sec. 4.1, stage A]: the rounded determinant of the rounded differences is off
 * by at most (3 + 16 eps) eps (|left| + |right|), eps = 2^-53; ABSOLUTE covers products that underflow. Infinite and
 * NaN values compare false and go to the exact stage. */
#define MW_ORIENT2D_ERROR (3.0 + 16.0 * 0x1p-53) * 0x1p-53
#define MW_ORIENT2D_ABSOLUTE 0x1p-960
static MW_INLINE double mw__orient2d(mw_point a, mw_point b, mw_point c)
{
    double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), det = left - right;
    double bound = MW_ORIENT2D_ERROR * (fabs(left) + fabs(right)) + MW_ORIENT2D_ABSOLUTE;
    if (MW_LIKELY(fabs(det) > bound)) return det;
    return mw__orient2d_exact(a, b, c);
}

/* Sign-exact incircle; defined in incircle.c with its filter. */
double mw__incircle(mw_point a, mw_point b, mw_point c, mw_point d);

#endif
