/* remove.c - a vertex is removed from its star.
 *
 * The ring round the vertex is filled by cutting off its corners; then edges between the new tiles
 * are flipped until they are Delaunay. (A small ring in a Delaunay mesh is filled with Delaunay
 * tiles at once.) On the hull, corners are cut off until the rest is convex. If two fixed edges
 * meet at the vertex in line, they become one edge, and each of its sides is filled separately. */
#include "dynamic/flip.h"
#include "dynamic/operations.h"
#include "dynamic/boundary.h"
#include "dynamic/tile_links.h"
#include "dynamic/vertex_star.h"

#include <inttypes.h>
#include <string.h>

static mw_status refuse_fixed(const mw_dynamic_tiling *dynamic, uint32_t v, mw_error *error)
{
    return mw__fail_at(error, -1, dynamic->vertex_number[v],
                       "vertex %" PRIu32
                       " cannot be removed: it is on the border or on a constraint",
                       dynamic->vertex_number[v]);
}

/* The number of a user tile beside the star; MW_NONE if there is none. */
static uint32_t number_beside(const mw_dynamic_tiling *dynamic, size_t steps)
{
    for (size_t i = 0; i < steps; i++) {
        uint32_t beyond = dynamic->boundary[i].beyond;
        if (beyond == MW_NONE || !mw__is_users_tile(dynamic, mw__link_triangle(beyond))) continue;
        return dynamic->tiling->tri[mw__link_triangle(beyond)].user & MW_USER_MASK;
    }
    return MW_NONE;
}

/* --- the three cases -------------------------------------------------------------------------- */

/* The tiles around the star are still Delaunay without its vertex: only the edges within are
 * tested. */
static mw_status ring_close(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, mw_point q,
                            mw_error *error)
{
    enum { FEW = 16 }; /* filling takes time quadratic in the steps; flips seldom do */
    mw_pool pool = {.tile = dynamic->pool, .count = star->n};
    if (!mw__pool_begin_ring(dynamic, &pool)) return mw__fail_memory(error);
    if (dynamic->delaunay && star->n <= FEW)
        mw__ring_fill_delaunay(dynamic, dynamic->boundary, star->n, &pool);
    else if (!mw__ring_cut_corners(dynamic, dynamic->boundary, star->n, q, &pool) ||
             !mw__legalise_within(dynamic))
        return mw__fail_memory(error);
    mw__pool_end(dynamic, &pool, MW_NONE);
    return mw__drop_tiles(dynamic, pool.tile + pool.used, pool.count - pool.used)
               ? MW_OK
               : mw__fail_memory(error);
}

static mw_status shrink_hull(mw_dynamic_tiling *dynamic, const mw_vertex_star *star,
                             mw_error *error)
{
    mw_pool pool = {.tile = dynamic->pool, .count = star->n};
    size_t left = star->n;
    uint32_t heir = number_beside(dynamic, star->n),
             number = dynamic->step[dynamic->step_count - 1].edit.vertex;
    if (!mw__pool_begin(dynamic, &pool) ||
        !mw__chain_cut_corners(dynamic, dynamic->boundary, &left, &pool))
        return mw__fail_memory(error);
    if (dynamic->tiling->tri_count == pool.count - pool.used)
        return mw__fail_at(error, -1, number,
                           "vertex %" PRIu32 " cannot be removed: no triangle would be left",
                           number);
    uint32_t *tile_at = dynamic->tiling->tile_at;
    for (size_t i = 0; i <= left; i++) tile_at[dynamic->boundary[i].vertex] = MW_NONE;
    for (size_t i = 0; i < left; i++) {
        uint32_t beyond = dynamic->boundary[i].beyond;
        if (beyond == MW_NONE) continue;
        tile_at[dynamic->boundary[i].vertex] = tile_at[dynamic->boundary[i + 1].vertex] =
            mw__link_triangle(beyond);
        if (!mw__journal_tile(dynamic, mw__link_triangle(beyond)))
            return mw__fail_memory(error); /* its vertices may have no other tile left */
        mw__attach(dynamic, beyond, MW_NONE);
        if (pool.used == 0) dynamic->last = mw__link_triangle(beyond);
    }
    if (!mw__legalise(dynamic)) return mw__fail_memory(error);
    mw__pool_end(dynamic, &pool, heir);
    return mw__drop_tiles(dynamic, pool.tile + pool.used, pool.count - pool.used)
               ? MW_OK
               : mw__fail_memory(error);
}

/* Fill one side of the line: steps[0 .. n - 1] become one. Sets *base to the half-edge of the line
 * on this side; MW_NONE if this side has no tile. */
static bool close_side(mw_dynamic_tiling *dynamic, mw_boundary_step *steps, size_t n, mw_pool *pool,
                       uint32_t *base)
{
    *base = MW_NONE;
    if (n == 0) return true;
    if (!mw__pool_begin(dynamic, pool) || !mw__chain_cut_corners(dynamic, steps, &n, pool))
        return false;
    *base = steps[0].beyond;
    dynamic->mark[mw__link_triangle(*base)] |= (uint8_t)(1u << mw__link_edge(*base));
    return true;
}

static mw_status close_line(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, mw_error *error)
{
    size_t n = star->n, first = star->spoke[0], middle = star->spoke[1] - first, rest = n - middle;
    if (star->open) rest = 0;
    if (!mw__boundary_room(dynamic, 2 * (n + 2))) return mw__fail_memory(error);
    mw_boundary_step *steps = dynamic->boundary + n + 2; /* the steps of each side, and its end */
    uint32_t *tiles = dynamic->pool + n + 2;
    for (size_t i = 0; i < n; i++) {
        size_t from = (first + i) % n;
        steps[i + (i >= middle)] = dynamic->boundary[from];
        tiles[i] = dynamic->pool[from];
    }
    steps[middle].vertex = dynamic->boundary[star->spoke[1]].vertex;
    steps[n + 1].vertex = dynamic->boundary[first].vertex;
    mw_pool one = {.tile = tiles, .count = middle}, two = {.tile = tiles + middle, .count = rest};
    uint32_t left, right;
    bool border = star->open ? !dynamic->convex
                             : mw__is_users_tile(dynamic, tiles[0]) !=
                                   mw__is_users_tile(dynamic, tiles[middle]);
    if (!close_side(dynamic, steps, middle, &one, &left) ||
        !close_side(dynamic, steps + middle + 1, rest, &two, &right) ||
        left == MW_NONE) /* the first side has at least one tile */
        return mw__fail_memory(error);
    mw__attach(dynamic, left, right);
    if (!border) dynamic->fixed_count--;
    if (!mw__legalise(dynamic)) return mw__fail_memory(error);
    mw__pool_end(dynamic, &one, MW_NONE);
    mw__pool_end(dynamic, &two, MW_NONE);
    memmove(two.tile, two.tile + two.used, (two.count - two.used) * sizeof *two.tile);
    return mw__drop_tiles(dynamic, one.tile + one.used, one.count - one.used + two.count - two.used)
               ? MW_OK
               : mw__fail_memory(error);
}

/* Are the first two fixed edges at v in line? */
static bool spokes_in_line(const mw_dynamic_tiling *dynamic, const mw_vertex_star *star, uint32_t v)
{
    const mw_point *p = dynamic->tiling->point;
    mw_point a = p[dynamic->boundary[star->spoke[0]].vertex],
             b = p[dynamic->boundary[star->spoke[1]].vertex];
    return mw__orient2d(a, b, p[v]) == 0 && mw__dot2d(p[v], a, b) < 0;
}

mw_status mw__dynamic_take_out(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, uint32_t v,
                               mw_error *error)
{
    return star->open ? shrink_hull(dynamic, star, error)
                      : ring_close(dynamic, star, dynamic->tiling->point[v], error);
}

static mw_status vertex_take_out(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, uint32_t v,
                                 mw_error *error)
{
    if (star->spokes == 2 && spokes_in_line(dynamic, star, v))
        return close_line(dynamic, star, error);
    if (star->spokes > 0) return refuse_fixed(dynamic, v, error);
    return mw__dynamic_take_out(dynamic, star, v, error);
}

mw_status mw__dynamic_remove(mw_dynamic_tiling *dynamic, uint32_t vertex, mw_error *error)
{
    mw_vertex_star star;
    if (!mw__vertex_star_collect(dynamic, vertex, &star)) return mw__fail_memory(error);
    mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    step->vertex = vertex;
    step->number = dynamic->vertex_number[vertex];
    step->point = dynamic->tiling->point[vertex];
    mw_status status = vertex_take_out(dynamic, &star, vertex, error);
    if (!status && !mw__free_vertex(dynamic, vertex)) status = mw__fail_memory(error);
    return status;
}
