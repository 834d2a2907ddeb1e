/* segment.h - segments as users have them: their walks and pieces. Private. */
#ifndef MW_SRC_SEGMENT_SEGMENT_H
#define MW_SRC_SEGMENT_SEGMENT_H

#include "segment/segment_walk.h"

/* MW_ERROR_ARGUMENT if segments cannot be followed with this locator. */
mw_status mw__segment_check_locator(const mw_locator *locator, mw_error *error);

/* Begin a walk. Coordinates are finite; the cursor's last tile is near a. */
void mw__segment_set(mw_segment *s, const mw_locator *locator, mw_cursor *cursor, const double a[2],
                     const double b[2]);

/* An edge, a vertex or neither of a tile, as the user numbers it. */
static MW_INLINE uint8_t mw__segment_user_place(uint32_t user, uint8_t at)
{
    if (at >= MW_AT_INSIDE) return at;
    return (uint8_t)(at < MW_AT_VERTEX
                         ? mw__user_local_edge(user, at)
                         : MW_AT_VERTEX + mw__user_local_vertex(user, at - MW_AT_VERTEX));
}

/* The segment may go on over this link: ask for the tile there, and for the vertex that it would
 * turn at. That is known before the turn is, so one step's memory comes while the one before it
 * computes. */
static MW_INLINE void mw__segment_look_ahead(const mw_locator *locator, uint32_t link)
{
    const mw_tiling *tiling = &locator->tiling;
    uint32_t t = link == MW_NONE ? 0 : mw__link_triangle(link), e = mw__link_edge(link);
    __builtin_prefetch(&tiling->point[tiling->tri[t].v[mw__prev(e)]]);
}

/* The edge after edge e, or the one before. Arithmetic: from `left ? mw__next(e) : mw__prev(e)`
 * gcc makes a jump, which a processor guesses wrong every other time. */
static MW_INLINE uint32_t mw__segment_turn(uint32_t e, bool left)
{
    return (18u >> (2 * e + left)) & 3;
}

/* Follow a segment that enters a tile over an edge into the next one, and append the piece, for
 * which there is room. Returns false where rounded areas are not sure, at vertices, and at b: there
 * mw__segment_next_surely goes on. For tilings without cut triangles. `ahead`: ask for the memory
 * of the next step; lanes that take turns do that themselves. */
static MW_INLINE bool mw__segment_run(mw_segment *s, bool ahead, mw_segment_piece *piece,
                                      size_t *count)
{
    const mw_tiling *tiling = &s->locator->tiling;
    const mw_triangle *tile = &tiling->tri[s->tile];
    const mw_point *point = tiling->point, a = mw__segment_a(s), b = mw__segment_b(s);
    uint32_t e = s->local, apex = mw__prev(e), user = tile->user;
    if (ahead) {
        mw__segment_look_ahead(s->locator, tile->link[apex]);
        mw__segment_look_ahead(s->locator, tile->link[mw__next(e)]);
    }
    double unsure, off_a, off_b, side = mw__orient2d_rounded(a, b, point[tile->v[apex]], &unsure);
    uint32_t out = mw__segment_turn(e, side > 0), link = tile->link[out];
    mw_point p = point[tile->v[out]], q = point[tile->v[out + 1]];
    double of_a = mw__orient2d_rounded(p, q, a, &off_a),
           of_b = -mw__orient2d_rounded(p, q, b, &off_b), sum = of_a + of_b;
    bool sure = (fabs(side) > unsure) & (MW_PARAMETER_ERROR * of_a > off_a) &
                (MW_PARAMETER_ERROR * of_b > off_b) & (of_a > MW_AREA_LEAST) &
                (of_b > MW_AREA_LEAST) & (sum < MW_AREA_MOST) & (link != MW_NONE);
    if (MW_UNLIKELY(!sure)) return false;
    double to = of_a / sum;
    to = to < s->at ? s->at : to;
    *piece = (mw_segment_piece){s->at,
                                to,
                                user & MW_USER_MASK,
                                (uint8_t)mw__user_local_edge(user, e),
                                (uint8_t)mw__user_local_edge(user, out),
                                255,
                                s->gap};
    s->gap = (user & MW_GHOST) != 0;
    *count += !s->gap;
    s->at = to;
    s->tile = mw__link_triangle(link);
    s->local = (uint8_t)mw__link_edge(link);
    return true;
}

/* The next piece where mw__segment_run is not sure: parts in ghosts are left out. False at the
 * end. */
bool mw__segment_next_surely(mw_segment *s, mw_segment_piece *piece);

/* Does mw__segment_run go on from here? */
static MW_INLINE bool mw__segment_may_run(const mw_segment *s)
{
    return s->phase == MW_SEGMENT_ENTERS && !s->locator->tiling.cut;
}

#endif
