/* flip.h - flips of edges that make tiles Delaunay again. Private.
 *
 * Functions that return a bool return false when out of memory. */
#ifndef MW_SRC_DYNAMIC_FLIP_H
#define MW_SRC_DYNAMIC_FLIP_H

#include "dynamic/dynamic_tiling.h"

/* Flip the edge `half`, a diagonal of a convex quadrilateral: the tiles a, b, c and b, a, d become
 * a, d, c and d, b, c. The second one takes the slot of the tile beyond. */
bool mw__edge_flip(mw_dynamic_tiling *dynamic, uint32_t half);

/* Is the vertex beyond the edge in the circumcircle of its tile? False if the edge is fixed or on
 * the hull. */
bool mw__edge_is_illegal(const mw_dynamic_tiling *dynamic, uint32_t half);

/* Flip the edges on the stack, and those that become illegal by it, until all are legal [Lawson
 * 1977]. In a mesh that is not kept Delaunay, flip only edges between tiles that the edit filled
 * (MW_FILLED). Empties the stack. */
bool mw__legalise(mw_dynamic_tiling *dynamic);
/* The same, but only for edges between tiles that the edit filled: where all others are known to be
 * legal. */
bool mw__legalise_within(mw_dynamic_tiling *dynamic);

#endif
