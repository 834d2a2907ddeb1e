/* complete.h - the tiling of a mesh that does not tile its hull by itself. Private. */
#ifndef MW_SRC_COMPLETE_H
#define MW_SRC_COMPLETE_H

#include "domain/survey.h"
#include "domain/tiling.h"

/* How many ghosts fill the hull. */
uint32_t mw__ghosts_wanted(const mw_cover *cover);

/* Make the tiles and points of *tiling from the survey of an embedding that is not `convex`, with ghosts where `fill` says
 * so; the owners are not found yet. MW_ERROR_MEMORY; MW_ERROR_LIMIT: more than MW_MAX_TRIANGLES tiles. Release *tiling in
 * either case. */
mw_status mw__complete(const mw_survey *survey, bool fill, mw_tiling *tiling, mw_error *error);

#endif
