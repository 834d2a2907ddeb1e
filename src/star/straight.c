/* straight.c - the straight walk on a star-shaped polyhedron: after [Devillers, Pion, Teillaud 2002, sec. 3.1], with
 * the great circle from a vertex p of the first facet to the ray through q in the place of the line. The walk that
 * surely ends.
 *
 * First it turns round p to the facet at p into which the arc sets out: the one whose corners a (after p) and b (before
 * p) have q on or to the left of the circle from p to a, and strictly to the right of the one from p to b. The angles
 * at p add up to one full turn, so there is exactly one, and turning one way finds it before any facet comes twice.
 * Then it follows the arc: with l and r the left and right ends of the edge just crossed and s the third vertex, the
 * arc leaves over rs where s lies strictly to its left, over sl otherwise. A vertex on the circle so counts as right of
 * it, always: the way is that of an arc beside it, which meets no vertex. q lies beyond the exit edge, or here.
 *
 * p must span a plane with q: where p, q and the centre lie on one line, either the ray goes through p, and it is here,
 * or p lies opposite to q; then another corner takes its place, for which that cannot be so, too.
 *
 * Why it ends, and rightly. Let p be at angle 0 on the circle, q at an angle below pi. The arc leaves each facet
 * farther on than it came in, or at the same place where it rests at a vertex, and there the walk turns one way. So no
 * facet comes twice after the turn. Beyond the exit edge are the angles from the exit y to y + pi; q comes after the
 * place where the arc came in and before pi <= y + pi, so where q is not beyond the edge it lies in the facet. */
#include "star/walk.h"

enum { FIRST, TURN_RIGHT, TURN_LEFT, FOLLOW }; /* phases */

/* On one line with c: do a and b lie on the same side of it? Along a line coordinates grow or fall together. */
static bool same_way(const double c[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        if (a[k] != c[k] && b[k] != c[k]) return (a[k] > c[k]) == (b[k] > c[k]);
    return false;
}

/* > 0: s lies to the left of the arc from p to q. det(p - c, q - c, s - c) = det(s - c, p - c, q - c). */
static MW_INLINE double side(mw_star_walk *w, const double s[3], mw_star_policy P)
{
    return turn(w, s, star_vertex(w, w->p), P);
}

/* The arc sets out into the current facet and leaves over edge e, off p: the turn ends here. */
static MW_INLINE mw_star_verdict follow(mw_star_walk *w, uint32_t e, mw_star_policy P)
{
    w->phase = FOLLOW;
    return leave(w, e, P);
}

/* The first facet: choose p, then look where the arc sets out. Edge k leaves p, edge k - 1 comes to it. */
static mw_star_verdict aim(mw_star_walk *w, mw_star_policy P)
{
    uint32_t k = 0;
    while (k < 2 && mw__collinear3(w->c, star_corner(w, k), w->q)) {
        if (same_way(w->c, star_corner(w, k), w->q)) return MW_STAR_FOUND;
        k++;
    }
    w->p = w->facet[w->t].v[k];
    uint32_t next = mw__next(k), prev = mw__prev(k);
    if (side(w, star_corner(w, next), P) > 0) { /* a is left of the arc: turn right, over the edge pa */
        w->phase = TURN_RIGHT;
        return cross(w, k, P);
    }
    if (side(w, star_corner(w, prev), P) <= 0) { /* b is right of it, or on its circle */
        w->phase = TURN_LEFT;
        return cross(w, prev, P);
    }
    return follow(w, next, P);
}

static MW_INLINE mw_star_verdict straight_step(mw_star_walk *w, mw_star_policy P)
{
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e);
    if (MW_LIKELY(w->phase == FOLLOW)) /* entered over edge e = lr */
        return leave(w, side(w, star_apex(w, w->e), P) > 0 ? next : prev, P);
    if (w->phase == TURN_RIGHT) /* entered over edge e = bp: its b was left of the arc, the new a is off it */
        return side(w, star_apex(w, w->e), P) > 0 ? cross(w, next, P) : follow(w, prev, P);
    if (w->phase == TURN_LEFT) /* entered over edge e = pa: its a was not left of the arc, the new b is off it */
        return side(w, star_apex(w, w->e), P) <= 0 ? cross(w, prev, P) : follow(w, next, P);
    return aim(w, P);
}

MW_STAR_STAMP(straight)
