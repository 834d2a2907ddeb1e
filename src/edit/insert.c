/* insert.c - a vertex is put into the tile or on the edge where it lies, or beside the hull.
 *
 * The tiles that have to go are dug out (hole.h), and what they leave is filled with a star round the vertex: the tiles that flips one after
 * another would lead to [Lawson 1977], each made once. All of them have the vertex as corner 2. */
#include "edit/hole.h"
#include "edit/journal.h"
#include "edit/operations.h"
#include "edit/stitch.h"

#include "walk/remembering_corners.h"

#include <inttypes.h>

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
            {from, to, v, from}, {beyond, mw__link(after, 2), mw__link(before, 1)}, tri[t].user & ~MW_REVERSED};
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
    uint32_t one = f->tiling->tri[mw__link_triangle(half)].user & ~MW_REVERSED;
    uint32_t two = f->tiling->tri[mw__link_triangle(other)].user & ~MW_REVERSED;
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
    while (k < 2 && mw__lifted_side(f->tiling, &f->sight[k], &f->sight[k + 1], q) != 0) k++;
    return mw__link(t, k);
}

mw_status mw__fabric_insert(mw_fabric *f, mw_point q, uint32_t t, uint32_t *vertex, mw_error *error)
{
    enum { SIGHTS = 16 };
    if (!mw__rim_room(f, SIGHTS)) return mw__fail_memory(error);
    /* the first three sights become the corners of the tile */
    const mw_walk_end at = mw__remembering_corners(f->tiling, q, t, f->sight);
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
