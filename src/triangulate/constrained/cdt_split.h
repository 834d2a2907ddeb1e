/* cdt_split.h - points are made where segments cross. Private. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_CDT_SPLIT_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_CDT_SPLIT_H

#include "triangulate/constrained/cdt_state.h"

/* Where ab and cd cross, rounded, but in the boxes of both. */
mw_point mw__crossing_point(mw_point a, mw_point b, mw_point c, mw_point d);

/* Some parts cross: make points there, and cut all parts at their points. Rounds count from 1;
 * after the first, parts are led through ends of others that they cross and pass close by.
 * MW_ERROR_MEMORY, MW_ERROR_LIMIT. */
mw_status mw__cdt_split_crossings(mw_cdt *m, int round, mw_error *error);

#endif
