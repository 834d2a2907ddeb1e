/* cdt_output.h - what was made becomes a mesh and a list of subsegments. Private. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_CDT_OUTPUT_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_CDT_OUTPUT_H

#include "triangulate/constrained/cdt_state.h"

/* Make the mesh and, unless NULL, the subsegments; fills what concerns them in the report. m->point
 * and m->tri may be moved into the mesh. MW_ERROR_INPUT: nothing is kept; MW_ERROR_MEMORY: the
 * caller releases the subsegments. Stages of the present part of the job. */
mw_status mw__cdt_output(mw_cdt *m, mw_constrain_report *report, mw_constrained_edges *subsegments,
                         mw_mesh **out, mw_error *error);

#endif
