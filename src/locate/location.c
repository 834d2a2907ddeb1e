/* location.c - the answer about a point in a triangle that contains it: inside, edge or vertex, and
 * the weights. */
#include "locate/location.h"

#include <float.h>
#include <limits.h>

/* Compute rounded areas from the corners as seen from q, and their bounds. Returns whether they are
 * accurate enough. */
static MW_INLINE bool location_round_areas(const double x[3], const double y[3], double least,
                                           double area[3], double bound[3])
{
    bool sure = true;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t a = mw__next(k), b = mw__prev(k);
        double left = x[a] * y[b], right = y[a] * x[b];
        area[k] = left - right;
        bound[k] = mw__orient2d_bound(left, right) + least;
        sure = sure && fabs(area[k]) > bound[k];
    }
    double off = bound[0] + bound[1] + bound[2], sum = area[0] + area[1] + area[2];
    return sure && off < 0x1p-42 * sum;
}

/* The same after multiplying the corners by a power of two, where products of coordinates leave the
 * range of doubles. After that, no corner is farther than 2 from q, and what underflows is off by
 * less than 2^-1074. */
static bool location_scale_areas(const double x[3], const double y[3], double area[3])
{
    static const double UNDERFLOW_ERROR = 0x1p-1000;
    double most = 0, u[3], v[3], bound[3];
    int exponent;
    for (uint32_t k = 0; k < 3; k++) most = fmax(most, fmax(fabs(x[k]), fabs(y[k])));
    if (!(most > 0 && most < INFINITY)) return false;
    (void)frexp(most, &exponent);
    for (uint32_t k = 0; k < 3; k++) {
        u[k] = ldexp(x[k], -exponent);
        v[k] = ldexp(y[k], -exponent);
    }
    return location_round_areas(u, v, UNDERFLOW_ERROR, area, bound);
}

void mw__location_areas(const mw_point corner[3], mw_point q, double area[3])
{
    double x[3], y[3], bound[3];
    for (uint32_t k = 0; k < 3; k++) {
        x[k] = corner[k].x - q.x;
        y[k] = corner[k].y - q.y;
    }
    const bool good = location_round_areas(x, y, 0, area, bound);
    double sum = area[0] + area[1] + area[2], scaled[3];
    const bool in_range = sum > 0x1p-900 && sum < 0x1p900;
    if (MW_LIKELY(good && in_range)) return;
    if (!in_range && location_scale_areas(x, y, scaled)) {
        for (uint32_t k = 0; k < 3; k++) area[k] = scaled[k];
        return;
    }
    /* On an edge, or the triangle is so thin that rounded areas would spoil the weights. */
    for (uint32_t k = 0; k < 3; k++)
        if (!(fabs(area[k]) > bound[k] && bound[k] < 0x1p-44 * sum))
            area[k] = mw__orient2d_exact(corner[mw__next(k)], corner[mw__prev(k)], q);
}

/* Areas up to a common factor, where they would leave the range of doubles: the largest becomes
 * about 1. */
static void location_rescale_areas(const mw_point corner[3], mw_point q, double area[3])
{
    int exponent[3], most = INT_MIN;
    for (uint32_t k = 0; k < 3; k++) {
        area[k] = mw__orient2d_fraction(corner[mw__next(k)], corner[mw__prev(k)], q, &exponent[k]);
        if (area[k] != 0 && exponent[k] > most) most = exponent[k];
    }
    for (uint32_t k = 0; k < 3; k++) /* an area that is not 0 must not vanish */
        if (area[k] != 0) area[k] = fmax(ldexp(area[k], exponent[k] - most), DBL_MIN);
}

mw_location mw__location_of(const mw_point corner[3], uint32_t user, mw_point q, double area[3])
{
    double sum = area[0] + area[1] + area[2];
    if (MW_UNLIKELY(!(sum > 0x1p-900 && sum < 0x1p900))) {
        location_rescale_areas(corner, q, area);
        sum = area[0] + area[1] + area[2];
    }
    mw_location location = {
        .triangle = user & MW_USER_MASK, .hole = MW_NONE, .where = MW_INSIDE, .local = 255};
    uint32_t zeros = 0, on = 0, at = 0;
    for (uint32_t k = 0; k < 3; k++) {
        location.weight[mw__user_local_vertex(user, k)] = area[k] / sum;
        if (area[k] != 0) {
            at = k;
        } else {
            zeros++;
            on = mw__next(k); /* the edge opposite to vertex k */
        }
    }
    if (zeros == 1) {
        location.where = MW_ON_EDGE;
        location.local = (uint8_t)mw__user_local_edge(user, on);
    } else if (zeros == 2) {
        location.where = MW_ON_VERTEX;
        location.local = (uint8_t)mw__user_local_vertex(user, at);
    }
    return location;
}

mw_location mw__location_in_triangle(const mw_mesh *mesh, uint32_t triangle, mw_point q)
{
    const mw_triangle *t = &mesh->tri[mw__triangle_slot(mesh, triangle)];
    mw_point corner[3] = {mesh->point[t->v[0]], mesh->point[t->v[1]], mesh->point[t->v[2]]};
    double area[3];
    mw__location_areas(corner, q, area);
    return mw__location_of(corner, t->user, q, area);
}

const char *mw_where_name(mw_where where)
{
    static const char *const names[MW_WHERE_COUNT] = {"inside", "edge", "vertex", "outside",
                                                      "hole",   "near", "bad"};
    return (unsigned)where < MW_WHERE_COUNT ? names[where] : NULL;
}
