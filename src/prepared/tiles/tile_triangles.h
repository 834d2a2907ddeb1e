/* tile_triangles.h - which triangles stand in which file of a mesh in tiles. Private.
 *
 * Each triangle with an area is in one tile. Flat triangles are in every tile that touches them,
 * themselves or by other flat ones: without one of them, a vertex would lie inside an edge. */
#ifndef MW_SRC_PREPARED_TILES_TILE_TRIANGLES_H
#define MW_SRC_PREPARED_TILES_TILE_TRIANGLES_H

#include "prepared/tiles/tile_cuts.h"

typedef struct mw_tile_triangles {
    const mw_mesh *mesh;
    mw_tile_cuts cuts;
    uint32_t *flat; /* triangles without area */
    uint32_t flat_count;
    uint32_t *group;  /* per vertex of a flat triangle another of its group, or itself; MW_NONE */
    uint32_t *met;    /* per vertex: the last tile + 1 that met the group that it stands for */
    uint32_t *chosen; /* the triangles of the file that was asked for last, ascending */
    size_t chosen_count;
} mw_tile_triangles;

/* Divide the triangles of a mesh into tiles. MW_ERROR_INPUT if fewer triangles have an area;
 * MW_ERROR_MEMORY. Release in either case. */
mw_status mw__tile_triangles_create(mw_tile_triangles *all, const mw_mesh *mesh, uint32_t tiles,
                                    mw_error *error);
void mw__tile_triangles_release(mw_tile_triangles *all);

/* Choose the triangles of a tile. */
void mw__tile_triangles_of_tile(mw_tile_triangles *all, uint32_t tile);
/* Choose the triangles of the overview: those with a vertex of the border or of a flat triangle.
 * False when out of memory. */
bool mw__tile_triangles_of_overview(mw_tile_triangles *all);

#endif
