/* long_walks.c - walks that get long.
 *
 * A walk from the locator's guide, from the tile of the query before or from a hint gets
 * MW_SHORT_WALK steps, after as many of the fast path. Then chains end it: those of the guide,
 * those of the few tiles that the guide leads far to (guide_walks.c), or those that were made late
 * for all tiles (late_chains.c). Where none of them knows its tile, it goes on and pays for late
 * chains. */
#include "locate/long_walks.h"

bool mw__query_is_guided(const mw_locator *locator, const mw_cursor *cursor)
{
    const mw_index *guide = &locator->guide;
    bool chained = cursor->start == MW_START_SORTED || cursor->start == MW_START_LAST;
    return cursor->index ? cursor->index == guide
                         : cursor->start == MW_START_AUTO || (chained && guide->sort_batches);
}

static uint32_t long_walk_fuel(const mw_locator *locator, const mw_cursor *cursor,
                               mw_walk_kind kind)
{
    return mw__walk_fuel(kind, (mw_arithmetic)cursor->arithmetic, &locator->tiling);
}

/* May chains end walks of this locator, now or later? */
static bool walks_have_limit(const mw_locator *locator)
{
    return locator->guide.start == MW_START_CHAINS || locator->fallback.start == MW_START_CHAINS ||
           locator->late;
}

uint32_t mw__query_fuel(const mw_locator *locator, const mw_cursor *cursor)
{
    uint32_t fuel = long_walk_fuel(locator, cursor, (mw_walk_kind)cursor->walk);
    return fuel > MW_SHORT_WALK && walks_have_limit(locator) && mw__query_is_guided(locator, cursor)
               ? MW_SHORT_WALK
               : fuel;
}

/* In exact arithmetic. */
static bool tile_has(const mw_tiling *tiling, uint32_t t, mw_point q)
{
    const uint32_t *v = tiling->tri[t].v;
    const mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    return mw__orient2d(a, b, q) >= 0 && mw__orient2d(b, c, q) >= 0 && mw__orient2d(c, a, q) >= 0;
}

/* Does q lie beyond a hull edge of tile t? */
static bool tile_has_beyond(const mw_tiling *tiling, uint32_t t, mw_point q)
{
    const mw_triangle *tile = &tiling->tri[t];
    for (uint32_t k = 0; k < 3; k++)
        if (tile->link[k] == MW_NONE &&
            mw__orient2d(tiling->point[tile->v[k]], tiling->point[tile->v[k + 1]], q) < 0)
            return true;
    return false;
}

/* The chains that end a walk now, NULL if there are none. Those of the fallback know few tiles
 * only. */
static const mw_chains *long_walk_chains(const mw_locator *locator)
{
    const mw_chains *late = mw__late_chains_ready(locator->late);
    if (locator->guide.start == MW_START_CHAINS) return &locator->guide.chains;
    if (late) return late;
    return locator->fallback.start == MW_START_CHAINS ? &locator->fallback.chains : NULL;
}

/* The tile that chains name; MW_NONE if they do not know it. */
static uint32_t tile_by_chains(const mw_locator *locator, const mw_cursor *cursor,
                               const mw_walk *walk)
{
    const mw_tiling *tiling = &locator->tiling;
    const mw_chains *chains = long_walk_chains(locator);
    if (!chains || (cursor->count && walk->work->trace)) return MW_NONE;
    const uint32_t t = mw__tile_of_name(tiling, mw__chains_first(chains, walk->q));
    if (cursor->count) mw__chains_count(chains, walk->q, walk->work);
    return chains == &locator->fallback.chains && !tile_has(tiling, t, walk->q) ? MW_NONE : t;
}

/* Go on to the end. Returns in *steps how many that took. */
static mw_verdict long_walk_run(const mw_locator *locator, const mw_cursor *cursor,
                                mw_walk_kind kind, mw_walk *walk, uint64_t *steps)
{
    const mw_tiling *tiling = &locator->tiling;
    const mw_walk_kind finish = (mw_walk_kind)cursor->finish;
    const bool exact = cursor->arithmetic == MW_EXACT;
    uint32_t fuel = walk->fuel = long_walk_fuel(locator, cursor, kind);
    mw_verdict verdict = mw__walk_run(walk, mw__walk_kernels(kind, tiling), exact, cursor->count);
    *steps = fuel - walk->fuel;
    if (verdict != MW_VERDICT_UNSURE) return verdict;
    fuel = long_walk_fuel(locator, cursor, finish);
    verdict = mw__walk_finish(walk, finish, fuel, tiling, exact, cursor->count);
    *steps += fuel - walk->fuel;
    return verdict;
}

/* Go on from the tile that chains have named: it has q, or q lies outside beyond an edge of it. */
static mw_verdict long_walk_jump(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                                 mw_walk *walk)
{
    const mw_tiling *tiling = &locator->tiling;
    uint64_t steps;
    *walk = mw__walk_begin(tiling, walk->q, t, 0, walk->random, cursor->count ? walk->work : NULL);
    if (tile_has_beyond(tiling, t, walk->q)) return MW_VERDICT_LEFT;
    return long_walk_run(locator, cursor, (mw_walk_kind)cursor->walk, walk, &steps);
}

mw_verdict mw__long_walk_end(const mw_locator *locator, const mw_cursor *cursor, mw_walk_kind kind,
                             mw_walk *walk)
{
    const uint32_t t = tile_by_chains(locator, cursor, walk);
    if (t != MW_NONE) return long_walk_jump(locator, cursor, t, walk);
    uint64_t steps;
    mw_verdict verdict = long_walk_run(locator, cursor, kind, walk, &steps);
    /* another walk will end it, over all tiles at most */
    if (verdict == MW_VERDICT_OUT_OF_FUEL) steps += locator->tiling.tri_count;
    if (!(cursor->count && walk->work->trace))
        mw__late_chains_owe(locator->late, &locator->tiling, steps);
    return verdict;
}
