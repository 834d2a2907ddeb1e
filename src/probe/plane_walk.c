/* plane_walk.c - the walk along a plane through the line [thesis App. G, Alg. 2].
 *
 *        l                 The plane contains the line and a point o of the first triangle. Seen
 *       /|\                along the line, the plane is another line, through q. The walk follows
 *   o  / | \ s   . q       it over the surface. Let r and l be the ends of the edge just crossed,
 *   ---r-|--'---'---       l above the plane and r not above it, and s the third vertex. The plane
 *       \|/                leaves over rs if s lies above it, over sl otherwise: one test a
 *        '                 triangle. A second test, of the exit edge, tells whether the line is
 *                          ahead or behind. Where this changes, the triangle is tested in full:
 *                          does m point at its front, and is it in reach?
 *
 * m points at the front of the first triangle, so seen along m the triangle is clockwise. The plane
 * leaves it towards the line over the edge that goes up, from a vertex not above the plane to a
 * vertex above it. It leaves away from the line over the edge that goes down. The triangle has one
 * edge of each kind, or none.
 *
 * A vertex in the plane counts as not above it. In effect the walk follows a parallel plane
 * slightly higher, which meets no vertex. If an edge passes the line on neither side (test 0), the
 * triangles at it are tested in full. The tests along the way only tell where to look; they decide
 * nothing.
 *
 * o is the rounded middle of the first triangle. If rounding has moved it so far that the plane
 * does not cut the triangle, or if o lies on the line and spans no plane with it, a corner takes
 * its place. One of the corners works: if m points at the front of a triangle, its edges do not all
 * lie in planes with the line.
 *
 * Departures from the printed pseudocode. There, a border ends a walk. Here, the walk goes back to
 * the first triangle, continues over the other edge, and ends at the next border. So it visits the
 * whole slice that it started in. And the mark, which changes at every triangle that the line
 * meets, is the sign of the last test: the same, except where tests are 0.
 *
 * Why it ends, on any surface, and visits no triangle twice. A vertex does not change sides of the
 * plane during a walk. So every triangle has either two edges whose ends are on different sides, or
 * none. Links join edges in pairs with the same ends. So the triangles of the first kind, joined by
 * links over such edges, form cycles and chains without forks, and the way back is as unique as the
 * way forth. A walk follows one of these: a cycle until it is back at its first triangle, or a
 * chain to one end and then to the other. This also holds for neighbours of another orientation, as
 * sides distinguish l and r, not their order; with vertices that are not finite, which count as not
 * above; and in a welded surface, where coincident vertices, even if moved apart since, all have
 * the position of their representative. The bound on steps is the number of triangles. */
#include "probe/plane_walk.h"

/* The variant of a kernel. Always a literal where a kernel is made. */
typedef struct mw_plane_walk_policy {
    bool count, raced;
} mw_plane_walk_policy;

/* --- vocabulary --- */

/* A vertex of the current triangle (its representative), and the position of a vertex. */
static MW_INLINE uint32_t corner_vertex(const mw_plane_walk *w, uint32_t k)
{
    uint32_t v = w->tri[w->t].v[k];
    return MW_UNLIKELY(w->coincident != NULL) ? w->coincident[v] : v;
}

static MW_INLINE const double *vertex_position(const mw_plane_walk *w, uint32_t v)
{
    return w->point + 3 * (size_t)v;
}

/* Set the plane through o and the line. */
static void plane_span(mw_plane_walk *w)
{
    const double *q = w->search->line.q, *m = w->search->line.m;
    double u[3] = {w->o[0] - q[0], w->o[1] - q[1], w->o[2] - q[2]};
    for (uint32_t k = 0; k < 3; k++) {
        double left = m[mw__next(k)] * u[mw__prev(k)], right = m[mw__prev(k)] * u[mw__next(k)];
        w->n[k] = left - right;
        w->sum[k] = fabs(left) + fabs(right);
    }
}

/* The sign of mw__side(line, o, v), exact. But the filter is n . (v - q), since n is at hand. The
 * error bound is that of line.h: a component of n is off by (3u + ...) of its sum, as one of its
 * factors is rounded; its product with a difference is off by (5u + ...); the rest is as there.
 * Underflow: as there, with differences below 2^100. */
static MW_INLINE bool is_above_plane(mw_plane_walk *w, uint32_t v, mw_plane_walk_policy P)
{
    if (P.count) w->work->tests++;
    const double *p = vertex_position(w, v), *q = w->search->line.q;
    double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    double side = w->n[0] * x + w->n[1] * y + w->n[2] * z;
    double permanent = w->sum[0] * fabs(x) + w->sum[1] * fabs(y) + w->sum[2] * fabs(z);
    bool small = fabs(x) + fabs(y) + fabs(z) < MW_SIDE_MOTION;
    if (MW_LIKELY(small && fabs(side) > MW_SIDE_ERROR * permanent + MW_UNDERFLOW_ERROR))
        return side > 0;
    return mw__side_exact(&w->search->line, w->o, p) > 0;
}

/* Is the line ahead of edge rl (1), behind it (-1), or on it (0)? */
static MW_INLINE int side_of_line(mw_plane_walk *w, uint32_t r, uint32_t l, mw_plane_walk_policy P)
{
    if (P.count) w->work->tests++;
    double side = mw__side(&w->search->line, vertex_position(w, r), vertex_position(w, l));
    return (side > 0) - (side < 0);
}

static MW_INLINE bool plane_walk_touches(mw_plane_walk *w, mw_plane_walk_policy P)
{
    const mw_probe_search *s = w->search;
    if (P.count) w->work->tests++;
    if (!mw__line_touches(s->surface, &s->line, w->t)) return false;
    if (P.count) w->work->intersections++;
    return mw__touch_in_reach(s->surface, &s->line, w->t, s->reach);
}

static MW_INLINE mw_plane_walk_verdict plane_walk_enter(mw_plane_walk *w, uint32_t link,
                                                        mw_plane_walk_policy P)
{
    if (MW_UNLIKELY(link == MW_NONE || mw__link_triangle(link) == w->first))
        return MW_PLANE_WALK_END;
    if (MW_UNLIKELY(w->fuel == 0)) return MW_PLANE_WALK_END;
    w->fuel--;
    w->t = mw__link_triangle(link);
    w->e = mw__link_edge(link);
    if (P.count) w->work->triangles++;
    return MW_PLANE_WALK_GO;
}

/* At a border: go back to the first triangle and continue over its other edge, whose first end is
 * above the plane. */
static MW_INLINE mw_plane_walk_verdict plane_walk_turn_back(mw_plane_walk *w,
                                                            mw_plane_walk_policy P)
{
    if (w->turned) return MW_PLANE_WALK_END;
    w->turned = true;
    w->t = w->first;
    w->l = corner_vertex(w, w->back);
    w->r = corner_vertex(w, w->back + 1);
    w->side = side_of_line(w, w->r, w->l, P);
    return plane_walk_enter(w, w->tri[w->t].link[w->back], P);
}

/* Leave over edge e = rl, unless the triangle is touched. */
static MW_INLINE mw_plane_walk_verdict plane_walk_leave(mw_plane_walk *w, uint32_t e, uint32_t r,
                                                        uint32_t l, mw_plane_walk_policy P)
{
    int side = side_of_line(w, r, l, P);
    bool met = side != w->side || side == 0;
    w->r = r;
    w->l = l;
    w->side = side;
    if (MW_UNLIKELY(met) && plane_walk_touches(w, P)) return MW_PLANE_WALK_TOUCH;
    uint32_t link = w->tri[w->t].link[e];
    return MW_UNLIKELY(link == MW_NONE) ? plane_walk_turn_back(w, P) : plane_walk_enter(w, link, P);
}

/* --- steps --- */

/* The edge of the current triangle that goes up through the plane, or MW_NONE. Sets `back`, the
 * edge that goes down. */
static MW_INLINE uint32_t plane_walk_edge_up(mw_plane_walk *w, mw_plane_walk_policy P)
{
    bool above[4];
    uint32_t up = MW_NONE;
    for (uint32_t k = 0; k < 3; k++) above[k] = is_above_plane(w, corner_vertex(w, k), P);
    above[3] = above[0];
    for (uint32_t k = 0; k < 3; k++) {
        if (!above[k] && above[k + 1]) up = k;
        if (above[k] && !above[k + 1]) w->back = k;
    }
    return up;
}

static void plane_through_middle(mw_plane_walk *w)
{
    const double *a = vertex_position(w, corner_vertex(w, 0)),
                 *b = vertex_position(w, corner_vertex(w, 1)),
                 *c = vertex_position(w, corner_vertex(w, 2));
    for (int i = 0; i < 3; i++) w->o[i] = a[i] / 3 + b[i] / 3 + c[i] / 3;
    plane_span(w);
}

static void plane_through_corner(mw_plane_walk *w, uint32_t k)
{
    const double *a = vertex_position(w, corner_vertex(w, k));
    for (int i = 0; i < 3; i++) w->o[i] = a[i];
    plane_span(w);
}

/* In the first triangle: choose the plane and the direction towards the line. No plane cuts the
 * triangle only if welded vertices have been moved apart. */
static MW_INLINE mw_plane_walk_verdict plane_walk_aim(mw_plane_walk *w, mw_plane_walk_policy P)
{
    plane_through_middle(w);
    uint32_t up = plane_walk_edge_up(w, P);
    for (uint32_t k = 0; MW_UNLIKELY(up == MW_NONE) && k < 3; k++) {
        plane_through_corner(w, k);
        up = plane_walk_edge_up(w, P);
    }
    if (MW_UNLIKELY(up == MW_NONE))
        return plane_walk_touches(w, P) ? MW_PLANE_WALK_TOUCH : MW_PLANE_WALK_END;
    w->side = 1;
    return plane_walk_leave(w, up, corner_vertex(w, up), corner_vertex(w, up + 1), P);
}

/* The next triangle. It was entered over edge e = rl, or lr, depending on its orientation and the
 * direction. */
static MW_INLINE mw_plane_walk_verdict plane_walk_follow(mw_plane_walk *w, mw_plane_walk_policy P)
{
    uint32_t s = corner_vertex(w, mw__prev(w->e));
    bool above = is_above_plane(w, s, P), begins_above = corner_vertex(w, w->e) == w->l;
    uint32_t out = above == begins_above ? mw__next(w->e) : mw__prev(w->e);
    return plane_walk_leave(w, out, above ? w->r : s, above ? s : w->l, P);
}

static MW_INLINE mw_plane_walk_verdict plane_walk_step(mw_plane_walk *w, mw_plane_walk_policy P)
{
    if (P.raced && atomic_load_explicit(w->found, memory_order_relaxed) != MW_NONE)
        return MW_PLANE_WALK_END;
    return MW_LIKELY(w->e != MW_PLANE_WALK_FIRST) ? plane_walk_follow(w, P) : plane_walk_aim(w, P);
}

/* --- kernels --- */

mw_plane_walk mw__plane_walk_begin(const mw_probe_search *search, uint32_t t,
                                   const _Atomic uint32_t *found, mw_probe_counters *work)
{
    const mw_surface *surface = search->surface;
    if (work) work->triangles++;
    return (mw_plane_walk){.search = search,
                           .point = surface->point,
                           .tri = surface->tri,
                           .coincident = surface->coincident,
                           .first = t,
                           .t = t,
                           .e = MW_PLANE_WALK_FIRST,
                           .fuel = search->steps - 1,
                           .found = found,
                           .work = work};
}

static MW_INLINE uint32_t plane_walk_run(mw_plane_walk *walk, mw_plane_walk_policy P)
{
    mw_plane_walk w = *walk; /* a local copy can stay in registers */
    mw_plane_walk_verdict verdict;
    do {
        verdict = plane_walk_step(&w, P);
    } while (verdict == MW_PLANE_WALK_GO);
    return verdict == MW_PLANE_WALK_TOUCH ? w.t : MW_NONE;
}

static uint32_t plane_walk_alone(mw_plane_walk *walk)
{
    return plane_walk_run(walk, (mw_plane_walk_policy){.count = false, .raced = false});
}

static uint32_t plane_walk_alone_count(mw_plane_walk *walk)
{
    return plane_walk_run(walk, (mw_plane_walk_policy){.count = true, .raced = false});
}

static uint32_t plane_walk_raced(mw_plane_walk *walk)
{
    return plane_walk_run(walk, (mw_plane_walk_policy){.count = false, .raced = true});
}

static uint32_t plane_walk_raced_count(mw_plane_walk *walk)
{
    return plane_walk_run(walk, (mw_plane_walk_policy){.count = true, .raced = true});
}

uint32_t mw__plane_walk_run(mw_plane_walk *walk)
{
    static uint32_t (*const kernels[2][2])(mw_plane_walk *) = {
        {plane_walk_alone, plane_walk_alone_count}, {plane_walk_raced, plane_walk_raced_count}};
    return kernels[walk->found != NULL][walk->work != NULL](walk);
}

static void probe_trace_add(mw_probe_trace *trace, uint32_t triangle)
{
    if (trace->count < trace->capacity) {
        trace->triangles[trace->count] = triangle;
        if (trace->iteration) trace->iteration[trace->count] = trace->walk;
    }
    trace->count++;
}

uint32_t mw__plane_walk_trace(mw_plane_walk *walk, mw_probe_trace *trace)
{
    mw_plane_walk_verdict verdict;
    do {
        probe_trace_add(trace, walk->t);
        verdict = plane_walk_step(walk, (mw_plane_walk_policy){.count = true, .raced = false});
    } while (verdict == MW_PLANE_WALK_GO);
    return verdict == MW_PLANE_WALK_TOUCH ? walk->t : MW_NONE;
}
