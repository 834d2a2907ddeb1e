/* improved_orthogonal.c - the improved orthogonal walk [Purchart, Kolingerova, Benes 2012; thesis
 * App. E, sec. 7.2 and Alg. 7].
 *
 *           l
 *          /|\
 *      ---/-|-\---> q.x
 *         \ | / s
 *          \|/
 *           r
 *
 * p is a point inside the first tile, so there is no vertex to turn round. Each tile takes two
 * comparisons. Is s, the vertex opposite to the entry edge, past the end of the leg? If not, on
 * which side of the line is it? If to its left, leave over rs, else over sl. If s is past the end,
 * turn, and go in the same way along the vertical line through q. The tile where that leg ends is
 * not tested: q is there or near, and an exact walk ends the search. Departures from the printed
 * pseudocode. In the first tile of a leg, s is the vertex farthest along the heading. It tells
 * whether the tile is past the end, as printed. But the edge to leave over need not be at s: it is
 * the edge that runs from a vertex on the right to one on the left. p is the centroid. The other
 * directions are the same code in turned coordinates: axis.h. Leaving the hull. If the horizontal
 * leg leaves the hull, the vertical leg begins there, along the line through the centroid of the
 * tile, as in the text of App. E; or through the vertex tested last, as in App. B and its Fig. 1
 * (that is a separate walk). If the vertical leg leaves the hull, the exact walk takes over. App. B
 * does not say on which side of its line that vertex lies: here the vertex counts as lying before
 * its line, as seen on the way there. With that, the counts of its Table II are met within the
 * spread of seeds; with the vertex beyond its line the walk would be 7 percent shorter, and the
 * final location 12 to 16 percent (docs/measurements/published-tables.md). Edge cases. If q is
 * level with p, or straight above or below it, one leg ends where it begins. A vertex on the line
 * of a leg counts as right of it, but as left where the walk turns to the right
 * (axis_turn_upright). If rounding puts the centroid outside the tile, so that the line misses it,
 * the exact walk takes over. A leg only compares coordinates, so this walk takes the same way in
 * both arithmetics. Ends on every tiling: there are two legs, and the point where a leg's line
 * leaves the tile moves on with each step. A tile may come once in each leg. */
#include "walk/axis.h"
#include "walk/drive.h"

enum { START, SET_OUT, FOLLOW }; /* phases */

/* The tile is past the end of the leg. */
static MW_INLINE mw_verdict improved_arrive(mw_walk *w, mw_policy P)
{
    if (axis_is_vertical(w)) return MW_VERDICT_UNSURE;
    axis_turn_upright(w, P);
    w->phase = SET_OUT;
    return MW_VERDICT_GO_ON;
}

/* Upright along the line through a vertex, which counts as lying before it. */
static MW_INLINE void improved_turn_at(mw_walk *w, mw_point s, mw_policy P)
{
    double before = w->d.x;
    axis_head_upright(w, s, P);
    if (before == w->d.y) w->p.y = nextafter(w->p.y, -INFINITY);
}

/* Over edge e; where that is on the hull, upright: along the line through `tested`, the vertex
 * tested last, or NULL, an inner point of the tile. */
static MW_INLINE mw_verdict improved_cross_or_detour(mw_walk *w, uint32_t e, const mw_point *tested,
                                                     mw_policy P)
{
    mw_verdict verdict = cross(w, e, P);
    if (MW_LIKELY(verdict == MW_VERDICT_GO_ON)) return MW_VERDICT_GO_ON;
    if (axis_is_vertical(w)) return MW_VERDICT_UNSURE;
    if (tested)
        improved_turn_at(w, *tested, P);
    else
        axis_head_upright(w, tile_inner_point(w), P);
    w->phase = SET_OUT;
    return MW_VERDICT_GO_ON;
}

/* The vertex of the tile that is farthest along the heading. */
static MW_INLINE mw_point improved_farthest(mw_walk *w, mw_policy P)
{
    mw_point s = corner(w, 0), b = corner(w, 1), c = corner(w, 2);
    if (axis_compared(w, axis_along(w, b) > axis_along(w, s), P)) s = b;
    if (axis_compared(w, axis_along(w, c) > axis_along(w, s), P)) s = c;
    return s;
}

/* In the first tile of a leg. */
static MW_INLINE mw_verdict improved_set_out(mw_walk *w, bool to_tested, mw_policy P)
{
    mw_point s = improved_farthest(w, P);
    if (axis_is_past(w, s, P)) return improved_arrive(w, P);
    uint32_t e = axis_exit_edge(w, P);
    if (e == MW_NO_EDGE) return MW_VERDICT_UNSURE;
    w->phase = FOLLOW;
    return improved_cross_or_detour(w, e, to_tested ? &s : NULL, P);
}

static MW_INLINE mw_verdict improved_step_with(mw_walk *w, bool to_tested, mw_policy P)
{
    if (MW_LIKELY(w->phase == FOLLOW)) { /* entered over edge e = lr */
        mw_point s = apex(w, w->e);
        if (MW_UNLIKELY(axis_is_past(w, s, P))) return improved_arrive(w, P);
        uint32_t e = axis_is_left(w, s, P) ? mw__next(w->e) : mw__prev(w->e);
        return improved_cross_or_detour(w, e, to_tested ? &s : NULL, P);
    }
    if (w->phase == START) axis_head_across(w, tile_inner_point(w), P);
    return improved_set_out(w, to_tested, P);
}

static MW_INLINE mw_verdict improved_orthogonal_step(mw_walk *w, mw_policy P)
{
    return improved_step_with(w, false, P);
}

static MW_INLINE mw_verdict improved_orthogonal_vertex_step(mw_walk *w, mw_policy P)
{
    return improved_step_with(w, true, P);
}

MW_STAMP_WALK(improved_orthogonal, false)
MW_STAMP_WALK(improved_orthogonal_vertex, false)
