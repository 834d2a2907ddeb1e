/* cdt.h - constrained triangulations for rooms above: what crosses is left out. Private. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_CDT_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_CDT_H

#include "triangulate/constrained/cdt_state.h"

/* Check m->given, triangulate its points, and force its segments in, each until it crosses one
 * that was forced in before. What could not be forced in is in m->crossing. All members of *m but
 * `given` and `job` are zero. Errors as of mw_constrained_delaunay. Stages of the present part of
 * the job. Release *m in either case. */
mw_status mw__cdt_make_partly(mw_cdt *m, mw_error *error);
void mw__cdt_release(mw_cdt *m);

#endif
