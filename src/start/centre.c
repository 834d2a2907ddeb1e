/* centre.c - the tile in the middle [thesis App. E, sec. 4.1]. */
#include "start/start.h"
#include "walk/walk.h"

uint32_t mw__start_centre(const mw_tiling *tiling, const double low[2], const double high[2])
{
    mw_point middle = {low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2};
    mw_walk walk = mw__walk_begin(tiling, middle, 0, 0, 0, NULL);
    mw__walk_surely(&walk, false);
    return walk.t;
}
