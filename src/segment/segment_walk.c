/* segment_walk.c - the parts of a segment that begin inside a tile, at a vertex, or on an edge that
 * the segment runs along. */
#include "segment/segment_walk.h"

static mw_point part_corner(const mw_segment *s, uint32_t tile, uint32_t k)
{
    const mw_tiling *tiling = &s->locator->tiling;
    return tiling->point[tiling->tri[tile].v[k]];
}

/* --- along an edge --- */

/* A place on an edge, or at an end of it, as the tile across the edge has it. */
static uint8_t part_place_across(uint8_t at, uint32_t edge, uint32_t across)
{
    if (at < MW_AT_VERTEX) return (uint8_t)(MW_AT_EDGE + across);
    bool begins = at == MW_AT_VERTEX + edge;
    return (uint8_t)(MW_AT_VERTEX + (begins ? mw__next(across) : across));
}

/* The lower of the user's triangles at an edge. */
static void part_choose_owner(const mw_segment *s, mw_segment_stretch *part, uint32_t edge)
{
    const mw_triangle *tri = s->locator->tiling.tri;
    uint32_t link = tri[part->tile].link[edge];
    part->along = (uint8_t)edge;
    if (link == MW_NONE) return;
    uint32_t here = tri[part->tile].user & ~MW_REVERSED,
             there = tri[mw__link_triangle(link)].user & ~MW_REVERSED;
    if (here < there) return; /* a ghost has a mark above all numbers */
    uint32_t across = mw__link_edge(link);
    part->from_at = part_place_across(part->from_at, edge, across);
    part->to_at = part_place_across(part->to_at, edge, across);
    part->tile = mw__link_triangle(link);
    part->along = (uint8_t)across;
}

/* The segment runs along an edge of its tile, towards the edge's end (`forward`) or beginning. */
static void part_run(mw_segment *s, mw_segment_stretch *part, uint32_t edge, bool forward)
{
    mw__segment_to_vertex(s, part, forward ? mw__next(edge) : edge, MW_AT_EDGE + edge);
    part_choose_owner(s, part, edge);
}

static void part_run_from_inside_edge(mw_segment *s, mw_segment_stretch *part)
{
    uint32_t e = s->local;
    mw_point p = part_corner(s, s->tile, e), q = part_corner(s, s->tile, mw__next(e));
    bool by_x = p.x != q.x;
    bool forward = (by_x ? p.x < q.x : p.y < q.y) == (by_x ? s->a[0] < s->b[0] : s->a[1] < s->b[1]);
    *part = mw__segment_part_begin(s, MW_AT_EDGE + e);
    part_run(s, part, e, forward);
}

/* --- from inside a tile --- */

static void part_from_inside(mw_segment *s, mw_segment_stretch *part)
{
    double side[4];
    for (uint32_t k = 0; k < 3; k++) side[k] = mw__segment_side(s, part_corner(s, s->tile, k));
    side[3] = side[0];
    *part = mw__segment_part_begin(s, MW_AT_INSIDE);
    for (uint32_t k = 0; k < 3; k++) {
        if (side[k] < 0 && side[k + 1] > 0) {
            mw__segment_to_edge(s, part, k);
            return;
        }
        if (side[k] == 0 && side[k + 1] > 0) {
            mw__segment_to_vertex(s, part, k, MW_AT_INSIDE);
            return;
        }
    }
}

/* --- from a vertex --- */

/* A tile at a vertex, and on which side of the segment its two other vertices lie. */
typedef struct vertex_tile {
    uint32_t tile, k;
    double right, left; /* of vertices k + 1 and k + 2 */
} vertex_tile;

static vertex_tile vertex_tile_first(const mw_segment *s)
{
    vertex_tile at = {.tile = s->tile, .k = s->local};
    at.right = mw__segment_side(s, part_corner(s, at.tile, mw__next(at.k)));
    at.left = mw__segment_side(s, part_corner(s, at.tile, mw__prev(at.k)));
    return at;
}

static bool vertex_tile_has_way(const vertex_tile *at)
{
    return (at->right < 0 && at->left >= 0) || (at->right == 0 && at->left > 0);
}

/* The next tile round the vertex. False at the hull. */
static bool vertex_tile_turn(const mw_segment *s, vertex_tile *at, bool clockwise)
{
    uint32_t link = s->locator->tiling.tri[at->tile].link[clockwise ? at->k : mw__prev(at->k)];
    if (link == MW_NONE) return false;
    uint32_t e = mw__link_edge(link);
    at->tile = mw__link_triangle(link);
    at->k = clockwise ? mw__next(e) : e;
    if (clockwise) {
        at->left = at->right;
        at->right = mw__segment_side(s, part_corner(s, at->tile, mw__next(at->k)));
    } else {
        at->right = at->left;
        at->left = mw__segment_side(s, part_corner(s, at->tile, mw__prev(at->k)));
    }
    return true;
}

/* False: the segment goes out of the hull. */
static bool vertex_find_way(const mw_segment *s, vertex_tile *at)
{
    const vertex_tile first = vertex_tile_first(s);
    for (int clockwise = 0; clockwise < 2; clockwise++) {
        *at = first;
        while (!vertex_tile_has_way(at))
            if (!vertex_tile_turn(s, at, clockwise)) break;
        if (vertex_tile_has_way(at)) return true;
    }
    return false;
}

static bool part_from_vertex(mw_segment *s, mw_segment_stretch *part)
{
    vertex_tile at;
    if (!vertex_find_way(s, &at)) {
        s->phase = MW_SEGMENT_ENDED;
        return false;
    }
    s->tile = at.tile;
    *part = mw__segment_part_begin(s, MW_AT_VERTEX + at.k);
    if (at.right == 0)
        part_run(s, part, at.k, true);
    else if (at.left == 0)
        part_run(s, part, mw__prev(at.k), false);
    else
        mw__segment_to_edge(s, part, mw__next(at.k));
    return true;
}

bool mw__segment_step_from(mw_segment *s, mw_segment_stretch *part)
{
    switch (s->phase) {
    case MW_SEGMENT_BEGINS: part_from_inside(s, part); return true;
    case MW_SEGMENT_RUNS: part_run_from_inside_edge(s, part); return true;
    case MW_SEGMENT_AT_VERTEX: return part_from_vertex(s, part);
    default: return false;
    }
}
