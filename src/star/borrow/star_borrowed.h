/* star_borrowed.h - rays on the records of the surface itself [thesis App. F]. Private.
 *
 * A borrowed star has nothing but its centre. Its facets are the surface's triangles, in the
 * caller's order and either orientation, flat ones among them. A walk asks the first facet on which
 * side of it the centre lies. From then on it knows how each facet is turned by the edge that it
 * came over:
 *
 *            S            The ray lies strictly to the left of the edge from A to B, seen from
 *           / \     *q    outside, as the facet does. So A, B and S turn left, whichever way
 *          /   \          the surface has them, and q is beyond BS where it lies to its right,
 *         A-----B         or beyond SA.
 *
 * A flat facet is crossed like any other: its three edges lie in one plane with the centre, so a
 * ray strictly beyond the edge that led there lies strictly beyond one of the two others. */
#ifndef MW_SRC_STAR_BORROW_STAR_BORROWED_H
#define MW_SRC_STAR_BORROW_STAR_BORROWED_H

#include "star/star_walk_run.h"

/* A walk, and what it did. */
typedef struct mw_star_borrowed_walk {
    const mw_star *star;
    double c[3], q[3], d[3]; /* centre, query point, and q - c, rounded */
    uint32_t t, e;           /* present facet, and the edge it was entered by: as mw_star_walk */
    uint32_t fuel;           /* steps left */
    bool turned;             /* seen from outside, the facet's corners go round clockwise */
    uint64_t random;
    mw_star_work work;
    mw_star_trace *trace; /* or NULL */
} mw_star_borrowed_walk;

/* 1: a facet's corners go round counter-clockwise, seen from outside; -1: clockwise; 0: it has no
 * area, or a corner that is not finite. Exact. */
int mw__star_borrowed_facing(const mw_star *star, uint32_t t);

/* On which side of the plane through edge k of facet t and the centre is the ray: the sign says,
 * as of mw__star_orient from the edge's first corner to its second. */
double mw__star_borrowed_side(const mw_star_borrowed_walk *w, uint32_t t, uint32_t k);

/* Go to facet t. False if it has no area: a walk cannot begin there. */
bool mw__star_borrowed_enter(mw_star_borrowed_walk *w, uint32_t t);

/* The remembering stochastic walk [thesis App. F, sec. 3] from the facet that was entered to the
 * one that the ray meets: true. False: fuel has run out, or an edge has no neighbour. */
bool mw__star_borrowed_run(mw_star_borrowed_walk *w);

/* The answer for the ray through q, which is finite and not the centre, by the start of the cursor.
 * *last: where the query before ended, or MW_NONE; becomes where this one did. *work becomes what
 * was done; *scanned: all facets were looked at. `trace` may be NULL. */
mw_location mw__star_borrowed_answer(const mw_star *star, const mw_star_cursor *cursor,
                                     const double q[3], uint32_t *last, uint64_t *random,
                                     mw_star_work *work, bool *scanned, mw_star_trace *trace);

#endif
