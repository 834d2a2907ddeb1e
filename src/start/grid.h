/* grid.h - a uniform grid of buckets. Private. */
#ifndef MW_SRC_GRID_H
#define MW_SRC_GRID_H

#include "start/lattice.h"

typedef struct mw_grid {
    mw_lattice lattice;
    uint32_t *tile; /* of each cell: the name of the one that holds its middle, or near it */
} mw_grid;

/* About `cells` cells (0: by the number of vertices, at most MW_MAX_CELLS) over low..high, the extent of the tiling. Of the
 * tiles every stride-th is looked at: more make walks shorter. *even, unless NULL: a quarter of the cells have one
 * of these; if not, the vertices are too crowded for a grid, and it is left unfinished. Returns false when out of memory. */
bool mw__grid_create(mw_grid *grid, const mw_tiling *tiling, const double low[2], const double high[2], uint32_t cells,
                     uint32_t stride, bool *even);
void mw__grid_release(mw_grid *grid);
size_t mw__grid_bytes(const mw_grid *grid);

static MW_INLINE uint32_t mw__grid_first(const mw_grid *grid, mw_point q)
{
    return grid->tile[mw__lattice_cell(&grid->lattice, q)];
}

#endif
