/* ghosts.h - the tiles of a mesh that is not its own tiling: ghosts fill its holes and pockets.
 * Private. */
#ifndef MW_SRC_TILING_GHOSTS_H
#define MW_SRC_TILING_GHOSTS_H

#include "tiling/embedding_check.h"
#include "tiling/tiling.h"

/* The number of ghosts that fill the hull. */
uint32_t mw__ghosts_count(const mw_coverage *coverage);

/* Make the tiles and points of *tiling from the check of an embedding that is not `convex`, with
 * ghosts if `fill`. Does not find the owners. MW_ERROR_MEMORY; MW_ERROR_LIMIT: more than
 * MW_MAX_TRIANGLES tiles. Release *tiling in either case. Stages of the present part of the job. */
mw_status mw__ghosts_fill(const mw_embedding_check *check, bool fill, mw_job *job,
                          mw_tiling *tiling, mw_error *error);

#endif
