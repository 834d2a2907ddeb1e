/* cdt_spans.h - what segments own that jumped along a run of subsegments. Private. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_CDT_SPANS_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_CDT_SPANS_H

#include "triangulate/constrained/cdt_state.h"

/* Let each subsegment have its lowest owner, among those that jumped along it, too. Time: O(n log
 * n) for n subsegments and spans. False when out of memory. */
bool mw__cdt_spans_settle(mw_cdt *m);

/* List all owners in m->owner, those that jumped, too: as many entries as there are pairs of a
 * segment and a subsegment of it. The spans are gone then. False when out of memory. */
bool mw__cdt_spans_list(mw_cdt *m);

#endif
