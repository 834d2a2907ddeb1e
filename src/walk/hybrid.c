/* hybrid.c - the hybrid walk [thesis App. B, Alg. 1].
 *
 *        l
 *       /|\
 *    p /_|_\ s _ _ _ q
 *      \ | /       .
 *       \|/        .
 *        r
 *
 * The straight walk in turned and scaled coordinates, in which the line from p to q is horizontal:
 * with a = q - p, x' = x a_x + y a_y and y' = -x a_y + y a_x. First turn round p, a vertex of the
 * first tile, to the tile at p that the line enters; each tile takes one y'. Then follow the line.
 * Let l and r be the left and right ends of the edge just crossed, and s the third vertex. If x' of
 * s is at least that of q, the walk is close to q and ends. Otherwise the line leaves over rs if s
 * lies above it, else over sl. An exact walk makes the last steps.
 *
 * Departures from the printed pseudocode. The printed matrix turns by the wrong sign, so that p->q
 * ends at twice its angle (slip 4). Coordinates are relative to p: q' = (|a|^2, 0), p' = 0, and
 * nothing cancels far from the origin. The first tile is seen from its vertex 0; like the straight
 * walk, and like the printed one, the turn takes the short way round. It ends at the tile that the
 * line enters. The vertex of that tile tested last is the first s; its y' is not compared again. A
 * vertex on the line counts as below it, everywhere; in the printed loop it counts as above. Edge
 * cases. q = p: an exact walk starts in the first tile. Where the turn or the walk meets the hull,
 * q is outside or on the hull, up to rounding: an exact walk goes on from there. At worst the walk
 * ends because its fuel runs out. Without rounding it enters no tile twice; rounding could only
 * lead it back to the edge it began with, or keep it turning round p: docs/proofs/walks.md. */
#include "walk/drive.h"

enum { FIRST, TURN_RIGHT, TURN_LEFT, FOLLOW }; /* phases */

/* y'_s > y'_q = 0: s lies to the left of the line. */
static MW_INLINE bool hybrid_above(mw_walk *w, mw_point s, mw_policy P)
{
    if (P.count) w->work->comparisons++;
    return leftward(w, w->p, s) > 0;
}

/* x'_s >= x'_q. Not a number counts as past it. */
static MW_INLINE bool hybrid_past(mw_walk *w, mw_point s, mw_policy P)
{
    if (P.count) w->work->comparisons++;
    return !(ahead(w, w->p, s) < ahead(w, w->p, w->q));
}

/* The turn ends in this tile: the line leaves it through edge e, off p. Its vertex s was the last
 * one tested. */
static MW_INLINE mw_verdict hybrid_follow(mw_walk *w, uint32_t e, mw_point s, mw_policy P)
{
    w->phase = FOLLOW;
    begin_stage(w, MW_STAGE_WALK, P);
    return hybrid_past(w, s, P) ? MW_VERDICT_UNSURE : cross_unsure(w, e, P);
}

/* The first tile, with p = vertex 0, r = vertex 1 and l = vertex 2. */
static MW_INLINE mw_verdict hybrid_aim(mw_walk *w, mw_policy P)
{
    initialise(w, P);
    w->p = corner(w, 0);
    if (MW_UNLIKELY(!set_direction(w, w->q.x - w->p.x, w->q.y - w->p.y))) return MW_VERDICT_UNSURE;
    if (hybrid_above(w, corner(w, 1), P)) {
        w->phase = TURN_RIGHT;
        return cross_unsure(w, 0, P);
    }
    if (!hybrid_above(w, corner(w, 2), P)) {
        w->phase = TURN_LEFT;
        return cross_unsure(w, 2, P);
    }
    return hybrid_follow(w, 1, corner(w, 2), P);
}

static MW_INLINE mw_verdict hybrid_step(mw_walk *w, mw_policy P)
{
    if (MW_UNLIKELY(w->phase == FIRST)) return hybrid_aim(w, P);
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e);
    mw_point s = apex(w, w->e);
    if (MW_LIKELY(w->phase == FOLLOW)) { /* entered over edge e = lr */
        if (MW_UNLIKELY(hybrid_past(w, s, P))) return MW_VERDICT_UNSURE;
        return cross_guessed_unsure(w, hybrid_above(w, s, P) ? next : prev, P);
    }
    if (w->phase == TURN_RIGHT) /* entered over edge e = lp, the new r is s */
        return hybrid_above(w, s, P) ? cross_unsure(w, next, P) : hybrid_follow(w, prev, s, P);
    return hybrid_above(w, s, P) ? hybrid_follow(w, next, s, P)
                                 /* entered over e = pr, the new l is s */
                                 : cross_unsure(w, prev, P);
}

MW_STAMP_WALK(hybrid, false)
