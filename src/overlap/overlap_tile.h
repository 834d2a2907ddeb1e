/* overlap_tile.h - a tile as a part of one of the user's triangles: its place, and the values of a
 * field at its corners. Private. */
#ifndef MW_SRC_OVERLAP_OVERLAP_TILE_H
#define MW_SRC_OVERLAP_OVERLAP_TILE_H

#include "locate/locator.h"

typedef struct mw_overlap_tile {
    mw_point p[3];      /* corners, counter-clockwise */
    uint32_t vertex[3]; /* their numbers */
    double value[3];
    bool there;  /* it is not a ghost, and its triangle has a finite value at each vertex */
    double area; /* 0 if it is not there */
} mw_overlap_tile;

/* Tile t with the values of the user's vertices, one for each vertex; NULL: all values are 0.
 * Coincident vertices may have different values: those of the user's triangle are taken. If the
 * triangle is cut into tiles, a tile may have a corner that the triangle lacks; its value is
 * interpolated. */
mw_overlap_tile mw__overlap_tile(const mw_locator *locator, uint32_t t, const double *values);

/* Returns MW_ERROR_ARGUMENT unless the mesh is an embedding and its tiles fill the hull;
 * MW_ERROR_LIMIT if coordinates are so large that areas could overflow. */
mw_status mw__overlap_check_locator(const mw_locator *locator, mw_error *error);

#endif
