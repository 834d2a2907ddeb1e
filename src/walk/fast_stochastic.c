/* fast_stochastic.c - the fast remembering stochastic walk [Kolingerova 2006; thesis App. E, sec.
 * 5.3].
 *
 *          c
 *         / `
 *        /   `    * q
 *       a-----b
 *          ^
 *
 * A walk that has entered a tile over ab, far from q, leaves over bc or ca. So it tests one of the
 * two, chosen at random: if q does not lie beyond it, q very likely lies beyond the other one,
 * which is crossed without a test. In the first tile any edge is tested, and if q does not lie
 * beyond it, one of the other two is crossed. A tile takes one test, but no step notices that it
 * has arrived: near q the walk circles round it. Therefore it ends after k steps. Then the
 * remembering stochastic walk goes on, or on a Delaunay mesh the remembering walk, unless the
 * caller has chosen. It tests all edges of its first tile, because q may lie beyond an edge that
 * was crossed without a test. The paper takes k from experiments with the number of vertices; here
 * it is given, or estimated from the distance for each query (mw__query_begin). A hull edge crossed
 * without a test does not mean that q is outside: then the final location goes on. Ends after k
 * steps. */
#include "walk/drive.h"
#include "walk/stochastic.h"

static MW_INLINE mw_verdict fast_stochastic_step(mw_walk *w, mw_policy P)
{
    if (MW_UNLIKELY(w->steps == 0)) return MW_VERDICT_UNSURE;
    w->steps--;
    uint64_t coin = mw__toss(&w->random);
    bool first = w->e == MW_NO_EDGE;
    uint32_t tested = first ? any_edge(coin) : either_edge(coin, w->e);
    uint32_t other = first ? either_edge(coin, tested) : third_edge(w->e, tested);
    return beyond(w, tested, P) ? cross(w, tested, P) : cross_unsure(w, other, P);
}

MW_STAMP_WALK(fast_stochastic, false)
