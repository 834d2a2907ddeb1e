/* overlap_tile.h - a tile as a part of one of the user's triangles: its place, and the values of a
 * field at its corners. Private. */
#ifndef MW_SRC_OVERLAP_OVERLAP_TILE_H
#define MW_SRC_OVERLAP_OVERLAP_TILE_H

#include "locate/locator.h"

typedef struct mw_overlap_tile {
    mw_point p[3];      /* corners, counter-clockwise */
    uint32_t vertex[3]; /* their numbers */
    double value[3];
    bool there;  /* it is no ghost, and its triangle has a finite value at each vertex */
    double area; /* 0 if it is not there */
} mw_overlap_tile;

/* Tile t with values of the user's vertices, one for each; NULL: no values, 0. Vertices at one
 * place may have different values: those of the user's own triangle count. Where that is cut into
 * tiles, a tile may have a corner that its triangle has not, whose value is between those of
 * others. */
mw_overlap_tile mw__overlap_tile(const mw_locator *locator, uint32_t t, const double *values);

/* MW_ERROR_ARGUMENT unless the tiles of this locator are those of an embedding and fill its hull;
 * MW_ERROR_LIMIT if coordinates are so large that areas could overflow. */
mw_status mw__overlap_check_locator(const mw_locator *locator, mw_error *error);

#endif
