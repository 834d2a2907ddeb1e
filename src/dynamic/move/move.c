/* move.c - a vertex moves.
 *
 * While no tile of its star turns over, the vertex stays in its star. Otherwise it is removed and
 * inserted again. A vertex with fixed edges takes its triangles along (move_border.h). */
#include "dynamic/move/move.h"

#include "dynamic/flip.h"
#include "dynamic/operations.h"
#include "dynamic/vertex_star.h"
#include "dynamic/move/move_border.h"

#include <inttypes.h>

/* Does the hull stay convex if its vertex, between boundary vertices n and 0, moves to q? */
static bool move_keeps_hull(const mw_dynamic_tiling *dynamic, const mw_vertex_star *star,
                            mw_point q)
{
    const mw_point *p = dynamic->tiling->point;
    uint32_t after = dynamic->boundary[0].vertex, before = dynamic->boundary[star->n].vertex;
    bool open;
    uint32_t out = mw__vertex_star_first(dynamic, after, &open); /* the hull edge that leaves it */
    mw_point beyond = p[mw__corner(dynamic, mw__half_next(out))];
    /* from the first tile of `before` to its last one, where the hull comes in */
    uint32_t in = mw__half_prev(mw__vertex_star_first(dynamic, before, &open));
    while (mw__beyond(dynamic, in) != MW_NONE) in = mw__half_prev(mw__beyond(dynamic, in));
    return mw__orient2d(p[before], q, p[after]) >= 0 && mw__orient2d(q, p[after], beyond) >= 0 &&
           mw__orient2d(p[mw__corner(dynamic, in)], p[before], q) >= 0;
}

static bool move_keeps_star(const mw_dynamic_tiling *dynamic, const mw_vertex_star *star,
                            mw_point q)
{
    const mw_point *p = dynamic->tiling->point;
    for (size_t i = 0; i < star->n; i++) {
        uint32_t to = mw__corner(dynamic, mw__half_next(dynamic->boundary[i].half));
        if (!(mw__orient2d(p[dynamic->boundary[i].vertex], p[to], q) > 0)) return false;
    }
    return !star->open || move_keeps_hull(dynamic, star, q);
}

/* Move the vertex within its star. All edges of the star may have to be flipped. */
static mw_status vertex_shift(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, uint32_t v,
                              mw_point q, mw_error *error)
{
    dynamic->tiling->point[v] = q;
    dynamic->last = dynamic->pool[0];
    if (!dynamic->delaunay) return MW_OK;
    return mw__vertex_star_push(dynamic, star) && mw__legalise(dynamic) ? MW_OK
                                                                        : mw__fail_memory(error);
}

/* Of the triangles in the star, the lowest one that would turn over or lose its area with the
 * vertex at q; MW_NONE if none would. */
static uint32_t turned_triangle(const mw_dynamic_tiling *dynamic, const mw_vertex_star *star,
                                mw_point q)
{
    const mw_point *p = dynamic->tiling->point;
    uint32_t lowest = MW_NONE;
    for (size_t i = 0; i < star->n; i++) {
        const uint32_t half = dynamic->boundary[i].half,
                       number = dynamic->tiling->tri[dynamic->pool[i]].user & MW_USER_MASK;
        const uint32_t to = mw__corner(dynamic, mw__half_next(half));
        if (!mw__is_users_tile(dynamic, dynamic->pool[i]) ||
            mw__orient2d(p[dynamic->boundary[i].vertex], p[to], q) > 0)
            continue;
        if (number < lowest) lowest = number;
    }
    return lowest;
}

static mw_status refuse_turned(const mw_dynamic_tiling *dynamic, uint32_t v, uint32_t triangle,
                               mw_error *error)
{
    return mw__fail_at(error, triangle, dynamic->vertex_number[v],
                       "vertex %" PRIu32 " cannot move there: triangle %" PRIu32
                       " would turn over or be flat",
                       dynamic->vertex_number[v], triangle);
}

/* Move v, which has fixed edges, or without which no triangle is left: it cannot be taken out and
 * inserted just anywhere. */
static mw_status move_with_triangles(mw_dynamic_tiling *dynamic, const mw_vertex_star *star,
                                     uint32_t v, mw_point q, uint32_t t, mw_error *error)
{
    const uint32_t turned = turned_triangle(dynamic, star, q);
    return turned == MW_NONE ? mw__border_move(dynamic, star, v, q, t, error)
                             : refuse_turned(dynamic, v, turned, error);
}

/* Do all vertices but v lie on one line? Then all tiles are in its star, between the line and v. */
static bool star_is_whole_mesh(const mw_dynamic_tiling *dynamic, const mw_vertex_star *star)
{
    const mw_point *p = dynamic->tiling->point;
    const mw_boundary_step *step = dynamic->boundary;
    if (!star->open || star->n < dynamic->tiling->tri_count) return false;
    for (size_t i = 2; i <= star->n; i++)
        if (mw__orient2d(p[step[0].vertex], p[step[1].vertex], p[step[i].vertex]) != 0)
            return false;
    return true;
}

mw_status mw__dynamic_move(mw_dynamic_tiling *dynamic, uint32_t vertex, mw_point q, uint32_t t,
                           mw_error *error)
{
    mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    mw_vertex_star star;
    if (!mw__vertex_star_collect(dynamic, vertex, &star)) return mw__fail_memory(error);
    step->vertex = vertex;
    step->point = dynamic->tiling->point[vertex];
    if (move_keeps_star(dynamic, &star, q)) return vertex_shift(dynamic, &star, vertex, q, error);
    if (star.spokes > 0 || star_is_whole_mesh(dynamic, &star))
        return move_with_triangles(dynamic, &star, vertex, q, t, error);
    mw_status status = mw__dynamic_take_out(dynamic, &star, vertex, error);
    if (status) return status;
    dynamic->tiling->point[vertex] = q;
    uint32_t at = vertex;
    status = mw__dynamic_insert(dynamic, q, t < dynamic->tiling->tri_count ? t : dynamic->last, &at,
                                error);
    if (!status && at != vertex)
        status = mw__fail_at(error, -1, dynamic->vertex_number[at],
                             "vertex %" PRIu32 " lies there already", dynamic->vertex_number[at]);
    return status;
}
