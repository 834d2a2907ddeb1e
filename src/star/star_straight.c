/* star_straight.c - the straight walk on a star-shaped polyhedron, after [Devillers, Pion, Teillaud
 * 2002, sec. 3.1]. The great circle from a vertex p of the first facet to the ray through q stands
 * for the line. This walk always ends.
 *
 * First it turns round p to the facet at p into which the arc starts. Let a be the corner after p
 * and b the one before it. In this facet q lies on or to the left of the circle from p to a, and
 * strictly to the right of the circle from p to b. The angles at p add up to one full turn, so
 * there is exactly one such facet. Turning in one direction finds it before any facet comes twice.
 *
 * Then it follows the arc. Let l and r be the left and right ends of the edge just crossed, and s
 * the third vertex. The arc leaves over rs if s lies strictly to its left, over sl otherwise. So a
 * vertex on the circle always counts as right of it. In effect the walk follows an arc next to it,
 * which meets no vertex. q lies beyond the exit edge, or in this facet.
 *
 * p must span a plane with q. If p, q and the centre are collinear, either the ray goes through p,
 * and the search ends here, or p lies opposite to q. Then another corner takes the place of p; it
 * cannot be opposite to q, too.
 *
 * Why it ends, with the right facet. Let p be at angle 0 on the circle, and q at an angle below pi.
 * The arc leaves each facet farther on than it entered, or at the same point if it stays at a
 * vertex; there the walk turns in one direction. So no facet comes twice after the turn. Beyond the
 * exit edge are the angles from the exit y to y + pi. q comes after the point where the arc
 * entered, and before pi <= y + pi. So if q is not beyond the exit edge, it lies in the facet. */
#include "star/star_walk.h"

enum { FIRST, TURN_RIGHT, TURN_LEFT, FOLLOW }; /* phases */

/* For a and b collinear with c: do they lie on the same side of c? Along a line each coordinate
 * only grows, or only falls. */
static bool points_same_way(const double c[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        if (a[k] != c[k] && b[k] != c[k]) return (a[k] > c[k]) == (b[k] > c[k]);
    return false;
}

/* > 0: s lies to the left of the arc from p to q. det(p - c, q - c, s - c) = det(s - c, p - c, q -
 * c). */
static MW_INLINE double star_straight_side(mw_star_walk *w, const double s[3], mw_star_policy P)
{
    return star_orient(w, s, star_vertex(w, w->p), P);
}

/* The arc starts into the current facet and leaves over edge e, opposite to p. The turn ends
 * here. */
static MW_INLINE mw_star_verdict star_straight_follow(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    w->phase = FOLLOW;
    return star_leave(w, e, P);
}

/* In the first facet: choose p, then find where the arc starts. Edge k leaves p, edge k - 1 arrives
 * at it. */
static mw_star_verdict star_straight_aim(mw_star_walk *w, mw_star_policy P)
{
    uint32_t k = 0;
    while (k < 2 && mw__collinear3(w->c, star_corner(w, k), w->q)) {
        if (points_same_way(w->c, star_corner(w, k), w->q)) return MW_STAR_FOUND;
        k++;
    }
    w->p = w->facet[w->t].v[k];
    uint32_t next = mw__next(k), prev = mw__prev(k);
    /* A is left of the arc: turn right, over the edge pa. */
    if (star_straight_side(w, star_corner(w, next), P) > 0) {
        w->phase = TURN_RIGHT;
        return star_cross(w, k, P);
    }
    /* B is right of it, or on its circle. */
    if (star_straight_side(w, star_corner(w, prev), P) <= 0) {
        w->phase = TURN_LEFT;
        return star_cross(w, prev, P);
    }
    return star_straight_follow(w, next, P);
}

static MW_INLINE mw_star_verdict star_straight_step(mw_star_walk *w, mw_star_policy P)
{
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e);
    if (MW_LIKELY(w->phase == FOLLOW)) /* entered over edge e = lr */
        return star_leave(w, star_straight_side(w, star_apex(w, w->e), P) > 0 ? next : prev, P);
    /* Entered over edge e = bp: b was left of the arc, the new a is opposite. */
    if (w->phase == TURN_RIGHT)
        return star_straight_side(w, star_apex(w, w->e), P) > 0 ? star_cross(w, next, P)
                                                                : star_straight_follow(w, prev, P);
    /* Entered over edge e = pa: a was not left of the arc, the new b is opposite. */
    if (w->phase == TURN_LEFT)
        return star_straight_side(w, star_apex(w, w->e), P) <= 0 ? star_cross(w, prev, P)
                                                                 : star_straight_follow(w, next, P);
    return star_straight_aim(w, P);
}

MW_STAR_STAMP(straight)
