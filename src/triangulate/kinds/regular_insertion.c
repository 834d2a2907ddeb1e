/* regular_insertion.c - one more point in a regular triangulation [Bowyer 1981; Watson 1981;
 * Edelsbrunner, Shah 1996].
 *
 * Lift each point x of weight w to the height |x|^2 - w. The triangulation is the lower hull of
 * the lifted points, seen from below. A new point p takes away the facets that its lifted point
 * lies below: they are connected, hold p, and see it, so the star of p fills their place. If the
 * facet that holds p is not among them, none is: p is hidden. Vertices that all facets are taken
 * from are hidden by p.
 *
 * Beyond an edge ab of the hull the ghost facet is the vertical plane through the lifted a and b:
 * p is below it where it lies beyond the edge, and on the line through the edge, where its lifted
 * point lies below the line through the lifted a and b. So two facets at one edge always agree
 * about a point on the line through it, and no facet of the star is flat.
 *
 * Points are found by walking. In a regular triangulation no walk goes round in a circle
 * [Edelsbrunner 1990]; where more than three lifted points lie on one plane, their triangles may
 * be of any kind, so a coin is tossed. */
#include "triangulate/kinds/regular_insertion.h"

#include "base/random.h"
#include "predicates/power.h"

#include <stdlib.h>

typedef struct mw_regular_edge {
    uint32_t from, to; /* vertices; the cavity lies to the left */
    uint32_t outer;    /* the half-edge beyond */
} mw_regular_edge;

/* --- memory --- */

bool mw__regular_create(mw_regular *r, const mw_point *point, const double *weight,
                        const uint32_t *number, uint32_t n)
{
    size_t facets = 2 * (size_t)n + 2;
    *r = (mw_regular){
        .point = point, .weight = weight, .number = number, .point_count = n, .random = 1};
    r->facet = mw__alloc_lines(facets, sizeof *r->facet);
    r->freed = mw__alloc(facets, sizeof *r->freed);
    r->facet_at = mw__alloc((size_t)n + 1, sizeof *r->facet_at);
    r->cavity = mw__alloc(facets, sizeof *r->cavity);
    r->edge = mw__alloc(facets, sizeof *r->edge);
    return r->facet && r->freed && r->facet_at && r->cavity && r->edge;
}

void mw__regular_release(mw_regular *r)
{
    free(r->facet);
    free(r->freed);
    free(r->facet_at);
    free(r->cavity);
    free(r->edge);
}

static uint32_t facet_new(mw_regular *r, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t t = r->freed_count ? r->freed[--r->freed_count] : r->facet_count++;
    r->facet[t] = (mw_triangle){.v = {a, b, c, a}, .link = {MW_NONE, MW_NONE, MW_NONE}, .user = 0};
    return t;
}

static void facet_link(mw_regular *r, uint32_t half, uint32_t other)
{
    r->facet[mw__link_triangle(half)].link[mw__link_edge(half)] = other;
    r->facet[mw__link_triangle(other)].link[mw__link_edge(other)] = half;
}

void mw__regular_begin(mw_regular *r, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t v[4] = {a, b, c, a}, t = facet_new(r, a, b, c), ghost[3];
    for (uint32_t k = 0; k < 3; k++) {
        ghost[k] = facet_new(r, v[k + 1], v[k], MW_NONE);
        facet_link(r, mw__link(t, k), mw__link(ghost[k], 0));
    }
    /* edge 1 of a ghost goes from the start of its edge of the triangle to infinity, edge 2 comes
     * back to the end */
    for (uint32_t k = 0; k < 3; k++)
        facet_link(r, mw__link(ghost[k], 2), mw__link(ghost[mw__next(k)], 1));
    r->last = t;
}

/* --- tests --- */

static mw_weighted_point weighted_point(const mw_regular *r, uint32_t v)
{
    return (mw_weighted_point){r->point[v], r->weight[v]};
}

/* The corner of a ghost facet that is at infinity; 3 of a triangle. */
static uint32_t facet_infinite_corner(const mw_triangle *f)
{
    for (uint32_t k = 0; k < 3; k++)
        if (f->v[k] == MW_NONE) return k;
    return 3;
}

/* Does the lifted p lie below facet t? */
static bool facet_is_above(const mw_regular *r, uint32_t t, uint32_t p)
{
    const mw_triangle *f = &r->facet[t];
    uint32_t infinite = facet_infinite_corner(f);
    if (infinite == 3) {
        mw_weighted_point w[4] = {weighted_point(r, f->v[0]), weighted_point(r, f->v[1]),
                                  weighted_point(r, f->v[2]), weighted_point(r, p)};
        return mw__power(w) > 0;
    }
    uint32_t a = f->v[mw__next(infinite)], b = f->v[mw__prev(infinite)];
    double side = mw__orient2d(r->point[a], r->point[b], r->point[p]);
    if (side != 0) return side > 0;
    mw_weighted_point w[3] = {weighted_point(r, a), weighted_point(r, b), weighted_point(r, p)};
    return mw__power_on_line(w) > 0;
}

/* --- finding p --- */

static bool facet_is_beyond(const mw_regular *r, const mw_triangle *f, uint32_t k, mw_point q)
{
    return mw__orient2d(r->point[f->v[k]], r->point[f->v[k + 1]], q) < 0;
}

/* The facet that p lies in, or a ghost facet whose edge it lies beyond. */
static uint32_t facet_find(mw_regular *r, uint32_t p)
{
    mw_point q = r->point[p];
    uint32_t t = r->last, entry = 3, infinite = facet_infinite_corner(&r->facet[t]);
    if (infinite < 3) t = mw__link_triangle(r->facet[t].link[mw__next(infinite)]);
    for (;;) {
        const mw_triangle *f = &r->facet[t];
        uint32_t out = 3, k = (uint32_t)(mw__toss(&r->random) * 3 >> 32);
        r->visited++;
        for (int i = 0; i < 3 && out == 3; i++, k = mw__next(k))
            if (k != entry && facet_is_beyond(r, f, k, q)) out = k;
        if (out == 3) return t;
        uint32_t link = f->link[out];
        t = mw__link_triangle(link);
        entry = mw__link_edge(link);
        if (facet_infinite_corner(&r->facet[t]) < 3) return t;
    }
}

/* --- the cavity --- */

/* The facets above p from facet `first` on, and the edges round them. Returns the number of
 * facets; *edges that of edges. */
static uint32_t facets_dig(mw_regular *r, uint32_t first, uint32_t p, uint32_t *edges)
{
    uint32_t count = 1, mark = p + 1;
    r->cavity[0] = first;
    r->facet[first].user = mark;
    *edges = 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t t = r->cavity[i], outer = r->facet[t].link[k], next = mw__link_triangle(outer);
            if (r->facet[next].user == mark) continue;
            if (facet_is_above(r, next, p)) {
                r->facet[next].user = mark;
                r->cavity[count++] = next;
            } else {
                r->edge[(*edges)++] =
                    (mw_regular_edge){r->facet[t].v[k], r->facet[t].v[k + 1], outer};
            }
        }
    return count;
}

static uint32_t *vertex_facet(mw_regular *r, uint32_t v)
{
    return &r->facet_at[v == MW_NONE ? r->point_count : v];
}

/* Put the star of p in the place of the cavity. */
static void facets_fill_star(mw_regular *r, uint32_t count, uint32_t edges, uint32_t p)
{
    for (uint32_t i = 0; i < count; i++) {
        r->facet[r->cavity[i]].user = MW_REGULAR_FREED;
        r->freed[r->freed_count++] = r->cavity[i];
    }
    for (uint32_t i = 0; i < edges; i++) {
        const mw_regular_edge *e = &r->edge[i];
        uint32_t t = facet_new(r, e->from, e->to, p);
        facet_link(r, mw__link(t, 0), e->outer);
        *vertex_facet(r, e->from) = t;
        r->last = t;
    }
    for (uint32_t i = 0; i < edges; i++) {
        const mw_regular_edge *e = &r->edge[i];
        facet_link(r, mw__link(*vertex_facet(r, e->from), 1), mw__link(*vertex_facet(r, e->to), 2));
    }
}

/* --- equal points --- */

/* p lies in facet t and is hidden. If it equals a vertex in weight, too, it takes the place of
 * that if it is lower. */
static void vertex_take_over(mw_regular *r, uint32_t t, uint32_t p)
{
    uint32_t k = 0, v;
    while (k < 3 && !mw__points_equal(r->point[r->facet[t].v[k]], r->point[p])) k++;
    if (k == 3 || r->number[v = r->facet[t].v[k]] < r->number[p]) return;
    if (weighted_point(r, v).weight != weighted_point(r, p).weight) return;
    uint32_t half = mw__link(t, k);
    do {
        mw_triangle *f = &r->facet[mw__link_triangle(half)];
        f->v[mw__link_edge(half)] = p;
        f->v[3] = f->v[0];
        /* the edge that comes in, from beyond: it leaves */
        half = mw__half_link(r->facet, mw__half_prev(half));
    } while (mw__link_triangle(half) != t);
}

void mw__regular_insert(mw_regular *r, uint32_t p)
{
    uint32_t t = facet_find(r, p), edges;
    if (!facet_is_above(r, t, p)) {
        vertex_take_over(r, t, p);
        r->last = t;
        return;
    }
    uint32_t count = facets_dig(r, t, p, &edges);
    facets_fill_star(r, count, edges, p);
}
