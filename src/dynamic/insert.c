/* insert.c - a vertex is inserted in a tile, on an edge, or outside of the hull.
 *
 * The tiles in conflict with the vertex are deleted (cavity.h), and the cavity is filled with a
 * star round the vertex. Flips, one after another, would lead to the same tiles [Lawson 1977]; here
 * each is made once. The vertex is corner 2 of each new tile. */
#include "dynamic/cavity.h"
#include "dynamic/journal.h"
#include "dynamic/operations.h"
#include "dynamic/tile_links.h"

#include "walk/remembering_corners.h"

#include <inttypes.h>

static mw_status refuse_outside(mw_point q, mw_error *error)
{
    return mw__fail(error, MW_ERROR_INPUT, "the point %.17g, %.17g lies outside of the mesh", q.x,
                    q.y);
}

/* --- the star --------------------------------------------------------------------------------- */

/* Begin a step if there is none: from here on the insertion may fail after it has changed tiles. */
static bool insertion_begin(mw_dynamic_tiling *dynamic, mw_point q)
{
    return dynamic->under_way ||
           mw__journal_begin(dynamic, &(mw_edit){.kind = MW_EDIT_INSERT, .x = q.x, .y = q.y}, true);
}

/* Add a vertex at q, if *vertex is MW_NONE. */
static mw_status insertion_make_vertex(mw_dynamic_tiling *dynamic, mw_point q, uint32_t *vertex,
                                       mw_error *error)
{
    if (*vertex != MW_NONE) return MW_OK;
    if (!mw__vertex_room(dynamic, 1))
        return dynamic->vertex_count >= MW_GONE - 1
                   ? mw__fail(error, MW_ERROR_LIMIT, "no vertex number is left; compact the editor")
                   : mw__fail_memory(error);
    *vertex = mw__add_vertex(dynamic, q);
    if (dynamic->under_way) dynamic->step[dynamic->step_count - 1].vertex = *vertex;
    return MW_OK;
}

/* Consecutive tiles round a vertex, counter-clockwise. */
typedef struct vertex_fan {
    uint32_t first, last;
} vertex_fan;

static mw_status insertion_tile_failure(const mw_dynamic_tiling *dynamic, size_t n, mw_error *error)
{
    if (dynamic->tiling->number_count > MW_USER_MASK - n ||
        dynamic->tiling->tri_count > MW_MAX_TRIANGLES - n)
        return mw__fail(error, MW_ERROR_LIMIT, "no triangle number is left; compact the editor");
    return mw__fail_memory(error);
}

static MW_INLINE bool journal_cavity(mw_dynamic_tiling *dynamic, const mw_cavity *cavity)
{
    for (size_t i = 0; dynamic->journal_below > 0 && i < cavity->tiles; i++)
        if (!mw__journal_tile(dynamic, dynamic->pool[cavity->pool + i])) return false;
    return true;
}

/* Fill the cavity with tiles round the vertex: those of the cavity, and new ones like tile
 * `beside`. If this fails, it has changed nothing. */
static mw_status cavity_fill(mw_dynamic_tiling *dynamic, const mw_cavity *cavity, uint32_t *vertex,
                             uint32_t beside, vertex_fan *made, mw_error *error)
{
    const size_t more = cavity->steps - cavity->tiles;
    if (!mw__tile_room(dynamic, beside, more)) return insertion_tile_failure(dynamic, more, error);
    if (!journal_cavity(dynamic, cavity)) return mw__fail_memory(error);
    mw_status status = insertion_make_vertex(dynamic, cavity->q, vertex, error);
    if (status) return status;
    const uint32_t v = *vertex;
    dynamic->star = (uint32_t)cavity->steps;
    uint32_t *pool = dynamic->pool + cavity->pool;
    mw__add_tiles(dynamic, beside, (uint32_t)more, pool + cavity->tiles);
    /* as if the star were closed */
    pool[cavity->steps] = pool[0];
    const bool unconstrained = dynamic->fixed_count == 0 && dynamic->convex; /* no edge is fixed */
    mw_triangle *tri = dynamic->tiling->tri;
    uint32_t *tile_at = dynamic->tiling->tile_at, before = pool[cavity->steps - 1];
    const mw_boundary_step *step = dynamic->boundary + cavity->first;
    for (const uint32_t *at = pool, *end = pool + cavity->steps; at < end; at++, step++) {
        const uint32_t t = at[0], after = at[1], from = step[0].vertex, to = step[1].vertex,
                       beyond = step->beyond;
        tri[t] = (mw_triangle){{from, to, v, from},
                               {beyond, mw__link(after, 2), mw__link(before, 1)},
                               tri[t].user & ~MW_REVERSED};
        if (beyond != MW_NONE)
            tri[mw__link_triangle(beyond)].link[mw__link_edge(beyond)] = mw__link(t, 0);
        if (!unconstrained) mw__set_fixed(dynamic, t, step->fixed);
        tile_at[from] = before = t;
    }
    tile_at[step->vertex] = tile_at[v] = before;
    *made = (vertex_fan){pool[0], before};
    return MW_OK;
}

/* The fan is not closed: its first and last edge have no neighbour yet. */
static void insertion_open_fan(mw_dynamic_tiling *dynamic, const vertex_fan *made)
{
    mw__attach(dynamic, mw__link(made->last, 1), MW_NONE);
    mw__attach(dynamic, mw__link(made->first, 2), MW_NONE);
}

/* Insert in tile t. The first three lifted vertices are its corners. */
static mw_status insert_in_tile(mw_dynamic_tiling *dynamic, uint32_t t, mw_point q, uint32_t *v,
                                mw_error *error)
{
    if (!mw__is_users_tile(dynamic, t)) return refuse_outside(q, error);
    mw_cavity cavity = {.q = q};
    vertex_fan made;
    if (!mw__cavity_dig_tile(dynamic, &cavity, t)) return mw__fail_memory(error);
    return cavity_fill(dynamic, &cavity, v, t, &made, error);
}

/* --- on an edge ------------------------------------------------------------------------------- */

/* The side of an edge whose tile has the lower number. The result must not depend on the side that
 * the walk reached. */
static uint32_t insertion_lower_side(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    uint32_t other = mw__beyond(dynamic, half);
    if (other == MW_NONE) return half;
    uint32_t one = dynamic->tiling->tri[mw__link_triangle(half)].user & ~MW_REVERSED;
    uint32_t two = dynamic->tiling->tri[mw__link_triangle(other)].user & ~MW_REVERSED;
    return one <= two ? half : other;
}

/* Dig and fill the cavity on one side of an edge, that of `half`, in the lists from cavity->first
 * and cavity->pool on. */
static mw_status insert_beside(mw_dynamic_tiling *dynamic, uint32_t half, mw_cavity *cavity,
                               uint32_t *v, vertex_fan *made, mw_error *error)
{
    bool fixed = mw__is_fixed(dynamic, half);
    if (!mw__cavity_dig_side(dynamic, cavity, half)) return mw__fail_memory(error);
    mw_status status = cavity_fill(dynamic, cavity, v, mw__link_triangle(half), made, error);
    if (status) return status;
    insertion_open_fan(dynamic, made);
    if (!fixed) return MW_OK;
    dynamic->mark[made->first] |= 4;
    dynamic->mark[made->last] |= 2;
    return MW_OK;
}

static mw_status insert_on_edge(mw_dynamic_tiling *dynamic, uint32_t half, mw_point q, uint32_t *v,
                                mw_error *error)
{
    half = insertion_lower_side(dynamic, half);
    uint32_t other = mw__beyond(dynamic, half), t = mw__link_triangle(half);
    bool users = mw__is_users_tile(dynamic, t),
         border = other == MW_NONE ? !dynamic->convex && users
                                   : users != mw__is_users_tile(dynamic, mw__link_triangle(other));
    if (!users && !border) return refuse_outside(q, error);
    if (!insertion_begin(dynamic, q)) return mw__fail_memory(error);
    if (mw__is_fixed(dynamic, half) && !border) dynamic->fixed_count++;
    mw_cavity one = {.q = q}, two = one;
    vertex_fan left, right;
    mw_status status = insert_beside(dynamic, half, &one, v, &left, error);
    if (status || other == MW_NONE) return status;
    two.first = one.steps + 1;
    two.pool = one.tiles;
    status = insert_beside(dynamic, other, &two, v, &right, error);
    if (status) return status;
    mw__attach(dynamic, mw__link(left.last, 1), mw__link(right.first, 2));
    mw__attach(dynamic, mw__link(right.last, 1), mw__link(left.first, 2));
    return MW_OK;
}

/* --- beyond the hull -------------------------------------------------------------------------- */

static mw_status insert_outside(mw_dynamic_tiling *dynamic, uint32_t t, mw_point q, uint32_t *v,
                                mw_error *error)
{
    if (!dynamic->convex) return refuse_outside(q, error);
    if (!insertion_begin(dynamic, q)) return mw__fail_memory(error);
    mw_cavity cavity = {.q = q};
    vertex_fan made;
    if (!mw__cavity_dig_outside(dynamic, &cavity, t)) return mw__fail_memory(error);
    mw_status status = cavity_fill(dynamic, &cavity, v, t, &made, error);
    if (!status) insertion_open_fan(dynamic, &made);
    return status;
}

/* --- all of them ------------------------------------------------------------------------------ */

/* Which of the first three lifted vertices coincides with q? 3 if none does. */
static uint32_t insertion_coinciding_corner(const mw_dynamic_tiling *dynamic)
{
    uint32_t k = 0;
    while (k < 3 && (dynamic->lifted[k].x != 0 || dynamic->lifted[k].y != 0)) k++;
    return k;
}

/* The edge of a tile on which q lies. The first three lifted vertices are the corners of the
 * tile. */
static uint32_t insertion_edge_through(const mw_dynamic_tiling *dynamic, uint32_t t, mw_point q)
{
    uint32_t k = 0;
    while (k < 2 &&
           mw__lifted_side(dynamic->tiling, &dynamic->lifted[k], &dynamic->lifted[k + 1], q) != 0)
        k++;
    return mw__link(t, k);
}

mw_status mw__dynamic_insert(mw_dynamic_tiling *dynamic, mw_point q, uint32_t t, uint32_t *vertex,
                             mw_error *error)
{
    enum { LIFTED = 16 };
    if (!mw__boundary_room(dynamic, LIFTED)) return mw__fail_memory(error);
    /* the first three lifted vertices become the corners of the tile */
    const mw_walk_end at = mw__remembering_corners(dynamic->tiling, q, t, dynamic->lifted);
    dynamic->last = at.tile;
    dynamic->walked = at.walked;
    if (MW_UNLIKELY(at.on_boundary) && insertion_coinciding_corner(dynamic) < 3) {
        *vertex = dynamic->lifted[insertion_coinciding_corner(dynamic)].vertex;
        return MW_OK;
    }
    if (MW_UNLIKELY(!at.inside)) return insert_outside(dynamic, at.tile, q, vertex, error);
    if (MW_UNLIKELY(at.on_boundary))
        return insert_on_edge(dynamic, insertion_edge_through(dynamic, at.tile, q), q, vertex,
                              error);
    return insert_in_tile(dynamic, at.tile, q, vertex, error);
}
