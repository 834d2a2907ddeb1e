/* grid.c - a uniform grid of buckets [Su, Drysdale 1997; thesis App. E, sec. 4.1].
 *
 * A cell of Su and Drysdale holds one of the vertices in it at most, as a tile that has it; a query begins there, and where
 * its cell has none they search the rings of cells round it, in a spiral, for every query. The grid of a mesh that does not
 * change can do that once for all cells, in linear time and without a byte more, so that the cost of a query is bounded where
 * most of the extent is empty. And it can walk on from there, once, to the middle of the cell: queries in the cell are nearer
 * to that tile, and visit 2.2 instead of 3.5 (uniform points). Building takes three times as long for it; a query 0.8 of the
 * time, alone or in a batch.
 *
 * Number of cells: with more of them walks are shorter, but time hardly is, since the grid itself has to come from memory. 10^6
 * uniform points, one thread, ns per query, cells per vertex:
 *     1/2  alone 451, in a batch 60        1  alone 466, in a batch 57        2  alone 526, in a batch 55
 * So one cell for two vertices: 2 bytes a vertex. */
#include "start/grid.h"

#include "start/start.h"
#include "walk/walk.h"

#include <stdlib.h>

/* Walk from the entry of each cell to its middle; where that takes long, as far as the fuel goes. */
static void centre(mw_grid *grid, const mw_tiling *tiling)
{
    enum { FUEL = 256 };
    uint32_t cells = mw__lattice_cells(&grid->lattice);
    for (uint32_t c = 0; c < cells; c++) {
        mw_point middle = mw__lattice_middle(&grid->lattice, c);
        mw_walk walk = mw__walk_begin(tiling, middle, grid->tile[c], FUEL, 0, NULL);
        (void)mw__remembering.run[true][false](&walk);
        grid->tile[c] = walk.t;
    }
}

bool mw__grid_create(mw_grid *grid, const mw_tiling *tiling, const double low[2], const double high[2], uint32_t cells)
{
    grid->lattice = mw__lattice(low, high, cells ? cells : mw__lattice_choose(tiling));
    cells = mw__lattice_cells(&grid->lattice);
    grid->tile = mw__alloc_lines(cells, sizeof *grid->tile);
    uint32_t *queue = mw__alloc(cells, sizeof *queue), *tile = mw__tile_of_vertices(tiling);
    bool done = grid->tile && queue && tile;
    if (done) {
        for (uint32_t c = 0; c < cells; c++) grid->tile[c] = MW_NONE;
        for (uint32_t v = 0; v < tiling->point_count; v++)
            if (tile[v] != MW_NONE) grid->tile[mw__lattice_cell(&grid->lattice, tiling->point[v])] = tile[v];
        mw__lattice_fill(&grid->lattice, grid->tile, queue);
        centre(grid, tiling);
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
