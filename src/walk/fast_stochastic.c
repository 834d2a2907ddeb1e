/* fast_stochastic.c - the fast remembering stochastic walk [Kolingerova 2006; thesis App. E, sec.
 * 5.3].
 *
 *          c
 *         / `
 *        /   `    * q
 *       a-----b
 *          ^
 *
 * Entered over ab, far from q, the walk has to leave over bc or ca. So it tests one of the two,
 * chosen by a coin: q lies beyond it, or else, very likely, beyond the other, which is crossed
 * without a test. In the first tile any edge is tested, and if q does not lie beyond it, one of the
 * other two is crossed.
 * One test a tile, but no step notices that it has arrived: near q the walk goes round it.
 * Therefore it makes k steps and ends; the remembering stochastic walk goes on, or on a Delaunay
 * mesh the remembering walk: the one that the caller chose to finish walks, or the mesh. It begins
 * without an edge that it came by, because q may lie beyond one that was crossed without a test.
 * The paper takes k from experiments with the number of vertices; here it is given, or estimated
 * from the distance for each query (mw__query_begin).
 * A hull edge crossed without a test does not mean that q is outside: then the final location goes
 * on. Ends after k steps. */
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
