/* cdt_output.h - what was made becomes a mesh and a list of pieces. Private. */
#ifndef MW_SRC_CONSTRAINED_RESULT_H
#define MW_SRC_CONSTRAINED_RESULT_H

#include "triangulate/constrained/cdt_state.h"

/* Make the mesh and, unless NULL, the pieces; fills what concerns them in the report. m->point and m->tri may be moved
 * into the mesh. MW_ERROR_INPUT: nothing is kept; MW_ERROR_MEMORY: the caller releases the pieces. */
mw_status mw__cdt_output(mw_cdt *m, mw_constrain_report *report, mw_constrained_edges *subsegments, mw_mesh **out,
                         mw_error *error);

#endif
