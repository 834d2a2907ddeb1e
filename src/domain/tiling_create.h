/* tiling_create.h - the tiling that a mesh needs is made. Private. */
#ifndef MW_SRC_TILING_CREATE_H
#define MW_SRC_TILING_CREATE_H

#include "domain/tiling.h"

/* Tile the hull of `mesh`. Where the mesh is no embedding: with `any`, see mw_tiling.embedding; otherwise
 * MW_ERROR_INPUT, the error naming the first defect. A mesh without any triangle that has an area gives no tiles. Also
 * MW_ERROR_MEMORY, MW_ERROR_LIMIT. The mesh must outlive the tiling. */
mw_status mw__tiling_create(const mw_mesh *mesh, bool any, mw_tiling *tiling, mw_error *error);

/* The same by several threads (0: as OpenMP gives), or left open; that is to be finished. Where the mesh fills its hull there is no
 * difference. */
typedef struct mw_tiling_options {
    bool any, open;
    uint32_t threads;
} mw_tiling_options;
mw_status mw__tiling_create_with(const mw_mesh *mesh, mw_tiling_options options, mw_tiling *tiling, mw_error *error);
/* Find the loops and pieces of an open tiling. MW_ERROR_MEMORY. */
mw_status mw__tiling_finish(mw_tiling *tiling, mw_error *error);

#endif
