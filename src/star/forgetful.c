/* forgetful.c - the stochastic walk as counted in thesis App. F, Table 1: it tests the edge just crossed like the
 * others. Here to be compared with those counts; it goes where the remembering walk might go, and ends as that does. */
#include "base/random.h"
#include "star/walk.h"

static MW_INLINE mw_star_verdict forgetful_step(mw_star_walk *w, mw_star_policy P)
{
    uint64_t coin = mw__toss(&w->random);
    uint32_t k = (uint32_t)(coin * 3 >> 32), first = coin & 1 ? mw__next(k) : mw__prev(k);
    if (beyond(w, k, P)) return cross(w, k, P);
    return leave_either(w, first, 3 - k - first, P);
}

MW_STAR_STAMP(forgetful)
