/* delaunay_merge.h - two Delaunay triangulations on either side of a line become one. Private. */
#ifndef MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_MERGE_H
#define MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_MERGE_H

#include "triangulate/delaunay/delaunay_grow.h"

/* Merge the triangulations that hold the ghosts a and b; a vertical or a horizontal line parts
 * their vertices strictly. Facets spare and spare + 1 are free, and become part of the result.
 * Returns a ghost of the result. */
uint32_t mw__merge(mw_growth *g, uint32_t a, uint32_t b, uint32_t spare);

#endif
