/* late_chains.c - chains for all tiles, made when long walks have cost as much as making them. */
#include "locate/late_chains.h"

#include <stdlib.h>

/* To make chains took 80 to 330 ns a tile, a step of a long walk 5 to 20 ns in cache and 50 to 90
 * beyond it: 4 to 18 steps a tile (10^3 to 10^6 vertices, uniform or in a strip whose steps shrink
 * by 2^30). With as many steps as that before, all walks together take at most about twice the time
 * that they would take if one knew which mesh needs chains. */
enum { STEPS_PER_TILE = 16 };

mw_late_chains *mw__late_chains_create(void)
{
    return mw__calloc(1, sizeof(mw_late_chains));
}

void mw__late_chains_destroy(mw_late_chains *late)
{
    if (!late) return;
    mw__chains_release(&late->made);
    free(late);
}

static void late_chains_make(mw_late_chains *late, const mw_tiling *tiling)
{
    mw_chains *made = &late->made;
    if (mw__chains_create(made, tiling, MW_ALONE) && made->tiles > 0) {
        atomic_store_explicit(&late->ready, made, memory_order_release);
        return;
    }
    mw__chains_release(made);
    *made = (mw_chains){0};
}

void mw__late_chains_owe(mw_late_chains *late, const mw_tiling *tiling, uint64_t tiles)
{
    if (!late) return;
    const uint64_t most = (uint64_t)STEPS_PER_TILE * tiling->tri_count,
                   before = atomic_fetch_add_explicit(&late->owed, tiles, memory_order_relaxed);
    /* of all threads, only one takes the sum over the limit */
    if (before <= most && tiles > most - before) late_chains_make(late, tiling);
}

size_t mw__late_chains_bytes(const mw_late_chains *late)
{
    const mw_chains *ready = mw__late_chains_ready(late);
    return ready ? mw__chains_bytes(ready) : 0;
}
