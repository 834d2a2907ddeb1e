/* forgetful.c - the stochastic walk without memory [Devillers, Pion, Teillaud 2002, sec. 3.2;
 * thesis App. E, Alg. 2 less its "remembering" condition].
 *
 *          c
 *         / `
 *        /   `    * q
 *       a-----b
 *
 * Lawson's walk with the edges of each tile in random order: any of them first, then the others
 * round the tile. The edge just crossed is tested like any other, though q cannot lie beyond it: up
 * to three tests a tile, and no state at all. As with the walk that remembers (stochastic.c), the
 * probability of walking for ever is zero on any mesh. If the fuel runs out, another walk takes
 * over. */
#include "walk/drive.h"
#include "walk/stochastic.h"

static MW_INLINE mw_verdict forgetful_step(mw_walk *w, mw_policy P)
{
    uint32_t k = any_edge(mw__toss(&w->random));
    if (beyond(w, k, P)) return cross(w, k, P);
    if (beyond(w, mw__next(k), P)) return cross(w, mw__next(k), P);
    return leave(w, mw__prev(k), P);
}

MW_STAMP_WALK(forgetful, false)
