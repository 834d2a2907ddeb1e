/* star_stochastic.c - the remembering stochastic walk on a star-shaped polyhedron [thesis App. F,
 * sec. 3].
 *
 * The plane through an edge of the facet and the centre may separate the ray from the facet. Then
 * the ray lies beyond that edge, and the walk leaves there. It tries the two edges other than the
 * entry edge in random order. The three half-spaces of a facet meet in its cone, without the
 * opposite cone. So if the ray lies beyond no edge, it meets the facet. The walk ends with
 * probability one, but has no fixed bound. When the fuel is used up, the straight walk takes
 * over. */
#include "base/random.h"
#include "star/star_walk.h"

/* The edge to leave by. Bit k of `beyond`: the ray lies beyond edge k. Candidates come in random
 * order: all three edges in the first facet, else the two other than the entry edge. */
static MW_INLINE uint32_t stochastic_choose_edge(uint32_t beyond, uint32_t entry, uint64_t coin)
{
    uint32_t k = entry == MW_STAR_NO_EDGE ? (uint32_t)(coin * 3 >> 32) : entry;
    uint32_t first = coin & 1 ? mw__next(k) : mw__prev(k), second = 3 - k - first;
    uint32_t other = beyond >> first & 1 ? first : second;
    return beyond >> k & 1 ? k : other;
}

/* The step for interleaved walks, on the same path: it makes all three tests, and no branch depends
 * on their results. */
static MW_INLINE mw_star_verdict star_stochastic_step_interleaved(mw_star_walk *w, mw_star_policy P)
{
    uint64_t coin = mw__toss(&w->random);
    uint32_t beyond = star_edges_beyond(w);
    return beyond ? star_cross(w, stochastic_choose_edge(beyond, w->e, coin), P) : MW_STAR_FOUND;
}

static MW_INLINE mw_star_verdict star_stochastic_step(mw_star_walk *w, mw_star_policy P)
{
    if (P.lanes) return star_stochastic_step_interleaved(w, P);
    uint64_t coin = mw__toss(&w->random);
    if (w->e == MW_STAR_NO_EDGE) {
        uint32_t k = (uint32_t)(coin * 3 >> 32);
        if (star_beyond(w, k, P)) return star_cross(w, k, P);
        w->e = k; /* as if it were the entry edge: the rest is the same */
    }
    uint32_t first = coin & 1 ? mw__next(w->e) : mw__prev(w->e);
    return star_leave_either(w, first, 3 - w->e - first, P);
}

MW_STAR_STAMP(stochastic)
