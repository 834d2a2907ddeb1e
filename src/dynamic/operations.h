/* operations.h - what an edit can do to a dynamic tiling; each operation has a file. Private.
 *
 * They return MW_ERROR_INPUT, MW_ERROR_LIMIT or MW_ERROR_MEMORY; the caller then rolls the edit
 * back. Vertices are slots. */
#ifndef MW_SRC_DYNAMIC_OPERATIONS_H
#define MW_SRC_DYNAMIC_OPERATIONS_H

#include "dynamic/vertex_star.h"

/* Insert a vertex at q. *vertex: MW_NONE for a new vertex, else the slot of a vertex that is in no
 * tile. Sets *vertex to the vertex at q, which may have been there before. `t`: the tile where the
 * search for q begins. If no edit is under way, none needs to be recorded; the insertion begins one
 * if it might fail after it has changed a tile. */
mw_status mw__dynamic_insert(mw_dynamic_tiling *dynamic, mw_point q, uint32_t t, uint32_t *vertex,
                             mw_error *error);
mw_status mw__dynamic_remove(mw_dynamic_tiling *dynamic, uint32_t vertex, mw_error *error);
/* Remove a vertex that has no fixed edges from the tiles, given its star, which was collected last.
 * The vertex keeps its slot and its number. */
mw_status mw__dynamic_take_out(mw_dynamic_tiling *dynamic, const mw_vertex_star *star, uint32_t v,
                               mw_error *error);
mw_status mw__dynamic_flip(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to, mw_error *error);
/* Constrain the segment between two vertices, or release its constraints. *constrained_edges: the
 * number of edges on the segment. */
mw_status mw__dynamic_constrain(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to,
                                bool release, uint32_t *constrained_edges, mw_error *error);
/* Flip edges that are not fixed until all are Delaunay. */
mw_status mw__dynamic_make_delaunay(mw_dynamic_tiling *dynamic, mw_error *error);

#endif
