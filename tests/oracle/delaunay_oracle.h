/* delaunay_oracle.h - is a mesh the Delaunay triangulation of its points? Decided triangle by
 * triangle with the exact predicates, which test_predicates.c holds against GMP. Failures are
 * cmocka's: call this from tests only. */
#ifndef MW_TESTS_ORACLE_DELAUNAY_ORACLE_H
#define MW_TESTS_ORACLE_DELAUNAY_ORACLE_H

#include <stdint.h>

#include "mesh/mesh.h"

/* Fails unless the records of the mesh are sound, it fills the convex hull of its points once,
 * every edge is locally Delaunay, and of equal points the first is a vertex, the others are
 * named in duplicate_of (one number a point, MW_NONE for vertices). Where the mesh is small,
 * looks at every point in every circle, too. */
void delaunay_oracle_check(const mw_mesh *mesh, const uint32_t *duplicate_of);

#endif
