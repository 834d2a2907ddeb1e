/* normal_straight.c - the straight walk that stops at a normal line [Soukal, Kolingerova 2009:
 * thesis App. A, Alg. 2 and App. E, Alg. 5].
 *
 *      l               . n
 *      |\              .
 *    p *-\- - - - - - - q
 *      |  \            .
 *      |___s           .
 *      r
 *
 * The line leads from p, the middle of the edge of the first tile that faces the vertex s nearest
 * to q, to q; n is its normal at q. Let l and r be the left and right ends of the edge just
 * crossed, and s the third vertex. If s is past n, the walk is close to q and ends. Otherwise the
 * line leaves over rs if s lies to its left, else over sl. Each tile takes the equations of two
 * fixed lines at s, and no orientation test. An exact walk makes the last steps.
 *
 * Departures from the printed pseudocode. The normal has the minus sign that eq. 7 lost (slip 1),
 * and the edge over which the line leaves is that of the prose of App. A and of Alg. 5 (slip 2).
 * Both equations take s relative to q. That makes their constants zero at the price of two
 * subtractions: nothing is saved, but no digits cancel far from the origin. p itself is not needed,
 * only the direction d from p to q: the mean of the directions from l and r. Edge cases. In a flat
 * first tile q may lie behind lr although s is the nearest vertex; the printed walk then goes away
 * from q. Therefore it is first tested, once a query, whether the edge to be crossed has its ends
 * on different sides of the line. If not, the walk starts over lr, into the tile that the line
 * enters. An exact walk goes on if d is zero (q = p), if s of the first tile is past n, if the line
 * leaves the hull, or if no edge of the first tile will do (in tiles a few roundings wide). Begun
 * by a turn. App. E also tried this walk with the beginning of the straight walk: p is vertex 0 of
 * the first tile, round which the walk turns by orientation tests to the tile that the line enters.
 * That is a separate walk, normal_straight_turn. At worst the walk ends because its fuel runs out.
 * Without rounding it enters no tile twice; rounding could only lead it back to the edge it began
 * with: docs/proofs/walks.md. */
#include "walk/drive.h"

/* position(lambda, s) > 0: s lies to the left of the line. */
static MW_INLINE bool normal_left_of_line(mw_walk *w, mw_point s, mw_policy P)
{
    if (P.count) w->work->implicit++;
    return leftward(w, w->q, s) > 0;
}

/* position(lambda_n, s): s lies on the normal or on its far side. Not a number counts as past
 * it. */
static MW_INLINE bool normal_is_past(mw_walk *w, mw_point s, mw_policy P)
{
    if (P.count) w->work->implicit++;
    return !(ahead(w, w->q, s) < 0);
}

/* The edge of the current tile that faces its vertex nearest to q. */
static MW_INLINE uint32_t edge_facing_nearest(const mw_walk *w)
{
    double distance[3];
    for (uint32_t k = 0; k < 3; k++) {
        double x = corner(w, k).x - w->q.x, y = corner(w, k).y - w->q.y;
        distance[k] = x * x + y * y;
    }
    uint32_t k = distance[1] < distance[0];
    return mw__next(distance[2] < distance[k] ? 2 : k);
}

/* The first tile. */
static MW_INLINE mw_verdict normal_aim(mw_walk *w, mw_policy P)
{
    uint32_t e = edge_facing_nearest(w);
    mw_point l = corner(w, e), r = corner(w, e + 1), s = apex(w, e);
    double x = ((w->q.x - l.x) + (w->q.x - r.x)) / 2, y = ((w->q.y - l.y) + (w->q.y - r.y)) / 2;
    if (MW_UNLIKELY(!set_direction(w, x, y))) return MW_VERDICT_UNSURE;
    bool left = normal_left_of_line(w, s, P);
    if (MW_UNLIKELY(normal_left_of_line(w, left ? r : l, P) == left))
        return normal_left_of_line(w, left ? l : r, P) != left ? cross_unsure(w, e, P)
                                                               : MW_VERDICT_UNSURE;
    return normal_is_past(w, s, P) ? MW_VERDICT_UNSURE
                                   : cross_unsure(w, left ? mw__next(e) : mw__prev(e), P);
}

static MW_INLINE mw_verdict normal_follow(mw_walk *w, mw_policy P)
{
    mw_point s = apex(w, w->e); /* entered over edge e = lr */
    if (normal_is_past(w, s, P)) return MW_VERDICT_UNSURE;
    return cross_unsure(w, normal_left_of_line(w, s, P) ? mw__next(w->e) : mw__prev(w->e), P);
}

static MW_INLINE mw_verdict normal_straight_step(mw_walk *w, mw_policy P)
{
    return MW_UNLIKELY(w->e == MW_NO_EDGE) ? normal_aim(w, P) : normal_follow(w, P);
}

MW_STAMP_WALK(normal_straight, false)

/* --- begun by turning round a vertex ---------------------------------------------------------- */

enum { FIRST, TURN_RIGHT, TURN_LEFT, FOLLOW }; /* phases */

/* > 0: s lies to the left of the line from p to q. */
static MW_INLINE double normal_turn_side(mw_walk *w, mw_point s, mw_policy P)
{
    return orient(w, w->p, w->q, s, P);
}

/* The turn ends: the line leaves this tile over edge e, off p. Its vertex s was the last one
 * tested. The rest of the way is unique, forwards and backwards, only if the ends of the edge where
 * it begins lie on different sides of the rounded line, too. */
static MW_INLINE mw_verdict normal_turned(mw_walk *w, uint32_t e, mw_point s, mw_policy P)
{
    w->phase = FOLLOW;
    begin_stage(w, MW_STAGE_WALK, P);
    bool parted =
        normal_left_of_line(w, corner(w, e + 1), P) && !normal_left_of_line(w, corner(w, e), P);
    return !parted || normal_is_past(w, s, P) ? MW_VERDICT_UNSURE : cross_unsure(w, e, P);
}

/* The first tile, with p = vertex 0, r = vertex 1 and l = vertex 2. */
static MW_INLINE mw_verdict normal_turn_aim(mw_walk *w, mw_policy P)
{
    initialise(w, P);
    w->p = corner(w, 0);
    if (MW_UNLIKELY(!set_direction(w, w->q.x - w->p.x, w->q.y - w->p.y))) return MW_VERDICT_UNSURE;
    if (normal_turn_side(w, corner(w, 1), P) > 0) {
        w->phase = TURN_RIGHT;
        return cross_unsure(w, 0, P);
    }
    if (normal_turn_side(w, corner(w, 2), P) < 0) {
        w->phase = TURN_LEFT;
        return cross_unsure(w, 2, P);
    }
    return normal_turned(w, 1, corner(w, 2), P);
}

static MW_INLINE mw_verdict normal_straight_turn_step(mw_walk *w, mw_policy P)
{
    if (MW_LIKELY(w->phase == FOLLOW)) return normal_follow(w, P);
    if (w->phase == FIRST) return normal_turn_aim(w, P);
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e);
    mw_point s = apex(w, w->e);
    if (w->phase == TURN_RIGHT) /* entered over edge e = lp, the new r is s */
        return normal_turn_side(w, s, P) > 0 ? cross_unsure(w, next, P)
                                             : normal_turned(w, prev, s, P);
    /* pr, l is s */
    return normal_turn_side(w, s, P) < 0 ? cross_unsure(w, prev, P) : normal_turned(w, next, s, P);
}

MW_STAMP_WALK(normal_straight_turn, false)
