/* segment_start.c - where a segment begins: in a tile, or where it comes over the hull. */
#include "segment/segment_start.h"
#include "locate/query.h"

#include "walk/walk.h"

static mw_point start_edge_point(const mw_tiling *tiling, uint32_t half, uint32_t end)
{
    return tiling->point[tiling->tri[mw__link_triangle(half)].v[mw__link_edge(half) + end]];
}

/* Does a lie beyond this edge? */
static bool start_is_beyond(const mw_segment *s, uint32_t half)
{
    const mw_tiling *tiling = &s->locator->tiling;
    return mw__orient2d(start_edge_point(tiling, half, 0), start_edge_point(tiling, half, 1),
                        mw__segment_a(s)) < 0;
}

/* The next edge of the hull, or the one before. */
static uint32_t start_hull_neighbour(const mw_tiling *tiling, uint32_t half, bool next)
{
    for (;;) {
        half = next ? mw__half_next(half) : mw__half_prev(half);
        uint32_t link = mw__half_link(tiling->tri, half);
        if (link == MW_NONE) return half;
        half = link;
    }
}

static void start_at_vertex(mw_segment *s, uint32_t tile, uint32_t k)
{
    s->tile = tile;
    s->local = (uint8_t)k;
    s->phase = MW_SEGMENT_AT_VERTEX;
}

/* The segment comes over edge `half` of the hull, or touches a vertex of it, unless it ends
 * before. side: on which side of it the ends of the edge lie. */
static void start_over_hull(mw_segment *s, uint32_t half, const double side[2])
{
    const mw_tiling *tiling = &s->locator->tiling;
    uint32_t tile = mw__link_triangle(half), e = mw__link_edge(half);
    mw_point p = start_edge_point(tiling, half, 0), q = start_edge_point(tiling, half, 1),
             a = mw__segment_a(s), b = mw__segment_b(s);
    s->tile = tile;
    if (side[0] == 0 || side[1] == 0) {
        mw_point v = side[0] == 0 ? p : q;
        if (mw__segment_reaches_beyond(s, v) <= 0) return;
        s->at = mw__segment_clamp(s, mw__segment_parameter_at(a, b, v));
        start_at_vertex(s, tile, side[0] == 0 ? e : mw__next(e));
        return;
    }
    double area_b = mw__segment_area(p, q, b);
    if (area_b <= 0) return;
    double t = mw__segment_crossing(p, q, a, b, mw__segment_area(p, q, a), area_b);
    s->at = mw__segment_clamp(s, t);
    s->local = (uint8_t)e;
    s->phase = MW_SEGMENT_ENTERS;
}

/* a lies beyond edge `half` of the hull. The edges that a lies beyond are a chain; seen from a they
 * go from left to right. Follow the chain to the edge that the segment's line crosses. */
static void start_outside(mw_segment *s, uint32_t half)
{
    const mw_tiling *tiling = &s->locator->tiling;
    int way = 0;
    s->gap = 1;
    while (start_is_beyond(s, half)) {
        double side[2] = {mw__segment_side(s, start_edge_point(tiling, half, 0)),
                          mw__segment_side(s, start_edge_point(tiling, half, 1))};
        if (side[0] >= 0 && side[1] <= 0) {
            start_over_hull(s, half, side);
            return;
        }
        int turn = side[1] > 0 ? 1 : -1;
        if (way == -turn || (side[0] < 0 && side[1] > 0)) return; /* the hull is behind a */
        way = turn;
        half = start_hull_neighbour(tiling, half, way > 0);
    }
}

/* a is in the tile; zero[k]: it is on edge k. */
static void start_in_tile(mw_segment *s, uint32_t tile, const bool zero[3])
{
    const mw_tiling *tiling = &s->locator->tiling;
    const mw_triangle *tri = &tiling->tri[tile];
    s->tile = tile;
    if (!zero[0] && !zero[1] && !zero[2]) {
        s->phase = MW_SEGMENT_BEGINS;
        return;
    }
    uint32_t e = zero[0] ? 0 : zero[1] ? 1 : 2;
    if (zero[0] + zero[1] + zero[2] > 1) { /* edges k and k - 1 meet at vertex k */
        start_at_vertex(s, tile, !zero[2] ? 1 : !zero[0] ? 2 : 0);
        return;
    }
    double side =
        mw__orient2d(tiling->point[tri->v[e]], tiling->point[tri->v[e + 1]], mw__segment_b(s));
    s->local = (uint8_t)e;
    s->phase = side == 0 ? MW_SEGMENT_RUNS : MW_SEGMENT_ENTERS;
    if (side >= 0) return;
    if (tri->link[e] == MW_NONE) {
        s->phase = MW_SEGMENT_ENDED;
        return;
    }
    s->tile = mw__link_triangle(tri->link[e]);
    s->local = (uint8_t)mw__link_edge(tri->link[e]);
}

/* Is a in the tile, or beyond an edge of it that is on the hull? Then the start is set. */
static bool start_is_at(mw_segment *s, uint32_t t)
{
    const mw_tiling *tiling = &s->locator->tiling;
    const mw_triangle *tile = &tiling->tri[t];
    bool zero[3], inside = true;
    for (uint32_t k = 0; k < 3; k++) {
        double side = mw__orient2d(tiling->point[tile->v[k]], tiling->point[tile->v[k + 1]],
                                   mw__segment_a(s));
        zero[k] = side == 0;
        if (side >= 0) continue;
        inside = false;
        if (tile->link[k] != MW_NONE) continue;
        start_outside(s, mw__link(t, k));
        return true;
    }
    if (inside) start_in_tile(s, t, zero);
    return inside;
}

void mw__segment_start(mw_segment *s, uint32_t near)
{
    if (MW_LIKELY(start_is_at(s, near))) return;
    start_is_at(s, mw__query_tile(s->locator, near, mw__segment_a(s)));
}
