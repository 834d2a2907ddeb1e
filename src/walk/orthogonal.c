/* orthogonal.c - the orthogonal walk [Devillers, Pion, Teillaud 2002; thesis App. E, sec. 7.1, Alg.
 * 6].
 *
 *          l          * q
 *         /|\         :
 *        / | \ s      :
 *    p ....|...\......a
 *        \ | /
 *         \|/
 *          r
 *
 * Let a be the point above or below q at the height of p, a vertex of the first tile. First turn
 * round p to the tile at p that the horizontal line from p to a enters; each tile takes one
 * comparison. Then follow the line. Let l and r be the left and right ends of the edge just
 * crossed, and s the third vertex. The line leaves over rs if s lies to its left, else over sl: one
 * comparison. As long as both ends of that edge fall short of a, a lies beyond it: two comparisons.
 * After that, orient2d of the edge and a decides. In the tile that contains a, turn, and follow the
 * vertical line to q in the same way. Departures from the printed pseudocode.
 * - Slip 3: a lies beyond the edge from r to l where orient2d(r, l, a) < 0; printed, the walk goes
 *   on where a is inside.
 * - The turn: printed, it looks at one end of the exit edge. Here the sides of all three vertices
 *   are compared with the vertical line; it leaves over the edge that runs from right to left. This
 *   covers every case of l and r.
 * - The other directions, "analogous" in print, are the same code in turned coordinates: axis.h.
 * - Leaving the hull, which only the text describes. First, if q lies beyond the hull edge, by an
 *   exact test, it is outside. Otherwise a horizontal leg is followed by a vertical one along
 *   another line, through an inner point of the tile (between its centroid and its vertex nearest
 *   to q). Wherever that leg ends, the walk starts again from there, at the vertex nearest to q. In
 *   a thin hull at an angle to the axes even that does not help; so after RESTARTS new starts an
 *   exact walk takes over. Edge cases. q = p: the first tile is the answer. q above or below p:
 *   there is only the vertical leg, from p. q at the height of p: a is q, and the horizontal leg
 *   finds it. A vertex on the line of a leg counts as right of it, but as left where the walk turns
 *   to the right (axis_turn_upright). p on the hull: if the turn meets the hull first, the line
 *   points out of the hull, or runs along it with the hull on its right; then the leg leaves the
 *   hull at p. MW_VERDICT_FOUND is exact (in exact arithmetic, on a tiling): since vertices on the
 *   line count as right of it, the walk follows a line moved infinitesimally. So every tile has
 *   points of that line inside, and the tile's part of the true line runs from the entry edge, or
 *   p, to the exit edge. The point that the leg looks for lies ahead of p, and then ahead of each
 *   entry edge, since it was beyond that edge. So it is in the tile unless it is beyond the exit
 *   edge. The vertical leg begins
 *   likewise in the tile that holds a, which has points just before the vertical line. Legs along
 *   another line never find the point; they only lead nearer to it. Ends on every tiling: the turn
 *   passes each tile at p at most once, the short way round; the point where a leg's line leaves
 *   the tile moves on with each step; and there are at most 2 (RESTARTS + 1) legs. Each meets a
 *   tile once at most.
 */
#include "walk/axis.h"
#include "walk/drive.h"

/* The phase of a walk: one of the first five; MOVED, where the vertical line is not that through q;
 * and the number of restarts. */
enum {
    START,
    TURN_RIGHT,
    TURN_LEFT,
    SET_OUT,
    FOLLOW,
    STEP = 7,
    MOVED = 8,
    RESTART = 16,
    RESTARTS = 2
};

static MW_INLINE void orthogonal_enter(mw_walk *w, uint32_t phase)
{
    w->phase = (w->phase & ~(uint32_t)STEP) | phase;
}

/* Where the leg ends: a, q, or the point of another vertical line at the height of q. */
static MW_INLINE mw_point leg_end(const mw_walk *w)
{
    if (!axis_is_vertical(w)) return (mw_point){w->q.x, w->d.x * w->p.y};
    return w->phase & MOVED ? (mw_point){-w->d.y * w->p.y, w->q.y} : w->q;
}

/* The vertex of the tile that is nearest to q, or about. */
static MW_INLINE uint32_t nearest_corner(const mw_walk *w)
{
    double far[3];
    for (uint32_t k = 0; k < 3; k++)
        far[k] = fabs(corner(w, k).x - w->q.x) + fabs(corner(w, k).y - w->q.y);
    if (far[1] < far[0]) return far[2] < far[1] ? 2 : 1;
    return far[2] < far[0] ? 2 : 0;
}

/* Run again from this tile. */
static MW_INLINE mw_verdict orthogonal_restart(mw_walk *w)
{
    if (w->phase / RESTART == RESTARTS) return MW_VERDICT_UNSURE;
    w->phase = (w->phase / RESTART + 1) * RESTART + START;
    return MW_VERDICT_GO_ON;
}

/* The horizontal leg would leave the hull: a vertical one from here instead. */
static MW_INLINE mw_verdict orthogonal_detour(mw_walk *w, mw_policy P)
{
    mw_point c = tile_inner_point(w), v = corner(w, nearest_corner(w));
    axis_head_upright(w, (mw_point){c.x / 2 + v.x / 2, c.y / 2 + v.y / 2}, P);
    if (w->stage == MW_STAGE_INIT) begin_stage(w, MW_STAGE_WALK, P);
    w->phase |= MOVED;
    orthogonal_enter(w, SET_OUT);
    return MW_VERDICT_GO_ON;
}

/* Cross edge e; if it is on the hull, see on which side of it q lies. */
static MW_INLINE mw_verdict orthogonal_cross_or_detour(mw_walk *w, uint32_t e, mw_policy P)
{
    mw_verdict verdict = cross(w, e, P);
    if (MW_LIKELY(verdict == MW_VERDICT_GO_ON)) return MW_VERDICT_GO_ON;
    if (beyond(w, e, P)) return MW_VERDICT_LEFT;
    return axis_is_vertical(w) ? orthogonal_restart(w) : orthogonal_detour(w, P);
}

/* The tile holds the end of the leg. */
static MW_INLINE mw_verdict orthogonal_arrive(mw_walk *w, mw_policy P)
{
    if (w->phase & MOVED) return orthogonal_restart(w);
    if (axis_is_vertical(w) || w->q.y == leg_end(w).y) return MW_VERDICT_FOUND;
    axis_turn_upright(w, P);
    orthogonal_enter(w, SET_OUT);
    return MW_VERDICT_GO_ON;
}

/* The line leaves the tile over edge e: so does the walk, unless the leg ends before. */
static MW_INLINE mw_verdict orthogonal_go_on(mw_walk *w, uint32_t e, mw_policy P)
{
    mw_point r = corner(w, e), l = corner(w, e + 1);
    bool r_past = axis_is_past(w, r, P), l_past = axis_is_past(w, l, P);
    if (MW_UNLIKELY(r_past || l_past) && orient(w, r, l, leg_end(w), P) >= 0)
        return orthogonal_arrive(w, P);
    return orthogonal_cross_or_detour(w, e, P);
}

/* The line leaves the tile over edge e, off p: the turn ends here. */
static MW_INLINE mw_verdict orthogonal_end_turn(mw_walk *w, uint32_t e, mw_policy P)
{
    orthogonal_enter(w, FOLLOW);
    begin_stage(w, MW_STAGE_WALK, P);
    return orthogonal_go_on(w, e, P);
}

static MW_INLINE mw_verdict orthogonal_turn(mw_walk *w, uint32_t phase, uint32_t e, mw_policy P)
{
    orthogonal_enter(w, phase);
    return orthogonal_cross_or_detour(w, e, P);
}

/* In the first tile, or one to run again from: choose p, and so the heading, r and l. */
static MW_INLINE mw_verdict orthogonal_start(mw_walk *w, mw_policy P)
{
    bool first = w->phase == START;
    if (first)
        initialise(w, P);
    else
        begin_stage(w, MW_STAGE_INIT, P);
    uint32_t k = first ? 0 : nearest_corner(w);
    mw_point p = corner(w, k);
    if (w->q.x == p.x && w->q.y == p.y) return MW_VERDICT_FOUND;
    if (w->q.x != p.x)
        axis_head_across(w, p, P);
    else
        axis_head_upright(w, p, P);
    if (axis_is_left(w, corner(w, k + 1), P)) return orthogonal_turn(w, TURN_RIGHT, k, P);
    if (!axis_is_left(w, apex(w, k), P)) return orthogonal_turn(w, TURN_LEFT, mw__prev(k), P);
    return orthogonal_end_turn(w, mw__next(k), P);
}

/* In the first tile of a vertical leg. */
static MW_INLINE mw_verdict orthogonal_set_out(mw_walk *w, mw_policy P)
{
    uint32_t e = axis_exit_edge(w, P);
    if (e == MW_NO_EDGE) return MW_VERDICT_UNSURE; /* the inner point was rounded off the tile */
    orthogonal_enter(w, FOLLOW);
    return orthogonal_go_on(w, e, P);
}

static MW_INLINE mw_verdict orthogonal_step(mw_walk *w, mw_policy P)
{
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e), step = w->phase & STEP;
    if (MW_LIKELY(step == FOLLOW)) /* entered over edge e = lr */
        return orthogonal_go_on(w, axis_is_left(w, apex(w, w->e), P) ? next : prev, P);
    if (step == TURN_RIGHT) /* entered over edge e = lp, the new r is off it */
        return axis_is_left(w, apex(w, w->e), P) ? orthogonal_cross_or_detour(w, next, P)
                                                 : orthogonal_end_turn(w, prev, P);
    if (step == TURN_LEFT) /* entered over edge e = pr, the new l is off it */
        return axis_is_left(w, apex(w, w->e), P) ? orthogonal_end_turn(w, next, P)
                                                 : orthogonal_cross_or_detour(w, prev, P);
    return step == SET_OUT ? orthogonal_set_out(w, P) : orthogonal_start(w, P);
}

MW_STAMP_WALK(orthogonal, false)
