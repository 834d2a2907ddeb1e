/* centre.c - the tile in the middle [thesis App. E, sec. 4.1]. */
#include "start/start.h"
#include "walk/walk.h"

uint32_t mw__start_centre(const mw_tiling *tiling, const double low[2], const double high[2])
{
    mw_point middle = {low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2};
    mw_walk walk = mw__walk_begin(tiling, middle, 0, mw__walk_fuel(MW_WALK_CELESTIAL, MW_EXACT, tiling), 0, NULL);
    mw__celestial.run[true][false](&walk);
    return walk.t;
}
