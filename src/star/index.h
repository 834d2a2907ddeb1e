/* index.h - what some starts build beside a star. Private. */
#ifndef MW_SRC_STAR_INDEX_H
#define MW_SRC_STAR_INDEX_H

#include "star/star.h"

/* The start that it is for. */
mw_star_start_kind mw__star_index_start(const mw_star_index *index);

#endif
