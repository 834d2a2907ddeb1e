/* hole.c - digging: along the boundary, counter-clockwise, where the tile beyond a step goes, its two other edges are steps instead.
 *
 * No tile is met twice, for a vertex all of whose tiles were in the hole would lie where q does. As tiles bring steps by twos, circles are
 * tested by twos, in the two halves of vectors. Whether a tile goes nobody can guess, a processor neither, which begins
 * again where it was wrong. So the neighbours of the first tile, of which two in three go, are looked at together with what lies beyond them, before
 * anything follows. */
#include "edit/hole.h"

#include "edit/fabric_memory.h"
#include "edit/stitch.h"

/* --- room -------------------------------------------------------------------------------------------------------------- */

/* Where the lists end. */
typedef struct ends {
    mw_rim_step *rim;
    mw_step_ahead *ahead;
    mw_lifted_vertex *sight; /* the first of f->sight */
    uint32_t sights;
    uint32_t *pool, *full; /* no more tiles than up to there, as each brings a step, a step ahead and two sights */
} ends;

enum {
    SPARE = 8, /* what a hole without tiles needs                  */
    FEW = 56   /* tiles for which there is room in any case        */
};

/* `steps` are ahead at first. */
static size_t room_besides(const mw_hole *h, size_t steps)
{
    return h->first + h->pool + steps + SPARE;
}

/* The second hole is written behind the first, and takes none of its tiles. */
bool mw__hole_room(mw_fabric *f, size_t tiles)
{
    const mw_hole first = {.first = tiles + 3, .pool = tiles};
    return mw__rim_room(f, room_besides(&first, 3) + FEW);
}

static ends begin(const mw_fabric *f, const mw_hole *h, size_t steps, uint32_t sights)
{
    uint32_t *pool = f->pool + h->pool;
    return (ends){f->rim + h->first, f->ahead + steps,
                  f->sight,          sights,
                  pool + h->tiles,   pool + (f->rim_room - room_besides(h, steps))};
}

/* Room for twice as many tiles; the pool is still full when out of memory. */
static __attribute__((noinline)) ends widen(mw_fabric *f, const mw_hole *h, size_t steps, ends at)
{
    const size_t rim = (size_t)(at.rim - f->rim), ahead = (size_t)(at.ahead - f->ahead);
    const size_t pool = (size_t)(at.pool - f->pool);
    if (!mw__rim_room(f, 2 * f->rim_room)) return at;
    return (ends){f->rim + rim, f->ahead + ahead, f->sight,
                  at.sights,    f->pool + pool,   f->pool + h->pool + (f->rim_room - room_besides(h, steps))};
}

/* --- circles ------------------------------------------------------------------------------------------------------------ */

/* Two numbers, one of each of two steps. */
typedef double pair __attribute__((vector_size(16)));

/* Is the tile beyond a step to stay? `plain`: no edge is fixed, and the mesh is kept Delaunay. */
static MW_INLINE bool is_closed(const mw_fabric *f, const mw_step_ahead *step, bool plain)
{
    return step->beyond == MW_NONE || (!plain && (step->fixed || !f->delaunay));
}

/* The vertex of the tile beyond a step across from it. */
static MW_INLINE uint32_t apex_beyond(const mw_triangle *tri, uint32_t beyond)
{
    return tri[mw__link_triangle(beyond)].v[mw__prev(mw__link_edge(beyond))];
}

static __attribute__((noinline)) bool in_circle_exact(const mw_fabric *f, uint32_t a, uint32_t b, uint32_t c,
                                                      mw_point q)
{
    const mw_point *p = f->tiling->point;
    const mw_lifted_vertex *sight = f->sight;
    return mw__incircle_exact(p[sight[a].vertex], p[sight[b].vertex], p[sight[c].vertex], q) > 0;
}

/* By arithmetic, as a jump would be guessed wrong: one of two numbers. */
static MW_INLINE uint32_t choose(bool which, uint32_t yes, uint32_t no)
{
    return no ^ ((no ^ yes) & (0 - (uint32_t)which));
}

/* Does the tile beyond a step from f->sight[from] on go? Its apex is made f->sight[apex]. */
static MW_INLINE bool goes(const mw_fabric *f, mw_point q, uint32_t from, const mw_step_ahead *step, uint32_t apex,
                           bool plain)
{
    if (MW_UNLIKELY(is_closed(f, step, plain))) return false;
    const uint32_t v = apex_beyond(f->tiling->tri, step->beyond);
    const mw_lifted_vertex *a = &f->sight[from], *b = &f->sight[step->end], c = mw__lift_vertex(f->tiling, v, q);
    double bound, det = mw__lifted_incircle(b, a, &c, &bound);
    f->sight[apex] = c;
    if (MW_UNLIKELY(!(fabs(det) > bound))) return in_circle_exact(f, step->end, from, apex, q);
    return det > 0;
}

typedef struct two_go {
    bool one, two;
} two_go;

static __attribute__((noinline)) two_go each_goes(const mw_fabric *f, mw_point q, uint32_t from, mw_step_ahead one,
                                                  mw_step_ahead two, uint32_t apex, bool plain)
{
    two_go go = {.one = goes(f, q, from, &one, apex, plain)};
    go.two = goes(f, q, one.end, &two, apex + 1, plain);
    return go;
}

/* The same for two steps one after the other, and two apices. Where it is not `wanted` it may be wrong. */
static MW_INLINE two_go both_go(const mw_fabric *f, mw_point q, uint32_t from, const mw_step_ahead *one,
                                const mw_step_ahead *two, uint32_t apex, bool wanted, bool plain)
{
    const two_go neither = {false, false};
    if (MW_UNLIKELY(is_closed(f, one, plain) || is_closed(f, two, plain)))
        return wanted ? each_goes(f, q, from, *one, *two, apex, plain) : neither;
    const mw_triangle *tri = f->tiling->tri;
    mw_lifted_vertex *sight = f->sight;
    const uint32_t v1 = apex_beyond(tri, one->beyond), v2 = apex_beyond(tri, two->beyond);
    const mw_point *p1 = &f->tiling->point[v1], *p2 = &f->tiling->point[v2];
    const mw_lifted_vertex *a = &sight[from], *b = &sight[one->end], *c = &sight[two->end];
    const pair here = {q.x, q.y}, to1 = (pair){p1->x, p1->y} - here, to2 = (pair){p2->x, p2->y} - here;
    const pair x = {to1[0], to2[0]}, y = {to1[1], to2[1]}, lift = x * x + y * y;
    const pair from_x = {a->x, b->x}, from_y = {a->y, b->y}, from_lift = {a->lift, b->lift};
    const pair end_x = {b->x, c->x}, end_y = {b->y, c->y}, end_lift = {b->lift, c->lift};
    const pair lifts = from_lift + end_lift + lift;
    const pair det = end_lift * (from_x * y - from_y * x) + from_lift * (x * end_y - y * end_x) +
                     lift * (end_x * from_y - end_y * from_x);
    sight[apex] = (mw_lifted_vertex){to1[0], to1[1], lift[0], v1};
    sight[apex + 1] = (mw_lifted_vertex){to2[0], to2[1], lift[1], v2};
    const double both = lifts[0] + lifts[1], bound = both * both * MW_LIFTED_ERROR + MW_UNDERFLOW_ERROR;
    const double first = fabs(det[0]), second = fabs(det[1]);
    if (MW_UNLIKELY(!((first < second ? first : second) > bound)))
        return wanted ? each_goes(f, q, from, *one, *two, apex, plain) : neither;
    return (two_go){det[0] > 0, det[1] > 0};
}

/* --- along the boundary ------------------------------------------------------------------------------------------------- */

/* Number by number, since to read at once what was just written in parts would take until that has left for the cache. */
static MW_INLINE void put(mw_step_ahead *to, const mw_step_ahead *step, bool plain)
{
    to->end = step->end;
    to->beyond = step->beyond;
    to->apex = step->apex;
    if (!plain) to->fixed = step->fixed;
}

/* From f->sight[from] on: `step`, and after it those of f->ahead, `steps` of them, the last one first. */
static MW_INLINE bool dig(mw_fabric *f, mw_hole *h, uint32_t from, mw_step_ahead step, size_t steps, uint32_t sights,
                          bool plain)
{
    const size_t dug = h->tiles;
    const mw_point q = h->q;
    ends at = begin(f, h, steps, sights);
    for (;;) {
        while (step.apex != MW_NONE) {
            const uint32_t t = mw__link_triangle(step.beyond), e = mw__link_edge(step.beyond), next = mw__next(e),
                           prev = mw__prev(e), fixed = plain ? 0 : f->mark[t];
            const uint32_t *link = f->tiling->tri[t].link;
            if (MW_UNLIKELY(at.pool >= at.full)) at = widen(f, h, steps, at);
            if (MW_UNLIKELY(at.pool >= at.full)) return false;
            *at.pool++ = t;
            mw_step_ahead one = {.end = step.apex, .beyond = link[next], .fixed = fixed >> next & 1},
                          two = {.end = step.end, .beyond = link[prev], .fixed = fixed >> prev & 1};
            const two_go go = both_go(f, q, from, &one, &two, at.sights, true, plain);
            two.apex = choose(go.two, at.sights + 1, MW_NONE);
            put(at.ahead++, &two, plain);
            one.apex = at.sights;
            put(&step, &one, plain);
            at.sights += 2;
            if (!go.one) break; /* with an apex that nobody looks at */
        }
        at.rim->vertex = at.sight[from].vertex;
        at.rim->beyond = step.beyond;
        if (!plain) at.rim->fixed = step.fixed;
        at.rim++;
        from = step.end;
        if (at.ahead == f->ahead) break;
        put(&step, --at.ahead, plain);
    }
    at.rim->vertex = at.sight[from].vertex;
    h->steps = (size_t)(at.rim - f->rim) - h->first;
    h->tiles = (size_t)(at.pool - f->pool) - h->pool;
    f->flips += (uint32_t)(h->tiles - dug);
    return true;
}

/* --- from where --------------------------------------------------------------------------------------------------------- */

/* Tile t goes: room for what it and its neighbours bring. */
static MW_INLINE bool begin_with(mw_fabric *f, mw_hole *h, uint32_t t)
{
    if (!mw__rim_room(f, room_besides(h, 3) + FEW)) return false;
    f->pool[h->pool] = t;
    h->tiles = 1;
    return true;
}

/* The edge k of tile t, which goes, as a step up to a sight. */
static MW_INLINE mw_step_ahead edge_of(const mw_fabric *f, uint32_t t, uint32_t k, uint32_t end, bool plain)
{
    return (mw_step_ahead){.end = end, .beyond = f->tiling->tri[t].link[k], .fixed = !plain && f->mark[t] >> k & 1};
}

/* Put edge k of the first tile, `step`, ahead, behind `steps` others; or, where the tile beyond goes, the two steps in its place. Returns how many are ahead
 * then. Sights: 3 + k is the apex of the tile beyond, 6 + 2 k and the one after it are those of the tiles beyond that. */
static MW_INLINE size_t put_neighbour(mw_fabric *f, mw_hole *h, size_t steps, uint32_t k, const mw_step_ahead *step,
                                      bool gone, bool plain)
{
    const uint32_t t = mw__link_triangle(step->beyond), e = mw__link_edge(step->beyond), apex = 3 + k, next = 6 + 2 * k;
    mw_step_ahead one = edge_of(f, t, mw__next(e), apex, plain), two = edge_of(f, t, mw__prev(e), step->end, plain);
    const two_go go = both_go(f, h->q, k, &one, &two, next, gone, plain);
    one.apex = choose(go.one, next, MW_NONE);
    two.apex = choose(gone & go.two, next + 1, MW_NONE);
    two.beyond = choose(gone, two.beyond, step->beyond);
    if (!plain && !gone) two.fixed = step->fixed;
    put(&f->ahead[steps], &two, plain);
    put(&f->ahead[steps + 1], &one,
        plain);                      /* which comes first, and so lies on top; beyond the end where the tile stays */
    f->pool[h->pool + h->tiles] = t; /* the same */
    h->tiles += gone;
    return steps + 1 + gone;
}

static MW_INLINE bool dig_tile(mw_fabric *f, mw_hole *h, uint32_t t, bool plain)
{
    mw_step_ahead one = edge_of(f, t, 0, 1, plain), two = edge_of(f, t, 1, 2, plain),
                  three = edge_of(f, t, 2, 0, plain);
    const bool open = !is_closed(f, &one, plain) && !is_closed(f, &two, plain) && !is_closed(f, &three, plain);
    const two_go go = both_go(f, h->q, 0, &one, &two, 3, true, plain);
    const bool last = goes(f, h->q, 2, &three, 5, plain);
    if (MW_UNLIKELY(!open)) {
        one.apex = choose(go.one, 3, MW_NONE);
        two.apex = choose(go.two, 4, MW_NONE);
        three.apex = choose(last, 5, MW_NONE);
        put(&f->ahead[0], &three, plain);
        put(&f->ahead[1], &two, plain);
        return dig(f, h, 0, one, 2, 6, plain);
    }
    size_t steps = put_neighbour(f, h, 0, 2, &three, last, plain);
    steps = put_neighbour(f, h, steps, 1, &two, go.two, plain);
    steps = put_neighbour(f, h, steps, 0, &one, go.one, plain) - 1;
    f->flips += (uint32_t)h->tiles - 1;
    put(&one, &f->ahead[steps], plain);
    return dig(f, h, 0, one, steps, 12, plain);
}

bool mw__dig_tile(mw_fabric *f, mw_hole *h, uint32_t t)
{
    if (!begin_with(f, h, t)) return false;
    bool plain = f->fixed_count == 0 && f->convex && f->delaunay;
    return MW_LIKELY(plain) ? dig_tile(f, h, t, true) : dig_tile(f, h, t, false);
}

bool mw__dig_side(mw_fabric *f, mw_hole *h, uint32_t half)
{
    const uint32_t t = mw__link_triangle(half), k = mw__link_edge(half), next = mw__next(k);
    const uint32_t prev = mw__prev(k);
    mw_step_ahead one = edge_of(f, t, next, prev, false), two = edge_of(f, t, prev, k, false);
    if (!begin_with(f, h, t)) return false;
    mw__lift_corners(f, t, h->q);
    const two_go go = both_go(f, h->q, next, &one, &two, 3, true, false);
    one.apex = go.one ? 3 : MW_NONE;
    two.apex = go.two ? 4 : MW_NONE;
    f->ahead[0] = two;
    return dig(f, h, next, one, 1, 5, false);
}

static bool sees(const mw_fabric *f, mw_point q, uint32_t half)
{
    const mw_point *p = f->tiling->point;
    const uint32_t *v = f->tiling->tri[mw__link_triangle(half)].v;
    return mw__orient2d(p[v[mw__link_edge(half)]], p[v[mw__link_edge(half) + 1]], q) < 0;
}

static uint32_t hull_after(const mw_fabric *f, uint32_t half)
{
    uint32_t at = mw__half_next(half);
    while (mw__beyond(f, at) != MW_NONE) at = mw__half_next(mw__beyond(f, at));
    return at;
}

static uint32_t hull_before(const mw_fabric *f, uint32_t half)
{
    uint32_t at = mw__half_prev(half);
    while (mw__beyond(f, at) != MW_NONE) at = mw__half_prev(mw__beyond(f, at));
    return at;
}

bool mw__dig_outside(mw_fabric *f, mw_hole *h, uint32_t t)
{
    const mw_point q = h->q;
    uint32_t steps = 0, half = mw__link(t, 0), after;
    while (mw__beyond(f, half) != MW_NONE || !sees(f, q, half)) half = mw__half_next(half);
    while (sees(f, q, hull_before(f, half))) half = hull_before(f, half);
    for (after = half; sees(f, q, after); after = hull_after(f, after)) {
        /* it stays, but nothing else tells that it had no neighbour there */
        if (!mw__journal(f, mw__link_triangle(after)) || !mw__rim_room(f, room_besides(h, steps + 1))) return false;
        f->sight[steps] = mw__lift_vertex(f->tiling, mw__corner(f, after), q);
        f->ahead[steps] = (mw_step_ahead){.end = steps, .beyond = after, .fixed = mw__is_fixed(f, after)};
        steps++;
    }
    f->sight[steps] = mw__lift_vertex(f->tiling, mw__corner(f, after), q);
    for (uint32_t i = 0; i < steps; i++)
        f->ahead[i].apex = goes(f, q, i + 1, &f->ahead[i], steps + 1 + i, false) ? steps + 1 + i : MW_NONE;
    return dig(f, h, steps, f->ahead[steps - 1], steps - 1, 2 * steps + 1, false);
}
