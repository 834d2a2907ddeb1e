/* stochastic.c - the remembering stochastic walk [Devillers, Pion, Teillaud 2002, sec. 3.2; thesis App. E, Alg. 2].
 *
 * The remembering walk with its edges in random order. On any mesh the chance of walking on for ever is zero, but there
 * is no bound that holds for certain; where the fuel runs out it hands over. */
#include "walk/drive.h"

/* xorshift64 [Marsaglia 2003]: the state is never 0, the upper bits are the good ones. */
static MW_INLINE uint64_t toss(mw_walk *w)
{
    uint64_t x = w->random | 1u << 7;
    x ^= x << 13;
    x ^= x >> 7;
    x ^= x << 17;
    w->random = x;
    return x >> 32;
}

static MW_INLINE mw_verdict stochastic_step(mw_walk *w, mw_policy P)
{
    uint64_t coin = toss(w);
    if (w->e == MW_NO_EDGE) {
        uint32_t k = (uint32_t)(coin * 3 >> 32);
        if (beyond(w, k, P)) return cross(w, k, P);
        w->e = k; /* as if entered there: the rest is the same */
    }
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e);
    uint32_t first = coin & 1 ? next : prev;
    return leave_either(w, first, next + prev - first, P);
}

MW_STAMP_WALK(stochastic, false)
