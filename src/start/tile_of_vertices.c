/* tile_of_vertices.c - from the vertices to the tiles: what grids and layers are made of. */
#include "start/start.h"

uint32_t *mw__tile_of_vertices(const mw_tiling *tiling)
{
    uint32_t *tile = mw__alloc(tiling->point_count, sizeof *tile);
    if (!tile) return NULL;
    for (uint32_t v = 0; v < tiling->point_count; v++) {
        bool known = tiling->tile_at && tiling->tile_at[v] != MW_NONE;
        tile[v] = known ? mw__lowest_around_vertex(tiling, tiling->tile_at[v], v) : MW_NONE;
    }
    if (tiling->tile_at) return tile;
    for (uint32_t t = tiling->tri_count; t-- > 0;)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = tiling->tri[t].v[k];
            if (mw__is_finite(tiling->point[v])) tile[v] = t;
        }
    return tile;
}
