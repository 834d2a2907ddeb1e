/* axis.h - what the two orthogonal walks share: legs along an axis. Private.
 *
 *      left |    l
 *           |   /|\
 *       ----+--/-|-\---> along
 *           |  \ | / s
 *           |   \|/
 *                r
 *
 * A leg follows a line parallel to an axis, in one of four directions. The walk is written once, in
 * coordinates turned with the heading d: along it, and to its left. d is a unit vector, so these
 * are coordinates of the point, or their negatives, and nothing is rounded. Turning, unlike
 * mirroring, keeps left and right: l and r are the ends of the entry edge in the order in which the
 * tile has them. A vertex on the line counts as right of it. So the walk follows a line moved to
 * the left by less than any distance between coordinates: it meets no vertex, leaves each tile that
 * it meets over one edge, and gets farther with each. */
#ifndef MW_SRC_WALK_AXIS_H
#define MW_SRC_WALK_AXIS_H

#include "walk/step.h"

/* Of the walk's state: d is the heading; p.x the coordinate along it where the leg ends, p.y the
 * coordinate to the left of the line. */

static MW_INLINE double axis_along(const mw_walk *w, mw_point s)
{
    return w->d.x * s.x + w->d.y * s.y;
}

static MW_INLINE double axis_aside(const mw_walk *w, mw_point s)
{
    return w->d.x * s.y - w->d.y * s.x;
}

static MW_INLINE bool axis_compared(mw_walk *w, bool result, mw_policy P)
{
    if (P.count) w->work->comparisons++;
    return result;
}

static MW_INLINE bool axis_is_left(mw_walk *w, mw_point s, mw_policy P)
{
    return axis_compared(w, axis_aside(w, s) > w->p.y, P);
}

static MW_INLINE bool axis_is_past(mw_walk *w, mw_point s, mw_policy P)
{
    return axis_compared(w, axis_along(w, s) >= w->p.x, P);
}

static MW_INLINE bool axis_is_vertical(const mw_walk *w)
{
    return w->d.y != 0;
}

/* From `from` along its horizontal line to the height of q, or along its vertical line. */
static MW_INLINE void axis_head_across(mw_walk *w, mw_point from, mw_policy P)
{
    double sign = axis_compared(w, w->q.x > from.x, P) ? 1 : -1;
    w->d = (mw_point){sign, 0};
    w->p = (mw_point){sign * w->q.x, sign * from.y};
}

static MW_INLINE void axis_head_upright(mw_walk *w, mw_point from, mw_policy P)
{
    double sign = axis_compared(w, w->q.y > from.y, P) ? 1 : -1;
    w->d = (mw_point){0, sign};
    w->p = (mw_point){sign * w->q.y, -sign * from.x};
}

/* The horizontal leg ends and the vertical one begins, along the vertical line through q. The tile
 * reached has points just before that line, but perhaps none beyond it. So a vertex on the line
 * must count as beyond it: as right of it after a turn to the left, as left of it after a turn to
 * the right. */
static MW_INLINE void axis_turn_upright(mw_walk *w, mw_policy P)
{
    double before = w->d.x;
    axis_head_upright(w, (mw_point){w->q.x, before * w->p.y}, P);
    if (before != w->d.y) w->p.y = nextafter(w->p.y, -INFINITY);
}

/* An inner point of the tile, rounded. */
static MW_INLINE mw_point tile_inner_point(const mw_walk *w)
{
    mw_point a = corner(w, 0), b = corner(w, 1), c = corner(w, 2);
    return (mw_point){a.x / 3 + b.x / 3 + c.x / 3, a.y / 3 + b.y / 3 + c.y / 3};
}

/* The edge over which the line leaves the tile: it runs from right to left. MW_NO_EDGE: the line
 * misses the tile. */
static MW_INLINE uint32_t axis_exit_edge(mw_walk *w, mw_policy P)
{
    bool left[3] = {axis_is_left(w, corner(w, 0), P), axis_is_left(w, corner(w, 1), P),
                    axis_is_left(w, corner(w, 2), P)};
    if (!left[0] && left[1]) return 0;
    if (!left[1] && left[2]) return 1;
    if (!left[2] && left[0]) return 2;
    return MW_NO_EDGE;
}

#endif
