/* random_tile.c - a random first tile [thesis App. E, sec. 4.1]. */
#include "base/random.h"
#include "start/start.h"

uint32_t mw__start_random(const mw_tiling *tiling, uint64_t *random)
{
    return mw__random_below(random, tiling->tri_count);
}
