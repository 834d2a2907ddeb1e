/* grid.c - a uniform grid of buckets [Su, Drysdale 1997]. */
#include "start/grid.h"

#include <stdlib.h>

bool mw__grid_create(mw_grid *grid, const mw_tiling *tiling, const double low[2], const double high[2], uint32_t cells)
{
    grid->lattice = mw__lattice(low, high, cells ? cells : mw__vertex_estimate(tiling));
    cells = mw__lattice_cells(&grid->lattice);
    grid->tile = mw__alloc(cells, sizeof *grid->tile);
    uint32_t *queue = mw__alloc(cells, sizeof *queue), *tile = mw__tile_of_vertices(tiling);
    bool done = grid->tile && queue && tile;
    if (done) {
        for (uint32_t c = 0; c < cells; c++) grid->tile[c] = MW_NONE;
        for (uint32_t v = 0; v < tiling->point_count; v++)
            if (tile[v] != MW_NONE) grid->tile[mw__lattice_cell(&grid->lattice, tiling->point[v])] = tile[v];
        mw__lattice_fill(&grid->lattice, grid->tile, queue);
    }
    free(queue);
    free(tile);
    return done;
}

void mw__grid_release(mw_grid *grid)
{
    free(grid->tile);
}

size_t mw__grid_bytes(const mw_grid *grid)
{
    return mw__lattice_cells(&grid->lattice) * sizeof *grid->tile;
}
