/* line.h - a line in space against edges and triangles, exactly: through a point q along a vector m. Private.
 *
 * Seen along m, everything is planar: an edge ab passes the line on one side or on the other, and the line meets a
 * triangle where it passes all its three edges on the same side. */
#ifndef MW_SRC_LINE_H
#define MW_SRC_LINE_H

#include "predicates/predicates.h"

typedef struct mw_line {
    double q[3], m[3]; /* all finite, m not zero */
} mw_line;

/* The exact stage of mw__side. */
double mw__side_exact(const mw_line *line, const double a[3], const double b[3]);

/* m . ((a - q) x (b - q)) as rounded. Its sign is sure where its magnitude is above *bound. */
static MW_INLINE double mw__side_rounded(const mw_line *line, const double a[3], const double b[3], double *bound);

/* Sign-exact. Over the sides of a triangle abc with normal n = (b - a) x (c - a) they add up to m . n: the line meets the
 * triangle where none is positive or none is negative, and not all are 0; m points at the front of it where none is
 * positive. */
static MW_INLINE double mw__side(const mw_line *line, const double a[3], const double b[3])
{
    double bound, side = mw__side_rounded(line, a, b, &bound);
    return MW_LIKELY(fabs(side) > bound) ? side : mw__side_exact(line, a, b);
}

/* m . n, n as above: < 0 where m points at the front of the triangle. Sign-exact. */
static MW_INLINE double mw__facing(const double m[3], const double a[3], const double b[3], const double c[3])
{
    mw_line line = {{a[0], a[1], a[2]}, {m[0], m[1], m[2]}};
    return mw__side(&line, b, c);
}

/* A triangle's corners, for the functions below: the line is not parallel to its plane. */
typedef const double *mw_corners[3];

/* Compare how far from q the line meets the planes of two triangles, on either side: -1 where s is nearer, 0 where they
 * are equal, 1 where t is nearer. Exact. */
int mw__compare_hits(const mw_line *line, const mw_corners s, const mw_corners t);

/* The same against the length d >= 0, which may be infinite. */
int mw__compare_hit_to(const mw_line *line, const mw_corners s, double d);

/* How far from q, along m: in units of length, negative behind q. Off by less than 2^-40 of itself; 0 only where it is 0,
 * infinite beyond the largest double. */
double mw__hit_distance(const mw_line *line, const mw_corners s);

/* Magnitudes of the three sides, each opposite to its corner, up to a common factor: exactly 0 where they are 0, off by
 * less than 2^-42 of their sum, which lies from 2^-900 to 2^900. For a triangle that the line meets. */
void mw__hit_sides(const mw_line *line, const mw_corners s, double side[3]);

#endif
