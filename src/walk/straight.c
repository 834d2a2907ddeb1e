/* straight.c - the straight walk [Devillers, Pion, Teillaud 2002, sec. 3.1; thesis App. A, Alg. 1
 * and App. E, Alg. 4].
 *
 *        l
 *       /|\
 *    p / | \ s   * q
 *      \ | /
 *       \|/
 *        r
 *
 * First turn round p, a vertex of the first tile, to the tile at p that the line from p to q
 * enters; each tile takes one test. Then follow the line. Let l and r be the left and right ends of
 * the edge just crossed, and s the third vertex. The line leaves over rs if s lies to its left,
 * over sl otherwise. If q does not lie beyond that edge, it is in this tile. Each tile takes two
 * tests. Departures from the printed pseudocode: slip 3 (the side of q is taken against the edge as
 * the tile's boundary runs). A vertex s on the line counts as neither side: where r is on the line
 * too, the line runs along rs and leaves over sl at s; otherwise it leaves over rs at s; and if q
 * lies beyond neither, it is here. Edge cases. q = p: every test is zero and the first tile is the
 * answer. p on the hull: if the turn meets the hull before it finds the line, the line points out
 * of the hull, because the angle of the hull at p is at most pi and the turn takes the short way
 * round. So q is outside. Ends on every tiling: the turn passes each tile at p at most once. After
 * it, the point where the line meets the exit edge never moves back; while it rests (at a vertex on
 * the line), the tiles turn one way round that vertex. So no tile is entered twice. */
#include "walk/drive.h"

enum { FIRST, TURN_RIGHT, TURN_LEFT, FOLLOW }; /* phases */

/* > 0: s lies to the left of the line from p to q; < 0: to the right. */
static MW_INLINE double straight_side(mw_walk *w, mw_point s, mw_policy P)
{
    return orient(w, w->p, w->q, s, P);
}

/* The line leaves the tile through edge e, off p: the turn ends here. */
static MW_INLINE mw_verdict straight_follow(mw_walk *w, uint32_t e, mw_policy P)
{
    w->phase = FOLLOW;
    begin_stage(w, MW_STAGE_WALK, P);
    return leave(w, e, P);
}

/* The first tile, with p = vertex 0, r = vertex 1 and l = vertex 2. */
static MW_INLINE mw_verdict straight_aim(mw_walk *w, mw_policy P)
{
    initialise(w, P);
    w->p = corner(w, 0);
    if (straight_side(w, corner(w, 1), P) > 0) {
        w->phase = TURN_RIGHT;
        return cross(w, 0, P);
    }
    if (straight_side(w, corner(w, 2), P) < 0) {
        w->phase = TURN_LEFT;
        return cross(w, 2, P);
    }
    return straight_follow(w, 1, P);
}

static MW_INLINE mw_verdict straight_step(mw_walk *w, mw_policy P)
{
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e);
    if (MW_LIKELY(w->phase == FOLLOW)) { /* entered over edge e = lr */
        double s = straight_side(w, apex(w, w->e), P);
        if (MW_UNLIKELY(s == 0) && beyond(w, next, P)) return cross(w, next, P);
        return leave(w, s > 0 ? next : prev, P);
    }
    if (w->phase == TURN_RIGHT) /* entered over edge e = lp, the new r is off it */
        return straight_side(w, apex(w, w->e), P) > 0 ? cross(w, next, P)
                                                      : straight_follow(w, prev, P);
    if (w->phase == TURN_LEFT) /* entered over edge e = pr, the new l is off it */
        return straight_side(w, apex(w, w->e), P) < 0 ? cross(w, prev, P)
                                                      : straight_follow(w, next, P);
    return straight_aim(w, P);
}

MW_STAMP_WALK(straight, true)
