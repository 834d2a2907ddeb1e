/* line_lanes.h - what line.h and line.c say of a line and a triangle, in vectors of four doubles:
 * three edges side by side, or three axes; the fourth lane is 0. Private.
 *
 * Operations have the order that they have there, so the numbers are the same to the last bit. For
 * functions with AVX2 only: two halves of a vector take longer than single numbers. */
#ifndef MW_SRC_PREDICATES_LINE_LANES_H
#define MW_SRC_PREDICATES_LINE_LANES_H

#include "predicates/line.h"

typedef double mw_lanes __attribute__((vector_size(32)));
typedef int64_t mw_lanes_mask __attribute__((vector_size(32))); /* 0 or all bits */

#define MW_LANES_MAGNITUDE(a) ((mw_lanes)((mw_lanes_mask)(a)&INT64_MAX))
/* Of each lane the next of three, or the one after that. */
#define MW_LANES_NEXT(a) __builtin_shufflevector(a, a, 1, 2, 0, 3)
#define MW_LANES_PREV(a) __builtin_shufflevector(a, a, 2, 0, 1, 3)
#define MW_LANES_POINT(p) ((mw_lanes){(p)[0], (p)[1], (p)[2], 0})

/* The lanes where a is greater than b, as bits. */
typedef uint32_t mw_lanes_above(const mw_lanes *a, const mw_lanes *b);

#ifdef __x86_64__

#include <immintrin.h>

__attribute__((target("avx2"))) static inline uint32_t mw__lanes_above_avx2(const mw_lanes *a,
                                                                            const mw_lanes *b)
{
    return (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd((__m256d)*a, (__m256d)*b, _CMP_GT_OQ));
}

#endif

/* --- sides --- */

/* mw__side_rounded of the edges that begin at each corner, as seen from q, axis by axis. `more` is
 * the mw__side_underflow of m. */
static MW_INLINE void mw__lanes_sides(const double m[3], const mw_lanes from[3], double more,
                                      mw_lanes *side, mw_lanes *bound)
{
    mw_lanes ax = from[0], ay = from[1], az = from[2];
    mw_lanes bx = MW_LANES_NEXT(ax), by = MW_LANES_NEXT(ay), bz = MW_LANES_NEXT(az);
    mw_lanes yz = ay * bz, zy = az * by, zx = az * bx, xz = ax * bz, xy = ax * by, yx = ay * bx;
    mw_lanes permanent = fabs(m[0]) * (MW_LANES_MAGNITUDE(yz) + MW_LANES_MAGNITUDE(zy)) +
                         fabs(m[1]) * (MW_LANES_MAGNITUDE(zx) + MW_LANES_MAGNITUDE(xz)) +
                         fabs(m[2]) * (MW_LANES_MAGNITUDE(xy) + MW_LANES_MAGNITUDE(yx));
    *bound = MW_SIDE_ERROR * permanent + more;
    *side = m[0] * (yz - zy) + m[1] * (zx - xz) + m[2] * (xy - yx);
}

/* Axis k of the corners. */
#define MW_LANES_AXIS(s, k) ((mw_lanes){(s)[0][k], (s)[1][k], (s)[2][k], 0})

/* mw__estimate_sides: *side and *bound. */
static MW_INLINE void mw__lanes_estimate(const mw_line *line, const mw_corners s, double more,
                                         mw_lanes *side, mw_lanes *bound)
{
    const double *q = line->q;
    mw_lanes from[3] = {MW_LANES_AXIS(s, 0) - q[0], MW_LANES_AXIS(s, 1) - q[1],
                        MW_LANES_AXIS(s, 2) - q[2]};
    mw__lanes_sides(line->m, from, more, side, bound);
}

/* --- the plane of a triangle --- */

#define MW_LANES_SUM(v) ((v)[0] + (v)[1] + (v)[2])

/* mw_line_plane; `more` as above. */
static MW_INLINE void mw__lanes_plane(const mw_line *line, const mw_corners s, double more,
                                      mw_line_plane *e)
{
    mw_lanes a = MW_LANES_POINT(s[0]), u = MW_LANES_POINT(s[1]) - a, v = MW_LANES_POINT(s[2]) - a,
             q = a - MW_LANES_POINT(line->q), m = MW_LANES_POINT(line->m);
    mw_lanes left = MW_LANES_NEXT(u) * MW_LANES_PREV(v),
             right = MW_LANES_PREV(u) * MW_LANES_NEXT(v), normal = left - right,
             size = MW_LANES_MAGNITUDE(left) + MW_LANES_MAGNITUDE(right);
    mw_lanes n = q * normal, mn = m * normal, n_size = MW_LANES_MAGNITUDE(q) * size,
             m_size = MW_LANES_MAGNITUDE(m) * size;
    double far[3] = {q[0], q[1], q[2]};
    e->n = MW_LANES_SUM(n);
    e->m = MW_LANES_SUM(mn);
    e->n_bound = MW_SIDE_ERROR * MW_LANES_SUM(n_size) + mw__side_underflow(far);
    e->m_bound = MW_SIDE_ERROR * MW_LANES_SUM(m_size) + more;
}

/* --- sides seen from near by --- */

static MW_INLINE void mw__lanes_two_sum(const mw_lanes *a, const mw_lanes *b, mw_lanes *sum,
                                        mw_lanes *tail)
{
    *sum = *a + *b;
    mw_lanes b_part = *sum - *a, a_part = *sum - b_part;
    *tail = (*a - a_part) + (*b - b_part);
}

static MW_INLINE void mw__lanes_split(const mw_lanes *a, mw_lanes *high, mw_lanes *low)
{
    mw_lanes c = 0x1.0000002p27 * *a;
    *high = c - (c - *a);
    *low = *a - *high;
}

static MW_INLINE void mw__lanes_two_product(const mw_lanes *a, const mw_lanes *b, mw_lanes *product,
                                            mw_lanes *tail)
{
    mw_lanes a_high, a_low, b_high, b_low;
    mw__lanes_split(a, &a_high, &a_low);
    mw__lanes_split(b, &b_high, &b_low);
    *product = *a * *b;
    mw_lanes rest = ((*product - a_high * b_high) - a_low * b_high) - a_high * b_low;
    *tail = a_low * b_low - rest;
}

/* A vector to each corner from the point p of the line near the triangle, axis by axis. From q they
 * would be much longer than the triangle, and the sides small differences of large products. p = q
 * + t (m + tail) + off, where t is a rounded N / M and `off` is what rounding leaves; corners are p
 * + head + tail. So each coordinate below is off by 2u of itself, and by 2^-100 of the largest
 * coordinate. */
static MW_INLINE void mw__lanes_from_line(const mw_line *line, const mw_corners s, double t,
                                          mw_lanes from[3])
{
    mw_lanes p, off, product, product_tail, along = {t, t, t, 0}, m = MW_LANES_POINT(line->m),
                                            q = MW_LANES_POINT(line->q);
    mw__lanes_two_product(&along, &m, &product, &product_tail);
    mw__lanes_two_sum(&q, &product, &p, &off);
    off = off + (product_tail + along * MW_LANES_POINT(line->tail));
    for (int k = 0; k < 3; k++) {
        mw_lanes corner = MW_LANES_AXIS(s, k), head, tail, back = {-p[k], -p[k], -p[k], 0},
                 less = {off[k], off[k], off[k], 0};
        mw__lanes_two_sum(&corner, &back, &head, &tail);
        from[k] = head + (tail - less);
    }
}

/* The largest of three lanes, none of which is negative. */
static MW_INLINE double mw__lanes_largest(const mw_lanes *a)
{
    double x = (*a)[0], y = (*a)[1], z = (*a)[2];
    x = y > x ? y : x;
    return z > x ? z : x;
}

/* Magnitudes of the sides from there, *side, in the order of the edges. Returns a bound of their
 * errors: that of mw__side_rounded is about doubled by 2u for each coordinate, and q adds
 * MW_SIDE_FAR_ERROR of the coordinates. */
static MW_INLINE double mw__lanes_near_sides(const mw_line *line, const mw_corners s, double t,
                                             double more, mw_lanes *side)
{
    mw_lanes from[3], bound, extent = {0}, farthest = MW_LANES_MAGNITUDE(MW_LANES_POINT(line->q));
    const double *m = line->m;
    mw__lanes_from_line(line, s, t, from);
    mw__lanes_sides(m, from, more, side, &bound);
    for (int k = 0; k < 3; k++) {
        mw_lanes corner = MW_LANES_AXIS(s, k);
        extent += MW_LANES_MAGNITUDE(from[k]);
        farthest += MW_LANES_MAGNITUDE(corner);
    }
    *side = MW_LANES_MAGNITUDE(*side);
    double length = fabs(m[0]) + fabs(m[1]) + fabs(m[2]);
    return 2 * mw__lanes_largest(&bound) +
           length * MW_LANES_SUM(extent) * MW_LANES_SUM(farthest) * MW_SIDE_FAR_ERROR;
}

/* mw__hit_sides_noted of a line that surely passes inside, if it is far from the triangle, and
 * doubles are enough. Returns whether that is so. */
static MW_INLINE bool mw__lanes_weights(const mw_line *line, const mw_corners s, double more,
                                        const mw_line_estimate *e, double side[3])
{
    double sum = 0, most = 0;
    bool sure = true;
    mw_lanes near;
    for (int k = 0; k < 3; k++) {
        sure = sure && fabs(e->side[k]) > e->bound[k];
        most = e->bound[k] > most ? e->bound[k] : most;
        sum += fabs(e->side[k]);
    }
    if (!sure || !(most > MW_WEIGHT_FINE * sum)) return false;
    most = mw__lanes_near_sides(line, s, e->n / e->m, more, &near);
    for (int k = 0; k < 3; k++) side[k] = near[k == 2 ? 0 : k + 1];
    sum = side[0] + side[1] + side[2];
    return most <= MW_WEIGHT_FINE * sum && sum >= MW_WEIGHT_NEAR_LEAST &&
           sum <= MW_WEIGHT_NEAR_MOST;
}

#endif
