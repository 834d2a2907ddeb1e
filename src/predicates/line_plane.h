/* line_plane.h - where a line meets a plane, each coordinate rounded once. Private. */
#ifndef MW_SRC_PREDICATES_LINE_PLANE_H
#define MW_SRC_PREDICATES_LINE_PLANE_H

#include "base/base.h"

/* The point where the line through c and q, which differ, meets the plane through a, b and e, which
 * are not collinear. The line must not be parallel to the plane. Each coordinate is the double
 * nearest to the exact one, of two as near the even one; never -0. All arguments are finite and
 * the exact point is within the range of doubles. */
void mw__line_meets_plane(const double *a, const double *b, const double *e, const double c[3],
                          const double q[3], double point[3]);

#endif
