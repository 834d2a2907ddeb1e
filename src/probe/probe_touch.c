/* probe_touch.c - does a line touch a triangle, which of two touches is better, and where is the
 * touch? All decisions are exact.
 *
 *      a---------d      A line through an edge or a vertex touches all triangles there whose fronts
 *     / \  t'   /       it points at. The lowest-numbered one is the answer. Inside an edge ab it
 *    /   *     /        is enough to look at the neighbour. At a vertex the search turns round it,
 *   /  t  \   /         both ways, until the fan closes or ends at a border. Flat triangles are in
 *  c-------b-'          the way. If the point * lies inside two of their edges, the search
 *                       continues through them. If it lies at a corner of theirs and inside the
 *                       opposite edge, or at two coincident corners, the search branches. */
#include "topology/fan.h"
#include "probe/prober.h"

#include <meshwalk/locate.h>

/* --- one triangle --- */

static void triangle_corners_of(const mw_surface *surface, uint32_t triangle, mw_corners corners)
{
    for (uint32_t k = 0; k < 3; k++) corners[k] = mw__surface_corner(surface, triangle, k);
}

/* A vertex that is not finite gives sides of 0 at most. So the test whether all vertices are finite
 * comes last, here and below. */
bool mw__line_touches(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    triangle_corners_of(surface, triangle, c);
    double ab = mw__side(line, c[0], c[1]);
    if (ab > 0) return false;
    double bc = mw__side(line, c[1], c[2]);
    if (bc > 0) return false;
    double ca = mw__side(line, c[2], c[0]);
    return ca <= 0 && (ab < 0 || bc < 0 || ca < 0) && mw__corners_finite(surface, triangle);
}

bool mw__line_meets(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    triangle_corners_of(surface, triangle, c);
    double ab = mw__side(line, c[0], c[1]), bc = mw__side(line, c[1], c[2]);
    if ((ab < 0 && bc > 0) || (ab > 0 && bc < 0)) return false;
    double ca = mw__side(line, c[2], c[0]);
    bool front = ab < 0 || bc < 0 || ca<0, back = ab> 0 || bc > 0 || ca > 0;
    return front != back && mw__corners_finite(surface, triangle);
}

bool mw__touch_in_reach(const mw_surface *surface, const mw_line *line, uint32_t triangle, double d)
{
    mw_corners c;
    triangle_corners_of(surface, triangle, c);
    return mw__compare_hit_to(line, c, d) <= 0;
}

bool mw__touch_is_better(const mw_surface *surface, const mw_line *line, uint32_t s, uint32_t t)
{
    mw_corners c, d;
    triangle_corners_of(surface, s, c);
    triangle_corners_of(surface, t, d);
    int order = mw__compare_hits(line, c, d);
    return order < 0 || (order == 0 && s < t);
}

/* --- triangles at one point --- */

/* The number of flat triangles where a search branches. If more of them meet in one point, the
 * others are not searched. The bound is for meshes of flat triangles only. */
#define MAX_BRANCHES 32

/* Searches the triangles at the point where the line meets a triangle, as far as they are linked
 * there. */
typedef struct touch_search {
    const mw_surface *surface;
    const mw_line *line;
    const double *vertex; /* the point, if it is known to be a vertex; else NULL */
    const double *apex;   /* else: the plane through the apex and the line divides the edge */
    uint32_t branch[MAX_BRANCHES], branch_count;
    uint32_t lowest; /* lowest triangle touched so far */
} touch_search;

static void touch_search_note(touch_search *s, uint32_t t)
{
    if (t < s->lowest) s->lowest = t;
}

static bool points_equal3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Does p lie strictly between a and b? All three are collinear. */
static bool touch_point_is_between(const double p[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        if ((a[k] < p[k] && p[k] < b[k]) || (b[k] < p[k] && p[k] < a[k])) return true;
    return false;
}

static void touch_search_add_branch(touch_search *s, uint32_t t)
{
    for (uint32_t i = 0; i < s->branch_count; i++)
        if (s->branch[i] == t) return;
    if (s->branch_count < MAX_BRANCHES) s->branch[s->branch_count++] = t;
}

/* Is d the point? d is on the line of an edge that has the point in its interior. */
static bool touch_is_at_point(const touch_search *s, const double d[3])
{
    return s->vertex ? points_equal3(d, s->vertex) : mw__side(s->line, s->apex, d) == 0;
}

/* Do l and d, which are both not the point, lie on different sides of it? d as above. */
static bool touch_is_parted(const touch_search *s, const double l[3], const double d[3])
{
    if (s->vertex) return touch_point_is_between(s->vertex, l, d);
    return (mw__side(s->line, s->apex, l) < 0) != (mw__side(s->line, s->apex, d) < 0);
}

/* Do the two halves of an edge still have the same ends? Welded vertices may have been moved
 * apart. */
static bool edge_is_joined(const mw_surface *surface, uint32_t half, uint32_t link)
{
    uint32_t t = mw__link_triangle(half), e = mw__link_edge(half), u = mw__link_triangle(link),
             f = mw__link_edge(link);
    const double *a = mw__surface_corner(surface, t, e), *b = mw__surface_corner(surface, t, e + 1);
    const double *c = mw__surface_corner(surface, u, f), *d = mw__surface_corner(surface, u, f + 1);
    return (points_equal3(a, c) && points_equal3(b, d)) ||
           (points_equal3(a, d) && points_equal3(b, c));
}

/* Cross a half-edge that has the point in its interior, and continue through flat triangles. A flat
 * triangle has two such edges or is a branch, so the search ends. */
static void touch_search_cross(touch_search *s, uint32_t half)
{
    for (;;) {
        uint32_t link = s->surface->tri[mw__link_triangle(half)].link[mw__link_edge(half)];
        if (link == MW_NONE || !edge_is_joined(s->surface, half, link)) return;
        uint32_t t = mw__link_triangle(link), e = mw__link_edge(link);
        const double *l = mw__surface_corner(s->surface, t, e),
                     *r = mw__surface_corner(s->surface, t, e + 1),
                     *d = mw__surface_corner(s->surface, t, mw__prev(e));
        if (!mw__is_finite3(d)) return;
        double side = mw__side(s->line, r, d);
        if (side < 0) touch_search_note(s, t);
        if (side != 0 || !mw__collinear3(l, r, d)) return;
        if (touch_is_at_point(s, d)) {
            s->vertex = d;
            touch_search_add_branch(s, t);
            return;
        }
        half = touch_is_parted(s, l, d) ? mw__half_prev(link) : mw__half_next(link);
    }
}

/* Look at a triangle with a corner at the point, which is a vertex. */
static void touch_search_look(touch_search *s, uint32_t t, uint32_t corner)
{
    const double *p = mw__surface_corner(s->surface, t, corner),
                 *a = mw__surface_corner(s->surface, t, mw__next(corner)),
                 *b = mw__surface_corner(s->surface, t, mw__prev(corner));
    if (!mw__is_finite3(a) || !mw__is_finite3(b)) return;
    double side = mw__side(s->line, a, b);
    if (side < 0) touch_search_note(s, t);
    if (side != 0 || !mw__collinear3(p, a, b)) return;
    if (touch_point_is_between(p, a, b) || points_equal3(p, a) || points_equal3(p, b))
        touch_search_add_branch(s, t);
}

/* Turn round the corner, over the given edge first, until the fan ends. Returns true if it
 * closes. */
static bool touch_search_turn_over(touch_search *s, mw_edge_end first)
{
    const mw_triangle *tri = s->surface->tri;
    mw_edge_end e = first;
    do {
        if (mw__link_of(tri, e) == MW_NONE) return false;
        e = mw__across(tri, s->surface->coincident, e);
        uint32_t t = mw__link_triangle(e.half), corner = mw__near_corner(e);
        if (!points_equal3(mw__surface_corner(s->surface, t, corner), s->vertex)) return false;
        touch_search_look(s, t, corner);
        e = mw__other_edge(e);
    } while (e.half != first.half || e.start != first.start);
    return true;
}

static void touch_search_turn(touch_search *s, uint32_t t, uint32_t corner)
{
    mw_edge_end e = {mw__link(t, corner), true};
    if (!touch_search_turn_over(s, e)) touch_search_turn_over(s, mw__other_edge(e));
}

/* Continue from a flat triangle with a corner at the point. */
static void touch_search_branch_out(touch_search *s, uint32_t t)
{
    for (uint32_t k = 0; k < 3; k++) {
        const double *a = mw__surface_corner(s->surface, t, k),
                     *b = mw__surface_corner(s->surface, t, k + 1);
        if (points_equal3(a, s->vertex)) touch_search_turn(s, t, k);
        if (touch_point_is_between(s->vertex, a, b)) touch_search_cross(s, mw__link(t, k));
    }
}

uint32_t mw__lowest_touched(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    touch_search s = {.surface = surface, .line = line, .lowest = triangle};
    mw_corners c;
    triangle_corners_of(surface, triangle, c);
    uint32_t on[3], count = 0; /* the edges that the line goes through */
    for (uint32_t k = 0; k < 3; k++)
        if (mw__side(line, c[k], c[mw__next(k)]) == 0) on[count++] = k;
    if (count == 1) {
        s.apex = c[mw__prev(on[0])];
        touch_search_cross(&s, mw__link(triangle, on[0]));
    } else if (count == 2) {
        uint32_t corner = on[1] == mw__next(on[0]) ? on[1] : on[0];
        s.vertex = c[corner];
        touch_search_turn(&s, triangle, corner);
    }
    for (uint32_t i = 0; i < s.branch_count; i++) touch_search_branch_out(&s, s.branch[i]);
    return s.lowest;
}

/* --- answers --- */

mw_touch mw__touch_inside(uint32_t triangle, double distance, const double side[3])
{
    double sum = side[0] + side[1] + side[2];
    return (mw_touch){.distance = distance,
                      .weight = {side[0] / sum, side[1] / sum, side[2] / sum},
                      .triangle = triangle,
                      .state = MW_TOUCH_HIT,
                      .where = MW_INSIDE,
                      .local = UINT8_MAX};
}

static mw_touch touch_make(uint32_t triangle, double distance, const double side[3])
{
    mw_touch touch = mw__touch_inside(triangle, distance, side);
    uint32_t zeros = 0;
    for (uint32_t k = 0; k < 3; k++) zeros += side[k] == 0;
    /* Corner k is opposite to the next edge, or the only corner on the line. */
    for (uint32_t k = 0; k < 3; k++) {
        if (zeros == 1 && side[k] == 0) touch.local = (uint8_t)mw__next(k);
        if (zeros == 2 && side[k] != 0) touch.local = (uint8_t)k;
    }
    if (zeros > 0) touch.where = zeros == 1 ? MW_ON_EDGE : MW_ON_VERTEX;
    return touch;
}

mw_touch mw__touch_at(const mw_line *line, uint32_t triangle, const mw_corners corners,
                      const mw_line_estimate *e, double distance)
{
    double side[3];
    mw__hit_sides_noted(line, corners, e, side);
    return touch_make(triangle, distance, side);
}

mw_touch mw__touch_of(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    double side[3];
    triangle_corners_of(surface, triangle, c);
    mw__hit_sides(line, c, side);
    return touch_make(triangle, mw__hit_distance(line, c), side);
}

mw_touch mw__touch_of_lowest(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    double side[3];
    triangle_corners_of(surface, triangle, c);
    mw__hit_sides(line, c, side);
    bool alone = side[0] != 0 && side[1] != 0 && side[2] != 0;
    if (MW_LIKELY(alone)) return touch_make(triangle, mw__hit_distance(line, c), side);
    return mw__touch_of(surface, line, mw__lowest_touched(surface, line, triangle));
}

/* Distances are off by less than 2^-40 of themselves, or by underflow. */
#define REACH_ERROR (1 + 0x1p-38)

bool mw__touch_surely_inside(const mw_surface *surface, const mw_line *line, uint32_t triangle,
                             double d, mw_touch *touch)
{
    mw_corners c;
    double side[3];
    triangle_corners_of(surface, triangle, c);
    if (!mw__hit_inside(line, c, side)) return false;
    double distance = mw__hit_distance(line, c);
    if (!((fabs(distance) + MW_BVH_TINY_LENGTH) * REACH_ERROR < d)) return false;
    *touch = mw__touch_inside(triangle, distance, side);
    return true;
}

mw_touch mw__touch_none(mw_touch_state state)
{
    return (mw_touch){.distance = NAN,
                      .weight = {NAN, NAN, NAN},
                      .triangle = MW_NONE,
                      .state = (uint8_t)state,
                      .where = MW_BAD,
                      .local = UINT8_MAX};
}
