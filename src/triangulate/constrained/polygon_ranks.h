/* polygon_ranks.h - polygons as given have any numbers; their ranks count from 0, in the order of
 * the numbers. Private. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_POLYGON_RANKS_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_POLYGON_RANKS_H

#include "triangulate/constrained/cdt_state.h"

typedef struct mw_polygon_ranks {
    uint32_t *rank;    /* per segment: that of its polygon; MW_NONE: it belongs to none */
    uint32_t *polygon; /* per rank: the number of the polygon                           */
    uint32_t count;
} mw_polygon_ranks;

/* MW_ERROR_INPUT: a polygon whose rings are not closed, with a point where one ends;
 * MW_ERROR_MEMORY. m->twin is set. Release it in either case. */
mw_status mw__polygon_ranks_create(mw_polygon_ranks *ranks, const mw_cdt *m, mw_error *error);
void mw__polygon_ranks_release(mw_polygon_ranks *ranks);

#endif
