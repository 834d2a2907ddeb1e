/* channel.h - force an edge between two vertices into the tiling, through the tiles in its way.
 * Private. */
#ifndef MW_SRC_DYNAMIC_CHANNEL_H
#define MW_SRC_DYNAMIC_CHANNEL_H

#include "dynamic/dynamic_tiling.h"

typedef struct mw_forced_edge {
    uint32_t half;    /* the edge, as a half-edge of a tile beside it; MW_NONE if blocked  */
    uint32_t end;     /* its other end: the vertex asked for, or the first one on the way  */
    uint32_t blocked; /* the fixed edge in the way; MW_NONE if there is none               */
} mw_forced_edge;

/* Make an edge from the vertex where the half-edge `begin` begins, straight towards `to`, up to the
 * first vertex on the way. Pushes edges between new tiles for mw__legalise. Changes nothing if a
 * fixed edge is in the way. False when out of memory. */
bool mw__edge_force(mw_dynamic_tiling *dynamic, uint32_t begin, uint32_t to,
                    mw_forced_edge *forced);

#endif
