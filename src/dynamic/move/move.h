/* move.h - moves of a vertex. Private. */
#ifndef MW_SRC_DYNAMIC_MOVE_MOVE_H
#define MW_SRC_DYNAMIC_MOVE_MOVE_H

#include "dynamic/dynamic_tiling.h"

/* `t`: the tile where the search for q begins if the vertex leaves its star. MW_NONE: at its
 * star. */
mw_status mw__dynamic_move(mw_dynamic_tiling *dynamic, uint32_t vertex, mw_point q, uint32_t t,
                           mw_error *error);

#endif
