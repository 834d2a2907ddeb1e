/* remembering_corners.c - what takes over where the remembering walk of the corners does not
 * end. */
#include "walk/remembering_corners.h"

mw_walk_end mw__corners_surely(const mw_tiling *tiling, mw_point q, uint32_t t,
                               mw_lifted_vertex corner[3])
{
    mw_walk walk = mw__walk_begin(tiling, q, t, 0, 0, NULL);
    bool inside = mw__walk_surely(&walk, false) == MW_VERDICT_FOUND;
    mw_walk_end at = {.tile = walk.t, .walked = MW_CORNER_STEPS, .inside = inside};
    for (uint32_t k = 0; k < 3; k++)
        corner[k] = mw__lift_vertex(tiling, tiling->tri[at.tile].v[k], q);
    for (uint32_t k = 0; k < 3; k++)
        at.on_boundary |= mw__lifted_side(tiling, &corner[k], &corner[mw__next(k)], q) == 0;
    return at;
}
