/* delaunay_grow.c - insertion of a point: walk, split, flip [Lawson 1977; Guibas, Stolfi 1985].
 *
 *            c
 *           /|\  n
 *          / | \
 *         /  q  \  d
 *        /.-' '-.\
 *       a---------b
 *
 * The facet that holds q is split in three, all with q as vertex 2. Then the edges opposite to q
 * are tested, once round: if the facet n beyond edge ab has q in its circle, ab is flipped to the
 * edge qd, and the two edges behind it are tested instead. The result is the Delaunay
 * triangulation: only facets with q in their circle have been removed. A ghost is a facet with the
 * vertex at infinity: its circle is the open half plane beyond its hull edge, and the inside of
 * that edge. A point on an edge or beyond the hull needs no special case: splitting gives flat
 * facets, and their edges are flipped at once, as the inside of a chord lies inside the circle.
 *
 * The walk is the remembering walk [thesis, App. A, sec. 2], which ends on every Delaunay
 * triangulation; it begins at the point inserted before. A point on a circle does not count as in
 * it, so with several points on one circle each order of insertion gives a Delaunay triangulation,
 * but not always the same one. */
#include "triangulate/delaunay/delaunay_grow.h"

#include "mesh/mesh.h"

/* A vertex as seen from q: its position relative to q, and the square of its distance.
 *
 * The vertex at infinity is the row 0, 0, far: with it the circle test of three vertices is far
 * times the orientation test of the other two, so the filter below serves ghosts as well. `far` is
 * no less than any lift. */
typedef struct lifted {
    double x, y, lift;
    uint32_t vertex;
} lifted;

static MW_INLINE lifted growth_lifted(const mw_growth *g, uint32_t vertex, mw_point q)
{
    if (MW_UNLIKELY(vertex == g->infinity)) return (lifted){0, 0, g->far, vertex};
    double x = g->point[vertex].x - q.x, y = g->point[vertex].y - q.y;
    return (lifted){x, y, x * x + y * y, vertex};
}

static bool value_strictly_between(double a, double b, double q)
{
    return (a < q && q < b) || (b < q && q < a);
}

/* Is q inside the edge ab, on whose line it lies? */
static bool edge_holds_point(mw_point a, mw_point b, mw_point q)
{
    return a.x != b.x ? value_strictly_between(a.x, b.x, q.x)
                      : value_strictly_between(a.y, b.y, q.y);
}

static __attribute__((noinline)) bool growth_in_circle_exact(const mw_growth *g, uint32_t a,
                                                             uint32_t b, uint32_t c, mw_point q)
{
    const mw_point *p = g->point;
    if (a != g->infinity && b != g->infinity && c != g->infinity)
        return mw__incircle_sign(p[a], p[b], p[c], q) > 0;
    uint32_t from = a == g->infinity ? b : b == g->infinity ? c : a;
    uint32_t to = a == g->infinity ? c : b == g->infinity ? a : b;
    double side = mw__orient2d(p[from], p[to], q);
    return side > 0 || (side == 0 && edge_holds_point(p[from], p[to], q));
}

/* Is q inside the circle of the counter-clockwise facet a, b, c? The filter is that of mw__incircle
 * with a bound that is cheaper: a permanent |bx cy| + |by cx| is at most the product of the two
 * lengths, so at most the mean of the two lifts, and the sum of lift times permanent at most ab +
 * bc + ca of the lifts. These are off by less than 8u, u = 2^-53; 11u instead of 10u covers that
 * and the rounding of the bound. */
#define CIRCLE_ERROR (11.0 * 0x1p-53)

/* On a lattice, such as that of integers, many points lie on one circle, and no error bound
 * decides. But let all coordinates be multiples of u, and let the lifts a, b, c add up to S < 2^26
 * u^2. Then each product of a lift and a minor is a multiple of u^4, and all together are at most
 * ab + bc + ca <= S^2 / 3 < 2^52 u^4: nothing is rounded. The same holds for the two products of
 * the orientation test. The powers of u must not under- or overflow. */
#define LATTICE_LIFTS 0x1p26
#define LATTICE_LEAST 0x1p-250
#define LATTICE_MOST 0x1p230
static MW_INLINE bool lifted_in_circle(const mw_growth *g, const lifted *a, const lifted *b,
                                       const lifted *c, mw_point q)
{
    double det = a->lift * (b->x * c->y - b->y * c->x) + b->lift * (c->x * a->y - c->y * a->x) +
                 c->lift * (a->x * b->y - a->y * b->x);
    double bound =
        CIRCLE_ERROR * (a->lift * b->lift + c->lift * (a->lift + b->lift)) + g->underflow;
    if (MW_LIKELY(fabs(det) > bound) || a->lift + b->lift + c->lift < g->lattice) return det > 0;
    return growth_in_circle_exact(g, a->vertex, b->vertex, c->vertex, q);
}

/* Is q strictly to the right of the directed edge ab? */
static MW_INLINE bool edge_lies_beyond(const mw_growth *g, const lifted *a, const lifted *b,
                                       mw_point q)
{
    double left = a->x * b->y, right = a->y * b->x, det = left - right;
    if (MW_LIKELY(fabs(det) > mw__orient2d_bound(left, right)) || a->lift + b->lift < g->lattice)
        return det < 0;
    return mw__orient2d_exact(g->point[a->vertex], g->point[b->vertex], q) < 0;
}

/* Where a walk has come to: the facet and the edge it was entered by, and its vertices, v[0] and
 * v[1] those of the edge. */
typedef struct found {
    uint32_t link;
    lifted v[3];
} found;

/* The last facet, or, where that is a ghost, the one across the hull edge. */
static MW_INLINE uint32_t growth_start(const mw_growth *g)
{
    const mw_facet *f = &g->facet[g->last];
    for (uint32_t k = 0; k < 3; k++)
        if (MW_UNLIKELY(f->v[k] == g->infinity)) return mw__link_triangle(f->link[mw__next(k)]);
    return g->last;
}

/* The walk from the last facet to one whose circle holds q: that contains q, or a ghost with q
 * beyond its edge. */
static MW_INLINE found growth_walk(mw_growth *g, mw_point q)
{
    uint32_t link = mw__link(growth_start(g), 0);
    const mw_facet *f = &g->facet[mw__link_triangle(link)];
    lifted a = growth_lifted(g, f->v[0], q), b = growth_lifted(g, f->v[1], q),
           c = growth_lifted(g, f->v[2], q);
    g->visited++;
    if (edge_lies_beyond(g, &a, &b, q)) {
        link = f->link[0], c = a, a = b, b = c;
    } else if (edge_lies_beyond(g, &b, &c, q)) {
        link = f->link[1], a = c;
    } else if (edge_lies_beyond(g, &c, &a, q)) {
        link = f->link[2], b = c;
    } else {
        return (found){link, {a, b, c}};
    }
    for (;;) {
        uint32_t e = mw__link_edge(link);
        f = &g->facet[mw__link_triangle(link)];
        c = growth_lifted(g, f->v[mw__prev(e)], q);
        g->visited++;
        if (MW_UNLIKELY(c.vertex == g->infinity)) break;
        if (edge_lies_beyond(g, &b, &c, q))
            link = f->link[mw__next(e)], a = c;
        else if (edge_lies_beyond(g, &c, &a, q))
            link = f->link[mw__prev(e)], b = c;
        else
            break;
    }
    return (found){link, {a, b, c}};
}

static MW_INLINE void facet_set_link(mw_growth *g, uint32_t from, uint32_t to)
{
    g->facet[mw__link_triangle(from)].link[mw__link_edge(from)] = to;
}

/* Facet t becomes a, b, q with the facet `outer` beyond ab, `next` beyond bq and `prev` beyond
 * qa. */
static MW_INLINE void facet_set(mw_growth *g, uint32_t t, const uint32_t v[3], uint32_t outer,
                                uint32_t next, uint32_t prev)
{
    g->facet[t] = (mw_facet){{v[0], v[1], v[2]}, {outer, mw__link(next, 2), mw__link(prev, 1)}};
    facet_set_link(g, outer, mw__link(t, 0));
}

/* Split the facet that holds q into three round q. The first keeps the number of the facet. */
static MW_INLINE void facet_split(mw_growth *g, const found *at, uint32_t q)
{
    uint32_t e = mw__link_edge(at->link), a = at->v[0].vertex, b = at->v[1].vertex,
             c = at->v[2].vertex;
    uint32_t first = mw__link_triangle(at->link), second = g->facet_count++,
             third = g->facet_count++;
    const mw_facet old = g->facet[first];
    facet_set(g, first, (uint32_t[]){a, b, q}, old.link[e], second, third);
    facet_set(g, second, (uint32_t[]){b, c, q}, old.link[mw__next(e)], third, first);
    facet_set(g, third, (uint32_t[]){c, a, q}, old.link[mw__prev(e)], first, second);
}

/* Restore the Delaunay property round q: facet t is a, b, q, the next one counter-clockwise lies
 * beyond bq. */
static MW_INLINE void growth_flip_round(mw_growth *g, uint32_t first, lifted a, lifted b,
                                        mw_point q)
{
    uint32_t t = first;
    for (;;) {
        mw_facet *f = &g->facet[t];
        uint32_t outer = f->link[0], n = mw__link_triangle(outer), e = mw__link_edge(outer);
        mw_facet *beyond_ab = &g->facet[n];
        lifted d = growth_lifted(g, beyond_ab->v[mw__prev(e)], q);
        if (lifted_in_circle(g, &b, &a, &d,
                             q)) { /* a, b, q and b, a, d become a, d, q and d, b, q */
            uint32_t over_ad = beyond_ab->link[mw__next(e)], over_db = beyond_ab->link[mw__prev(e)];
            uint32_t next = mw__link_triangle(f->link[1]);
            f->v[1] = d.vertex;
            f->link[0] = over_ad;
            f->link[1] = mw__link(n, 2);
            facet_set_link(g, over_ad, mw__link(t, 0));
            facet_set(g, n, (uint32_t[]){d.vertex, b.vertex, f->v[2]}, over_db, next, t);
            facet_set_link(g, mw__link(next, 2), mw__link(n, 1));
            b = d;
        } else {
            t = mw__link_triangle(f->link[1]);
            if (t == first) return;
            a = b;
            b = growth_lifted(g, g->facet[t].v[1], q);
        }
    }
}

void mw__grow_prepare(mw_growth *g, uint32_t point_count, double width, double height, double unit)
{
    g->infinity = point_count;
    g->lattice = unit >= LATTICE_LEAST && unit <= LATTICE_MOST ? LATTICE_LIFTS * unit * unit : 0;
    /* so no ghost passes for a part of the lattice */
    g->far = fmax(2 * (width * width + height * height), g->lattice);
    /* 12 * 2^-1075 times the sum of the lifts (see mw__incircle), which is below 3 far, or times
     * 1 */
    g->underflow = 0x1p-1069 * fmax(g->far, 1);
}

void mw__grow_begin(mw_growth *g, const uint32_t first[3])
{
    const mw_point *p = g->point;
    uint32_t v[3] = {first[0], first[1], first[2]}, t = g->facet_count;
    if (mw__orient2d(p[v[0]], p[v[1]], p[v[2]]) < 0) {
        v[1] = first[2];
        v[2] = first[1];
    }
    g->facet[t] = (mw_facet){{v[0], v[1], v[2]},
                             {mw__link(t + 1, 0), mw__link(t + 2, 0), mw__link(t + 3, 0)}};
    for (uint32_t k = 0; k < 3; k++) /* the ghost of edge k */
        g->facet[t + k + 1] = (mw_facet){
            {v[mw__next(k)], v[k], g->infinity},
            {mw__link(t, k), mw__link(t + mw__prev(k) + 1, 2), mw__link(t + mw__next(k) + 1, 1)}};
    g->facet_count = t + 4;
    g->last = t;
}

uint32_t mw__grow(mw_growth *g, uint32_t point)
{
    mw_point q = g->point[point];
    found at = growth_walk(g, q);
    g->last = mw__link_triangle(at.link);
    for (int k = 0; k < 3; k++)
        if (at.v[k].x == 0 && at.v[k].y == 0 && at.v[k].vertex != g->infinity)
            return at.v[k].vertex;
    facet_split(g, &at, point);
    growth_flip_round(g, g->last, at.v[0], at.v[1], q);
    return point;
}
