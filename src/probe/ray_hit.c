/* ray_hit.c - does a ray meet a triangle, and where along the ray? All decisions are exact.
 *
 * The line q + t m meets the plane of a triangle with normal n and corner a at t = N / M, N = n .
 * (a - q), M = n . m. The sign of N is an orientation of q and the corners. M < 0 where the line
 * meets the front. */
#include "probe/ray.h"

#include <meshwalk/locate.h>

static void ray_corners_of(const mw_surface *surface, uint32_t triangle, mw_corners corners)
{
    for (uint32_t k = 0; k < 3; k++) corners[k] = mw__surface_corner(surface, triangle, k);
}

/* --- the line --- */

/* A vertex that is not finite gives sides of 0 at most. */
mw_ray_side mw__line_meets_exactly(const mw_line *line, const mw_corners c)
{
    double side[3] = {mw__side(line, c[0], c[1]), mw__side(line, c[1], c[2]),
                      mw__side(line, c[2], c[0])};
    bool front =
        side[0] < 0 || side[1] < 0 || side[2]<0, back = side[0]> 0 || side[1] > 0 || side[2] > 0;
    bool finite = mw__is_finite3(c[0]) && mw__is_finite3(c[1]) && mw__is_finite3(c[2]);
    if (front == back || !finite) return MW_RAY_MISSES;
    return front ? MW_RAY_FRONT : MW_RAY_BACK;
}

/* All three sides at once: most triangles in a box are missed, and a branch at each side would be
 * guessed wrong. */
mw_ray_side mw__ray_line_meets(const mw_line *line, const mw_corners c, mw_line_estimate *e)
{
    const double *side = e->side, *bound = e->bound;
    mw__estimate_sides(line, c, e);
    int right = (side[0] < -bound[0]) + (side[1] < -bound[1]) + (side[2] < -bound[2]),
        left = (side[0] > bound[0]) + (side[1] > bound[1]) + (side[2] > bound[2]);
    if (right && left) return MW_RAY_MISSES;
    if (right == 3) return MW_RAY_FRONT;
    if (left == 3) return MW_RAY_BACK;
    return mw__line_meets_exactly(line, c);
}

/* --- along the line --- */

/* The sign of t - 0, or for `from` the end of a segment, of t - 1. */
static int hit_after(const double from[3], const mw_corners c, mw_ray_side side)
{
    double n = mw__orient3d(from, c[1], c[2], c[0]);
    return n == 0 ? 0 : (n < 0) == (side == MW_RAY_FRONT) ? 1 : -1;
}

bool mw__ray_reaches(const mw_ray_query *ray, const mw_corners c, mw_ray_side side)
{
    if (ray->extent != MW_PROBE_LINE && hit_after(ray->line.q, c, side) < 0) return false;
    if (ray->extent == MW_PROBE_SEGMENT && hit_after(ray->end, c, side) > 0) return false;
    if (ray->least > 0 && mw__compare_hit_to(&ray->line, c, ray->least) < 0) return false;
    return isinf(ray->greatest) || mw__compare_hit_to(&ray->line, c, ray->greatest) <= 0;
}

/* The sign of the distance is exact. */
bool mw__ray_reaches_at(const mw_ray_query *ray, const mw_corners c, mw_ray_side side,
                        double distance)
{
    bool limited = ray->least > 0 || !isinf(ray->greatest) || ray->extent == MW_PROBE_SEGMENT;
    if (ray->extent == MW_PROBE_RAY && distance < 0) return false;
    return !limited || mw__ray_reaches(ray, c, side);
}

int mw__ray_place_order(const mw_surface *surface, const mw_ray_query *ray, uint32_t s,
                        mw_ray_side s_side, uint32_t t, mw_ray_side t_side)
{
    mw_corners c, d;
    ray_corners_of(surface, s, c);
    ray_corners_of(surface, t, d);
    int after = hit_after(ray->line.q, c, s_side), other = hit_after(ray->line.q, d, t_side);
    if (after != other) return after < other ? -1 : 1;
    return after == 0 ? 0 : mw__compare_hits(&ray->line, c, d) * after;
}

int mw__ray_order(const mw_surface *surface, const mw_ray_query *ray, uint32_t s,
                  mw_ray_side s_side, uint32_t t, mw_ray_side t_side)
{
    int order = mw__ray_place_order(surface, ray, s, s_side, t, t_side);
    return order != 0 ? order : s < t ? -1 : s > t;
}

mw_touch mw__ray_touch(const mw_surface *surface, const mw_ray_query *ray, uint32_t triangle,
                       mw_ray_side side)
{
    mw_touch touch = mw__touch_of(surface, &ray->line, triangle);
    touch.back = side == MW_RAY_BACK;
    return touch;
}
