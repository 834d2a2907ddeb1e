/* mend_geometry.c - in space the exact tests are those of the three projections along the axes:
 * points are on one line, or equal, if and only if they are so in each of them. */
#include "mend/mend_geometry.h"
#include "predicates/predicates.h"

#include <math.h>

static mw_point mend_projected(const mw_mend_work *w, uint32_t vertex, int drop)
{
    const double *p = mw__mend_point(w, vertex);
    return drop == 2   ? (mw_point){p[0], p[1]}
           : drop == 1 ? (mw_point){p[2], p[0]}
                       : (mw_point){p[1], p[2]};
}

/* The first axis to project along; the last one is z. */
static int mend_first_axis(const mw_mend_work *w)
{
    return w->dimension == 3 ? 0 : 2;
}

bool mw__mend_finite(const mw_mend_work *w, uint32_t vertex)
{
    const double *p = mw__mend_point(w, vertex);
    return isfinite(p[0]) && isfinite(p[1]) && (w->dimension < 3 || isfinite(p[2]));
}

double mw__mend_square_distance(const mw_mend_work *w, uint32_t a, uint32_t b)
{
    const double *p = mw__mend_point(w, a), *q = mw__mend_point(w, b);
    double sum = 0;
    for (size_t k = 0; k < w->dimension; k++) sum += (p[k] - q[k]) * (p[k] - q[k]);
    return sum;
}

/* Are two vertices at the same point? */
static bool mend_equal(const mw_mend_work *w, uint32_t a, uint32_t b)
{
    const double *p = mw__mend_point(w, a), *q = mw__mend_point(w, b);
    return p[0] == q[0] && p[1] == q[1] && (w->dimension < 3 || p[2] == q[2]);
}

bool mw__mend_near(const mw_mend_work *w, uint32_t a, uint32_t b)
{
    if (mend_equal(w, a, b)) return true;
    if (w->tolerance == 0) return false;
    if (w->dimension == 3) return sqrt(mw__mend_square_distance(w, a, b)) <= w->tolerance;
    mw_point p = mend_projected(w, a, 2), q = mend_projected(w, b, 2);
    return mw__compare_distance_to(p, q, q, w->tolerance) <= 0;
}

bool mw__mend_flat(const mw_mend_work *w, const uint32_t v[3])
{
    for (int axis = mend_first_axis(w); axis < 3; axis++)
        if (mw__orient2d(mend_projected(w, v[0], axis), mend_projected(w, v[1], axis),
                         mend_projected(w, v[2], axis)) != 0)
            return false;
    return true;
}

double mw__mend_area(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t c)
{
    return mw__orient2d(mend_projected(w, a, 2), mend_projected(w, b, 2), mend_projected(w, c, 2));
}

/* Of vertices on one line: is v strictly between a and b? */
static bool mend_between(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t v)
{
    const double *p = mw__mend_point(w, a), *q = mw__mend_point(w, b), *r = mw__mend_point(w, v);
    if (mend_equal(w, a, v) || mend_equal(w, b, v)) return false;
    for (size_t k = 0; k < w->dimension; k++)
        if (r[k] < fmin(p[k], q[k]) || r[k] > fmax(p[k], q[k])) return false;
    return true;
}

/* In space, rounded: the foot of the perpendicular from v as a part of the edge, and its distance.
 */
static double mend_foot(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t v, double *distance)
{
    const double *p = mw__mend_point(w, a), *q = mw__mend_point(w, b), *r = mw__mend_point(w, v);
    double dot = 0, length = 0, off = 0;
    for (int k = 0; k < 3; k++) {
        dot += (q[k] - p[k]) * (r[k] - p[k]);
        length += (q[k] - p[k]) * (q[k] - p[k]);
    }
    double part = dot / length;
    for (int k = 0; k < 3; k++) {
        double away = r[k] - (p[k] + part * (q[k] - p[k]));
        off += away * away;
    }
    *distance = sqrt(off);
    return part;
}

bool mw__mend_inside_edge(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t v)
{
    const uint32_t line[3] = {a, b, v};
    if (w->tolerance == 0) return mend_between(w, a, b, v) && mw__mend_flat(w, line);
    if (w->dimension == 3) {
        double distance, part = mend_foot(w, a, b, v, &distance);
        return part > 0 && part < 1 && distance <= w->tolerance;
    }
    mw_point p = mend_projected(w, a, 2), q = mend_projected(w, b, 2), r = mend_projected(w, v, 2);
    return mw__dot2d(p, q, r) > 0 && mw__dot2d(q, p, r) > 0 &&
           mw__compare_distance_to(r, p, q, w->tolerance) <= 0;
}

/* The coordinate along which the edge is longest tells, without rounding. */
double mw__mend_along(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t v)
{
    const double *p = mw__mend_point(w, a), *q = mw__mend_point(w, b);
    size_t longest = 0;
    for (size_t k = 1; k < w->dimension; k++)
        if (fabs(q[k] - p[k]) > fabs(q[longest] - p[longest])) longest = k;
    double x = mw__mend_point(w, v)[longest];
    return q[longest] > p[longest] ? x : -x;
}
