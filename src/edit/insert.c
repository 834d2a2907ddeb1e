/* insert.c - a vertex is put into the tile or on the edge where it lies, or beside the hull.
 *
 * The tiles that have to go are dug out (hole.h), and what they leave is filled with a star round the vertex: the tiles that flips one after
 * another would lead to [Lawson 1977], each made once. All of them have the vertex as corner 2. */
#include "edit/fetch.h"
#include "edit/hole.h"

#include "walk/walk.h"

#include <inttypes.h>

/* --- where ------------------------------------------------------------------------------------------------------------ */

/* Where a point is: in `tile`, whose corners are the first three of f->sight, seen from there; or outside, beyond an edge of that tile. */
typedef struct place {
    uint32_t tile, walked;    /* the last one of so many */
    bool inside, on_boundary; /* the tile's own */
} place;

/* Where the mesh is not Delaunay the remembering walk may go in a circle: after so many tiles the celestial walk takes over, from there. */
enum { MANY = 1 << 16 };
static __attribute__((noinline)) place find_surely(mw_fabric *f, mw_point q, uint32_t t)
{
    mw_walk walk = mw__walk_begin(f->tiling, q, t, 0, 0, NULL);
    bool inside = mw__walk_surely(&walk, false) == MW_FOUND;
    place at = {.tile = walk.t, .walked = MANY, .inside = inside};
    mw__see_corners(f, at.tile, q);
    for (int k = 0; k < 3; k++) {
        const mw_sight *a = &f->sight[k], *b = &f->sight[mw__next((uint32_t)k)];
        at.on_boundary |= mw__sights_side(f, a, b, q) == 0;
    }
    return at;
}

/* The remembering walk from tile t on [thesis, App. A, sec. 2], written once more because what it saw of the corners is of use for what
 * follows. There has to be room for sights. What lies beyond is asked of memory together with the corners: the walk goes there, or
 * the hole that is dug. */
static place find(mw_fabric *f, mw_point q, uint32_t t)
{
    const mw_triangle *tri = f->tiling->tri;
    uint32_t fuel = MANY, e = 0, exit = MW_NONE;
    mw_sight a = mw__sight_of(f, tri[t].v[0], q), b = mw__sight_of(f, tri[t].v[1], q),
             c = mw__sight_of(f, tri[t].v[2], q);
    double ab = mw__sights_side(f, &a, &b, q), bc = mw__sights_side(f, &b, &c, q), ca = mw__sights_side(f, &c, &a, q);
    if (ab < 0) {
        exit = 0, c = a, a = b, b = c;
    } else if (bc < 0) {
        exit = 1, a = c;
    } else if (ca < 0) {
        exit = 2, b = c;
    }
    while (exit != MW_NONE) { /* by an edge from b to a, which in the next tile goes from a to b */
        uint32_t link = tri[t].link[exit];
        if (link == MW_NONE) return (place){.tile = t, .walked = MANY - fuel};
        t = mw__link_triangle(link);
        if (MW_UNLIKELY(fuel-- == 0)) return find_surely(f, q, t);
        e = mw__link_edge(link);
        mw__fetch_tile(f->tiling, tri[t].link[mw__next(e)]);
        mw__fetch_tile(f->tiling, tri[t].link[mw__prev(e)]);
        c = mw__sight_of(f, tri[t].v[mw__prev(e)], q);
        exit = MW_NONE;
        ab = 1; /* it came over this edge */
        bc = mw__sights_side(f, &b, &c, q);
        if (bc < 0) {
            exit = mw__next(e), a = c;
            continue;
        }
        ca = mw__sights_side(f, &c, &a, q);
        if (ca < 0) exit = mw__prev(e), b = c;
    }
    f->sight[e] = a;
    f->sight[mw__next(e)] = b;
    f->sight[mw__prev(e)] = c;
    return (place){.tile = t, .walked = MANY - fuel, .inside = true, .on_boundary = ab == 0 || bc == 0 || ca == 0};
}

static mw_status refuse_outside(mw_point q, mw_error *error)
{
    return mw__fail(error, MW_ERROR_INPUT, "the point %.17g, %.17g lies outside of the mesh", q.x, q.y);
}

/* --- the star --------------------------------------------------------------------------------------------------------- */

/* From here on something may fail after tiles have changed. */
static bool begin(mw_fabric *f, mw_point q)
{
    return f->under_way || mw__fabric_begin(f, &(mw_edit){.kind = MW_EDIT_INSERT, .x = q.x, .y = q.y}, true);
}

/* A vertex at q, if there is none for it. */
static mw_status make_vertex(mw_fabric *f, mw_point q, uint32_t *vertex, mw_error *error)
{
    if (*vertex != MW_NONE) return MW_OK;
    if (!mw__vertex_room(f, 1))
        return f->vertex_count >= MW_GONE - 1 ? mw__fail(error, MW_ERROR_LIMIT, "no more numbers for vertices")
                                              : mw__fail_memory(error);
    *vertex = mw__add_vertex(f, q);
    if (f->under_way) f->step[f->step_count - 1].vertex = *vertex;
    return MW_OK;
}

/* Tiles round v, counter-clockwise. */
typedef struct fan {
    uint32_t first, last;
} fan;

static mw_status tile_failure(const mw_fabric *f, size_t n, mw_error *error)
{
    if (f->tiling->number_count > MW_USER_MASK - n || f->tiling->tri_count > MW_MAX_TRIANGLES - n)
        return mw__fail(error, MW_ERROR_LIMIT, "no more numbers for triangles");
    return mw__fail_memory(error);
}

static MW_INLINE bool journal_pool(mw_fabric *f, const mw_hole *h)
{
    for (size_t i = 0; f->journaled > 0 && i < h->tiles; i++)
        if (!mw__journal(f, f->pool[h->pool + i])) return false;
    return true;
}

/* Fill the hole with tiles round the vertex: its own, and others beside tile `beside`. Where this fails it has changed nothing. */
static mw_status fill(mw_fabric *f, const mw_hole *h, uint32_t *vertex, uint32_t beside, fan *made, mw_error *error)
{
    const size_t more = h->steps - h->tiles;
    if (!mw__tile_room(f, beside, more)) return tile_failure(f, more, error);
    if (!journal_pool(f, h)) return mw__fail_memory(error);
    mw_status status = make_vertex(f, h->q, vertex, error);
    if (status) return status;
    const uint32_t v = *vertex;
    uint32_t *pool = f->pool + h->pool;
    mw__add_tiles(f, beside, (uint32_t)more, pool + h->tiles);
    pool[h->steps] = pool[0];                            /* as if they went all the way round */
    const bool plain = f->fixed_count == 0 && f->convex; /* no edge is fixed, here or elsewhere */
    mw_triangle *tri = f->tiling->tri;
    uint32_t *tile_at = f->tiling->tile_at, before = pool[h->steps - 1];
    const mw_rim_step *step = f->rim + h->first;
    for (const uint32_t *at = pool, *end = pool + h->steps; at < end; at++, step++) {
        const uint32_t t = at[0], after = at[1], from = step[0].vertex, to = step[1].vertex, beyond = step->beyond;
        tri[t] = (mw_triangle){
            {from, to, v, from}, {beyond, mw__link(after, 2), mw__link(before, 1)}, tri[t].user & ~MW_FLIPPED};
        if (beyond != MW_NONE) tri[mw__link_triangle(beyond)].link[mw__link_edge(beyond)] = mw__link(t, 0);
        if (!plain) mw__set_fixed(f, t, step->fixed);
        tile_at[from] = before = t;
    }
    tile_at[step->vertex] = tile_at[v] = before;
    *made = (fan){pool[0], before};
    return MW_OK;
}

/* The fan does not go all the way round. */
static void open_fan(mw_fabric *f, const fan *made)
{
    mw__attach(f, mw__link(made->last, 1), MW_NONE);
    mw__attach(f, mw__link(made->first, 2), MW_NONE);
}

/* Tile t, whose corners are the first three sights. */
static mw_status put_in_tile(mw_fabric *f, uint32_t t, mw_point q, uint32_t *v, mw_error *error)
{
    if (!mw__is_users(f, t)) return refuse_outside(q, error);
    mw_hole h = {.q = q};
    fan made;
    if (!mw__dig_tile(f, &h, t)) return mw__fail_memory(error);
    return fill(f, &h, v, t, &made, error);
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
static mw_status put_beside(mw_fabric *f, uint32_t half, mw_hole *h, uint32_t *v, fan *made, mw_error *error)
{
    bool fixed = mw__is_fixed(f, half);
    if (!mw__dig_side(f, h, half)) return mw__fail_memory(error);
    mw_status status = fill(f, h, v, mw__link_triangle(half), made, error);
    if (status) return status;
    open_fan(f, made);
    if (!fixed) return MW_OK;
    f->mark[made->first] |= 4;
    f->mark[made->last] |= 2;
    return MW_OK;
}

static mw_status put_on_edge(mw_fabric *f, uint32_t half, mw_point q, uint32_t *v, mw_error *error)
{
    half = lower_side(f, half);
    uint32_t other = mw__beyond(f, half), t = mw__link_triangle(half);
    bool users = mw__is_users(f, t),
         border = other == MW_NONE ? !f->convex && users : users != mw__is_users(f, mw__link_triangle(other));
    if (!users && !border) return refuse_outside(q, error);
    if (!begin(f, q)) return mw__fail_memory(error);
    if (mw__is_fixed(f, half) && !border) f->fixed_count++;
    mw_hole one = {.q = q}, two = one;
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

static mw_status put_outside(mw_fabric *f, uint32_t t, mw_point q, uint32_t *v, mw_error *error)
{
    if (!f->convex) return refuse_outside(q, error);
    if (!begin(f, q)) return mw__fail_memory(error);
    mw_hole h = {.q = q};
    fan made;
    if (!mw__dig_outside(f, &h, t)) return mw__fail_memory(error);
    mw_status status = fill(f, &h, v, t, &made, error);
    if (!status) open_fan(f, &made);
    return status;
}

/* --- all of them ------------------------------------------------------------------------------------------------------ */

/* Of the first three sights that which is q itself; 3 if none is. */
static uint32_t corner_there(const mw_fabric *f)
{
    uint32_t k = 0;
    while (k < 3 && (f->sight[k].x != 0 || f->sight[k].y != 0)) k++;
    return k;
}

/* The edge of a tile, whose corners are the first three sights, on which q lies. */
static uint32_t edge_there(const mw_fabric *f, uint32_t t, mw_point q)
{
    uint32_t k = 0;
    while (k < 2 && mw__sights_side(f, &f->sight[k], &f->sight[k + 1], q) != 0) k++;
    return mw__link(t, k);
}

mw_status mw__fabric_insert(mw_fabric *f, mw_point q, uint32_t t, uint32_t *vertex, mw_error *error)
{
    enum { SIGHTS = 16 };
    if (!mw__rim_room(f, SIGHTS)) return mw__fail_memory(error);
    place at = find(f, q, t);
    f->last = at.tile;
    f->walked = at.walked;
    if (MW_UNLIKELY(at.on_boundary) && corner_there(f) < 3) {
        *vertex = f->sight[corner_there(f)].vertex;
        return MW_OK;
    }
    if (MW_UNLIKELY(!at.inside)) return put_outside(f, at.tile, q, vertex, error);
    if (MW_UNLIKELY(at.on_boundary)) return put_on_edge(f, edge_there(f, at.tile, q), q, vertex, error);
    return put_in_tile(f, at.tile, q, vertex, error);
}
