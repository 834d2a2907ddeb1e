/* insert.c - a vertex is put into the tile or on the edge where it lies, or beside the hull.
 *
 * All tiles whose circles it lies in go, and what they leave is a star round it [Bowyer 1981; Watson 1981]: the tiles that flips one after
 * another would lead to [Lawson 1977], each made once. Fixed edges are not crossed, so in a constrained mesh the hole is what the vertex
 * sees; where the mesh is not kept Delaunay it is the tile or two that hold the vertex. All new tiles have the vertex as corner 2. */
#include "edit/rim.h"

#include "walk/walk.h"

#include <inttypes.h>

/* --- where ------------------------------------------------------------------------------------------------------------ */

static MW_INLINE bool is_beyond(const mw_fabric *f, const mw_sight *a, const mw_sight *b, mw_point q)
{
    return mw__sights_side(f, a, b, q) < 0;
}

static void see_corners(const mw_fabric *f, uint32_t t, mw_point q, mw_sight corner[3])
{
    for (int k = 0; k < 3; k++) corner[k] = mw__sight_of(f, f->tiling->tri[t].v[k], q);
}

/* Where the mesh is not Delaunay the remembering walk may go in a circle: after so many tiles the celestial walk takes over, from there. */
enum { MANY = 1 << 16 };
static __attribute__((noinline)) bool find_surely(const mw_fabric *f, mw_point q, uint32_t *t, mw_sight corner[3])
{
    mw_walk walk = mw__walk_begin(f->tiling, q, *t, 0, 0, NULL);
    bool inside = mw__walk_surely(&walk, false) == MW_FOUND;
    *t = walk.t;
    see_corners(f, walk.t, q, corner);
    return inside;
}

/* The remembering walk from tile *t on [thesis, App. A, sec. 2], written once more because what it saw of the corners is of use for what
 * follows. Is q in the tile *t where it ends? Else it is outside, beyond an edge of that. */
static bool find(const mw_fabric *f, mw_point q, uint32_t *t, mw_sight corner[3])
{
    const mw_triangle *tri = f->tiling->tri;
    uint32_t at = *t, fuel = MANY, e = 0, exit = MW_NONE;
    see_corners(f, at, q, corner);
    mw_sight a = corner[0], b = corner[1], c = corner[2];
    if (is_beyond(f, &a, &b, q)) {
        exit = 0, c = a, a = b, b = c;
    } else if (is_beyond(f, &b, &c, q)) {
        exit = 1, a = c;
    } else if (is_beyond(f, &c, &a, q)) {
        exit = 2, b = c;
    }
    while (exit != MW_NONE) { /* by an edge from b to a, which in the next tile goes from a to b */
        uint32_t link = tri[at].link[exit];
        if (link == MW_NONE) {
            *t = at;
            return false;
        }
        at = mw__link_triangle(link);
        if (MW_UNLIKELY(fuel-- == 0)) {
            *t = at;
            return find_surely(f, q, t, corner);
        }
        e = mw__link_edge(link);
        c = mw__sight_of(f, tri[at].v[mw__prev(e)], q);
        exit = MW_NONE;
        if (is_beyond(f, &b, &c, q)) {
            exit = mw__next(e), a = c;
        } else if (is_beyond(f, &c, &a, q)) {
            exit = mw__prev(e), b = c;
        }
    }
    *t = at;
    corner[e] = a;
    corner[mw__next(e)] = b;
    corner[mw__prev(e)] = c;
    return true;
}

static mw_status refuse_outside(mw_point q, mw_error *error)
{
    return mw__fail(error, MW_ERROR_INPUT, "the point %.17g, %.17g lies outside of the mesh", q.x, q.y);
}

/* --- the hole --------------------------------------------------------------------------------------------------------- */

/* Part of the boundary of a hole round q, from step `first` on, counter-clockwise; its tiles are those of f->pool from `pool` on. */
typedef struct hole {
    mw_point q;
    size_t first, pool; /* in f->rim, in f->pool                          */
    size_t steps, tiles, ahead;
    size_t most; /* tiles that there is room for, with the steps they bring */
} hole;

/* Is q, from which the others are seen, in the circle of a, b, c? */
static MW_INLINE bool in_circle(const mw_fabric *f, const mw_sight *a, const mw_sight *b, const mw_sight *c, mw_point q)
{
    double bound, det = mw__sights_rounded(a, b, c, &bound);
    if (MW_LIKELY(fabs(det) > bound)) return det > 0;
    const mw_point *p = f->tiling->point;
    return mw__incircle_exact(p[a->vertex], p[b->vertex], p[c->vertex], q) > 0;
}

/* Room for more tiles, and the steps they bring: each brings one more. */
static bool deepen(mw_fabric *f, hole *h)
{
    size_t used = h->first + h->pool + h->steps + h->ahead + 4;
    if (!mw__rim_room(f, used + 2 * h->tiles + 8)) return false;
    h->most = f->rim_room - used;
    return true;
}

/* Take a tile into the hole. */
static MW_INLINE bool take(mw_fabric *f, hole *h, uint32_t t)
{
    if (MW_UNLIKELY(h->tiles >= h->most) && !deepen(f, h)) return false;
    f->pool[h->pool + h->tiles++] = t;
    return mw__journal(f, t);
}

static MW_INLINE void look_ahead(mw_fabric *f, hole *h, const mw_sight *end, uint32_t beyond, bool fixed)
{
    f->ahead[h->ahead++] = (mw_step_ahead){*end, beyond, fixed};
}

/* Go along the steps ahead, the last one first, which begins at vertex a: where the tile beyond has q in its circle, its two other edges are
 * steps instead. No tile is met twice, for a vertex all of whose tiles were in the hole would lie where q does. */
static bool dig(mw_fabric *f, hole *h, mw_sight a)
{
    const mw_triangle *tri = f->tiling->tri;
    const bool delaunay = f->delaunay;
    const size_t taken = h->tiles;
    mw_step_ahead step = f->ahead[--h->ahead];
    for (;;) {
        if (step.beyond != MW_NONE && !step.fixed && delaunay) {
            const mw_triangle *tile = &tri[mw__link_triangle(step.beyond)];
            uint32_t e = mw__link_edge(step.beyond), next = mw__next(e), prev = mw__prev(e);
            mw_sight d = mw__sight_of(f, tile->v[prev], h->q);
            if (in_circle(f, &step.end, &a, &d, h->q)) {
                uint32_t t = mw__link_triangle(step.beyond), fixed = f->mark[t];
                if (!take(f, h, t)) return false;
                look_ahead(f, h, &step.end, tile->link[prev], fixed >> prev & 1);
                step = (mw_step_ahead){d, tile->link[next], fixed >> next & 1};
                continue;
            }
        }
        mw_rim_step *rim = &f->rim[h->first + h->steps++];
        rim->vertex = a.vertex;
        rim->beyond = step.beyond;
        rim->fixed = step.fixed;
        a = step.end;
        if (h->ahead == 0) break;
        step = f->ahead[--h->ahead];
    }
    f->rim[h->first + h->steps].vertex = a.vertex;
    f->flips += (uint32_t)(h->tiles - taken);
    return true;
}

/* --- the star --------------------------------------------------------------------------------------------------------- */

/* Tiles round v, counter-clockwise, from the one whose edge 2 to the one whose edge 1 is not linked. */
typedef struct fan {
    uint32_t first, last;
} fan;

static mw_status tile_failure(const mw_fabric *f, size_t n, mw_error *error)
{
    if (f->tiling->number_count > MW_USER_MASK - n || f->tiling->tri_count > MW_MAX_TRIANGLES - n)
        return mw__fail(error, MW_ERROR_LIMIT, "no more numbers for triangles");
    return mw__fail_memory(error);
}

/* Fill the hole with tiles round v: its own, and others beside tile `beside`. */
static mw_status fill(mw_fabric *f, const hole *h, uint32_t v, uint32_t beside, fan *made, mw_error *error)
{
    size_t more = h->steps - h->tiles;
    if (!mw__add_tiles(f, beside, (uint32_t)more, f->pool + h->pool + h->tiles)) return tile_failure(f, more, error);
    mw_triangle *tri = f->tiling->tri;
    uint32_t *tile_at = f->tiling->tile_at, before = MW_NONE;
    const uint32_t *pool = f->pool + h->pool;
    const mw_rim_step *step = f->rim + h->first;
    for (size_t i = 0; i < h->steps; i++, step++) {
        uint32_t t = pool[i];
        mw_triangle *tile = &tri[t];
        tile->v[0] = tile->v[3] = step->vertex;
        tile->v[1] = step[1].vertex;
        tile->v[2] = v;
        tile->user &= ~MW_FLIPPED;
        tile->link[2] = before == MW_NONE ? before : mw__link(before, 1);
        mw__attach(f, mw__link(t, 0), step->beyond);
        if (before != MW_NONE) tri[before].link[1] = mw__link(t, 2);
        mw__set_fixed(f, t, step->fixed);
        tile_at[step->vertex] = before = t;
    }
    tri[before].link[1] = MW_NONE;
    tile_at[step->vertex] = tile_at[v] = before;
    *made = (fan){pool[0], before};
    return MW_OK;
}

/* `corner`: those of tile t. */
static mw_status put_in_tile(mw_fabric *f, uint32_t t, const mw_sight corner[3], mw_point q, uint32_t v,
                             mw_error *error)
{
    if (!mw__is_users(f, t)) return refuse_outside(q, error);
    hole h = {.q = q};
    fan made;
    if (!take(f, &h, t)) return mw__fail_memory(error);
    const mw_triangle *tile = &f->tiling->tri[t];
    for (uint32_t k = 3; k-- > 0;) look_ahead(f, &h, &corner[mw__next(k)], tile->link[k], f->mark[t] >> k & 1);
    if (!dig(f, &h, corner[0])) return mw__fail_memory(error);
    mw_status status = fill(f, &h, v, t, &made, error);
    if (!status) mw__attach(f, mw__link(made.last, 1), mw__link(made.first, 2));
    return status;
}

/* --- on an edge ------------------------------------------------------------------------------------------------------- */

/* Of the two sides of an edge, that of the lower number: which one the walk came to must not show. */
static uint32_t lower_side(const mw_fabric *f, uint32_t half)
{
    uint32_t other = mw__beyond(f, half);
    if (other == MW_NONE) return half;
    uint32_t one = f->tiling->tri[mw__link_triangle(half)].user & ~MW_FLIPPED;
    uint32_t two = f->tiling->tri[mw__link_triangle(other)].user & ~MW_FLIPPED;
    return one <= two ? half : other;
}

/* Fill the hole on the side of an edge where `half` is, and after it that of h->first and h->pool. */
static mw_status put_beside(mw_fabric *f, uint32_t half, hole *h, uint32_t v, fan *made, mw_error *error)
{
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half);
    bool fixed = mw__is_fixed(f, half);
    if (!take(f, h, t)) return mw__fail_memory(error);
    const mw_triangle *tile = &f->tiling->tri[t];
    uint32_t next = mw__next(k), prev = mw__prev(k), marks = f->mark[t];
    mw_sight from = mw__sight_of(f, tile->v[k], h->q), apex = mw__sight_of(f, tile->v[prev], h->q);
    look_ahead(f, h, &from, tile->link[prev], marks >> prev & 1);
    look_ahead(f, h, &apex, tile->link[next], marks >> next & 1);
    if (!dig(f, h, mw__sight_of(f, tile->v[next], h->q))) return mw__fail_memory(error);
    mw_status status = fill(f, h, v, t, made, error);
    if (status || !fixed) return status;
    f->mark[made->first] |= 4;
    f->mark[made->last] |= 2;
    return MW_OK;
}

static mw_status put_on_edge(mw_fabric *f, uint32_t half, mw_point q, uint32_t v, mw_error *error)
{
    half = lower_side(f, half);
    uint32_t other = mw__beyond(f, half), t = mw__link_triangle(half);
    bool users = mw__is_users(f, t),
         border = other == MW_NONE ? !f->convex && users : users != mw__is_users(f, mw__link_triangle(other));
    if (!users && !border) return refuse_outside(q, error);
    if (mw__is_fixed(f, half) && !border) f->fixed_count++;
    hole one = {.q = q}, two = one;
    fan left, right;
    mw_status status = put_beside(f, half, &one, v, &left, error);
    if (status || other == MW_NONE) return status;
    two.first = one.steps + 1;
    two.pool = one.tiles;
    status = put_beside(f, other, &two, v, &right, error);
    if (status) return status;
    mw__attach(f, mw__link(left.last, 1), mw__link(right.first, 2));
    mw__attach(f, mw__link(right.last, 1), mw__link(left.first, 2));
    return MW_OK;
}

/* --- beyond the hull -------------------------------------------------------------------------------------------------- */

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

/* The hull edges that q sees are steps of a hole without tiles. */
static mw_status put_outside(mw_fabric *f, uint32_t t, mw_point q, uint32_t v, mw_error *error)
{
    if (!f->convex) return refuse_outside(q, error);
    uint32_t half = mw__link(t, 0);
    while (mw__beyond(f, half) != MW_NONE || !sees(f, q, half)) half = mw__half_next(half);
    for (uint32_t before = hull_before(f, half); sees(f, q, before); before = hull_before(f, half)) half = before;
    hole h = {.q = q};
    fan made;
    mw_sight begin;
    do {
        uint32_t at = mw__link_triangle(half), k = mw__link_edge(half);
        if (!mw__journal(f, at) || !mw__rim_room(f, h.ahead + 4)) return mw__fail_memory(error);
        mw_sight end = mw__sight_of(f, f->tiling->tri[at].v[k], q);
        look_ahead(f, &h, &end, half, mw__is_fixed(f, half));
        begin = mw__sight_of(f, f->tiling->tri[at].v[k + 1], q);
        half = hull_after(f, half);
    } while (sees(f, q, half));
    if (!dig(f, &h, begin)) return mw__fail_memory(error);
    return fill(f, &h, v, t, &made, error);
}

/* --- both ------------------------------------------------------------------------------------------------------------- */

/* Put a vertex at q into tile t, where the walk found it. */
static mw_status put_inside(mw_fabric *f, uint32_t t, const mw_sight corner[3], mw_point q, uint32_t v, mw_error *error)
{
    for (uint32_t k = 0; k < 3; k++)
        if (mw__sights_side(f, &corner[k], &corner[mw__next(k)], q) == 0)
            return put_on_edge(f, mw__link(t, k), q, v, error);
    return put_in_tile(f, t, corner, q, v, error);
}

/* The corner that lies at the point from which the three are seen; 3 if none does. */
static uint32_t corner_there(const mw_sight corner[3])
{
    uint32_t at = 3;
    for (uint32_t k = 0; k < 3; k++) at = corner[k].x == 0 && corner[k].y == 0 ? k : at;
    return at;
}

mw_status mw__fabric_insert(mw_fabric *f, mw_point q, uint32_t t, uint32_t *vertex, mw_error *error)
{
    mw_sight corner[3];
    bool inside = find(f, q, &t, corner);
    uint32_t at = inside ? corner_there(corner) : 3;
    f->last = t;
    if (at < 3) {
        *vertex = corner[at].vertex;
        return MW_OK;
    }
    if (*vertex == MW_NONE) {
        if (f->vertex_count >= MW_GONE - 1) return mw__fail(error, MW_ERROR_LIMIT, "no more numbers for vertices");
        if (!mw__add_vertex(f, q, vertex)) return mw__fail_memory(error);
        f->step[f->step_count - 1].vertex = *vertex;
    }
    return inside ? put_inside(f, t, corner, q, *vertex, error) : put_outside(f, t, q, *vertex, error);
}
