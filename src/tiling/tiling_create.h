/* tiling_create.h - makes the tiling of a mesh. Private. */
#ifndef MW_SRC_TILING_TILING_CREATE_H
#define MW_SRC_TILING_TILING_CREATE_H

#include "tiling/tiling.h"

/* Tile the hull of `mesh`, which must outlive the tiling. If the mesh is no embedding: with `any`,
 * see mw_tiling.embedding; else MW_ERROR_INPUT, naming the first defect. A mesh without a triangle
 * with an area has no tiles. MW_ERROR_MEMORY, MW_ERROR_LIMIT. */
mw_status mw__tiling_create(const mw_mesh *mesh, bool any, mw_tiling *tiling, mw_error *error);

/* The same by several threads (0: OpenMP's choice), or without ghosts; then mw__tiling_finish must
 * follow. The latter makes no difference if the mesh fills its hull. */
typedef struct mw_tiling_options {
    bool any, without_ghosts;
    uint32_t threads;
} mw_tiling_options;
mw_status mw__tiling_create_with(const mw_mesh *mesh, mw_tiling_options options, mw_tiling *tiling, mw_error *error);
/* Find the border loops and components of a tiling without ghosts. MW_ERROR_MEMORY. */
mw_status mw__tiling_finish(mw_tiling *tiling, mw_error *error);
void mw__tiling_release(mw_tiling *tiling);

#endif
