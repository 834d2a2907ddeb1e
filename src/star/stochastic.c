/* stochastic.c - the remembering stochastic walk on a star-shaped polyhedron [thesis App. F, sec. 3].
 *
 * The ray lies beyond an edge of the facet where the plane through the edge and the centre parts it from the facet:
 * leave there. The other two edges than the one just crossed are tried in random order. The three half-spaces of a
 * facet meet in its cone, without the opposite one, so where the ray lies beyond no edge it meets the facet. The chance
 * of walking on for ever is zero, but there is no bound that holds for certain; where the fuel runs out, the straight
 * walk goes on. */
#include "base/random.h"
#include "star/walk.h"

/* Of the edges of which the ray lies beyond some (bit k), the one that the walk tries first: all three in the first
 * facet, else the two that it did not come over. */
static MW_INLINE uint32_t choose(uint32_t beyond, uint32_t entry, uint64_t coin)
{
    uint32_t k = entry == MW_STAR_NO_EDGE ? (uint32_t)(coin * 3 >> 32) : entry;
    uint32_t first = coin & 1 ? mw__next(k) : mw__prev(k), second = 3 - k - first;
    uint32_t other = beyond >> first & 1 ? first : second;
    return beyond >> k & 1 ? k : other;
}

/* Many in flight go the same way: all three tests are made, and no jump depends on what they say. */
static MW_INLINE mw_star_verdict step_in_flight(mw_star_walk *w, mw_star_policy P)
{
    uint64_t coin = mw__toss(&w->random);
    uint32_t beyond = edges_beyond(w);
    return beyond ? cross(w, choose(beyond, w->e, coin), P) : MW_STAR_FOUND;
}

static MW_INLINE mw_star_verdict stochastic_step(mw_star_walk *w, mw_star_policy P)
{
    if (P.lanes) return step_in_flight(w, P);
    uint64_t coin = mw__toss(&w->random);
    if (w->e == MW_STAR_NO_EDGE) {
        uint32_t k = (uint32_t)(coin * 3 >> 32);
        if (beyond(w, k, P)) return cross(w, k, P);
        w->e = k; /* as if entered there: the rest is the same */
    }
    uint32_t first = coin & 1 ? mw__next(w->e) : mw__prev(w->e);
    return leave_either(w, first, 3 - w->e - first, P);
}

MW_STAR_STAMP(stochastic)
