/* predicates.h - exact geometric predicates.
 *
 * Each returns a double whose *sign* is the sign of the determinant taken over the real numbers that the given doubles
 * stand for, for all finite doubles; its magnitude approximates the determinant. A filter decides nearly every call,
 * exact expansion arithmetic [Shewchuk 1997] the rest, and big integers where coordinates are out of its range, which
 * docs/guarantees.md states. With a coordinate that is NaN or infinite the result is 0. Rounding must be to nearest,
 * and tiny numbers must not be flushed to zero: both are so unless a program asks for something else. Thread-safe. */
#ifndef MESHWALK_PREDICATES_H
#define MESHWALK_PREDICATES_H

#include <meshwalk/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each argument is an array of 2 (3 for orient3d) coordinates. */

/* > 0: c lies to the left of the directed line a->b; < 0: to the right; 0: on it. Twice the signed area of abc. */
MW_API double mw_orient2d(const double a[2], const double b[2], const double c[2]);

/* > 0: d lies above the plane through a, b, c as seen from the side where a, b, c turn counter-clockwise, that is, on
 * that side; < 0: on the other; 0: in the plane. (The classic routine of the 1997 paper has the opposite sign.) */
MW_API double mw_orient3d(const double a[3], const double b[3], const double c[3], const double d[3]);

/* For a, b, c counter-clockwise: > 0: d lies inside their circle; < 0: outside; 0: on it. */
MW_API double mw_incircle(const double a[2], const double b[2], const double c[2], const double d[2]);

#ifdef __cplusplus
}
#endif
#endif
