/* open.h - what a walk along borders has to know of tiles that do not fill their hull. Private.
 *
 * Border edges follow each other round the part of the plane beyond them: at a vertex where several fans of tiles meet, the
 * way goes on with the fan that the outside comes to next, so that it never leaves the hole or pocket it runs round. Tiles that
 * hang together, be it by a vertex, are a piece; what a piece leaves of the plane are faces, each bounded by one loop of
 * such edges. */
#ifndef MW_SRC_OPEN_H
#define MW_SRC_OPEN_H

#include "domain/boxes.h"

/* An edge of the border, 4 * tile + edge. */
typedef struct mw_rim_edge {
    uint32_t half;
    uint32_t next; /* the one that follows                             */
    uint32_t hole; /* beyond it: its number, or MW_POCKET              */
} mw_rim_edge;

/* Where the edge after `from` is not found by turning round its end through tiles: it is `to`. */
typedef struct mw_turn {
    uint32_t from, to;
} mw_turn;

/* A loop round a bounded face: its lowest edge, and the hole along it. */
typedef struct mw_hole_loop {
    uint32_t lowest, hole;
} mw_hole_loop;

typedef struct mw_part {
    mw_box box;
    uint32_t first; /* a tile of it */
} mw_part;

typedef struct mw_open {
    mw_turn *turn;      /* by `from`   */
    mw_hole_loop *loop; /* by `lowest` */
    mw_part *piece;     /* small before large ones, those near each other together */
    uint32_t *piece_of; /* per vertex its piece; NULL where there is one           */
    mw_boxes boxes;     /* of the pieces */
    uint32_t edge_count, turn_count, loop_count, piece_count; /* edge_count: of the border */
} mw_open;

void mw__open_release(mw_open *open);
size_t mw__open_bytes(const mw_open *open, uint32_t vertex_count); /* of its tiling */

/* The hole along the loop whose lowest edge this is; MW_NONE if the loop bounds nothing. */
uint32_t mw__open_hole(const mw_open *open, uint32_t lowest);

/* The edge that follows border edge `half` where turning round its end would not find it, else MW_NONE. */
uint32_t mw__open_turn(const mw_open *open, uint32_t half);

#endif
