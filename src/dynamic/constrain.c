/* constrain.c - constraints: a segment is forced into the tiling, or released.
 *
 * The segment is followed from its first vertex. An edge that lies on it becomes a constrained
 * edge. Where no edge does, the segment enters a tile and crosses edges until the next vertex on
 * it. The tiles crossed are a channel. Each vertex of the channel is an end of an edge that crosses
 * the segment; so either side of the channel can be filled by cutting off corners (boundary.h), and
 * the constrained edge is the edge between the two sides. */
#include "dynamic/channel.h"
#include "dynamic/flip.h"
#include "dynamic/operations.h"
#include "dynamic/boundary.h"
#include "dynamic/tile_links.h"
#include "dynamic/vertex_star.h"

#include <inttypes.h>

static bool edge_is_border(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    uint32_t other = mw__beyond(dynamic, half);
    if (other == MW_NONE)
        return !dynamic->convex && mw__is_users_tile(dynamic, mw__link_triangle(half));
    return mw__is_users_tile(dynamic, mw__link_triangle(half)) !=
           mw__is_users_tile(dynamic, mw__link_triangle(other));
}

/* --- where a segment leaves a vertex ---------------------------------------------------------- */

/* How a segment leaves a vertex. Along an edge: `half` begins at the vertex (on the hull it may end
 * there), and `vertex` is the other end. Through a tile: `half` is the edge opposite of the vertex,
 * which the segment crosses, and `vertex` is MW_NONE. */
typedef struct star_exit {
    uint32_t half, vertex;
} star_exit;

static bool vertex_lies_ahead(const mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                              uint32_t v)
{
    const mw_point *p = dynamic->tiling->point;
    return mw__orient2d(p[from], p[to], p[v]) == 0 && mw__dot2d(p[from], p[to], p[v]) > 0;
}

/* `begin`: an edge that begins at `from`. The search goes counter-clockwise from there; on the hull
 * it continues at the first tile. */
static star_exit exit_after_edge(const mw_dynamic_tiling *dynamic, uint32_t begin, uint32_t from,
                                 uint32_t to)
{
    const mw_point *p = dynamic->tiling->point;
    uint32_t at = begin;
    bool open;
    do {
        uint32_t across = mw__half_next(at), last = mw__half_prev(at);
        uint32_t a = mw__corner(dynamic, across), b = mw__corner(dynamic, last);
        if (vertex_lies_ahead(dynamic, from, to, a)) return (star_exit){at, a};
        if (vertex_lies_ahead(dynamic, from, to, b)) return (star_exit){last, b};
        if (mw__orient2d(p[from], p[to], p[a]) < 0 && mw__orient2d(p[from], p[to], p[b]) > 0)
            return (star_exit){across, MW_NONE};
        at = mw__beyond(dynamic, last);
        if (at == MW_NONE)
            at = mw__vertex_star_first_from(dynamic, from, mw__link_triangle(begin), &open);
    } while (at != begin);
    return (star_exit){MW_NONE, MW_NONE}; /* it leaves the hull: impossible between two vertices */
}

/* dynamic->last is a tile of `from`. */
static star_exit exit_from_vertex(const mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to)
{
    bool open;
    return exit_after_edge(dynamic, mw__vertex_star_first_from(dynamic, from, dynamic->last, &open),
                           from, to);
}

static mw_status refuse_crossing(const mw_dynamic_tiling *dynamic, uint32_t half, mw_error *error)
{
    uint32_t a = dynamic->vertex_number[mw__corner(dynamic, half)],
             b = dynamic->vertex_number[mw__corner(dynamic, mw__half_next(half))];
    return mw__fail_at(
        error, -1, a,
        "the constraint or border edge from vertex %" PRIu32 " to %" PRIu32 " is in the way", a, b);
}

static mw_status refuse_leaving(const mw_dynamic_tiling *dynamic, uint32_t from, mw_error *error)
{
    return mw__fail_at(error, -1, dynamic->vertex_number[from],
                       "the segment leaves the mesh at vertex %" PRIu32 "",
                       dynamic->vertex_number[from]);
}

/* --- the channel ------------------------------------------------------------------------------ */

typedef struct constraint_channel {
    mw_boundary_step *right, *left; /* the left side is filled from its end */
    size_t rights, lefts, tiles;
    uint32_t end; /* the vertex where it ends */
} constraint_channel;

static mw_boundary_step boundary_step_at(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    return (mw_boundary_step){.vertex = mw__corner(dynamic, half),
                              .beyond = mw__beyond(dynamic, half),
                              .half = half,
                              .fixed = mw__is_fixed(dynamic, half)};
}

/* Count the tiles of the channel, beginning with the tile of `half`, which is crossed. Returns the
 * fixed edge in the way; MW_NONE if there is none. */
static uint32_t channel_measure(const mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                                uint32_t half, size_t *tiles)
{
    const mw_point *p = dynamic->tiling->point;
    for (*tiles = 1;; (*tiles)++) {
        if (mw__is_fixed(dynamic, half)) return half;
        uint32_t other = mw__beyond(dynamic, half), apex = mw__apex(dynamic, other);
        double side = mw__orient2d(p[from], p[to], p[apex]);
        if (side == 0) break;
        half = side > 0 ? mw__half_next(other) : mw__half_prev(other);
    }
    (*tiles)++;
    return MW_NONE;
}

/* Collect both sides: dynamic->boundary has room for `tiles` + 2 steps each, dynamic->pool for the
 * tiles. */
static constraint_channel channel_gather(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                                         uint32_t half, size_t tiles)
{
    const mw_point *p = dynamic->tiling->point;
    constraint_channel c = {.right = dynamic->boundary, .left = dynamic->boundary + 2 * tiles + 4};
    *--c.left = (mw_boundary_step){.vertex = from};
    *--c.left = boundary_step_at(dynamic, mw__half_next(half));
    c.lefts = c.rights = 1;
    c.right[0] = boundary_step_at(dynamic, mw__half_prev(half));
    dynamic->pool[c.tiles++] = mw__link_triangle(half);
    for (;;) {
        uint32_t other = mw__beyond(dynamic, half), onward = mw__half_next(other),
                 back = mw__half_prev(other);
        c.end = mw__apex(dynamic, other);
        dynamic->pool[c.tiles++] = mw__link_triangle(other);
        double side = mw__orient2d(p[from], p[to], p[c.end]);
        /* from the right end to the apex */
        if (side <= 0) c.right[c.rights++] = boundary_step_at(dynamic, onward);
        if (side >= 0) {
            *--c.left = boundary_step_at(dynamic, back);
            c.lefts++;
        }
        if (side == 0) break;
        half = side > 0 ? onward : back;
    }
    c.right[c.rights].vertex = c.end;
    return c;
}

/* Mark the slits: the steps that have the channel on both sides, so that a step of the same chain
 * is their other side. */
static void channel_find_slits(mw_dynamic_tiling *dynamic, mw_boundary_step *steps, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint32_t beyond = steps[i].beyond;
        if (beyond == MW_NONE || !(dynamic->mark[mw__link_triangle(beyond)] & MW_JOURNALED))
            continue;
        for (size_t j = 0; j < n && !steps[i].slit; j++) steps[i].slit = steps[j].half == beyond;
    }
}

/* Replace the channel that begins with edge `half` by tiles on either side of a new edge, from
 * `from` to the end of the channel. False when out of memory. */
static bool channel_fill(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to, uint32_t half,
                         mw_forced_edge *forced)
{
    size_t tiles;
    *forced = (mw_forced_edge){MW_NONE, MW_NONE, channel_measure(dynamic, from, to, half, &tiles)};
    if (forced->blocked != MW_NONE) return true;
    if (!mw__boundary_room(dynamic, 4 * tiles + 8)) return false;
    constraint_channel c = channel_gather(dynamic, from, to, half, tiles);
    mw_pool pool = {
        .tile = dynamic->pool, .count = c.tiles, .slit = dynamic->boundary + 2 * tiles + 4};
    if (!mw__pool_begin(dynamic, &pool)) return false;
    channel_find_slits(dynamic, c.right, c.rights);
    channel_find_slits(dynamic, c.left, c.lefts);
    if (!mw__chain_cut_corners(dynamic, c.right, &c.rights, &pool) ||
        !mw__chain_cut_corners(dynamic, c.left, &c.lefts, &pool))
        return false;
    *forced = (mw_forced_edge){c.left[0].beyond, c.end, MW_NONE};
    mw__attach(dynamic, c.left[0].beyond, c.right[0].beyond);
    return true;
}

bool mw__edge_force(mw_dynamic_tiling *dynamic, uint32_t begin, uint32_t to, mw_forced_edge *forced)
{
    const uint32_t from = mw__corner(dynamic, begin);
    star_exit exit = exit_after_edge(dynamic, begin, from, to);
    *forced = (mw_forced_edge){exit.half, exit.vertex, MW_NONE};
    return exit.vertex != MW_NONE || channel_fill(dynamic, from, to, exit.half, forced);
}

/* --- constrained edges ------------------------------------------------------------------------ */

/* Make an edge a constraint, or release it. */
static bool edge_set_fixed(mw_dynamic_tiling *dynamic, uint32_t half, bool fixed)
{
    uint32_t sides[2] = {half, mw__beyond(dynamic, half)};
    dynamic->fixed_count += fixed ? 1 : UINT32_MAX;
    for (int i = 0; i < 2; i++) {
        if (sides[i] == MW_NONE) continue;
        uint32_t t = mw__link_triangle(sides[i]), bit = 1u << mw__link_edge(sides[i]);
        if (!mw__journal_tile(dynamic, t)) return false;
        mw__set_fixed(dynamic, t, (dynamic->mark[t] & MW_FIXED_EDGES & ~bit) | (fixed ? bit : 0));
    }
    return true;
}

static mw_status constrain_edge(mw_dynamic_tiling *dynamic, uint32_t half, mw_error *error)
{
    bool border = edge_is_border(dynamic, half);
    if (!border && !mw__is_users_tile(dynamic, mw__link_triangle(half)))
        return refuse_leaving(dynamic, mw__corner(dynamic, half), error);
    if (border || mw__is_fixed(dynamic, half)) return MW_OK;
    return edge_set_fixed(dynamic, half, true) ? MW_OK : mw__fail_memory(error);
}

static mw_status release_edge(mw_dynamic_tiling *dynamic, uint32_t half, mw_error *error)
{
    uint32_t a = dynamic->vertex_number[mw__corner(dynamic, half)],
             b = dynamic->vertex_number[mw__corner(dynamic, mw__half_next(half))];
    if (edge_is_border(dynamic, half) || !mw__is_fixed(dynamic, half))
        return mw__fail_at(error, -1, a, "the edge from vertex %" PRIu32 " to %" PRIu32 " is %s", a,
                           b, edge_is_border(dynamic, half) ? "border" : "no constraint");
    return edge_set_fixed(dynamic, half, false) ? MW_OK : mw__fail_memory(error);
}

/* Constrain the next edge of the segment, from `from` to *end. dynamic->last becomes a tile of
 * *end. */
static mw_status constrain_next_edge(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                                     uint32_t *end, mw_error *error)
{
    star_exit exit = exit_from_vertex(dynamic, from, to);
    if (exit.half == MW_NONE) return refuse_leaving(dynamic, from, error);
    *end = exit.vertex;
    uint32_t half = exit.half;
    if (*end == MW_NONE) {
        if (!mw__is_users_tile(dynamic, mw__link_triangle(half)))
            return refuse_leaving(dynamic, from, error);
        mw_forced_edge forced;
        if (!channel_fill(dynamic, from, to, exit.half, &forced)) return mw__fail_memory(error);
        if (forced.blocked != MW_NONE) return refuse_crossing(dynamic, forced.blocked, error);
        *end = forced.end;
        half = forced.half;
    }
    dynamic->last = mw__link_triangle(half);
    return constrain_edge(dynamic, half, error);
}

/* Release the next edge of the segment. */
static mw_status release_next_edge(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                                   uint32_t *end, mw_error *error)
{
    star_exit exit = exit_from_vertex(dynamic, from, to);
    *end = exit.vertex;
    if (*end == MW_NONE)
        return mw__fail_at(error, -1, dynamic->vertex_number[from],
                           "there is no constraint from vertex %" PRIu32 " to %" PRIu32 "",
                           dynamic->vertex_number[from], dynamic->vertex_number[to]);
    dynamic->last = mw__link_triangle(exit.half);
    return release_edge(dynamic, exit.half, error);
}

/* Push the edges released: they may have to be flipped. */
static mw_status push_released_edges(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                                     mw_error *error)
{
    while (from != to) {
        star_exit exit = exit_from_vertex(dynamic, from, to);
        if (!mw__stack_push(dynamic, exit.half)) return mw__fail_memory(error);
        dynamic->last = mw__link_triangle(exit.half);
        from = exit.vertex;
    }
    return MW_OK;
}

/* Flips come last, since a flip could move an edge off the segment. Channels share no tile, so the
 * half-edges on the stack remain valid. */
mw_status mw__dynamic_constrain(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                                bool release, uint32_t *constrained_edges, mw_error *error)
{
    *constrained_edges = 0;
    dynamic->last = mw__dynamic_lowest_tile(dynamic, from);
    for (uint32_t at = from, end = MW_NONE; at != to; at = end, (*constrained_edges)++) {
        mw_status status = release ? release_next_edge(dynamic, at, to, &end, error)
                                   : constrain_next_edge(dynamic, at, to, &end, error);
        if (status) return status;
    }
    dynamic->last = mw__dynamic_lowest_tile(dynamic, from);
    /* else old edges of the channel, and near it, need not be Delaunay: they stay */
    if (!dynamic->delaunay) return MW_OK;
    mw_status status = release ? push_released_edges(dynamic, from, to, error) : MW_OK;
    return status || mw__legalise(dynamic) ? status : mw__fail_memory(error);
}
