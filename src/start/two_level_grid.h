/* two_level_grid.h - a grid of buckets whose crowded cells have a grid of their own. Private. */
#ifndef MW_SRC_START_TWO_LEVEL_GRID_H
#define MW_SRC_START_TWO_LEVEL_GRID_H

#include "start/lattice.h"

/* The grid of a crowded cell: over the extent of the vertices there, which may be a small part of
 * the cell. */
typedef struct mw_fine_grid {
    mw_lattice lattice;
    uint32_t first; /* of its cells */
} mw_fine_grid;

#define MW_FINE (UINT32_C(1) << 31)

typedef struct mw_two_level_grid {
    mw_lattice lattice;
    /* of each cell: the name of a tile, as in mw_grid; or MW_FINE and the number of its fine
     * grid */
    uint32_t *coarse;
    mw_fine_grid *grid;
    uint32_t *fine; /* the cells of the fine grids: the name of a tile each */
    uint32_t grid_count, fine_count;
} mw_two_level_grid;

/* About `cells` coarse cells (0: by the number of vertices, at most MW_MAX_CELLS) over low..high,
 * the extent of the tiling. Stages of the present part of the job. Returns false when out of
 * memory, or cancelled. */
bool mw__two_level_grid_create(mw_two_level_grid *grid, const mw_tiling *tiling,
                               const double low[2], const double high[2], uint32_t cells,
                               mw_job *job);
/* See mw__lattice_put. */
void mw__two_level_grid_put(mw_two_level_grid *grid, const mw_cell_entry *e);
/* Does p lie in a cell of its own level, and not beyond the outermost cells of a grid? */
bool mw__two_level_grid_covers(const mw_two_level_grid *grid, mw_point p);
void mw__two_level_grid_release(mw_two_level_grid *grid);
size_t mw__two_level_grid_bytes(const mw_two_level_grid *grid);

static MW_INLINE uint32_t mw__two_level_grid_first(const mw_two_level_grid *grid, mw_point q)
{
    uint32_t entry = grid->coarse[mw__lattice_cell(&grid->lattice, q)];
    if (!(entry & MW_FINE)) return entry;
    const mw_fine_grid *fine = &grid->grid[entry - MW_FINE];
    return grid->fine[fine->first + mw__lattice_cell(&fine->lattice, q)];
}

#endif
