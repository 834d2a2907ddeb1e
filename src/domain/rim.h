/* rim.h - the border of the tiles, in the order in which it runs round what lies beyond it.
 * Private. */
#ifndef MW_SRC_DOMAIN_RIM_H
#define MW_SRC_DOMAIN_RIM_H

#include "domain/survey.h"
#include "domain/tiling.h"

/* The edges of the border of the tiles that a survey's mesh has without ghosts. *count of them, released
 * with free(); NULL when out of memory. */
mw_rim_edge *mw__rim_create(const mw_survey *survey, const mw_tiling *tiling, uint32_t *count);

#endif
