/* borrowed_walk.c - the remembering walk [Devillers, Pion, Teillaud 2002, sec. 3.2; thesis App. A,
 * sec. 2] over triangles of any orientation.
 *
 *            S            Only the first triangle is asked for its orientation. From then on the
 *           / \     *q    walk knows its corners by the edge AB that it came over, with q and the
 *          /   \          triangle strictly to its left. So A, B and S turn left, whichever way the
 *         A-----B         arrays have them, and q is beyond BS where it lies to its right, or
 *                         beyond SA. Where it crosses BS, that edge, from S to B, is the next AB.
 *
 * A triangle without an area is crossed like any other: q lies strictly beyond the edge that led
 * there, and so beyond one of the two others. */
#include "borrow/borrowed_walk.h"
#include "walk/stochastic.h"

/* The tile of a walk, and the numbers of its corners A, B and S in it. */
typedef struct borrowed_step {
    mw_borrowed_tile tile;
    uint32_t a, b, s;
} borrowed_step;

static MW_INLINE bool borrowed_beyond(mw_borrowed_walk *w, const borrowed_step *at, uint32_t from,
                                      uint32_t to)
{
    return orient(&w->counts, at->tile.p[from], at->tile.p[to], w->q, mw__borrowed_policy) < 0;
}

/* Over the edge from corner `from` to corner `to`, which q lies to the right of. */
static MW_INLINE mw_verdict borrowed_cross(mw_borrowed_walk *w, borrowed_step *at, uint32_t from,
                                           uint32_t to)
{
    uint32_t next = mw__borrowed_across(w->mesh, w->t, 3 - from - to);
    if (MW_UNLIKELY(next == MW_NONE)) return MW_VERDICT_LEFT;
    uint32_t b = at->tile.v[from], a = at->tile.v[to];
    if (MW_UNLIKELY(!mw__borrowed_read(w->mesh, next, &at->tile))) return MW_VERDICT_OUT_OF_FUEL;
    uint32_t s = mw__borrowed_apex(&at->tile, a, b);
    if (MW_UNLIKELY(s == 3)) return MW_VERDICT_OUT_OF_FUEL;
    at->s = s;
    at->a = at->tile.v[mw__next(s)] == a ? mw__next(s) : mw__prev(s);
    at->b = 3 - s - at->a;
    mw__borrowed_enter(w, next);
    return MW_VERDICT_GO_ON;
}

/* The first tile: its orientation, and over which of its edges to go, if any. */
static mw_verdict borrowed_begin(mw_borrowed_walk *w, borrowed_step *at)
{
    if (!mw__borrowed_read(w->mesh, w->t, &at->tile)) return MW_VERDICT_OUT_OF_FUEL;
    double area =
        orient(&w->counts, at->tile.p[0], at->tile.p[1], at->tile.p[2], mw__borrowed_policy);
    if (area == 0) return MW_VERDICT_OUT_OF_FUEL;
    at->a = area > 0 ? 0 : 1;
    at->b = 1 - at->a;
    at->s = 2;
    return borrowed_beyond(w, at, at->a, at->b) ? borrowed_cross(w, at, at->a, at->b)
                                                : MW_VERDICT_GO_ON;
}

/* Over one of the two edges that the walk did not come by, `swap`: SA first. */
static MW_INLINE mw_verdict borrowed_go(mw_borrowed_walk *w, borrowed_step *at, bool swap)
{
    uint32_t a = at->a, b = at->b, s = at->s;
    if (swap && borrowed_beyond(w, at, s, a)) return borrowed_cross(w, at, s, a);
    if (borrowed_beyond(w, at, b, s)) return borrowed_cross(w, at, b, s);
    if (!swap && borrowed_beyond(w, at, s, a)) return borrowed_cross(w, at, s, a);
    return MW_VERDICT_FOUND;
}

mw_verdict mw__borrowed_remembering(mw_borrowed_walk *w)
{
    borrowed_step at;
    mw_verdict verdict = borrowed_begin(w, &at);
    uint32_t sober = w->fuel / 2;
    while (verdict == MW_VERDICT_GO_ON && w->fuel > 0) {
        bool swap = w->fuel < sober && (mw__toss(&w->random) & 1);
        w->fuel--;
        verdict = borrowed_go(w, &at, swap);
    }
    return verdict == MW_VERDICT_GO_ON ? MW_VERDICT_OUT_OF_FUEL : verdict;
}
