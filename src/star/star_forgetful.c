/* star_forgetful.c - the stochastic walk as counted in thesis App. F, Table 1: it also tests the
 * edge just crossed. It serves to compare with those counts. Its path is a possible path of the
 * remembering walk, and it ends for the same reason. */
#include "base/random.h"
#include "star/star_walk.h"

static MW_INLINE mw_star_verdict star_forgetful_step(mw_star_walk *w, mw_star_policy P)
{
    uint64_t coin = mw__toss(&w->random);
    uint32_t k = (uint32_t)(coin * 3 >> 32), first = coin & 1 ? mw__next(k) : mw__prev(k);
    if (star_beyond(w, k, P)) return star_cross(w, k, P);
    return star_leave_either(w, first, 3 - k - first, P);
}

MW_STAR_STAMP(forgetful)
