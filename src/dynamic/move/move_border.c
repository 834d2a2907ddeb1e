/* move_border.c - a vertex with fixed edges moves, and the ghosts beside it make room.
 *
 * How pockets and holes are filled with ghosts must not decide where a border vertex can go: its
 * ghosts may turn over where its triangles do not. Then its triangles are set aside: their tiles
 * become ghosts. The vertex is taken out of its star and put in where it goes: into a ghost, or
 * outside of the hull. The edges to its neighbours are forced in among the ghosts, and the
 * triangles get the tiles between these edges. All other border edges stay fixed meanwhile; a move
 * that would cross one is refused.
 *
 *      a-----b         a     b         a     b         a-----b
 *      |\   /          |               |\   /          |\   /
 *      | \ /           |               | \ /           | \ /
 *      |  v            |   (taken      |  q   (put     |  q   (its triangles
 *      |               |    out)       |       in)     |       are back)
 *
 * v moves to q. The mesh lies to the right of the line a v b, a pocket to its left.
 *
 * A mesh that fills its hull has no ghosts before. Those left between the mesh and its new hull
 * become triangles. Time and memory are in proportion to the tiles round the vertex, before and
 * after, and to those that its new edges cross. */
#include "dynamic/move/move_border.h"

#include "dynamic/cavity.h"
#include "dynamic/channel.h"
#include "dynamic/flip.h"
#include "dynamic/journal.h"
#include "dynamic/operations.h"
#include "dynamic/tile_links.h"

#include "dynamic/move/hole_numbers.h"

#include "walk/walk.h"

#include <inttypes.h>
#include <stdlib.h>

/* A triangle set aside, as its tile was. */
typedef struct triangle_aside {
    uint32_t v[3], user, fixed;
    uint32_t corner; /* which of its vertices moves */
} triangle_aside;

typedef struct border_mover {
    mw_dynamic_tiling *dynamic;
    uint32_t v, ghost; /* the vertex; what new ghosts have as number */
    mw_point q;
    bool mixed; /* not all ghosts round v lie in one hole, or in none */
    triangle_aside *aside;
    size_t count;
    mw_error *error;
} border_mover;

static mw_status mover_fail_memory(const border_mover *m)
{
    return mw__fail_memory(m->error);
}

/* --- why not ---------------------------------------------------------------------------------- */

static uint32_t mover_number_of(const border_mover *m, uint32_t vertex)
{
    return m->dynamic->vertex_number[vertex];
}

static mw_status move_refuse_vertex(const border_mover *m, uint32_t there)
{
    return mw__fail_at(m->error, -1, mover_number_of(m, there),
                       "vertex %" PRIu32 " cannot move there: vertex %" PRIu32
                       " lies there already",
                       mover_number_of(m, m->v), mover_number_of(m, there));
}

static mw_status move_refuse_inside(const border_mover *m, uint32_t t)
{
    const uint32_t number = m->dynamic->tiling->tri[t].user & MW_USER_MASK;
    return mw__fail_at(m->error, number, mover_number_of(m, m->v),
                       "vertex %" PRIu32 " cannot move there: it would lie in triangle %" PRIu32,
                       mover_number_of(m, m->v), number);
}

/* The ends of an edge by their numbers, the lower one first: which side of it was met does not
 * show. */
typedef struct named_edge {
    uint32_t from, to;
} named_edge;

static named_edge edge_name(const border_mover *m, uint32_t half)
{
    const uint32_t a = mover_number_of(m, mw__corner(m->dynamic, half)),
                   b = mover_number_of(m, mw__corner(m->dynamic, mw__half_next(half)));
    return a < b ? (named_edge){a, b} : (named_edge){b, a};
}

static mw_status move_refuse_on_edge(const border_mover *m, uint32_t half)
{
    const named_edge edge = edge_name(m, half);
    return mw__fail_at(m->error, -1, mover_number_of(m, m->v),
                       "vertex %" PRIu32
                       " cannot move there: it would lie on the edge from vertex %" PRIu32
                       " to %" PRIu32,
                       mover_number_of(m, m->v), edge.from, edge.to);
}

static mw_status move_refuse_crossing(const border_mover *m, uint32_t to, uint32_t half)
{
    const named_edge edge = edge_name(m, half);
    return mw__fail_at(m->error, -1, mover_number_of(m, m->v),
                       "vertex %" PRIu32 " cannot move there: its edge to vertex %" PRIu32
                       " would cross the edge from vertex %" PRIu32 " to %" PRIu32,
                       mover_number_of(m, m->v), mover_number_of(m, to), edge.from, edge.to);
}

static mw_status move_refuse_way(const border_mover *m, uint32_t to, uint32_t on_way)
{
    return mw__fail_at(m->error, -1, mover_number_of(m, on_way),
                       "vertex %" PRIu32 " cannot move there: vertex %" PRIu32
                       " would lie on its edge to vertex %" PRIu32,
                       mover_number_of(m, m->v), mover_number_of(m, on_way),
                       mover_number_of(m, to));
}

static mw_status move_refuse_cover(const border_mover *m, const triangle_aside *a, uint32_t covered)
{
    const uint32_t number = a->user & MW_USER_MASK;
    return mw__fail_at(m->error, number, mover_number_of(m, covered),
                       "vertex %" PRIu32 " cannot move there: triangle %" PRIu32
                       " would cover vertex %" PRIu32,
                       mover_number_of(m, m->v), number, mover_number_of(m, covered));
}

/* --- triangles are set aside ------------------------------------------------------------------ */

/* Journal a tile and let its edge be fixed or not. */
static bool half_set_fixed(mw_dynamic_tiling *dynamic, uint32_t half, bool fixed)
{
    const uint32_t t = mw__link_triangle(half), bit = 1u << mw__link_edge(half);
    if (!mw__journal_tile(dynamic, t)) return false;
    mw__set_fixed(dynamic, t, (dynamic->mark[t] & MW_FIXED_EDGES & ~bit) | (fixed ? bit : 0));
    return true;
}

static bool beyond_set_fixed(mw_dynamic_tiling *dynamic, uint32_t half, bool fixed)
{
    const uint32_t other = mw__beyond(dynamic, half);
    return other == MW_NONE || half_set_fixed(dynamic, other, fixed);
}

/* What the gaps between the triangles round v are: one hole, a pocket or the outside; or several
 * of these. */
static void mover_find_ghost(border_mover *m, const mw_vertex_star *star)
{
    const mw_dynamic_tiling *dynamic = m->dynamic;
    m->ghost = star->open ? MW_GHOST | MW_POCKET : MW_NONE;
    for (size_t i = 0; i < star->n; i++) {
        const uint32_t user = dynamic->tiling->tri[dynamic->pool[i]].user & ~MW_REVERSED;
        if (!(user & MW_GHOST)) continue;
        m->mixed |= m->ghost != MW_NONE && m->ghost != user;
        m->ghost = user;
    }
    if (m->mixed) m->ghost = MW_GHOST | MW_POCKET;
}

/* The tiles round v become ghosts without fixed edges but those across from v, which stay as
 * long as v is away. */
static bool star_set_aside(border_mover *m, const mw_vertex_star *star)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    mover_find_ghost(m, star);
    m->aside = mw__alloc(star->n, sizeof *m->aside);
    if (!m->aside) return false;
    for (size_t i = 0; i < star->n; i++) {
        const uint32_t t = dynamic->pool[i], across = dynamic->boundary[i].half,
                       bit = 1u << mw__link_edge(across);
        mw_triangle *tile = &dynamic->tiling->tri[t];
        const uint32_t fixed = dynamic->mark[t] & MW_FIXED_EDGES;
        if (!mw__journal_tile(dynamic, t)) return false;
        if (tile->user & MW_GHOST) {
            mw__set_fixed(dynamic, t, fixed & bit);
            continue;
        }
        m->aside[m->count++] = (triangle_aside){
            {tile->v[0], tile->v[1], tile->v[2]}, tile->user, fixed, mw__corner_of(tile, m->v)};
        tile->user = m->ghost;
        dynamic->tiling->ghost_count++;
        mw__set_fixed(dynamic, t, bit);
        if (!beyond_set_fixed(dynamic, across, true)) return false;
    }
    return true;
}

static mw_status vertex_take_away(border_mover *m, const mw_vertex_star *star)
{
    mw_vertex_star empty;
    if (!star_set_aside(m, star) || !mw__vertex_star_collect(m->dynamic, m->v, &empty))
        return mover_fail_memory(m);
    return mw__dynamic_take_out(m->dynamic, &empty, m->v, m->error);
}

/* --- the vertex is put in --------------------------------------------------------------------- */

/* The steps round q in dynamic->boundary, and the tiles that go in dynamic->pool. */
typedef struct vertex_site {
    size_t steps, tiles;
    bool open; /* q will lie on the hull */
} vertex_site;

static void site_add_step(mw_dynamic_tiling *dynamic, vertex_site *s, uint32_t half)
{
    dynamic->boundary[s->steps++] = (mw_boundary_step){.vertex = mw__corner(dynamic, half),
                                                       .beyond = mw__beyond(dynamic, half),
                                                       .half = half,
                                                       .fixed = mw__is_fixed(dynamic, half)};
    dynamic->boundary[s->steps].vertex = mw__corner(dynamic, mw__half_next(half));
}

static void site_add_tile(mw_dynamic_tiling *dynamic, vertex_site *s, uint32_t t)
{
    dynamic->pool[s->tiles++] = t;
}

static mw_status site_dig_tile(border_mover *m, uint32_t t, vertex_site *s)
{
    if (mw__is_users_tile(m->dynamic, t)) return move_refuse_inside(m, t);
    for (uint32_t k = 0; k < 3; k++) site_add_step(m->dynamic, s, mw__link(t, k));
    site_add_tile(m->dynamic, s, t);
    return MW_OK;
}

static mw_status site_dig_edge(border_mover *m, uint32_t half, vertex_site *s)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    const uint32_t sides[2] = {half, mw__beyond(dynamic, half)};
    if (mw__is_fixed(dynamic, half) || mw__is_users_tile(dynamic, mw__link_triangle(half)))
        return move_refuse_on_edge(m, half);
    s->open = sides[1] == MW_NONE;
    for (int i = 0; i < 2 && sides[i] != MW_NONE; i++) {
        site_add_step(dynamic, s, mw__half_next(sides[i]));
        site_add_step(dynamic, s, mw__half_prev(sides[i]));
        site_add_tile(dynamic, s, mw__link_triangle(sides[i]));
    }
    return MW_OK;
}

/* Beyond the hull, near tile t: the edges that q sees, from the last to the first. */
static mw_status site_dig_outside(border_mover *m, uint32_t t, vertex_site *s)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    uint32_t half = mw__link(t, 0);
    s->open = true;
    while (mw__beyond(dynamic, half) != MW_NONE || !mw__sees_hull_edge(dynamic, m->q, half))
        half = mw__half_next(half);
    while (mw__sees_hull_edge(dynamic, m->q, mw__hull_after(dynamic, half)))
        half = mw__hull_after(dynamic, half);
    for (; mw__sees_hull_edge(dynamic, m->q, half); half = mw__hull_before(dynamic, half)) {
        if (!mw__journal_tile(dynamic, mw__link_triangle(half)) ||
            !mw__boundary_room(dynamic, s->steps + 2))
            return mover_fail_memory(m);
        dynamic->boundary[s->steps++] =
            (mw_boundary_step){.vertex = mw__corner(dynamic, mw__half_next(half)),
                               .beyond = half,
                               .fixed = mw__is_fixed(dynamic, half)};
        dynamic->boundary[s->steps].vertex = mw__corner(dynamic, half);
    }
    return MW_OK;
}

static mw_status site_dig(border_mover *m, uint32_t from, vertex_site *s)
{
    enum { STEPS = 8 };
    mw_dynamic_tiling *dynamic = m->dynamic;
    mw_walk walk = mw__walk_begin(dynamic->tiling, m->q, from, 0, 0, NULL);
    const bool inside = mw__walk_surely(&walk, false) == MW_VERDICT_FOUND;
    const mw_point *p = dynamic->tiling->point;
    const uint32_t t = walk.t, *v = dynamic->tiling->tri[t].v;
    if (!mw__boundary_room(dynamic, STEPS)) return mover_fail_memory(m);
    if (!inside) return site_dig_outside(m, t, s);
    for (uint32_t k = 0; k < 3; k++)
        if (p[v[k]].x == m->q.x && p[v[k]].y == m->q.y) return move_refuse_vertex(m, v[k]);
    for (uint32_t k = 0; k < 3; k++)
        if (mw__orient2d(p[v[k]], p[v[k + 1]], m->q) == 0)
            return site_dig_edge(m, mw__link(t, k), s);
    return site_dig_tile(m, t, s);
}

/* Fill the site with ghosts round the vertex. */
static mw_status site_fill(border_mover *m, const vertex_site *s)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    const size_t more = s->steps - s->tiles;
    for (size_t i = 0; i < s->tiles; i++)
        if (!mw__journal_tile(dynamic, dynamic->pool[i])) return mover_fail_memory(m);
    if (!mw__tile_room_grow(dynamic, more, false))
        return dynamic->tiling->tri_count > MW_MAX_TRIANGLES - more
                   ? mw__fail(m->error, MW_ERROR_LIMIT,
                              "no triangle number is left; compact the editor")
                   : mover_fail_memory(m);
    mw__add_ghosts(dynamic, m->ghost, (uint32_t)more, dynamic->pool + s->tiles);
    dynamic->tiling->point[m->v] = m->q;
    for (size_t i = 0; i < s->steps; i++) {
        const uint32_t t = dynamic->pool[i];
        mw__set_corners(dynamic, t, dynamic->boundary[i].vertex, dynamic->boundary[i + 1].vertex,
                        m->v);
        mw__set_fixed(dynamic, t, dynamic->boundary[i].fixed);
        mw__attach(dynamic, mw__link(t, 0), dynamic->boundary[i].beyond);
        if (i > 0) mw__attach(dynamic, mw__link(t, 2), mw__link(dynamic->pool[i - 1], 1));
    }
    mw__attach(dynamic, mw__link(dynamic->pool[0], 2),
               s->open ? MW_NONE : mw__link(dynamic->pool[s->steps - 1], 1));
    if (s->open) mw__attach(dynamic, mw__link(dynamic->pool[s->steps - 1], 1), MW_NONE);
    return MW_OK;
}

static mw_status vertex_put_in(border_mover *m, uint32_t from)
{
    vertex_site s = {0};
    mw_status status = site_dig(m, from, &s);
    return status ? status : site_fill(m, &s);
}

/* --- the triangles come back ------------------------------------------------------------------ */

/* An edge that begins at v. */
static uint32_t edge_of_mover(const border_mover *m)
{
    const uint32_t t = m->dynamic->tiling->tile_at[m->v];
    return mw__link(t, mw__corner_of(&m->dynamic->tiling->tri[t], m->v));
}

/* Make an edge from v to one of its neighbours, which stays. */
static mw_status edge_join(border_mover *m, uint32_t to)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    mw_forced_edge forced;
    if (!mw__edge_force(dynamic, edge_of_mover(m), to, &forced)) return mover_fail_memory(m);
    if (forced.half == MW_NONE) return move_refuse_crossing(m, to, forced.blocked);
    if (forced.end != to) return move_refuse_way(m, to, forced.end);
    bool done = half_set_fixed(dynamic, forced.half, true) &&
                beyond_set_fixed(dynamic, forced.half, true) && mw__legalise(dynamic);
    return done ? MW_OK : mover_fail_memory(m);
}

/* The edge from v to a vertex, beside the tile on its left: from a half-edge that begins at v
 * on. There is one. */
static uint32_t edge_turn_to(const mw_dynamic_tiling *dynamic, uint32_t half, uint32_t to)
{
    const uint32_t v = mw__corner(dynamic, half);
    bool open;
    while (mw__corner(dynamic, mw__half_next(half)) != to) {
        uint32_t after = mw__beyond(dynamic, mw__half_prev(half));
        half = after != MW_NONE
                   ? after
                   : mw__vertex_star_first_from(dynamic, v, mw__link_triangle(half), &open);
    }
    return half;
}

/* The tile of the edge `half` from v becomes the triangle, in the order of vertices that it had. */
static bool triangle_give_tile(border_mover *m, uint32_t half, const triangle_aside *a)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    const uint32_t t = mw__link_triangle(half);
    if (!mw__journal_tile(dynamic, t)) return false;
    mw_triangle *tile = &dynamic->tiling->tri[t];
    const mw_triangle was = *tile;
    *tile = (mw_triangle){.v = {a->v[0], a->v[1], a->v[2], a->v[0]}, .user = a->user};
    for (uint32_t k = 0; k < 3; k++)
        mw__attach(dynamic, mw__link(t, k),
                   was.link[(k + 3 - a->corner + mw__link_edge(half)) % 3]);
    dynamic->tiling->tile_of[a->user & MW_USER_MASK] = t;
    dynamic->tiling->ghost_count--;
    mw__set_fixed(dynamic, t, a->fixed);
    dynamic->last = t;
    for (uint32_t k = 0; k < 3; k++)
        if (!beyond_set_fixed(dynamic, mw__link(t, k), a->fixed >> k & 1)) return false;
    return true;
}

static mw_status triangles_bring_back(border_mover *m)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    for (size_t i = 0; i < m->count; i++)
        for (uint32_t k = 1; k < 3; k++) {
            mw_status status = edge_join(m, m->aside[i].v[(m->aside[i].corner + k) % 3]);
            if (status) return status;
        }
    uint32_t half = edge_of_mover(m);
    for (size_t i = 0; i < m->count; i++) {
        const triangle_aside *a = &m->aside[i];
        half = edge_turn_to(dynamic, half, a->v[(a->corner + 1) % 3]);
        const uint32_t apex = mw__apex(dynamic, half);
        if (apex != a->v[(a->corner + 2) % 3]) return move_refuse_cover(m, a, apex);
        if (!triangle_give_tile(m, half, a)) return mover_fail_memory(m);
        half = mw__link(mw__link_triangle(half), a->corner); /* as the tile counts its edges now */
    }
    return MW_OK;
}

/* --- ghosts beside a mesh that fills its hull ------------------------------------------------- */

/* A ghost by the numbers of its vertices, from the lowest on. */
typedef struct named_ghost {
    uint32_t vertex[3], tile;
} named_ghost;

static named_ghost ghost_name(const mw_dynamic_tiling *dynamic, uint32_t t)
{
    const uint32_t *v = dynamic->tiling->tri[t].v, *number = dynamic->vertex_number;
    uint32_t k = 0;
    for (uint32_t i = 1; i < 3; i++)
        if (number[v[i]] < number[v[k]]) k = i;
    return (named_ghost){{number[v[k]], number[v[mw__next(k)]], number[v[mw__prev(k)]]}, t};
}

static int ghosts_compare(const void *left, const void *right)
{
    const named_ghost *a = left, *b = right;
    int k = 0;
    while (k < 2 && a->vertex[k] == b->vertex[k]) k++;
    return (a->vertex[k] > b->vertex[k]) - (a->vertex[k] < b->vertex[k]);
}

/* All ghosts, which this edit has made, in an order that does not depend on their slots: a replay
 * gives the same numbers. */
static named_ghost *ghosts_list(const mw_dynamic_tiling *dynamic)
{
    const mw_journal_entry *first;
    const size_t journaled = mw__journal_entries(dynamic, &first);
    named_ghost *list = mw__alloc(dynamic->tiling->ghost_count, sizeof *list);
    size_t n = 0;
    if (!list) return NULL;
    for (size_t i = 0; i < journaled; i++)
        if (first[i].slot < dynamic->tiling->tri_count &&
            !mw__is_users_tile(dynamic, first[i].slot))
            list[n++] = ghost_name(dynamic, first[i].slot);
    for (uint32_t t = dynamic->step[dynamic->step_count - 1].tiles; t < dynamic->tiling->tri_count;
         t++)
        if (!mw__is_users_tile(dynamic, t)) list[n++] = ghost_name(dynamic, t);
    qsort(list, n, sizeof *list, ghosts_compare);
    return list;
}

/* The number after the last becomes that of a ghost, whose edges may have to be flipped. */
static bool ghost_adopt(mw_dynamic_tiling *dynamic, uint32_t t)
{
    mw_tiling *tiling = dynamic->tiling;
    tiling->tri[t].user = tiling->number_count;
    tiling->tile_of[tiling->number_count++] = t;
    for (uint32_t k = 0; k < 3; k++)
        if (!mw__stack_push(dynamic, mw__link(t, k))) return false;
    return true;
}

static mw_status ghosts_adopt(border_mover *m)
{
    mw_tiling *tiling = m->dynamic->tiling;
    const uint32_t n = tiling->ghost_count;
    named_ghost *list = ghosts_list(m->dynamic);
    bool done = list && mw__tile_room_grow(m->dynamic, n, true);
    for (uint32_t i = 0; i < n && done; i++) done = ghost_adopt(m->dynamic, list[i].tile);
    free(list);
    if (done) tiling->ghost_count = 0;
    if (done || n <= MW_USER_MASK - tiling->number_count)
        return done ? MW_OK : mover_fail_memory(m);
    return mw__fail(m->error, MW_ERROR_LIMIT, "no triangle number is left; compact the editor");
}

/* --- all of it -------------------------------------------------------------------------------- */

/* Tiles at the end of the array are in no journal that would clear their marks. */
static void filled_marks_clear(mw_dynamic_tiling *dynamic)
{
    const uint32_t end = dynamic->tiling->tri_count;
    for (uint32_t t = dynamic->step[dynamic->step_count - 1].tiles; t < end; t++)
        dynamic->mark[t] &= (uint8_t)~MW_FILLED;
}

/* The ghosts are what they are to be, or become triangles; edges that are not Delaunay are
 * flipped. */
static mw_status mover_settle(border_mover *m, bool delaunay)
{
    mw_dynamic_tiling *dynamic = m->dynamic;
    mw_vertex_star star;
    mw_status status = MW_OK;
    if (m->mixed && !mw__hole_numbers_update(dynamic)) return mover_fail_memory(m);
    dynamic->stack_count = 0;
    if (!mw__vertex_star_collect(dynamic, m->v, &star)) return mover_fail_memory(m);
    if (dynamic->convex) status = ghosts_adopt(m);
    filled_marks_clear(dynamic);
    dynamic->flips = 0;
    dynamic->delaunay = delaunay;
    if (!delaunay) dynamic->stack_count = 0;
    if (status || !delaunay) return status;
    return mw__vertex_star_push(dynamic, &star) && mw__legalise(dynamic) ? MW_OK
                                                                         : mover_fail_memory(m);
}

mw_status mw__border_move(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, uint32_t v,
                          mw_point q, uint32_t t, mw_error *error)
{
    border_mover m = {.dynamic = dynamic, .v = v, .q = q, .error = error};
    const bool delaunay = dynamic->delaunay;
    /* until all is in place again, only new ghosts are flipped; a rollback restores this */
    dynamic->delaunay = false;
    mw_status status = vertex_take_away(&m, star);
    if (!status) status = vertex_put_in(&m, t < dynamic->tiling->tri_count ? t : dynamic->last);
    if (!status) status = triangles_bring_back(&m);
    if (!status) status = mover_settle(&m, delaunay);
    free(m.aside);
    return status;
}
