/* insert.c - a vertex is put into the tile or the edge where it lies, or beside the hull; then edges across from it are flipped until the
 * mesh is Delaunay again [Lawson 1977; Guibas, Stolfi 1985]. All new tiles have the vertex as corner 2, so that the edge across from it is
 * edge 0, and stay so when flipped. */
#include "edit/stitch.h"

#include "walk/walk.h"

#include <inttypes.h>

/* --- where ------------------------------------------------------------------------------------------------------------ */

/* The walk is the remembering one; where the mesh leads it in a circle the celestial one takes over. */
static mw_verdict find(const mw_fabric *f, mw_point q, uint32_t *t)
{
    mw_walk walk = mw__walk_begin(f->tiling, q, *t, mw__walk_fuel(MW_WALK_REMEMBERING, MW_EXACT, f->tiling), 0, NULL);
    mw_verdict verdict = mw__remembering.run[true][false](&walk);
    if (verdict == MW_DRY) verdict = mw__walk_surely(&walk, false);
    *t = walk.t;
    return verdict;
}

static mw_status refuse_outside(mw_point q, mw_error *error)
{
    return mw__fail(error, MW_ERROR_INPUT, "the point %.17g, %.17g lies outside of the mesh", q.x, q.y);
}

/* --- splitting -------------------------------------------------------------------------------------------------------- */

/* MW_NONE from mw__add_tile means one of two things. */
static mw_status tile_failure(const mw_fabric *f, mw_error *error)
{
    if (f->tiling->number_count >= MW_USER_MASK || f->tiling->tri_count >= MW_MAX_TRIANGLES)
        return mw__fail(error, MW_ERROR_LIMIT, "no more numbers for triangles");
    return mw__fail_memory(error);
}

static void set_tile(mw_fabric *f, uint32_t t, uint32_t a, uint32_t b, uint32_t c, uint32_t fixed)
{
    mw__set_corners(f, t, a, b, c);
    mw__set_fixed(f, t, fixed);
}

static mw_status split_tile(mw_fabric *f, uint32_t t, uint32_t v, mw_error *error)
{
    if (!mw__journal(f, t)) return mw__fail_memory(error);
    uint32_t t1 = mw__add_tile(f, mw__user_beside(f, t)),
             t2 = t1 == MW_NONE ? t1 : mw__add_tile(f, mw__user_beside(f, t));
    if (t2 == MW_NONE) return tile_failure(f, error);
    const mw_triangle old = f->tiling->tri[t];
    uint32_t fixed = f->mark[t];
    set_tile(f, t, old.v[0], old.v[1], v, fixed & 1);
    set_tile(f, t1, old.v[1], old.v[2], v, fixed >> 1 & 1);
    set_tile(f, t2, old.v[2], old.v[0], v, fixed >> 2 & 1);
    mw__attach(f, mw__link(t1, 0), old.link[1]);
    mw__attach(f, mw__link(t2, 0), old.link[2]);
    mw__attach(f, mw__link(t, 1), mw__link(t1, 2));
    mw__attach(f, mw__link(t1, 1), mw__link(t2, 2));
    mw__attach(f, mw__link(t2, 1), mw__link(t, 2));
    return MW_OK;
}

/* The tile with edge a, b and apex c becomes c, a, v, and a new one b, c, v, which is set to *more. */
static mw_status halve(mw_fabric *f, uint32_t half, uint32_t v, uint32_t *more, mw_error *error)
{
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half);
    if (!mw__journal(f, t)) return mw__fail_memory(error);
    *more = mw__add_tile(f, mw__user_beside(f, t));
    if (*more == MW_NONE) return tile_failure(f, error);
    const mw_triangle old = f->tiling->tri[t];
    uint32_t marks = f->mark[t], fixed = marks >> k & 1, next = mw__next(k), prev = mw__prev(k);
    set_tile(f, t, old.v[prev], old.v[k], v, (marks >> prev & 1) | fixed << 1);
    set_tile(f, *more, old.v[next], old.v[prev], v, (marks >> next & 1) | fixed << 2);
    mw__attach(f, mw__link(t, 0), old.link[prev]);
    mw__attach(f, mw__link(*more, 0), old.link[next]);
    mw__attach(f, mw__link(t, 2), mw__link(*more, 1));
    return MW_OK;
}

/* Of the two sides of an edge, that of the lower number: which one the walk came to must not show. */
static uint32_t lower_side(const mw_fabric *f, uint32_t half)
{
    uint32_t other = mw__beyond(f, half);
    if (other == MW_NONE) return half;
    uint32_t one = f->tiling->tri[mw__link_triangle(half)].user & ~MW_FLIPPED;
    uint32_t two = f->tiling->tri[mw__link_triangle(other)].user & ~MW_FLIPPED;
    return one <= two ? half : other;
}

/* *first: the first tile round v, counter-clockwise. */
static mw_status split_edge(mw_fabric *f, uint32_t half, uint32_t v, uint32_t *first, mw_error *error)
{
    half = lower_side(f, half);
    uint32_t other = mw__beyond(f, half), t = mw__link_triangle(half), t1, n1;
    bool users = mw__is_users(f, t),
         border = other == MW_NONE ? !f->convex && users : users != mw__is_users(f, mw__link_triangle(other));
    if (!users && !border) return refuse_outside(f->tiling->point[v], error);
    if (mw__is_fixed(f, half) && !border) f->fixed_count++;
    mw_status status = halve(f, half, v, &t1, error);
    if (status) return status;
    if (other == MW_NONE) {
        mw__attach(f, mw__link(t, 1), MW_NONE);
        mw__attach(f, mw__link(t1, 2), MW_NONE);
        *first = t1;
        return MW_OK;
    }
    uint32_t n = mw__link_triangle(other);
    status = halve(f, other, v, &n1, error);
    if (status) return status;
    *first = t;
    mw__attach(f, mw__link(t, 1), mw__link(n1, 2));
    mw__attach(f, mw__link(t1, 2), mw__link(n, 1));
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

/* A tile for each hull edge that q sees; `half` is one of them. *last: the last one made, which is the first round v. */
static mw_status grow_hull(mw_fabric *f, uint32_t half, mw_point q, uint32_t v, uint32_t *last, mw_error *error)
{
    for (uint32_t before = hull_before(f, half); sees(f, q, before); before = hull_before(f, half)) half = before;
    *last = MW_NONE;
    do {
        uint32_t next = hull_after(f, half), at = mw__link_triangle(half);
        if (!mw__journal(f, at)) return mw__fail_memory(error);
        uint32_t t = mw__add_tile(f, mw__user_beside(f, at));
        if (t == MW_NONE) return tile_failure(f, error);
        const mw_triangle *tile = &f->tiling->tri[at];
        uint32_t k = mw__link_edge(half);
        set_tile(f, t, tile->v[k + 1], tile->v[k], v, mw__is_fixed(f, half));
        mw__attach(f, mw__link(t, 0), half);
        if (*last != MW_NONE) mw__attach(f, mw__link(t, 1), mw__link(*last, 2));
        *last = t;
        half = next;
    } while (sees(f, q, half));
    return MW_OK;
}

/* --- the insertion ---------------------------------------------------------------------------------------------------- */

/* A vertex as seen from the new one: its position relative to it, and the square of its distance. */
typedef struct sight {
    double x, y, lift;
    uint32_t vertex;
} sight;

static MW_INLINE sight sight_of(const mw_fabric *f, uint32_t vertex, mw_point q)
{
    double x = f->tiling->point[vertex].x - q.x, y = f->tiling->point[vertex].y - q.y;
    return (sight){x, y, x * x + y * y, vertex};
}

/* Is q in the circle of a, b, c? mw__incircle, with what is the same from one test to the next kept, and a bound by the lifts alone:
 * triangulate/delaunay_grow.c tells why it is one. */
static MW_INLINE bool in_circle(const mw_fabric *f, const sight *a, const sight *b, const sight *c, mw_point q)
{
    double det = a->lift * (b->x * c->y - b->y * c->x) + b->lift * (c->x * a->y - c->y * a->x) +
                 c->lift * (a->x * b->y - a->y * b->x);
    double bound = 11.0 * 0x1p-53 * (a->lift * b->lift + c->lift * (a->lift + b->lift)) + MW_UNDERFLOW_ERROR;
    bool small = a->lift + b->lift + c->lift < MW_INCIRCLE_LIFTS;
    if (MW_LIKELY(small && fabs(det) > bound)) return det > 0;
    const mw_point *p = f->tiling->point;
    return mw__incircle_exact(p[a->vertex], p[b->vertex], p[c->vertex], q) > 0;
}

/* Go round q once, from tile `first`, which has no tile of q before it if q is on the hull. Where the tile beyond an edge has q in its circle
 * the edge is flipped, and the one before it is next; else the one after it. */
static bool flip_round(mw_fabric *f, uint32_t first, mw_point q)
{
    const mw_triangle *tile = &f->tiling->tri[first];
    sight a = sight_of(f, tile->v[0], q), b = sight_of(f, tile->v[1], q);
    for (uint32_t t = first;;) {
        uint32_t beyond = f->tiling->tri[t].link[0];
        if (beyond != MW_NONE && !(f->mark[t] & 1)) {
            sight d = sight_of(f, mw__apex(f, beyond), q);
            if (in_circle(f, &b, &a, &d, q)) {
                if (!mw__exchange(f, mw__link(t, 0))) return false;
                f->flips++;
                b = d;
                continue;
            }
        }
        uint32_t next = f->tiling->tri[t].link[1];
        if (next == MW_NONE || mw__link_triangle(next) == first) return true;
        t = mw__link_triangle(next);
        a = b;
        b = sight_of(f, f->tiling->tri[t].v[1], q);
    }
}

static mw_status put_outside(mw_fabric *f, uint32_t *t, mw_point q, uint32_t v, mw_error *error)
{
    if (!f->convex) return refuse_outside(q, error);
    uint32_t half = mw__link(*t, 0);
    while (mw__beyond(f, half) != MW_NONE || !sees(f, q, half)) half = mw__half_next(half);
    return grow_hull(f, half, q, v, t, error);
}

/* Put v, whose place is q, into tile *t, where the walk found it; side[k] is 0 where q lies on edge k. *t becomes the first tile round v. */
static mw_status put_inside(mw_fabric *f, uint32_t *t, const double side[3], mw_point q, uint32_t v, mw_error *error)
{
    for (uint32_t k = 0; k < 3; k++)
        if (side[k] == 0) return split_edge(f, mw__link(*t, k), v, t, error);
    return mw__is_users(f, *t) ? split_tile(f, *t, v, error) : refuse_outside(q, error);
}

/* The sides of q on the edges of tile t; the corner where q lies, 3 if it is at none. */
static uint32_t look(const mw_fabric *f, uint32_t t, mw_point q, double side[3])
{
    const mw_point *p = f->tiling->point;
    const uint32_t *v = f->tiling->tri[t].v;
    for (uint32_t k = 0; k < 3; k++) {
        if (p[v[k]].x == q.x && p[v[k]].y == q.y) return k;
        side[k] = mw__orient2d(p[v[k]], p[v[k + 1]], q);
    }
    return 3;
}

mw_status mw__fabric_insert(mw_fabric *f, mw_point q, uint32_t t, uint32_t *vertex, mw_error *error)
{
    double side[3];
    bool inside = find(f, q, &t) == MW_FOUND;
    uint32_t corner = inside ? look(f, t, q, side) : 3;
    f->last = t;
    if (corner < 3) {
        *vertex = f->tiling->tri[t].v[corner];
        return MW_OK;
    }
    if (*vertex == MW_NONE) {
        if (f->vertex_count >= MW_GONE - 1) return mw__fail(error, MW_ERROR_LIMIT, "no more numbers for vertices");
        if (!mw__add_vertex(f, q, vertex)) return mw__fail_memory(error);
        f->step[f->step_count - 1].vertex = *vertex;
    }
    mw_status status = inside ? put_inside(f, &t, side, q, *vertex, error) : put_outside(f, &t, q, *vertex, error);
    if (!status && f->delaunay && !flip_round(f, t, q)) status = mw__fail_memory(error);
    return status;
}
