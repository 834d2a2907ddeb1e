/* remove.c - a vertex is removed from its star.
 *
 * The ring round the vertex is filled by cutting off its corners; then edges between the new tiles
 * are flipped until they are Delaunay. (A small ring in a Delaunay mesh is filled with Delaunay
 * tiles at once.) On the hull, corners are cut off until the rest is convex. If two fixed edges
 * meet at the vertex in line, they become one edge, and each of its sides is filled separately. */
#include "edit/flip.h"
#include "edit/operations.h"
#include "edit/boundary.h"
#include "edit/tile_links.h"
#include "edit/vertex_star.h"

#include <inttypes.h>
#include <string.h>

static mw_status refuse_fixed(const mw_dynamic_tiling *f, uint32_t v, mw_error *error)
{
    return mw__fail_at(error, -1, f->vertex_number[v], "vertex %" PRIu32 " is on the border or on a constraint",
                       f->vertex_number[v]);
}

/* The number of a user tile beside the star; MW_NONE if there is none. */
static uint32_t number_beside(const mw_dynamic_tiling *f, size_t steps)
{
    for (size_t i = 0; i < steps; i++) {
        uint32_t beyond = f->boundary[i].beyond;
        if (beyond == MW_NONE || !mw__is_users_tile(f, mw__link_triangle(beyond))) continue;
        return f->tiling->tri[mw__link_triangle(beyond)].user & MW_USER_MASK;
    }
    return MW_NONE;
}

/* --- the three cases -------------------------------------------------------------------------- */

/* The tiles around the star are still Delaunay without its vertex: only the edges within are
 * tested. */
static mw_status ring_close(mw_dynamic_tiling *f, const mw_vertex_star *star, mw_point q, mw_error *error)
{
    enum { FEW = 16 }; /* filling takes time quadratic in the steps; flips seldom do */
    mw_pool pool = {.tile = f->pool, .count = star->n};
    if (!mw__pool_begin_ring(f, &pool)) return mw__fail_memory(error);
    if (f->delaunay && star->n <= FEW)
        mw__ring_fill_delaunay(f, f->boundary, star->n, &pool);
    else if (!mw__ring_cut_corners(f, f->boundary, star->n, q, &pool) || !mw__legalise_within(f))
        return mw__fail_memory(error);
    mw__pool_end(f, &pool, MW_NONE);
    return mw__drop_tiles(f, pool.tile + pool.used, pool.count - pool.used) ? MW_OK : mw__fail_memory(error);
}

static mw_status shrink_hull(mw_dynamic_tiling *f, const mw_vertex_star *star, mw_error *error)
{
    mw_pool pool = {.tile = f->pool, .count = star->n};
    size_t left = star->n;
    uint32_t heir = number_beside(f, star->n), number = f->step[f->step_count - 1].edit.vertex;
    if (!mw__pool_begin(f, &pool) || !mw__chain_cut_corners(f, f->boundary, &left, &pool))
        return mw__fail_memory(error);
    if (f->tiling->tri_count == pool.count - pool.used)
        return mw__fail_at(error, -1, number, "without vertex %" PRIu32 " no triangle would be left", number);
    uint32_t *tile_at = f->tiling->tile_at;
    for (size_t i = 0; i <= left; i++) tile_at[f->boundary[i].vertex] = MW_NONE;
    for (size_t i = 0; i < left; i++) {
        uint32_t beyond = f->boundary[i].beyond;
        if (beyond == MW_NONE) continue;
        tile_at[f->boundary[i].vertex] = tile_at[f->boundary[i + 1].vertex] = mw__link_triangle(beyond);
        if (!mw__journal_tile(f, mw__link_triangle(beyond)))
            return mw__fail_memory(error); /* its vertices may have no other tile left */
        mw__attach(f, beyond, MW_NONE);
        if (pool.used == 0) f->last = mw__link_triangle(beyond);
    }
    if (!mw__legalise(f)) return mw__fail_memory(error);
    mw__pool_end(f, &pool, heir);
    return mw__drop_tiles(f, pool.tile + pool.used, pool.count - pool.used) ? MW_OK : mw__fail_memory(error);
}

/* Fill one side of the line: steps[0 .. n - 1] become one. Sets *base to the half-edge of the line
 * on this side; MW_NONE if this side has no tile. */
static bool close_side(mw_dynamic_tiling *f, mw_boundary_step *steps, size_t n, mw_pool *pool, uint32_t *base)
{
    *base = MW_NONE;
    if (n == 0) return true;
    if (!mw__pool_begin(f, pool) || !mw__chain_cut_corners(f, steps, &n, pool)) return false;
    *base = steps[0].beyond;
    f->mark[mw__link_triangle(*base)] |= (uint8_t)(1u << mw__link_edge(*base));
    return true;
}

static mw_status close_line(mw_dynamic_tiling *f, const mw_vertex_star *star, mw_error *error)
{
    size_t n = star->n, first = star->spoke[0], middle = star->spoke[1] - first, rest = n - middle;
    if (star->open) rest = 0;
    if (!mw__boundary_room(f, 2 * (n + 2))) return mw__fail_memory(error);
    mw_boundary_step *steps = f->boundary + n + 2; /* the steps of each side, and its end */
    uint32_t *tiles = f->pool + n + 2;
    for (size_t i = 0; i < n; i++) {
        size_t from = (first + i) % n;
        steps[i + (i >= middle)] = f->boundary[from];
        tiles[i] = f->pool[from];
    }
    steps[middle].vertex = f->boundary[star->spoke[1]].vertex;
    steps[n + 1].vertex = f->boundary[first].vertex;
    mw_pool one = {.tile = tiles, .count = middle}, two = {.tile = tiles + middle, .count = rest};
    uint32_t left, right;
    bool border = star->open ? !f->convex : mw__is_users_tile(f, tiles[0]) != mw__is_users_tile(f, tiles[middle]);
    if (!close_side(f, steps, middle, &one, &left) || !close_side(f, steps + middle + 1, rest, &two, &right) ||
        left == MW_NONE) /* the first side has at least one tile */
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

/* Are the first two fixed edges at v in line? */
static bool spokes_in_line(const mw_dynamic_tiling *f, const mw_vertex_star *star, uint32_t v)
{
    const mw_point *p = f->tiling->point;
    mw_point a = p[f->boundary[star->spoke[0]].vertex], b = p[f->boundary[star->spoke[1]].vertex];
    return mw__orient2d(a, b, p[v]) == 0 && mw__dot2d(p[v], a, b) < 0;
}

mw_status mw__dynamic_take_out(mw_dynamic_tiling *f, const mw_vertex_star *star, uint32_t v, mw_error *error)
{
    return star->open ? shrink_hull(f, star, error) : ring_close(f, star, f->tiling->point[v], error);
}

static mw_status vertex_take_out(mw_dynamic_tiling *f, const mw_vertex_star *star, uint32_t v, mw_error *error)
{
    if (star->spokes == 2 && spokes_in_line(f, star, v)) return close_line(f, star, error);
    if (star->spokes > 0) return refuse_fixed(f, v, error);
    return mw__dynamic_take_out(f, star, v, error);
}

mw_status mw__dynamic_remove(mw_dynamic_tiling *f, uint32_t vertex, mw_error *error)
{
    mw_vertex_star star;
    if (!mw__vertex_star_collect(f, vertex, &star)) return mw__fail_memory(error);
    mw_journal_step *step = &f->step[f->step_count - 1];
    step->vertex = vertex;
    step->number = f->vertex_number[vertex];
    step->point = f->tiling->point[vertex];
    mw_status status = vertex_take_out(f, &star, vertex, error);
    if (!status && !mw__free_vertex(f, vertex)) status = mw__fail_memory(error);
    return status;
}
