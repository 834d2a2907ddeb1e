/* measure.c - areas in the plane and on the sphere. */
#include "overlap/measure.h"

#include "segment/segment_parameter.h"

#define MEASURE_DEGREE 0x1.1df46a2529d39p-6 /* pi / 180 */

/* sin a - sin b, with a relative error of a few units in the last place. */
static double measure_sine_difference(double a, double b)
{
    return 2 * cos((a + b) / 2) * sin((a - b) / 2);
}

/* 1 - sin(x) / x. Below 1/8 by its series, whose first omitted term is less than 2^-53 of the first
 * one. */
static double measure_sinc_rest(double x)
{
    double s = x * x;
    if (fabs(x) > 0.125) return 1 - sin(x) / x;
    return s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110 * (1 - s / 156)))));
}

/* Points are in radians, relative to a point whose latitude is `y`. */
static double measure_chain(const mw_point *point, uint32_t n, double y)
{
    double sum = 0;
    for (uint32_t i = 0; i < n; i++) {
        mw_point a = point[i], b = point[i + 1 == n ? 0 : i + 1];
        double middle = y + (a.y + b.y) / 2;
        double mean =
            measure_sine_difference(middle, y) - sin(middle) * measure_sinc_rest((b.y - a.y) / 2);
        sum -= (b.x - a.x) * mean;
    }
    return fmax(sum, 0);
}

double mw__measure_triangle(const mw_point p[3], bool degrees)
{
    mw_point from[3];
    if (!degrees) return mw__segment_area(p[0], p[1], p[2]) / 2;
    for (int k = 0; k < 3; k++)
        from[k] =
            (mw_point){(p[k].x - p[0].x) * MEASURE_DEGREE, (p[k].y - p[0].y) * MEASURE_DEGREE};
    return measure_chain(from, 3, p[0].y * MEASURE_DEGREE);
}

double mw__measure_box(double west, double south, double east, double north, bool degrees)
{
    if (!degrees) return (east - west) * (north - south);
    return (east - west) * MEASURE_DEGREE *
           measure_sine_difference(north * MEASURE_DEGREE, south * MEASURE_DEGREE);
}

double mw__measure_clip(const mw_clip *clip, const mw_point p[3], const mw_point frame[3],
                        double plane, bool degrees)
{
    mw_point at[MW_CLIP_SIDES + 3];
    if (!degrees) return plane;
    bool by_p = clip->double_p <= clip->double_q;
    const mw_point *of = by_p ? p : frame;
    for (uint32_t i = 0; i < clip->count; i++) {
        const double *w = by_p ? clip->corner[i].p : clip->corner[i].q;
        at[i] =
            (mw_point){(w[1] * (of[1].x - of[0].x) + w[2] * (of[2].x - of[0].x)) * MEASURE_DEGREE,
                       (w[1] * (of[1].y - of[0].y) + w[2] * (of[2].y - of[0].y)) * MEASURE_DEGREE};
    }
    return measure_chain(at, clip->count, of[0].y * MEASURE_DEGREE);
}
