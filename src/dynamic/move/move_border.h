/* move_border.h - a vertex with fixed edges leaves its star, and takes its triangles along.
 * Private. */
#ifndef MW_SRC_DYNAMIC_MOVE_MOVE_BORDER_H
#define MW_SRC_DYNAMIC_MOVE_MOVE_BORDER_H

#include "dynamic/vertex_star.h"

/* Move v, whose star was collected last, to q. Call it when none of the triangles at v turns over,
 * but ghosts there do, or when the hull would not stay convex. `t`: the tile where the search for q
 * begins. MW_ERROR_INPUT: a triangle would cover others; the error tells which edge would be
 * crossed, or what is in the way. Also MW_ERROR_MEMORY and MW_ERROR_LIMIT. */
mw_status mw__border_move(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, uint32_t v,
                          mw_point q, uint32_t t, mw_error *error);

#endif
