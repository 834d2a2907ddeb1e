/* constraint.c - edges that stay: a segment is forced in, or let go.
 *
 * The segment is followed from its first vertex. Where an edge lies on it, that is a piece. Else it enters a tile and crosses edges up to the
 * next vertex on it: the tiles crossed are a channel, each vertex of which is joined to the segment by an edge that crosses it; so either
 * side of the channel is filled by cutting off corners (rim.h), and the piece is the edge between the two sides. */
#include "edit/flip.h"
#include "edit/operations.h"
#include "edit/rim.h"
#include "edit/stitch.h"
#include "edit/vertex_star.h"

#include <inttypes.h>

static bool is_border(const mw_fabric *f, uint32_t half)
{
    uint32_t other = mw__beyond(f, half);
    if (other == MW_NONE) return !f->convex && mw__is_users(f, mw__link_triangle(half));
    return mw__is_users(f, mw__link_triangle(half)) != mw__is_users(f, mw__link_triangle(other));
}

/* --- the way ---------------------------------------------------------------------------------------------------------- */

/* How a segment leaves a vertex: along an edge, which begins there (or, on the hull, ends there), or through the tile whose edge `half`,
 * across from the vertex, it crosses. */
typedef struct exit_of_star {
    uint32_t half, vertex; /* vertex: the other end of the edge, MW_NONE if it is crossed */
} exit_of_star;

static bool lies_ahead(const mw_fabric *f, uint32_t from, uint32_t to, uint32_t v)
{
    const mw_point *p = f->tiling->point;
    return mw__orient2d(p[from], p[to], p[v]) == 0 && mw__dot2d(p[from], p[to], p[v]) > 0;
}

/* f->last is a tile of `from`. */
static exit_of_star leave(const mw_fabric *f, uint32_t from, uint32_t to)
{
    const mw_point *p = f->tiling->point;
    bool open;
    uint32_t first = mw__star_from(f, from, f->last, &open), at = first;
    do {
        uint32_t across = mw__half_next(at), last = mw__half_prev(at);
        uint32_t a = mw__corner(f, across), b = mw__corner(f, last);
        if (lies_ahead(f, from, to, a)) return (exit_of_star){at, a};
        if (lies_ahead(f, from, to, b)) return (exit_of_star){last, b};
        if (mw__orient2d(p[from], p[to], p[a]) < 0 && mw__orient2d(p[from], p[to], p[b]) > 0)
            return (exit_of_star){across, MW_NONE};
        at = mw__beyond(f, last);
    } while (at != MW_NONE && at != first);
    return (exit_of_star){MW_NONE, MW_NONE}; /* out of the hull: not for a segment between two vertices */
}

static mw_status refuse_crossing(const mw_fabric *f, uint32_t half, mw_error *error)
{
    uint32_t a = f->vertex_number[mw__corner(f, half)], b = f->vertex_number[mw__corner(f, mw__half_next(half))];
    return mw__fail_at(error, -1, a, "the constraint from vertex %" PRIu32 " to %" PRIu32 " or border is in the way", a,
                       b);
}

static mw_status refuse_leaving(const mw_fabric *f, uint32_t from, mw_error *error)
{
    return mw__fail_at(error, -1, f->vertex_number[from], "at vertex %" PRIu32 " the way leaves the mesh",
                       f->vertex_number[from]);
}

/* --- the channel ------------------------------------------------------------------------------------------------------ */

typedef struct channel {
    mw_rim_step *right, *left; /* the left side backwards: filled from its end */
    size_t rights, lefts, tiles;
    uint32_t end; /* the vertex where it ends */
} channel;

static mw_rim_step step_at(const mw_fabric *f, uint32_t half)
{
    return (mw_rim_step){
        .vertex = mw__corner(f, half), .beyond = mw__beyond(f, half), .half = half, .fixed = mw__is_fixed(f, half)};
}

/* Count the tiles from the one that has edge `half` on, which is crossed; or what is in the way. */
static mw_status follow(const mw_fabric *f, uint32_t from, uint32_t to, uint32_t half, size_t *tiles, mw_error *error)
{
    const mw_point *p = f->tiling->point;
    for (*tiles = 1;; (*tiles)++) {
        if (mw__is_fixed(f, half)) return refuse_crossing(f, half, error);
        uint32_t other = mw__beyond(f, half), apex = mw__apex(f, other);
        double side = mw__orient2d(p[from], p[to], p[apex]);
        if (side == 0) break;
        half = side > 0 ? mw__half_next(other) : mw__half_prev(other);
    }
    (*tiles)++;
    return MW_OK;
}

/* Gather both sides: f->rim has room for `tiles` + 2 steps each, f->pool for the tiles. */
static channel gather(mw_fabric *f, uint32_t from, uint32_t to, uint32_t half, size_t tiles)
{
    const mw_point *p = f->tiling->point;
    channel c = {.right = f->rim, .left = f->rim + 2 * tiles + 4};
    *--c.left = (mw_rim_step){.vertex = from};
    *--c.left = step_at(f, mw__half_next(half));
    c.lefts = c.rights = 1;
    c.right[0] = step_at(f, mw__half_prev(half));
    f->pool[c.tiles++] = mw__link_triangle(half);
    for (;;) {
        uint32_t other = mw__beyond(f, half), onward = mw__half_next(other), back = mw__half_prev(other);
        c.end = mw__apex(f, other);
        f->pool[c.tiles++] = mw__link_triangle(other);
        double side = mw__orient2d(p[from], p[to], p[c.end]);
        if (side <= 0) c.right[c.rights++] = step_at(f, onward); /* from the edge's right end to the apex */
        if (side >= 0) {
            *--c.left = step_at(f, back);
            c.lefts++;
        }
        if (side == 0) break;
        half = side > 0 ? onward : back;
    }
    c.right[c.rights].vertex = c.end;
    return c;
}

/* Which steps have the channel on both sides? Their other side is a step of the same chain. */
static void find_slits(mw_fabric *f, mw_rim_step *steps, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint32_t beyond = steps[i].beyond;
        if (beyond == MW_NONE || !(f->mark[mw__link_triangle(beyond)] & MW_JOURNALED)) continue;
        for (size_t j = 0; j < n && !steps[i].slit; j++) steps[i].slit = steps[j].half == beyond;
    }
}

/* Replace the channel by tiles on either side of an edge from `from` to its end, which is set. */
static mw_status dig(mw_fabric *f, uint32_t from, uint32_t to, uint32_t half, uint32_t *end, uint32_t *piece,
                     mw_error *error)
{
    size_t tiles;
    mw_status status = follow(f, from, to, half, &tiles, error);
    if (status) return status;
    if (!mw__rim_room(f, 4 * tiles + 8)) return mw__fail_memory(error);
    channel c = gather(f, from, to, half, tiles);
    mw_pool pool = {.tile = f->pool, .count = c.tiles, .slit = f->rim + 2 * tiles + 4};
    if (!mw__pool_begin(f, &pool)) return mw__fail_memory(error);
    find_slits(f, c.right, c.rights);
    find_slits(f, c.left, c.lefts);
    if (!mw__cut_chain(f, c.right, &c.rights, &pool) || !mw__cut_chain(f, c.left, &c.lefts, &pool))
        return mw__fail_memory(error);
    *end = c.end;
    *piece = c.left[0].beyond;
    mw__attach(f, c.left[0].beyond, c.right[0].beyond);
    return MW_OK;
}

/* --- pieces ----------------------------------------------------------------------------------------------------------- */

/* An edge becomes a constraint, or is one no longer. */
static bool set_piece(mw_fabric *f, uint32_t half, bool fixed)
{
    uint32_t sides[2] = {half, mw__beyond(f, half)};
    f->fixed_count += fixed ? 1 : UINT32_MAX;
    for (int i = 0; i < 2; i++) {
        if (sides[i] == MW_NONE) continue;
        uint32_t t = mw__link_triangle(sides[i]), bit = 1u << mw__link_edge(sides[i]);
        if (!mw__journal(f, t)) return false;
        mw__set_fixed(f, t, (f->mark[t] & MW_FIXED_EDGES & ~bit) | (fixed ? bit : 0));
    }
    return true;
}

static mw_status constrain_edge(mw_fabric *f, uint32_t half, mw_error *error)
{
    bool border = is_border(f, half);
    if (!border && !mw__is_users(f, mw__link_triangle(half))) return refuse_leaving(f, mw__corner(f, half), error);
    if (border || mw__is_fixed(f, half)) return MW_OK;
    return set_piece(f, half, true) ? MW_OK : mw__fail_memory(error);
}

static mw_status release_edge(mw_fabric *f, uint32_t half, mw_error *error)
{
    uint32_t a = f->vertex_number[mw__corner(f, half)], b = f->vertex_number[mw__corner(f, mw__half_next(half))];
    if (is_border(f, half) || !mw__is_fixed(f, half))
        return mw__fail_at(error, -1, a, "the edge from vertex %" PRIu32 " to %" PRIu32 " is %s", a, b,
                           is_border(f, half) ? "border" : "no constraint");
    return set_piece(f, half, false) ? MW_OK : mw__fail_memory(error);
}

/* The next piece, from `from` to *end, of which f->last is a tile then. */
static mw_status constrain_piece(mw_fabric *f, uint32_t from, uint32_t to, uint32_t *end, mw_error *error)
{
    exit_of_star exit = leave(f, from, to);
    if (exit.half == MW_NONE) return refuse_leaving(f, from, error);
    *end = exit.vertex;
    uint32_t half = exit.half;
    if (*end == MW_NONE) {
        if (!mw__is_users(f, mw__link_triangle(half))) return refuse_leaving(f, from, error);
        mw_status status = dig(f, from, to, exit.half, end, &half, error);
        if (status) return status;
    }
    f->last = mw__link_triangle(half);
    return constrain_edge(f, half, error);
}

static mw_status release_piece(mw_fabric *f, uint32_t from, uint32_t to, uint32_t *end, mw_error *error)
{
    exit_of_star exit = leave(f, from, to);
    *end = exit.vertex;
    if (*end == MW_NONE)
        return mw__fail_at(error, -1, f->vertex_number[from],
                           "from vertex %" PRIu32 " to %" PRIu32 " there is no constraint", f->vertex_number[from],
                           f->vertex_number[to]);
    f->last = mw__link_triangle(exit.half);
    return release_edge(f, exit.half, error);
}

/* Edges released may have to be flipped. */
static mw_status push_way(mw_fabric *f, uint32_t from, uint32_t to, mw_error *error)
{
    while (from != to) {
        exit_of_star exit = leave(f, from, to);
        if (!mw__push(f, exit.half)) return mw__fail_memory(error);
        f->last = mw__link_triangle(exit.half);
        from = exit.vertex;
    }
    return MW_OK;
}

/* Flips come last: what one turns away could be on the way. Channels share no tile, so half-edges on the stack stay what they are. */
mw_status mw__fabric_constrain(mw_fabric *f, uint32_t from, uint32_t to, bool release, uint32_t *pieces,
                               mw_error *error)
{
    *pieces = 0;
    f->last = mw__fabric_tile(f, from);
    for (uint32_t at = from, end = MW_NONE; at != to; at = end, (*pieces)++) {
        mw_status status = release ? release_piece(f, at, to, &end, error) : constrain_piece(f, at, to, &end, error);
        if (status) return status;
    }
    f->last = mw__fabric_tile(f, from);
    if (!f->delaunay) return MW_OK; /* a channel may have old edges in it, and others be beside it: these are to stay */
    mw_status status = release ? push_way(f, from, to, error) : MW_OK;
    return status || mw__legalise(f) ? status : mw__fail_memory(error);
}
