/* loop_edges.h - the border edges, each with the next one of its loop. Private. */
#ifndef MW_SRC_TILING_LOOP_EDGES_H
#define MW_SRC_TILING_LOOP_EDGES_H

#include "tiling/embedding_check.h"
#include "tiling/tiling.h"

/* The *count border edges of the tiling without ghosts that belongs to a checked mesh. Release with
 * free(). NULL when out of memory. */
mw_loop_edge *mw__loop_edges_create(const mw_embedding_check *check, const mw_tiling *tiling,
                                    uint32_t *count);

#endif
