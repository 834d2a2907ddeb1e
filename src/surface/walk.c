/* walk.c - the walk along a plane through the line [thesis App. G, Alg. 2].
 *
 *        l                 The plane holds the line and a point o of the first triangle. Seen along the line, it is
 *       /|\                another line, that passes through q. Follow it over the surface: with r and l the ends of
 *   o  / | \ s   . q       the edge just crossed, l above the plane and r not above it, and s the third vertex, the
 *   ---r-|--'---'---       plane leaves over rs where s lies above it, over sl otherwise: one test a triangle. A second
 *       \|/                test, of the edge by which it leaves, tells whether the line is ahead or behind; where that
 *        '                 changes, the triangle is tested in full: does m point at its front, is it in reach?
 *
 * m points at the front of the first triangle, which is therefore clockwise seen along m: the plane leaves it towards
 * the line over the edge that goes up, from a vertex not above the plane to one above it, and away from the line over
 * the edge that goes down. There are one of each, or none.
 * A vertex in the plane counts as not above it: the walk follows a plane that is moved a little upwards, parallel to
 * itself, and meets no vertex. Where an edge passes the line on neither side (test 0), the triangles at it are tested
 * in full. What the tests along the way say only tells where to look; nothing is decided by it.
 * o is the middle of the first triangle, rounded. Where rounding has moved it so far that the plane does not cut the
 * triangle, or where it lies on the line and spans no plane with it, a corner is taken. One corner does, as not all
 * edges of a triangle whose front m points at lie in planes with the line.
 * Departures from the printed pseudocode: a border ends a walk. Here it goes back to the first triangle, on over the
 * other edge, and ends at the next border: so it visits all of the slice that it began in. And the mark, which changes
 * at every triangle that the line meets, is the sign of the last test: the same but where tests are 0.
 *
 * Ends, on any surface, without visiting a triangle twice. Whether a vertex is above the plane does not change during
 * a walk, so every triangle has two edges with ends on different sides, or none. Links join edges in pairs, with the
 * same ends. So the triangles of the first kind, joined by links over such edges, form cycles and chains without forks;
 * the way back is as determined as the way forth. A walk follows one of them: a cycle until it is back at its first
 * triangle, a chain to one end and then to the other. That holds for neighbours of other orientation too, as l and r
 * are told apart by their sides, not by their order; with vertices that are not finite, which count as not above; and
 * in a welded surface, where the vertices that were made one, but may have been moved apart since, all have the place
 * of the lowest of them. The bound on steps is the number of triangles. */
#include "surface/walk.h"

/* How a kernel works. Always a literal where a kernel is stamped. */
typedef struct mw_slice_policy {
    bool count, raced;
} mw_slice_policy;

/* --- vocabulary --- */

/* The number of a vertex of the current triangle, and where it is. */
static MW_INLINE uint32_t name(const mw_slice *w, uint32_t k)
{
    uint32_t v = w->tri[w->t].v[k];
    return MW_UNLIKELY(w->place != NULL) ? w->place[v] : v;
}

static MW_INLINE const double *at(const mw_slice *w, uint32_t v)
{
    return w->point + 3 * (size_t)v;
}

/* The plane through o and the line. */
static void span(mw_slice *w)
{
    const double *q = w->search->line.q, *m = w->search->line.m;
    double u[3] = {w->o[0] - q[0], w->o[1] - q[1], w->o[2] - q[2]};
    for (uint32_t k = 0; k < 3; k++) {
        double left = m[mw__next(k)] * u[mw__prev(k)], right = m[mw__prev(k)] * u[mw__next(k)];
        w->n[k] = left - right;
        w->sum[k] = fabs(left) + fabs(right);
    }
}

/* mw__side(line, o, v) > 0, exactly; but its filter is n . (v - q), with n at hand. The bound is that of line.h: a
 * component of n is off by (3u + ...) of its sum, as one of its factors is rounded; the product with a difference by
 * (5u + ...), and from there on all is as there. Underflow: as there, with the differences below 2^100. */
static MW_INLINE bool is_above(mw_slice *w, uint32_t v, mw_slice_policy P)
{
    if (P.count) w->work->tests++;
    const double *p = at(w, v), *q = w->search->line.q;
    double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    double side = w->n[0] * x + w->n[1] * y + w->n[2] * z;
    double permanent = w->sum[0] * fabs(x) + w->sum[1] * fabs(y) + w->sum[2] * fabs(z);
    bool small = fabs(x) + fabs(y) + fabs(z) < MW_SIDE_MOTION;
    if (MW_LIKELY(small && fabs(side) > MW_SIDE_ERROR * permanent + MW_UNDERFLOW_ERROR)) return side > 0;
    return mw__side_exact(&w->search->line, w->o, p) > 0;
}

/* Does the plane meet the line behind edge rl, or before it? */
static MW_INLINE int side_of_line(mw_slice *w, uint32_t r, uint32_t l, mw_slice_policy P)
{
    if (P.count) w->work->tests++;
    double side = mw__side(&w->search->line, at(w, r), at(w, l));
    return (side > 0) - (side < 0);
}

static MW_INLINE bool is_touched(mw_slice *w, mw_slice_policy P)
{
    const mw_search *s = w->search;
    if (P.count) w->work->tests++;
    if (!mw__touches(s->surface, &s->line, w->t)) return false;
    if (P.count) w->work->intersections++;
    return mw__in_reach(s->surface, &s->line, w->t, s->reach);
}

static MW_INLINE mw_course enter(mw_slice *w, uint32_t link, mw_slice_policy P)
{
    if (MW_UNLIKELY(link == MW_NONE || mw__link_triangle(link) == w->first)) return MW_COURSE_END;
    if (MW_UNLIKELY(w->fuel == 0)) return MW_COURSE_END;
    w->fuel--;
    w->t = mw__link_triangle(link);
    w->e = mw__link_edge(link);
    if (P.count) w->work->triangles++;
    return MW_COURSE_GO;
}

/* At a border: from the first triangle on over its other edge, whose first end is above the plane. */
static MW_INLINE mw_course turn(mw_slice *w, mw_slice_policy P)
{
    if (w->turned) return MW_COURSE_END;
    w->turned = true;
    w->t = w->first;
    w->l = name(w, w->back);
    w->r = name(w, w->back + 1);
    w->side = side_of_line(w, w->r, w->l, P);
    return enter(w, w->tri[w->t].link[w->back], P);
}

/* Leave over edge e = rl, unless the line is touched on the way to it. */
static MW_INLINE mw_course leave(mw_slice *w, uint32_t e, uint32_t r, uint32_t l, mw_slice_policy P)
{
    int side = side_of_line(w, r, l, P);
    bool met = side != w->side || side == 0;
    w->r = r;
    w->l = l;
    w->side = side;
    if (MW_UNLIKELY(met) && is_touched(w, P)) return MW_COURSE_TOUCH;
    uint32_t link = w->tri[w->t].link[e];
    return MW_UNLIKELY(link == MW_NONE) ? turn(w, P) : enter(w, link, P);
}

/* --- steps --- */

/* The edge of the current triangle that goes up through the plane; MW_NONE: none. Sets `back`, the edge that goes
 * down. */
static MW_INLINE uint32_t edge_up(mw_slice *w, mw_slice_policy P)
{
    bool above[4];
    uint32_t up = MW_NONE;
    for (uint32_t k = 0; k < 3; k++) above[k] = is_above(w, name(w, k), P);
    above[3] = above[0];
    for (uint32_t k = 0; k < 3; k++) {
        if (!above[k] && above[k + 1]) up = k;
        if (above[k] && !above[k + 1]) w->back = k;
    }
    return up;
}

static void set_middle(mw_slice *w)
{
    const double *a = at(w, name(w, 0)), *b = at(w, name(w, 1)), *c = at(w, name(w, 2));
    for (int i = 0; i < 3; i++) w->o[i] = a[i] / 3 + b[i] / 3 + c[i] / 3;
    span(w);
}

static void set_corner(mw_slice *w, uint32_t k)
{
    const double *a = at(w, name(w, k));
    for (int i = 0; i < 3; i++) w->o[i] = a[i];
    span(w);
}

/* The first triangle: the plane, and the way to the line. No plane cuts it only where welded vertices have been
 * moved apart. */
static MW_INLINE mw_course aim(mw_slice *w, mw_slice_policy P)
{
    set_middle(w);
    uint32_t up = edge_up(w, P);
    for (uint32_t k = 0; MW_UNLIKELY(up == MW_NONE) && k < 3; k++) {
        set_corner(w, k);
        up = edge_up(w, P);
    }
    if (MW_UNLIKELY(up == MW_NONE)) return is_touched(w, P) ? MW_COURSE_TOUCH : MW_COURSE_END;
    w->side = 1;
    return leave(w, up, name(w, up), name(w, up + 1), P);
}

/* Entered over edge e = rl, or lr, as its orientation and the way say. */
static MW_INLINE mw_course follow(mw_slice *w, mw_slice_policy P)
{
    uint32_t s = name(w, mw__prev(w->e));
    bool above = is_above(w, s, P), begins_above = name(w, w->e) == w->l;
    uint32_t out = above == begins_above ? mw__next(w->e) : mw__prev(w->e);
    return leave(w, out, above ? w->r : s, above ? s : w->l, P);
}

static MW_INLINE mw_course step(mw_slice *w, mw_slice_policy P)
{
    if (P.raced && atomic_load_explicit(w->found, memory_order_relaxed) != MW_NONE) return MW_COURSE_END;
    return MW_LIKELY(w->e != MW_SLICE_FIRST) ? follow(w, P) : aim(w, P);
}

/* --- from begin to end --- */

mw_slice mw__slice_begin(const mw_search *search, uint32_t t, const _Atomic uint32_t *found, mw_probe_counters *work)
{
    const mw_surface *surface = search->surface;
    if (work) work->triangles++;
    return (mw_slice){.search = search,
                      .point = surface->point,
                      .tri = surface->tri,
                      .place = surface->place,
                      .first = t,
                      .t = t,
                      .e = MW_SLICE_FIRST,
                      .fuel = search->steps - 1,
                      .found = found,
                      .work = work};
}

static MW_INLINE uint32_t run(mw_slice *walk, mw_slice_policy P)
{
    mw_slice w = *walk; /* a local copy can live in registers */
    mw_course course;
    do {
        course = step(&w, P);
    } while (course == MW_COURSE_GO);
    return course == MW_COURSE_TOUCH ? w.t : MW_NONE;
}

static uint32_t run_alone(mw_slice *walk)
{
    return run(walk, (mw_slice_policy){.count = false, .raced = false});
}

static uint32_t run_alone_count(mw_slice *walk)
{
    return run(walk, (mw_slice_policy){.count = true, .raced = false});
}

static uint32_t run_raced(mw_slice *walk)
{
    return run(walk, (mw_slice_policy){.count = false, .raced = true});
}

static uint32_t run_raced_count(mw_slice *walk)
{
    return run(walk, (mw_slice_policy){.count = true, .raced = true});
}

uint32_t mw__slice_run(mw_slice *walk)
{
    static uint32_t (*const kernels[2][2])(mw_slice *) = {{run_alone, run_alone_count}, {run_raced, run_raced_count}};
    return kernels[walk->found != NULL][walk->work != NULL](walk);
}

static void write_down(mw_trace *trace, uint32_t triangle)
{
    if (trace->count < trace->capacity) {
        trace->triangles[trace->count] = triangle;
        if (trace->iteration) trace->iteration[trace->count] = trace->walk;
    }
    trace->count++;
}

uint32_t mw__slice_trace(mw_slice *walk, mw_trace *trace)
{
    mw_course course;
    do {
        write_down(trace, walk->t);
        course = step(walk, (mw_slice_policy){.count = true, .raced = false});
    } while (course == MW_COURSE_GO);
    return course == MW_COURSE_TOUCH ? walk->t : MW_NONE;
}
