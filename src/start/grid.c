/* grid.c - a uniform grid of buckets [Su, Drysdale 1997; thesis App. E, sec. 4.1].
 *
 * A cell holds one of the vertices in it at most, as a tile that has it; a query begins there. Where its cell has none,
 * Su and Drysdale search the rings of cells round it, in a spiral, for every query. The grid of a mesh that does not
 * change can do that once for all cells, in linear time and without a byte more: the first tile is the same, up to the
 * choice within a ring, and the cost of a query is bounded where most of the extent is empty. With 10^5 (10^6) points in
 * 32 clusters, 99.8 % (99.9 %) of the cells empty, a spiral for each query takes 1.6 (16) microseconds, an entry that is
 * there 3 (10) ns; with uniform points, 13 % empty, 6 (10) ns against 3 (7).
 *
 * Number of cells: with more of them walks are shorter, but time hardly is. Uniform points, the remembering walk, one
 * thread, cells per vertex (triangles visited per query; ns in a batch of 10^5 and of 10^6 points):
 *     1/4  3.86  253  314        1/2  3.51  245  341        1  3.35  243  348        2  3.15  245  335
 * and queries one at a time 480 and 920 ns for all of these, within the noise. So one cell for two vertices: 2 bytes a
 * vertex. */
#include "start/grid.h"

#include "start/start.h"

#include <stdlib.h>

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
