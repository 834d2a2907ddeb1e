/* parts.h - the triangles of a mesh from piles, in order and linked. Private. */
#ifndef MW_SRC_PARTS_H
#define MW_SRC_PARTS_H

#include "mesh/match.h"
#include "mesh/piles.h"

/* Fill the arrays of triangles, and of their places, of a mesh that has its vertices: by their lowest vertices, counter-clockwise,
 * linked. Returns false when out of memory. */
bool mw__work_parts(mw_mesh *mesh, const mw_piles *piles, mw_links *links);

#endif
