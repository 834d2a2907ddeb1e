/* measure.h - areas of triangles, pixels and common parts, in the plane or on the unit sphere.
 * Private.
 *
 * On the sphere x is a longitude and y a latitude in degrees, and edges are straight in longitude
 * and latitude. The area to the left of a closed chain is the sum over its edges of -dx times the
 * mean of sin y on the edge, which has a closed form. From each mean, sin y at a nearby point is
 * subtracted, so that small areas are not differences of large numbers. */
#ifndef MW_SRC_OVERLAP_MEASURE_H
#define MW_SRC_OVERLAP_MEASURE_H

#include "clip/clip.h"

double mw__measure_triangle(const mw_point p[3], bool degrees);
double mw__measure_box(double west, double south, double east, double north, bool degrees);

/* The area of the common part of p and the polygon whose frame is q0, q1 and its last corner;
 * `plane` is its area in the plane. */
double mw__measure_clip(const mw_clip *clip, const mw_point p[3], const mw_point frame[3],
                        double plane, bool degrees);

#endif
