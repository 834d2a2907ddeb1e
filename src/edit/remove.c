/* remove.c - a vertex is taken out of its star, or moved.
 *
 * The tiles round the vertex are replaced by corners cut off their boundary, then edges between these are flipped until they are Delaunay. On
 * the hull corners are cut off until what is left is convex. Where two fixed edges meet at the vertex in line they become one, and the two
 * sides of it are filled each for itself. */
#include "edit/flip.h"
#include "edit/operations.h"
#include "edit/rim.h"
#include "edit/stitch.h"
#include "edit/vertex_star.h"

#include <inttypes.h>
#include <string.h>

static mw_status refuse_fixed(const mw_fabric *f, uint32_t v, mw_error *error)
{
    return mw__fail_at(error, -1, f->vertex_number[v], "vertex %" PRIu32 " is on the border or on a constraint",
                       f->vertex_number[v]);
}

/* Of a tile beside the star. */
static uint32_t number_beside(const mw_fabric *f, size_t steps)
{
    for (size_t i = 0; i < steps; i++) {
        uint32_t beyond = f->rim[i].beyond;
        if (beyond == MW_NONE || !mw__is_users(f, mw__link_triangle(beyond))) continue;
        return f->tiling->tri[mw__link_triangle(beyond)].user & MW_USER_MASK;
    }
    return MW_NONE;
}

/* --- the three cases -------------------------------------------------------------------------------------------------- */

/* The tiles round a star are still Delaunay without its vertex: only the edges within are looked at. */
static mw_status close_ring(mw_fabric *f, const mw_star *star, mw_point q, mw_error *error)
{
    enum {
        FEW = 16
    }; /* to look for each tile's circle takes time with the square of the steps, flips do not as a rule */
    mw_pool pool = {.tile = f->pool, .count = star->n};
    if (!mw__pool_begin_ring(f, &pool)) return mw__fail_memory(error);
    if (f->delaunay && star->n <= FEW)
        mw__fill_ring(f, f->rim, star->n, &pool);
    else if (!mw__cut_ring(f, f->rim, star->n, q, &pool) || !mw__legalise_within(f))
        return mw__fail_memory(error);
    mw__pool_end(f, &pool, MW_NONE);
    return mw__drop_tiles(f, pool.tile + pool.used, pool.count - pool.used) ? MW_OK : mw__fail_memory(error);
}

static mw_status shrink_hull(mw_fabric *f, const mw_star *star, mw_error *error)
{
    mw_pool pool = {.tile = f->pool, .count = star->n};
    size_t left = star->n;
    uint32_t heir = number_beside(f, star->n), number = f->step[f->step_count - 1].edit.vertex;
    if (!mw__pool_begin(f, &pool) || !mw__cut_chain(f, f->rim, &left, &pool)) return mw__fail_memory(error);
    if (f->tiling->tri_count == pool.count - pool.used)
        return mw__fail_at(error, -1, number, "without vertex %" PRIu32 " no triangle would be left", number);
    uint32_t *tile_at = f->tiling->tile_at;
    for (size_t i = 0; i <= left; i++) tile_at[f->rim[i].vertex] = MW_NONE;
    for (size_t i = 0; i < left; i++) {
        uint32_t beyond = f->rim[i].beyond;
        if (beyond == MW_NONE) continue;
        tile_at[f->rim[i].vertex] = tile_at[f->rim[i + 1].vertex] = mw__link_triangle(beyond);
        if (!mw__journal(f, mw__link_triangle(beyond))) return mw__fail_memory(error); /* all that its ends have left */
        mw__attach(f, beyond, MW_NONE);
        if (pool.used == 0) f->last = mw__link_triangle(beyond);
    }
    if (!mw__legalise(f)) return mw__fail_memory(error);
    mw__pool_end(f, &pool, heir);
    return mw__drop_tiles(f, pool.tile + pool.used, pool.count - pool.used) ? MW_OK : mw__fail_memory(error);
}

/* Fill the tiles on one side of the line: steps[0 .. n - 1] become one, with the line beyond it: *base, MW_NONE where that side has
 * none. */
static bool close_side(mw_fabric *f, mw_rim_step *steps, size_t n, mw_pool *pool, uint32_t *base)
{
    *base = MW_NONE;
    if (n == 0) return true;
    if (!mw__pool_begin(f, pool) || !mw__cut_chain(f, steps, &n, pool)) return false;
    *base = steps[0].beyond;
    f->mark[mw__link_triangle(*base)] |= (uint8_t)(1u << mw__link_edge(*base));
    return true;
}

static mw_status close_line(mw_fabric *f, const mw_star *star, mw_error *error)
{
    size_t n = star->n, first = star->spoke[0], middle = star->spoke[1] - first, rest = n - middle;
    if (star->open) rest = 0;
    if (!mw__rim_room(f, 2 * (n + 2))) return mw__fail_memory(error);
    mw_rim_step *steps = f->rim + n + 2; /* each side with its end */
    uint32_t *tiles = f->pool + n + 2;
    for (size_t i = 0; i < n; i++) {
        size_t from = (first + i) % n;
        steps[i + (i >= middle)] = f->rim[from];
        tiles[i] = f->pool[from];
    }
    steps[middle].vertex = f->rim[star->spoke[1]].vertex;
    steps[n + 1].vertex = f->rim[first].vertex;
    mw_pool one = {.tile = tiles, .count = middle}, two = {.tile = tiles + middle, .count = rest};
    uint32_t left, right;
    bool border = star->open ? !f->convex : mw__is_users(f, tiles[0]) != mw__is_users(f, tiles[middle]);
    if (!close_side(f, steps, middle, &one, &left) || !close_side(f, steps + middle + 1, rest, &two, &right) ||
        left == MW_NONE) /* the first side has a tile, at least */
        return mw__fail_memory(error);
    mw__attach(f, left, right);
    if (!border) f->fixed_count--;
    if (!mw__legalise(f)) return mw__fail_memory(error);
    mw__pool_end(f, &one, MW_NONE);
    mw__pool_end(f, &two, MW_NONE);
    memmove(two.tile, two.tile + two.used, (two.count - two.used) * sizeof *two.tile);
    return mw__drop_tiles(f, one.tile + one.used, one.count - one.used + two.count - two.used) ? MW_OK
                                                                                               : mw__fail_memory(error);
}

/* Do the first two fixed edges at v go on in one line? */
static bool in_line(const mw_fabric *f, const mw_star *star, uint32_t v)
{
    const mw_point *p = f->tiling->point;
    mw_point a = p[f->rim[star->spoke[0]].vertex], b = p[f->rim[star->spoke[1]].vertex];
    return mw__orient2d(a, b, p[v]) == 0 && mw__dot2d(p[v], a, b) < 0;
}

/* Take v out of the tiles, given its star. */
static mw_status take_out(mw_fabric *f, const mw_star *star, uint32_t v, mw_error *error)
{
    if (star->spokes == 2 && in_line(f, star, v)) return close_line(f, star, error);
    if (star->spokes > 0) return refuse_fixed(f, v, error);
    return star->open ? shrink_hull(f, star, error) : close_ring(f, star, f->tiling->point[v], error);
}

mw_status mw__fabric_remove(mw_fabric *f, uint32_t vertex, mw_error *error)
{
    mw_star star;
    if (!mw__collect_star(f, vertex, &star)) return mw__fail_memory(error);
    mw_step *step = &f->step[f->step_count - 1];
    step->vertex = vertex;
    step->number = f->vertex_number[vertex];
    step->point = f->tiling->point[vertex];
    mw_status status = take_out(f, &star, vertex, error);
    if (!status && !mw__free_vertex(f, vertex)) status = mw__fail_memory(error);
    return status;
}

/* --- moving ----------------------------------------------------------------------------------------------------------- */

/* Does the hull stay convex if its vertex, between rim vertices w[n] and w[0], moves to q? */
static bool keeps_hull(const mw_fabric *f, const mw_star *star, mw_point q)
{
    const mw_point *p = f->tiling->point;
    uint32_t after = f->rim[0].vertex, before = f->rim[star->n].vertex;
    bool open;
    uint32_t out = mw__star_first(f, after, &open); /* the hull edge that leaves it */
    mw_point beyond = p[mw__corner(f, mw__half_next(out))];
    uint32_t in =
        mw__half_prev(mw__star_first(f, before, &open)); /* turned round to its last tile, where the hull comes in */
    while (mw__beyond(f, in) != MW_NONE) in = mw__half_prev(mw__beyond(f, in));
    return mw__orient2d(p[before], q, p[after]) >= 0 && mw__orient2d(q, p[after], beyond) >= 0 &&
           mw__orient2d(p[mw__corner(f, in)], p[before], q) >= 0;
}

static bool stays_valid(const mw_fabric *f, const mw_star *star, mw_point q)
{
    const mw_point *p = f->tiling->point;
    for (size_t i = 0; i < star->n; i++) {
        uint32_t to = mw__corner(f, mw__half_next(f->rim[i].half));
        if (!(mw__orient2d(p[f->rim[i].vertex], p[to], q) > 0)) return false;
    }
    return !star->open || keeps_hull(f, star, q);
}

/* In place; all edges of the star may have to be flipped. */
static mw_status shift(mw_fabric *f, const mw_star *star, uint32_t v, mw_point q, mw_error *error)
{
    f->tiling->point[v] = q;
    f->last = f->pool[0];
    if (!f->delaunay) return MW_OK;
    for (size_t i = 0; i < star->n; i++) {
        uint32_t across = f->rim[i].half;
        if (!mw__push(f, across) || !mw__push(f, mw__half_next(across)) || !mw__push(f, mw__half_prev(across)))
            return mw__fail_memory(error);
    }
    return mw__legalise(f) ? MW_OK : mw__fail_memory(error);
}

mw_status mw__fabric_move(mw_fabric *f, uint32_t vertex, mw_point q, uint32_t t, mw_error *error)
{
    mw_step *step = &f->step[f->step_count - 1];
    mw_star star;
    if (!mw__collect_star(f, vertex, &star)) return mw__fail_memory(error);
    step->vertex = vertex;
    step->point = f->tiling->point[vertex];
    if (stays_valid(f, &star, q)) return shift(f, &star, vertex, q, error);
    if (star.spokes > 0) return refuse_fixed(f, vertex, error);
    mw_status status = take_out(f, &star, vertex, error);
    if (status) return status;
    f->tiling->point[vertex] = q;
    uint32_t at = vertex;
    status = mw__fabric_insert(f, q, t < f->tiling->tri_count ? t : f->last, &at, error);
    if (!status && at != vertex)
        status =
            mw__fail_at(error, -1, f->vertex_number[at], "vertex %" PRIu32 " lies there already", f->vertex_number[at]);
    return status;
}
