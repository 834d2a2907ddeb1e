/* holes.c - where the holes of a mesh are. */
#include "locate/locator.h"

/* Note edge k of a tile for the hole beyond it, if there is one. */
static void hole_look_along(const mw_locator *locator, const mw_triangle *tile, uint32_t k,
                            mw_hole_edge *edges)
{
    const mw_tiling *tiling = &locator->tiling;
    if (tile->link[k] == MW_NONE) return;
    const uint32_t mark = tiling->tri[mw__link_triangle(tile->link[k])].user;
    if (!(mark & MW_GHOST) || (mark & MW_USER_MASK) == MW_POCKET) return;
    mw_hole_edge *lowest = &edges[mark & MW_USER_MASK];
    const mw_hole_edge found = {tile->user & MW_USER_MASK,
                                mw__border_edge_of_user(locator->mesh, tiling, tile, k)};
    if (found.triangle < lowest->triangle ||
        (found.triangle == lowest->triangle && found.edge < lowest->edge))
        *lowest = found;
}

mw_status mw_locator_holes(const mw_locator *locator, mw_hole_edge *edges, mw_error *error)
{
    if (!locator || (locator->tiling.hole_count && !edges))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the locator or the edges are NULL");
    const mw_tiling *tiling = &locator->tiling;
    if (tiling->border_loops || tiling->tile_of)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "this needs a locator that fills pockets and holes and was not edited");
    for (uint32_t i = 0; i < tiling->hole_count; i++) edges[i] = (mw_hole_edge){MW_NONE, MW_NONE};
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 3 && !(tiling->tri[t].user & MW_GHOST); k++)
            hole_look_along(locator, &tiling->tri[t], k, edges);
    return MW_OK;
}
