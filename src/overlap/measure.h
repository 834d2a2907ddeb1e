/* measure.h - areas of triangles, pixels and common parts, in the plane or on the unit sphere.
 * Private.
 *
 * On the sphere x is a longitude and y a latitude in degrees, and edges are straight in these. The
 * area to the left of a closed chain is then the sum over its edges of -dx times the mean of sin y
 * on the edge, in closed form; less sin y at a point near it, so that small areas are not
 * differences of large ones. */
#ifndef MW_SRC_OVERLAP_MEASURE_H
#define MW_SRC_OVERLAP_MEASURE_H

#include "clip/clip.h"

double mw__measure_triangle(const mw_point p[3], bool degrees);
double mw__measure_box(double west, double south, double east, double north, bool degrees);

/* Of the part that p and the polygon with corners q0, q1 and the last one (frame) have in common;
 * `plane` is its area in the plane. */
double mw__measure_clip(const mw_clip *clip, const mw_point p[3], const mw_point frame[3],
                        double plane, bool degrees);

#endif
