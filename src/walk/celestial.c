/* celestial.c - the celestial walk [Kuijper, Ermolaev, Devillers 2017, arXiv 1710.01620], for
 * triangles.
 *
 *        b
 *       / `
 *      /    ` .
 *     /        `
 *    a----------c
 *               :
 *               : * q
 *
 * The edges that q lies beyond form a chain, one or two edges of a triangle. Begin at its first
 * edge, counter-clockwise: ac. If the corner c between it and the next edge cb is obtuse and q lies
 * on the far side of the perpendicular to ac at c, take cb. Cross. The perpendicular divides the
 * obtuse angle into a right and an acute one, as the paper requires of the line. The signs of two
 * dot products decide. Ends on every tiling: the edge crossed holds the point x of the tile nearest
 * to q, so the distance from q to the tile never grows. It stays the same only if x is a vertex,
 * and then the walk turns one way round x. So no tile is entered twice (proof:
 * docs/proofs/walks.md). The walk would end without any memory; it remembers the edge it came over
 * only to save a test. */
#include "walk/drive.h"

/* Cross edge e, the first of the chain, or the next edge if q lies round the corner between
 * them. */
static MW_INLINE mw_verdict celestial_cross_chain(mw_walk *w, uint32_t e, mw_policy P)
{
    uint32_t next = mw__next(e);
    mw_point a = corner(w, e), c = corner(w, next), b = apex(w, e);
    bool round = dot(w, c, a, w->q, P) < 0 && dot(w, c, a, b, P) < 0;
    return cross_guessed(w, round ? next : e, P);
}

static MW_INLINE mw_verdict celestial_step(mw_walk *w, mw_policy P)
{
    if (MW_UNLIKELY(w->e == MW_NO_EDGE)) {
        /* Where q lies beyond edges 0 and 2, the chain begins with 2. */
        if (beyond(w, 0, P)) return celestial_cross_chain(w, beyond(w, 2, P) ? 2 : 0, P);
        w->e = 0; /* as if entered there: the rest is the same */
    }
    uint32_t next = mw__next(w->e);
    if (beyond(w, next, P)) return celestial_cross_chain(w, next, P);
    return leave(w, mw__prev(w->e), P);
}

MW_STAMP_WALK(celestial, true)
