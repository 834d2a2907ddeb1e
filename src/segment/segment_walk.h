/* segment_walk.h - the walk along a segment from a to b, tile by tile. Private.
 *
 *        l
 *       /|\
 *    a / | \ s   * b      Entered over edge lr, the segment leaves over rs if s lies to its left,
 *      \ | /              over sl if s lies to its right, and at s if s is on it; unless b comes
 *       \|/               first. It is the straight walk (walk/straight.c), but it treats a vertex
 *        r                as what it is, because the pieces are part of the answer.
 *
 * At a vertex v on the segment, the tiles round v are passed until the one that the segment goes
 * on in, or the edge vw that it goes along: seen from v, w is on the segment and the tile's third
 * vertex on one side. For a tile vpq, counter-clockwise, the segment goes on
 *   inside it    if p is to the right and q to the left,
 *   along vp     if p is on it and q to the left,
 *   along vq     if q is on it and p to the right.
 * Ends: each part begins at or behind the end of the one before, and only one part, through a tile
 * or along an edge, begins at a given point. */
#ifndef MW_SRC_SEGMENT_SEGMENT_WALK_H
#define MW_SRC_SEGMENT_SEGMENT_WALK_H

#include "locate/locator.h"
#include "segment/segment_parameter.h"

#include <meshwalk/segment.h>

/* What is reached: mw_segment.phase. */
enum {
    MW_SEGMENT_ENDED,    /* b, or the hull on the way out */
    MW_SEGMENT_BEGINS,   /* a, inside the tile */
    MW_SEGMENT_ENTERS,   /* a point inside edge `local` of the tile that the segment enters */
    MW_SEGMENT_RUNS,     /* a, inside edge `local` of the tile, which the segment runs along */
    MW_SEGMENT_AT_VERTEX /* vertex `local` of the tile; b is another point */
};

/* A part of the segment in one tile, or along one edge. Edges and vertices as the tile has them. */
typedef struct mw_segment_stretch {
    double from, to;
    uint32_t tile;
    uint8_t from_at, to_at, along;
} mw_segment_stretch;

static MW_INLINE mw_point mw__segment_a(const mw_segment *s)
{
    return (mw_point){s->a[0], s->a[1]};
}
static MW_INLINE mw_point mw__segment_b(const mw_segment *s)
{
    return (mw_point){s->b[0], s->b[1]};
}

/* > 0: p lies to the left of the segment's line; < 0: to the right. */
static MW_INLINE double mw__segment_side(const mw_segment *s, mw_point p)
{
    return mw__orient2d(mw__segment_a(s), mw__segment_b(s), p);
}

/* v is on the line: > 0 where b lies behind it, seen from a; 0 where b is v. */
static MW_INLINE int mw__segment_reaches_beyond(const mw_segment *s, mw_point v)
{
    bool by_x = s->a[0] != s->b[0];
    double a = by_x ? s->a[0] : s->a[1], b = by_x ? s->b[0] : s->b[1], at = by_x ? v.x : v.y;
    return a < b ? (b > at) - (b < at) : (b < at) - (b > at);
}

static MW_INLINE double mw__segment_clamp(const mw_segment *s, double t)
{
    return t < s->at ? s->at : t > 1 ? 1 : t;
}

/* Also where the next part begins. */
static MW_INLINE void mw__segment_part_end(mw_segment *s, mw_segment_stretch *part, double to,
                                           uint32_t at)
{
    part->to = s->at = to;
    part->to_at = (uint8_t)at;
}

static MW_INLINE void mw__segment_stop(mw_segment *s, mw_segment_stretch *part, uint32_t at)
{
    mw__segment_part_end(s, part, 1, at);
    s->phase = MW_SEGMENT_ENDED;
}

/* The segment passes through the tile towards its vertex k, which is on its line. */
static MW_INLINE void mw__segment_to_vertex(mw_segment *s, mw_segment_stretch *part, uint32_t k,
                                            uint32_t at_before)
{
    const mw_tiling *tiling = &s->locator->tiling;
    mw_point v = tiling->point[tiling->tri[s->tile].v[k]];
    int beyond = mw__segment_reaches_beyond(s, v);
    if (beyond <= 0) {
        mw__segment_stop(s, part, beyond < 0 ? at_before : MW_AT_VERTEX + k);
        return;
    }
    double t = mw__segment_parameter_at(mw__segment_a(s), mw__segment_b(s), v);
    mw__segment_part_end(s, part, mw__segment_clamp(s, t), MW_AT_VERTEX + k);
    s->phase = MW_SEGMENT_AT_VERTEX;
    s->local = (uint8_t)k;
}

/* The segment passes through the tile towards the inside of its edge e. */
static MW_INLINE void mw__segment_to_edge(mw_segment *s, mw_segment_stretch *part, uint32_t e)
{
    const mw_tiling *tiling = &s->locator->tiling;
    const mw_triangle *tile = &tiling->tri[s->tile];
    mw_point p = tiling->point[tile->v[e]], q = tiling->point[tile->v[e + 1]], a = mw__segment_a(s),
             b = mw__segment_b(s);
    double area_b = mw__segment_area(p, q, b);
    if (MW_UNLIKELY(area_b >= 0)) {
        mw__segment_stop(s, part, area_b > 0 ? MW_AT_INSIDE : MW_AT_EDGE + e);
        return;
    }
    double t = mw__segment_crossing(p, q, a, b, mw__segment_area(p, q, a), area_b);
    mw__segment_part_end(s, part, mw__segment_clamp(s, t), MW_AT_EDGE + e);
    uint32_t link = tile->link[e];
    if (MW_UNLIKELY(link == MW_NONE)) {
        s->phase = MW_SEGMENT_ENDED;
        return;
    }
    s->phase = MW_SEGMENT_ENTERS;
    s->tile = mw__link_triangle(link);
    s->local = (uint8_t)mw__link_edge(link);
}

static MW_INLINE mw_segment_stretch mw__segment_part_begin(const mw_segment *s, uint32_t at)
{
    return (mw_segment_stretch){
        .from = s->at, .tile = s->tile, .from_at = (uint8_t)at, .along = 255};
}

/* The next part from a place that is not the inside of an edge on the way in (segment_walk.c).
 * False: there is none. */
bool mw__segment_step_from(mw_segment *s, mw_segment_stretch *part);

/* The next part, in a ghost perhaps. False: there is none. */
static MW_INLINE bool mw__segment_step(mw_segment *s, mw_segment_stretch *part)
{
    if (MW_UNLIKELY(s->phase != MW_SEGMENT_ENTERS)) return mw__segment_step_from(s, part);
    const mw_tiling *tiling = &s->locator->tiling;
    uint32_t e = s->local, apex = mw__prev(e);
    *part = mw__segment_part_begin(s, MW_AT_EDGE + e);
    double side = mw__segment_side(s, tiling->point[tiling->tri[s->tile].v[apex]]);
    if (MW_UNLIKELY(side == 0))
        mw__segment_to_vertex(s, part, apex, MW_AT_INSIDE);
    else
        mw__segment_to_edge(s, part, side > 0 ? mw__next(e) : apex);
    return true;
}

#endif
