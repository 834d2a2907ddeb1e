/* line.h - a line in space against edges and triangles, exactly: through a point q along a vector
 * m, or through two points. Private.
 *
 * Seen along m, everything is planar: an edge ab passes the line on one side or on the other, and
 * the line meets a triangle where it passes all its three edges on the same side. */
#ifndef MW_SRC_PREDICATES_LINE_H
#define MW_SRC_PREDICATES_LINE_H

#include "predicates/predicates.h"

/* The vector is m + tail: a vector between two points may take two doubles a coordinate. All are
 * finite, m is not zero, and each coordinate of m is the sum of its two doubles, rounded. */
typedef struct mw_line {
    double q[3], m[3], tail[3];
} mw_line;

/* The line from q to r, at t = 0 and t = 1. False if a difference of coordinates overflows, or the
 * points are equal. */
bool mw__line_through(const double q[3], const double r[3], mw_line *line);

/* The exact stage of mw__side: 0 with a coordinate that is not finite. */
double mw__side_exact(const mw_line *line, const double a[3], const double b[3]);

/* Bound for m . ((a - q) x (b - q)) in terms of its permanent. A minor is off by (4u + 4u^2 + ...)
 * P, as in orient3d; m is off by u |m| without its tail, so the product with it, rounded, is off by
 * (6u + 14u^2 + ...) |m| P, which is (6u + 26u^2 + ...) of its computed permanent. The first sum
 * adds u and a factor 1 + u: 7u + 32u^2; the sum of the permanents and the last rounding make it 7u
 * + 46u^2 + .... (7u + 64u^2)(1 - u)^2 is more. Underflow: an error of 2^-1075 in each of six
 * products is multiplied by a coordinate of m, and 2^-1075 added; with the sum of m below 2^100
 * that is less than 2^-970. */
#define MW_SIDE_ERROR ((7.0 + 64.0 * 0x1p-53) * 0x1p-53)
#define MW_SIDE_MOTION 0x1p100

/* m . ((a - q) x (b - q)) as rounded. Its sign is sure where its magnitude is above *bound. */
static MW_INLINE double mw__side_rounded(const mw_line *line, const double a[3], const double b[3],
                                         double *bound)
{
    const double *q = line->q, *m = line->m;
    double ax = a[0] - q[0], ay = a[1] - q[1], az = a[2] - q[2];
    double bx = b[0] - q[0], by = b[1] - q[1], bz = b[2] - q[2];
    double yz = ay * bz, zy = az * by, zx = az * bx, xz = ax * bz, xy = ax * by, yx = ay * bx;
    double permanent = fabs(m[0]) * (fabs(yz) + fabs(zy)) + fabs(m[1]) * (fabs(zx) + fabs(xz)) +
                       fabs(m[2]) * (fabs(xy) + fabs(yx));
    bool small = fabs(m[0]) + fabs(m[1]) + fabs(m[2]) < MW_SIDE_MOTION;
    *bound = small ? MW_SIDE_ERROR * permanent + MW_UNDERFLOW_ERROR : INFINITY;
    return m[0] * (yz - zy) + m[1] * (zx - xz) + m[2] * (xy - yx);
}

/* Sign-exact. Over the sides of a triangle abc with normal n = (b - a) x (c - a) they add up to m .
 * n: the line meets the triangle where none is positive or none is negative, and not all are 0; m
 * points at the front of it where none is positive. */
static MW_INLINE double mw__side(const mw_line *line, const double a[3], const double b[3])
{
    double bound, side = mw__side_rounded(line, a, b, &bound);
    return MW_LIKELY(fabs(side) > bound) ? side : mw__side_exact(line, a, b);
}

/* m . n, n as above: < 0 where m points at the front of the triangle. Sign-exact. */
static MW_INLINE double mw__facing(const double m[3], const double a[3], const double b[3],
                                   const double c[3])
{
    mw_line line = {{a[0], a[1], a[2]}, {m[0], m[1], m[2]}, {0}};
    return mw__side(&line, b, c);
}

/* A triangle's corners, for the functions below: the line is not parallel to its plane. */
typedef const double *mw_corners[3];

/* Compare how far from q the line meets the planes of two triangles, on either side: -1 where s is
 * nearer, 0 where they are equal, 1 where t is nearer. Exact. */
int mw__compare_hits(const mw_line *line, const mw_corners s, const mw_corners t);

/* The same against the length d >= 0, which may be infinite. */
int mw__compare_hit_to(const mw_line *line, const mw_corners s, double d);

/* How far from q, along m: in units of length, negative behind q. The relative error is below
 * 2^-40. The result is 0 only if the exact value is; below the normal doubles at least its sign is
 * right, and beyond the largest double it is infinite. */
double mw__hit_distance(const mw_line *line, const mw_corners s);

/* What doubles say of a line and a triangle, kept so that it is not computed again. */
typedef struct mw_line_estimate {
    double side[3], bound[3]; /* mw__side_rounded of the edge that begins at corner k */
    double n, m;              /* t = n / m: where the plane is met; not exact */
} mw_line_estimate;

static MW_INLINE void mw__estimate_sides(const mw_line *line, const mw_corners s,
                                         mw_line_estimate *e)
{
    for (int k = 0; k < 3; k++)
        e->side[k] = mw__side_rounded(line, s[k], s[k == 2 ? 0 : k + 1], &e->bound[k]);
}

/* The plane of a triangle, with normal n = (b - a) x (c - a): N = (a - q) . n and M = m . n. Each
 * is as mw__side_rounded of another vector: a - q may be a rounded difference, like m. */
typedef struct mw_line_plane {
    double n, m, n_bound, m_bound;
} mw_line_plane;

/* What MW_SIDE_ERROR leaves out: underflow, and vectors m too large for it. */
static MW_INLINE double mw__side_underflow(const double m[3])
{
    bool small = fabs(m[0]) + fabs(m[1]) + fabs(m[2]) < MW_SIDE_MOTION;
    return small ? MW_UNDERFLOW_ERROR : INFINITY;
}

/* An estimate is good enough for a distance where its bound is no more than this part of it: N, M
 * and |m| are then off by less than 2^-43 together. */
#define MW_PLANE_FINE 0x1p-45
/* A side whose sign is sure is good enough for weights where its bound is no more than this part of
 * their sum. */
#define MW_WEIGHT_FINE 0x1p-44
/* From here to there no product of two coordinates of interest over- or underflows. */
#define MW_WEIGHT_NEAR_LEAST 0x1p-200
#define MW_WEIGHT_NEAR_MOST 0x1p200
/* Of a side that is computed from near by, as part of the coordinates (line.c). */
#define MW_SIDE_FAR_ERROR 0x1p-96

/* Products and quotients of a few such magnitudes, and squares of the largest of a vector, are
 * normal doubles. */
static MW_INLINE bool mw__is_ordinary(double x)
{
    return fabs(x) > 0x1p-200 && fabs(x) < 0x1p200;
}

/* mw__hit_distance by the plane, which it notes. Powers of two change no digit: ordinary numbers
 * need none. */
double mw__hit_distance_slow(const mw_line *line, const mw_corners s, const mw_line_plane *plane,
                             bool fine);

static MW_INLINE double mw__hit_distance_by(const mw_line *line, const mw_corners s,
                                            const mw_line_plane *plane, mw_line_estimate *e)
{
    double n = e->n = plane->n, m = e->m = plane->m;
    bool fine =
        MW_PLANE_FINE * fabs(n) > plane->n_bound && MW_PLANE_FINE * fabs(m) > plane->m_bound;
    const double *v = line->m;
    double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (MW_LIKELY(fine && mw__is_ordinary(n) && mw__is_ordinary(m) && mw__is_ordinary(square)))
        return n * sqrt(square) / m;
    return mw__hit_distance_slow(line, s, plane, fine);
}

/* mw__hit_distance; notes n and m. */
double mw__hit_distance_noted(const mw_line *line, const mw_corners s, mw_line_estimate *e);

/* Magnitudes of the three sides, each opposite to its corner, up to a common factor: exactly 0
 * where they are 0, off by less than 2^-42 of their sum, which lies from 2^-900 to 2^900. For a
 * triangle that the line meets. */
void mw__hit_sides(const mw_line *line, const mw_corners s, double side[3]);
/* The same by a full estimate. */
void mw__hit_sides_noted(const mw_line *line, const mw_corners s, const mw_line_estimate *e,
                         double side[3]);

/* Does the line meet the triangle strictly inside, with m pointing at its front? Returns true if
 * doubles are enough to be sure and to give the weights; then side[] is that of mw__hit_sides.
 * False means nothing: ask the exact functions. */
bool mw__hit_inside(const mw_line *line, const mw_corners s, double side[3]);

#endif
