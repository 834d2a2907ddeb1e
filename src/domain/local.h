/* local.h - defects of single triangles and edges. Private. */
#ifndef MW_SRC_LOCAL_H
#define MW_SRC_LOCAL_H

#include "mesh/defect.h"
#include "domain/outline.h"

/* Add what makes triangles unusable (of a tolerant mesh), the flat triangles, and the folds. O(n), for a tolerant mesh
 * O(n log b) for b edges without neighbour. Returns false when out of memory. */
bool mw__find_local_defects(const mw_outline *outline, mw_defects *defects);

/* Add the inner vertices round which the triangles turn more than once. O(n); false when out of memory. */
bool mw__find_turns(const mw_outline *outline, mw_defects *defects);

#endif
