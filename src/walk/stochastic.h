/* stochastic.h - a coin, and the remembering stochastic step: for the walks that toss one.
 * Private. */
#ifndef MW_SRC_WALK_STOCHASTIC_H
#define MW_SRC_WALK_STOCHASTIC_H

#include "base/random.h"
#include "walk/step.h"

/* Any of the three edges, from the upper bits of the coin. */
static MW_INLINE uint32_t any_edge(uint64_t coin)
{
    return (uint32_t)(coin * 3 >> 32);
}

/* One of the two edges other than e, from the lowest bit. */
static MW_INLINE uint32_t either_edge(uint64_t coin, uint32_t e)
{
    return coin & 1 ? mw__next(e) : mw__prev(e);
}

/* The edge that is neither e nor f. */
static MW_INLINE uint32_t third_edge(uint32_t e, uint32_t f)
{
    return 3 - e - f;
}

static MW_INLINE mw_verdict stochastic_step(mw_walk *w, mw_policy P)
{
    uint64_t coin = mw__toss(&w->random);
    if (w->e == MW_NO_EDGE) {
        uint32_t k = any_edge(coin);
        if (beyond(w, k, P)) return cross(w, k, P);
        w->e = k; /* as if entered there: the rest is the same */
    }
    uint32_t first = either_edge(coin, w->e);
    return leave_either(w, first, third_edge(w->e, first), P);
}

#endif
