/* location_oracle.c - brute force over all triangles in exact rationals. */
#include "oracle/location_oracle.h"

#include <gmp.h>
#include <math.h>
#include <meshwalk/meshwalk.h>

int location_oracle_orient(const double a[2], const double b[2], const double c[2])
{
    mpq_t v[6], left, right;
    const double *from[6] = {&a[0], &a[1], &b[0], &b[1], &c[0], &c[1]};
    for (int i = 0; i < 6; i++) {
        mpq_init(v[i]);
        mpq_set_d(v[i], *from[i]);
    }
    mpq_init(left);
    mpq_init(right);
    for (int i = 0; i < 4; i++) mpq_sub(v[i], v[i], v[4 + i % 2]);
    mpq_mul(left, v[0], v[3]);
    mpq_mul(right, v[1], v[2]);
    int sign = mpq_cmp(left, right);
    for (int i = 0; i < 6; i++) mpq_clear(v[i]);
    mpq_clear(left);
    mpq_clear(right);
    return (sign > 0) - (sign < 0);
}

bool location_oracle_contains(const double *points, const uint32_t *t, const double q[2],
                              location_answer *answer)
{
    const double *p[3] = {points + 2 * (size_t)t[0], points + 2 * (size_t)t[1],
                          points + 2 * (size_t)t[2]};
    int turn = location_oracle_orient(p[0], p[1], p[2]), zeros = 0, edge = 0, off = 0;
    if (turn == 0) return false;
    for (int k = 0; k < 3; k++) {
        int side = location_oracle_orient(p[k], p[(k + 1) % 3], q) * turn;
        if (side < 0) return false;
        if (side == 0) {
            zeros++;
            edge = k;
        } else {
            off = k;
        }
    }
    answer->where = zeros == 0 ? MW_INSIDE : zeros == 1 ? MW_ON_EDGE : MW_ON_VERTEX;
    answer->local = (uint8_t)(zeros == 0 ? 255 : zeros == 1 ? edge : (off + 2) % 3);
    return true;
}

location_answer location_oracle_locate(const double *points, const uint32_t *triangles,
                                       uint32_t count, const double q[2])
{
    location_answer answer = {MW_NONE, MW_OUTSIDE, 255};
    if (!isfinite(q[0]) || !isfinite(q[1])) return (location_answer){MW_NONE, MW_BAD, 255};
    for (uint32_t t = 0; t < count; t++)
        if (location_oracle_contains(points, triangles + 3 * (size_t)t, q, &answer)) {
            answer.triangle = t;
            break;
        }
    return answer;
}

/* --- polygons --- */

static bool between(double a, double b, double x)
{
    return (a <= x && x <= b) || (b <= x && x <= a);
}

static const double *segment_end(const mw_constraints *rings, size_t segment, unsigned end)
{
    return rings->points + 2 * (size_t)rings->segments[2 * segment + end];
}

static bool points_same(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

static bool segment_has(const double *a, const double *b, const double *q)
{
    return between(a[0], b[0], q[0]) && between(a[1], b[1], q[1]) &&
           location_oracle_orient(a, b, q) == 0;
}

/* Does the ray from q to the right cross the segment? One that ends on the ray's line counts where
 * its other end is below. */
static bool ray_crosses(const double *a, const double *b, const double *q)
{
    if ((a[1] > q[1]) == (b[1] > q[1])) return false;
    int side = location_oracle_orient(a, b, q);
    return b[1] > a[1] ? side > 0 : side < 0;
}

polygon_side location_oracle_polygon(const mw_constraints *rings, uint32_t polygon,
                                     const double q[2])
{
    bool inside = false;
    for (size_t i = 0; i < rings->segment_count; i++) {
        if (rings->polygon[i] != polygon) continue;
        const double *a = segment_end(rings, i, 0), *b = segment_end(rings, i, 1);
        if (!points_same(a, b) && segment_has(a, b, q)) return POLYGON_BORDER;
        if (ray_crosses(a, b, q)) inside = !inside;
    }
    return inside ? POLYGON_INSIDE : POLYGON_OUTSIDE;
}

static bool strictly_inside(const double *a, const double *b, const double *q)
{
    return segment_has(a, b, q) && !points_same(a, q) && !points_same(b, q);
}

static bool segments_cross(const double *a, const double *b, const double *c, const double *d)
{
    int ac = location_oracle_orient(a, b, c), ad = location_oracle_orient(a, b, d);
    if (points_same(a, b) || points_same(c, d)) return false;
    if (ac == 0 && ad == 0)
        return strictly_inside(a, b, c) || strictly_inside(a, b, d) || strictly_inside(c, d, a) ||
               strictly_inside(c, d, b) || (points_same(a, c) && points_same(b, d)) ||
               (points_same(a, d) && points_same(b, c));
    return ac * ad < 0 && location_oracle_orient(c, d, a) * location_oracle_orient(c, d, b) < 0;
}

bool location_oracle_crosses(const mw_constraints *rings, uint32_t polygon)
{
    for (size_t i = 0; i < rings->segment_count; i++)
        for (size_t j = 0; rings->polygon[i] == polygon && j < i; j++)
            if (rings->polygon[j] == polygon &&
                segments_cross(segment_end(rings, i, 0), segment_end(rings, i, 1),
                               segment_end(rings, j, 0), segment_end(rings, j, 1)))
                return true;
    return false;
}
