/* kernel.h - is a surface a polyhedron star-shaped about a centre, and if not, where? Private.
 *
 * It is, if it is closed (each edge joins two facets; where vertices were welded, they are still at one place), if
 * its facets can be oriented so that neighbours agree and the centre lies strictly behind each of them, and if one
 * ray from the centre meets only one facet. For then the projection of the facets onto a sphere round the centre is
 * a closed surface all of which turns the same way, so every ray off the edges meets as many facets as any other:
 * one. Facets without area project to nothing; facets of which two corners are one place are not linked, and count
 * for nothing at all. All tests are exact, and all is O(n). */
#ifndef MW_SRC_KERNEL_H
#define MW_SRC_KERNEL_H

#include "mesh/defect.h"
#include "star/star.h"

/* Decide, and orient star->tri, which holds the surface's triangles, as star.h says; also star->area_count. Every
 * defect joins *defects, that of a ray (MW_DEFECT_COVERED) only if there is no other. If there is none, the surface
 * is star-shaped. Returns false when out of memory. */
bool mw__star_kernel(mw_star *star, mw_defects *defects);

#endif
