/* grid.c - a uniform grid of buckets [Su, Drysdale 1997; thesis App. E, sec. 4.1].
 *
 * A cell of Su and Drysdale holds one of the vertices in it at most, as a tile that has it; a query begins there, and where
 * its cell has none they search the rings of cells round it, in a spiral, for every query. Here a cell holds the tile whose
 * middle is the nearest to its own, so that queries in it visit 2.3 tiles instead of 3.5 (uniform points); and the cells
 * without one are filled once, in linear time: a spiral search from all others, then a walk to their middle. So the cost of
 * a query is bounded where most of the extent is empty. To walk to the middle of every cell makes it 2.2 tiles, and
 * building 2.7 times as long.
 *
 * Beyond the extent is a rim of cells that hold no middle of a tile. The walk to the middle of one ends at an edge of the hull that parts
 * it from the mesh. To the right of the extent no such edge faces left, so it parts all that lies farther to the right, too; and likewise on the other
 * sides. So nearly every query outside ends in its first tile. Without the rim it walked there from within, over 7 to 12
 * tiles that are ever longer: 112 and 147 ns (10^4 and 10^6 uniform points, in batches) instead of 46.
 *
 * Number of cells: with more of them walks are shorter, but time hardly is, since the grid itself has to come from memory. 10^6
 * uniform points, one thread, ns per query, cells per vertex:
 *     1/8  alone 519, in a batch 82        1/2  alone 453, in a batch 69        1  alone 430, in a batch 63
 * So one cell for two vertices: 2 bytes a vertex. */
#include "start/grid.h"

#include "start/start.h"
#include "walk/walk.h"

#include <stdlib.h>

/* Of every few tiles, put the one nearest to the middle of a cell into it. Returns how many cells got one. */
static uint32_t put_some(mw_grid *grid, const mw_tiling *tiling, uint32_t stride, float *distance)
{
    uint32_t taken = 0;
    for (uint64_t t = 0; t < tiling->tri_count; t += stride) {
        float off;
        uint32_t cell = mw__lattice_cell_off(&grid->lattice, mw__tile_middle(tiling, (uint32_t)t), &off);
        if (!(off < distance[cell])) continue;
        taken += grid->tile[cell] == MW_NONE;
        grid->tile[cell] = (uint32_t)t;
        distance[cell] = off;
    }
    return taken;
}

/* Give the cells that have none the tile at their middle: walk there from a cell near by; where that takes long, as far as
 * the fuel goes. */
static bool fill_gaps(mw_grid *grid, const mw_tiling *tiling, const float *distance)
{
    enum { FUEL = 256 };
    uint32_t cells = mw__lattice_cells(&grid->lattice), *queue = mw__alloc_lines(cells, sizeof *queue);
    if (!queue) return false;
    mw__lattice_fill(&grid->lattice, grid->tile, queue);
    free(queue);
    for (uint32_t c = 0; c < cells; c++) {
        if (distance[c] < INFINITY) continue;
        mw_point middle = mw__lattice_middle(&grid->lattice, c);
        if (!isfinite(middle.x) || !isfinite(middle.y)) continue;
        mw_walk walk = mw__walk_begin(tiling, middle, grid->tile[c], FUEL, 0, NULL);
        (void)mw__remembering.run[true][false](&walk);
        grid->tile[c] = walk.t;
    }
    for (uint32_t c = 0; c < cells && tiling->tile_of; c++) grid->tile[c] = mw__tile_name(tiling, grid->tile[c]);
    return true;
}

bool mw__grid_create(mw_grid *grid, const mw_tiling *tiling, const double low[2], const double high[2], uint32_t cells,
                     uint32_t stride, bool *even)
{
    if (cells == 0) cells = mw__lattice_choose(tiling);
    grid->lattice = mw__lattice_of(tiling, low, high, cells);
    uint32_t count = mw__lattice_cells(&grid->lattice);
    grid->tile = mw__alloc_lines(count, sizeof *grid->tile);
    float *distance = mw__alloc_lines(count, sizeof *distance);
    bool done = grid->tile && distance;
    for (uint32_t c = 0; c < count && done; c++) {
        grid->tile[c] = MW_NONE;
        distance[c] = INFINITY;
    }
    bool crowded = done && put_some(grid, tiling, stride, distance) < cells / 4;
    if (even) *even = !crowded;
    done = done && ((even && crowded) || fill_gaps(grid, tiling, distance));
    free(distance);
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
