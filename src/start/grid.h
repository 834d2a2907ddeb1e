/* grid.h - a uniform grid of buckets. Private. */
#ifndef MW_SRC_START_GRID_H
#define MW_SRC_START_GRID_H

#include "start/lattice.h"

typedef struct mw_grid {
    mw_lattice lattice;
    uint32_t *tile; /* of each cell: the name of the one that holds its middle, or near it */
    /* of each cell: the vertices of that tile, to ask memory for them; NULL: not kept */
    uint32_t (*corner)[3];
} mw_grid;

/* About `cells` cells (0: by the number of vertices, at most MW_MAX_CELLS) over low..high, the
 * extent of the tiling. Stages of the present part of the job. Returns false when out of memory, or
 * cancelled; the grid may be released in either case. */
bool mw__grid_create(mw_grid *grid, const mw_tiling *tiling, const double low[2],
                     const double high[2], uint32_t cells, mw_job *job);

/* What is known of a cell while its grid is built. */
typedef struct mw_grid_site {
    /* how far the middle of its tile is off its own, in widths of a cell, squared; infinite: it
     * has none */
    float off;
    uint32_t tile;
    uint32_t
        /* tiles in it, of those that were looked at */
        count;
} mw_grid_site;

/* The same in two steps, so that between them the choice can be made by what was seen. Of the tiles
 * every stride-th is looked at: more make walks shorter. */
typedef struct mw_grid_plan {
    const mw_tiling *tiling;
    uint32_t stride;
    mw_job *job;
    mw_grid_site *site; /* of each cell; released by mw__grid_end, or with free() */
    uint32_t taken;     /* cells that have a tile that was looked at              */
    bool crowded;       /* a quarter of the tiles lies in cells with very many    */
} mw_grid_plan;

/* Each is a stage that takes 0.4 of the present part. Returns false when out of memory, or
 * cancelled. */
bool mw__grid_begin(mw_grid *grid, mw_grid_plan *plan, const double low[2], const double high[2],
                    uint32_t cells);
/* With `sparse` crowded cells are left without a tile: MW_NONE. */
bool mw__grid_end(mw_grid *grid, mw_grid_plan *plan, bool sparse);
/* Cut each cell of a finished grid into four. A new cell that has none of every stride-th tile gets
 * the tile of the old cell, which takes no walk. The grid stays as it was if memory is short or if
 * cells would be too small for doubles. While this runs it takes 16 more bytes a cell. */
void mw__grid_refine(mw_grid *grid, const mw_tiling *tiling, uint32_t stride, mw_job *job);
/* Keep the corners of each cell's tile. The tiling is not edited. False when out of memory. */
bool mw__grid_keep_corners(mw_grid *grid, const mw_tiling *tiling);
void mw__grid_release(mw_grid *grid);
size_t mw__grid_bytes(const mw_grid *grid);

static MW_INLINE uint32_t mw__grid_first(const mw_grid *grid, mw_point q)
{
    return grid->tile[mw__lattice_cell(&grid->lattice, q)];
}

#endif
