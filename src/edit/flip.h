/* flip.h - flips of edges that make tiles Delaunay again. Private.
 *
 * Functions that return a bool may need memory: false when there is none. */
#ifndef MW_SRC_EDIT_FLIP_H
#define MW_SRC_EDIT_FLIP_H

#include "edit/fabric.h"

/* The edge `half` of a convex quadrilateral becomes its other diagonal: a, b, c and b, a, d become a, d, c and d, b, c, the second one in
 * the place of the tile beyond. */
bool mw__exchange(mw_fabric *f, uint32_t half);

/* Is the vertex across the edge in the circle of its tile? Not if the edge is fixed or on the hull. */
bool mw__is_illegal(const mw_fabric *f, uint32_t half);

/* Flip the edges on the stack, and what becomes illegal by it, until all are legal [Lawson 1977]. Where the mesh is not kept Delaunay,
 * only edges within what the edit has filled (MW_FILLED). Empties the stack. */
bool mw__legalise(mw_fabric *f);
/* The same, but only edges within what the edit has filled: where those round about are known to be legal. */
bool mw__legalise_within(mw_fabric *f);

#endif
