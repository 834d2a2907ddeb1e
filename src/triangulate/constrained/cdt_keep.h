/* cdt_keep.h - which triangles are kept. Private. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_CDT_KEEP_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_CDT_KEEP_H

#include "triangulate/constrained/cdt_state.h"

/* Set m->kept, and the idle holes of the report. MW_ERROR_INPUT: a polygon that is not closed, or
 * no triangle is kept; MW_ERROR_MEMORY. */
mw_status mw__cdt_keep_triangles(mw_cdt *m, mw_keep keep, mw_constrain_report *report,
                                 mw_error *error);

#endif
