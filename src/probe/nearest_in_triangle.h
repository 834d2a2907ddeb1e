/* nearest_in_triangle.h - the point of a triangle nearest to a point. Private. */
#ifndef MW_SRC_PROBE_NEAREST_IN_TRIANGLE_H
#define MW_SRC_PROBE_NEAREST_IN_TRIANGLE_H

#include "probe/prober.h"

/* The distance of q from the box of a triangle, rounded. */
double mw__distance_to_corners_box(const mw_corners corner, const double q[3]);

/* The nearest point of a triangle, without the triangle's number. `least` is the distance of the
 * box, which the rounded distance is not less than. */
mw_nearest_surface_point mw__nearest_in_triangle(const mw_corners corner, const double q[3],
                                                 double least);

/* Is the rounded distance of q from a triangle certainly greater than `than`? */
bool mw__triangle_is_farther(const mw_corners corner, const double q[3], double than);

/* The distance of q from a triangle that has an area and finite corners, rounded as that of
 * mw_nearest_on_surface. q is finite. */
double mw__distance_to_triangle(const mw_surface *surface, uint32_t triangle, const double q[3]);

#endif
