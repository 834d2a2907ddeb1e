#include "bench/space/space_judge.h"
#include "bench/space/space_engine.h"

#include <float.h>
#include <math.h>

/* 113 bits, by whatever name; compilers for 32-bit ARM have no such type, and there the judge
 * rounds as doubles do. */
#if LDBL_MANT_DIG < 113 && defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 judge_quad;
#else
typedef long double judge_quad;
#endif

static const double *judge_corner(const space_model *m, uint32_t triangle, int k)
{
    return m->points + 3 * (size_t)m->triangles[3 * (size_t)triangle + (size_t)k];
}

/* The sides of the ray on which the three edges pass, as signs. Returns whether the ray's line
 * meets the triangle. */
static bool judge_sides(const space_model *m, const double *ray, uint32_t t, int side[3])
{
    double through[3] = {ray[0] + ray[3], ray[1] + ray[4], ray[2] + ray[5]};
    bool less = false, more = false;
    for (int k = 0; k < 3; k++) {
        double o =
            mw_orient3d(ray, through, judge_corner(m, t, k), judge_corner(m, t, (k + 1) % 3));
        side[k] = (o > 0) - (o < 0);
        less = less || o < 0;
        more = more || o > 0;
    }
    return less != more;
}

/* Where the line meets the plane: q + t m. Differences of doubles of about one size, and products
 * of two of them, have 113 bits or few more. */
static judge_quad judge_place(const space_model *m, const double *ray, uint32_t t)
{
    const double *a = judge_corner(m, t, 0), *b = judge_corner(m, t, 1), *c = judge_corner(m, t, 2);
    judge_quad u[3], v[3], above = 0, below = 0;
    for (int k = 0; k < 3; k++) {
        u[k] = (judge_quad)b[k] - a[k];
        v[k] = (judge_quad)c[k] - a[k];
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        judge_quad n = u[i] * v[j] - u[j] * v[i];
        above += n * ((judge_quad)a[k] - ray[k]);
        below += n * ray[3 + k];
    }
    return above / below;
}

/* Does the ray meet the triangle? Sets where. The ray begins on its plane where the orientation is
 * exactly 0. */
static bool judge_meets(const space_model *m, const double *ray, uint32_t t, bool behind,
                        judge_quad *place)
{
    int side[3];
    if (!judge_sides(m, ray, t, side)) return false;
    *place = judge_place(m, ray, t);
    double on =
        mw_orient3d(ray, judge_corner(m, t, 0), judge_corner(m, t, 1), judge_corner(m, t, 2));
    return behind || on == 0 || *place > 0;
}

static bool judge_points_equal(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Do both triangles have all corners that the ray passes between: the vertex, the ends of the edge,
 * or all three? Then it meets them in one point. */
static bool judge_same_point(const space_model *m, const double *ray, uint32_t s, uint32_t t)
{
    int side[3];
    judge_sides(m, ray, s, side);
    for (int k = 0; k < 3; k++) {
        if (side[(k + 1) % 3] == 0) continue; /* the corner's weight is 0 */
        bool shared = false;
        for (int j = 0; j < 3; j++)
            shared = shared || judge_points_equal(judge_corner(m, s, k), judge_corner(m, t, j));
        if (!shared) return false;
    }
    return true;
}

#define JUDGE_EQUAL 0x1p-80

/* Is triangle s nearer than t, by more than rounding? Both are met. */
static bool judge_nearer(judge_quad s, judge_quad t)
{
    return s < t - (t < 0 ? -t : t) * (judge_quad)JUDGE_EQUAL;
}

/* Is `found` as good an answer as the right one? */
static bool judge_is_right(const space_model *m, const double *ray, uint32_t found, uint32_t right,
                           bool any)
{
    judge_quad place, best = 0;
    if (found == right) return true;
    if (found >= m->triangle_count || !judge_meets(m, ray, found, any, &place)) return false;
    if (any) return true;
    judge_meets(m, ray, right, false, &best);
    if (judge_nearer(best, place)) return false;
    return judge_same_point(m, ray, right, found) || judge_same_point(m, ray, found, right);
}

/* --- all triangles ---------------------------------------------------------------------------- */

/* The nearest triangle; of those at one place the lowest. */
static uint32_t judge_search(const space_model *m, const double *ray)
{
    uint32_t nearest = SPACE_NOTHING;
    judge_quad best = 0, place;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        if (!judge_meets(m, ray, t, false, &place)) continue;
        if (nearest != SPACE_NOTHING && !judge_nearer(place, best)) continue;
        nearest = t;
        best = place;
    }
    return nearest;
}

size_t space_truth_check(space_truth *t, const space_model *m, const space_rays *rays, double tests)
{
    size_t wrong = 0;
    double many = tests / (double)m->triangle_count + 1;
    t->checked = many < (double)t->count ? (size_t)many : t->count;
    for (size_t i = 0; i < t->checked; i++) {
        uint32_t right = judge_search(m, rays->ray + 6 * i);
        wrong += right != t->nearest[i];
        t->nearest[i] = right;
    }
    return wrong;
}

space_verdict space_judge(const space_truth *t, const space_model *m, const space_rays *rays,
                          const uint32_t *found, size_t count, bool any)
{
    space_verdict v = {0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        uint32_t right = t->nearest[i];
        if (found[i] == SPACE_NOTHING)
            v.missed += right != SPACE_NOTHING;
        else if (right == SPACE_NOTHING)
            v.invented += found[i] != SPACE_NOTHING;
        else
            v.other += !judge_is_right(m, rays->ray + 6 * i, found[i], right, any);
    }
    return v;
}
