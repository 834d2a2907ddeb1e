/* tiling_create.h - makes the tiling of a mesh. Private. */
#ifndef MW_SRC_TILING_TILING_CREATE_H
#define MW_SRC_TILING_TILING_CREATE_H

#include "tiling/tiling.h"

typedef struct mw_tiling_options {
    bool any; /* take a mesh that is not an embedding: see mw_tiling.embedding */
    /* mw__tiling_finish must follow; no difference if the mesh fills its hull */
    bool without_ghosts;
} mw_tiling_options;

/* Tile the hull of `mesh`, which must outlive the tiling. If the mesh is not an embedding, and is
 * not taken as it is: MW_ERROR_INPUT, naming the first defect. A mesh without a triangle with an
 * area has no tiles. MW_ERROR_MEMORY (also if cancelled), MW_ERROR_LIMIT. Stages of the present
 * part of the job. */
mw_status mw__tiling_create(const mw_mesh *mesh, mw_tiling_options options, mw_job *job,
                            mw_tiling *tiling, mw_error *error);
/* Find the border loops and components of a tiling without ghosts. MW_ERROR_MEMORY. */
mw_status mw__tiling_finish(mw_tiling *tiling, mw_error *error);

#endif
