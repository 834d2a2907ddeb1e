/**
 * @file predicates.h
 * Exact geometric predicates.
 *
 * Each function returns a double. Its sign is the sign of the determinant over the real numbers
 * that the given doubles represent, for all finite doubles. Its magnitude approximates the
 * determinant. If a coordinate is NaN or infinite, the result is 0.
 *
 * A floating-point filter decides nearly every call. Exact expansion arithmetic decides the others
 * [Shewchuk 1997]; big integers decide if coordinates leave the range of expansions
 * (docs/promises.md states it).
 *
 * The rounding mode must be to nearest, and subnormal numbers must not be flushed to zero; both
 * hold unless a program changes them.
 */
#ifndef MESHWALK_PREDICATES_H
#define MESHWALK_PREDICATES_H

#include <meshwalk/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Decide on which side of a directed line a point lies [Shewchuk 1997].
 *
 * @param a, b  two points of the line: x, y
 * @param c     the point to test: x, y
 * @return positive if c lies to the left of the line from a to b, negative if to the right, 0 if on
 *         the line. The magnitude approximates twice the area of the triangle a b c.
 *
 * Thread-safe. No allocation. O(1).
 */
MW_API double mw_orient2d(const double a[2], const double b[2], const double c[2]);

/**
 * Decide on which side of a plane a point lies [Shewchuk 1997].
 *
 * @param a, b, c  three points of the plane: x, y, z
 * @param d        the point to test: x, y, z
 * @return positive if d lies on the side from which a, b, c appear counter-clockwise, negative if
 *         on the other side, 0 if in the plane. Shewchuk's orient3d has the opposite sign.
 *
 * Thread-safe. No allocation. O(1).
 */
MW_API double mw_orient3d(const double a[3], const double b[3], const double c[3],
                          const double d[3]);

/**
 * Decide whether a point lies inside a circle [Shewchuk 1997].
 *
 * @param a, b, c  three points of the circle, counter-clockwise: x, y
 * @param d        the point to test: x, y
 * @return positive if d lies inside the circle, negative if outside, 0 if on it. For clockwise
 *         a, b, c the sign is reversed.
 *
 * Thread-safe. No allocation. O(1).
 */
MW_API double mw_incircle(const double a[2], const double b[2], const double c[2],
                          const double d[2]);

#ifdef __cplusplus
}
#endif
#endif
