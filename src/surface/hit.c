/* hit.c - does a line touch a triangle, which of two touches is better, and where it lies. All decisions are exact.
 *
 *      a---------d      Where the line goes through an edge or a vertex, it touches all triangles there that it is in
 *     / \  t'   /       front of, and the lowest-numbered is the answer. Inside an edge ab it is enough to look at the
 *    /   *     /        triangle beyond; at a vertex one turns round it, both ways until the fan closes or ends at a
 *   /  t  \   /         border. Flat triangles stand in the way: the place * lies inside two of their edges, and the
 *  c-------b-'          search goes on through them; or at a corner of them and inside the edge opposite, or at two
 *                       corners that coincide, where it branches. */
#include "mesh/fan.h"
#include "surface/prober.h"

#include <meshwalk/locate.h>

/* --- one triangle ------------------------------------------------------------------------------------------------- */

static void corners_of(const mw_surface *surface, uint32_t triangle, mw_corners corners)
{
    for (uint32_t k = 0; k < 3; k++) corners[k] = mw__surface_corner(surface, triangle, k);
}

/* Sides tell of a vertex that is not finite at most that they are 0: whether all are is asked last, here and below. */
bool mw__touches(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    corners_of(surface, triangle, c);
    double ab = mw__side(line, c[0], c[1]);
    if (ab > 0) return false;
    double bc = mw__side(line, c[1], c[2]);
    if (bc > 0) return false;
    double ca = mw__side(line, c[2], c[0]);
    return ca <= 0 && (ab < 0 || bc < 0 || ca < 0) && mw__corners_finite(surface, triangle);
}

bool mw__meets(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    corners_of(surface, triangle, c);
    double ab = mw__side(line, c[0], c[1]), bc = mw__side(line, c[1], c[2]);
    if ((ab < 0 && bc > 0) || (ab > 0 && bc < 0)) return false;
    double ca = mw__side(line, c[2], c[0]);
    bool front = ab < 0 || bc < 0 || ca<0, back = ab> 0 || bc > 0 || ca > 0;
    return front != back && mw__corners_finite(surface, triangle);
}

bool mw__in_reach(const mw_surface *surface, const mw_line *line, uint32_t triangle, double d)
{
    mw_corners c;
    corners_of(surface, triangle, c);
    return mw__compare_hit_to(line, c, d) <= 0;
}

bool mw__better(const mw_surface *surface, const mw_line *line, uint32_t s, uint32_t t)
{
    mw_corners c, d;
    corners_of(surface, s, c);
    corners_of(surface, t, d);
    int order = mw__compare_hits(line, c, d);
    return order < 0 || (order == 0 && s < t);
}

/* --- triangles at one place --------------------------------------------------------------------------------------- */

/* Flat triangles where a search branches. More of them at one place would not be searched through; the bound is there
 * for meshes that are nothing but flat. */
#define MAX_BRANCHES 32

/* All triangles that contain the place where the line meets a triangle, as far as they are linked there. */
typedef struct search {
    const mw_surface *surface;
    const mw_line *line;
    const double *vertex; /* the place, if it is that of a vertex; NULL: not known to be */
    const double *apex;   /* where it is not: the plane through it and the line parts the edge */
    uint32_t branch[MAX_BRANCHES], branch_count;
    uint32_t lowest; /* touched */
} search;

static void touched(search *s, uint32_t t)
{
    if (t < s->lowest) s->lowest = t;
}

static bool equal3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Does p lie strictly between a and b, all three on one line? */
static bool between(const double p[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        if ((a[k] < p[k] && p[k] < b[k]) || (b[k] < p[k] && p[k] < a[k])) return true;
    return false;
}

static void add_branch(search *s, uint32_t t)
{
    for (uint32_t i = 0; i < s->branch_count; i++)
        if (s->branch[i] == t) return;
    if (s->branch_count < MAX_BRANCHES) s->branch[s->branch_count++] = t;
}

/* For a point d on the line of an edge that contains the place inside. */
static bool at_place(const search *s, const double d[3])
{
    return s->vertex ? equal3(d, s->vertex) : mw__side(s->line, s->apex, d) == 0;
}

/* Do l and d, neither at the place, lie on different sides of it? As above. */
static bool parted(const search *s, const double l[3], const double d[3])
{
    if (s->vertex) return between(s->vertex, l, d);
    return (mw__side(s->line, s->apex, l) < 0) != (mw__side(s->line, s->apex, d) < 0);
}

/* Have the two halves of an edge the same ends still? Those of a welded surface may have been moved apart. */
static bool is_joined(const mw_surface *surface, uint32_t half, uint32_t link)
{
    uint32_t t = mw__link_triangle(half), e = mw__link_edge(half), u = mw__link_triangle(link), f = mw__link_edge(link);
    const double *a = mw__surface_corner(surface, t, e), *b = mw__surface_corner(surface, t, e + 1);
    const double *c = mw__surface_corner(surface, u, f), *d = mw__surface_corner(surface, u, f + 1);
    return (equal3(a, c) && equal3(b, d)) || (equal3(a, d) && equal3(b, c));
}

/* Over a half-edge that contains the place inside, and on through flat triangles. Each has two such edges, or is a
 * branch: so it comes to an end. */
static void cross(search *s, uint32_t half)
{
    for (;;) {
        uint32_t link = s->surface->tri[mw__link_triangle(half)].link[mw__link_edge(half)];
        if (link == MW_NONE || !is_joined(s->surface, half, link)) return;
        uint32_t t = mw__link_triangle(link), e = mw__link_edge(link);
        const double *l = mw__surface_corner(s->surface, t, e), *r = mw__surface_corner(s->surface, t, e + 1),
                     *d = mw__surface_corner(s->surface, t, mw__prev(e));
        if (!mw__is_finite3(d)) return;
        double side = mw__side(s->line, r, d);
        if (side < 0) touched(s, t);
        if (side != 0 || !mw__collinear3(l, r, d)) return;
        if (at_place(s, d)) {
            s->vertex = d;
            add_branch(s, t);
            return;
        }
        half = parted(s, l, d) ? mw__half_prev(link) : mw__half_next(link);
    }
}

/* A triangle with a corner at the place, which is that of a vertex. */
static void look(search *s, uint32_t t, uint32_t corner)
{
    const double *p = mw__surface_corner(s->surface, t, corner),
                 *a = mw__surface_corner(s->surface, t, mw__next(corner)),
                 *b = mw__surface_corner(s->surface, t, mw__prev(corner));
    if (!mw__is_finite3(a) || !mw__is_finite3(b)) return;
    double side = mw__side(s->line, a, b);
    if (side < 0) touched(s, t);
    if (side != 0 || !mw__collinear3(p, a, b)) return;
    if (between(p, a, b) || equal3(p, a) || equal3(p, b)) add_branch(s, t);
}

/* Round the corner, over the edge first, until the fan ends; true where it is closed. */
static bool turn_over(search *s, mw_edge_end first)
{
    const mw_triangle *tri = s->surface->tri;
    mw_edge_end e = first;
    do {
        if (mw__link_of(tri, e) == MW_NONE) return false;
        e = mw__across(tri, s->surface->place, e);
        uint32_t t = mw__link_triangle(e.half), corner = mw__near_corner(e);
        if (!equal3(mw__surface_corner(s->surface, t, corner), s->vertex)) return false;
        look(s, t, corner);
        e = mw__other_edge(e);
    } while (e.half != first.half || e.start != first.start);
    return true;
}

static void turn(search *s, uint32_t t, uint32_t corner)
{
    mw_edge_end e = {mw__link(t, corner), true};
    if (!turn_over(s, e)) turn_over(s, mw__other_edge(e));
}

/* From a flat triangle on, at least one of whose corners is at the place. */
static void branch_out(search *s, uint32_t t)
{
    for (uint32_t k = 0; k < 3; k++) {
        const double *a = mw__surface_corner(s->surface, t, k), *b = mw__surface_corner(s->surface, t, k + 1);
        if (equal3(a, s->vertex)) turn(s, t, k);
        if (between(s->vertex, a, b)) cross(s, mw__link(t, k));
    }
}

uint32_t mw__lowest_touched(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    search s = {.surface = surface, .line = line, .lowest = triangle};
    mw_corners c;
    corners_of(surface, triangle, c);
    uint32_t on[3], count = 0; /* edges that the line goes through */
    for (uint32_t k = 0; k < 3; k++)
        if (mw__side(line, c[k], c[mw__next(k)]) == 0) on[count++] = k;
    if (count == 1) {
        s.apex = c[mw__prev(on[0])];
        cross(&s, mw__link(triangle, on[0]));
    } else if (count == 2) {
        uint32_t corner = on[1] == mw__next(on[0]) ? on[1] : on[0];
        s.vertex = c[corner];
        turn(&s, triangle, corner);
    }
    for (uint32_t i = 0; i < s.branch_count; i++) branch_out(&s, s.branch[i]);
    return s.lowest;
}

/* --- answers ------------------------------------------------------------------------------------------------------ */

static mw_touch inside(uint32_t triangle, double distance, const double side[3])
{
    double sum = side[0] + side[1] + side[2];
    return (mw_touch){.distance = distance,
                      .weight = {side[0] / sum, side[1] / sum, side[2] / sum},
                      .triangle = triangle,
                      .state = MW_TOUCH_HIT,
                      .where = MW_INSIDE,
                      .local = UINT8_MAX};
}

static mw_touch touch(const mw_line *line, uint32_t triangle, const mw_corners corners, const double side[3])
{
    mw_touch touch = inside(triangle, mw__hit_distance(line, corners), side);
    uint32_t zeros = 0;
    for (uint32_t k = 0; k < 3; k++) zeros += side[k] == 0;
    for (uint32_t k = 0; k < 3; k++) { /* corner k is off the edge after it, or alone on the line */
        if (zeros == 1 && side[k] == 0) touch.local = (uint8_t)mw__next(k);
        if (zeros == 2 && side[k] != 0) touch.local = (uint8_t)k;
    }
    if (zeros > 0) touch.where = zeros == 1 ? MW_ON_EDGE : MW_ON_VERTEX;
    return touch;
}

mw_touch mw__touch(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    double side[3];
    corners_of(surface, triangle, c);
    mw__hit_sides(line, c, side);
    return touch(line, triangle, c, side);
}

mw_touch mw__touch_lowest(const mw_surface *surface, const mw_line *line, uint32_t triangle)
{
    mw_corners c;
    double side[3];
    corners_of(surface, triangle, c);
    mw__hit_sides(line, c, side);
    bool alone = side[0] != 0 && side[1] != 0 && side[2] != 0;
    if (MW_LIKELY(alone)) return touch(line, triangle, c, side);
    return mw__touch(surface, line, mw__lowest_touched(surface, line, triangle));
}

/* Distances are off by less than 2^-40 of themselves, or by what underflows. */
#define REACH_ERROR (1 + 0x1p-38)

bool mw__touch_again(const mw_surface *surface, const mw_line *line, uint32_t triangle, double d, mw_touch *touch)
{
    mw_corners c;
    double side[3];
    corners_of(surface, triangle, c);
    if (!mw__hit_inside(line, c, side)) return false;
    double distance = mw__hit_distance(line, c);
    if (!((fabs(distance) + MW_SURFACE_TINY_LENGTH) * REACH_ERROR < d)) return false;
    *touch = inside(triangle, distance, side);
    return true;
}

mw_touch mw__no_touch(mw_touch_state state)
{
    return (mw_touch){.distance = NAN,
                      .weight = {NAN, NAN, NAN},
                      .triangle = MW_NONE,
                      .state = (uint8_t)state,
                      .where = MW_BAD,
                      .local = UINT8_MAX};
}
