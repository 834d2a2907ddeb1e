/* local_defects.h - defects of single triangles, edges and vertices. Private. */
#ifndef MW_SRC_TILING_LOCAL_DEFECTS_H
#define MW_SRC_TILING_LOCAL_DEFECTS_H

#include "mesh/defect.h"
#include "tiling/outline.h"

/* Add the defects of unusable triangles (of a tolerant mesh), the flat triangles, and the folds.
 * O(n); for a tolerant mesh O(n log b) for b edges without a neighbour. Returns false when out of
 * memory. */
bool mw__find_local_defects(const mw_outline *outline, mw_defects *defects);

/* Add the inner vertices round which the triangles turn more than once. O(n). Returns false when
 * out of memory. */
bool mw__find_winding_defects(const mw_outline *outline, mw_defects *defects);

#endif
