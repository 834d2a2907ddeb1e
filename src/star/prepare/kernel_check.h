/* kernel_check.h - is a surface a polyhedron that is star-shaped about a centre, and if not, where?
 * Private.
 *
 * It is star-shaped if three conditions hold. It is closed: each edge joins two facets, and welded
 * vertices still coincide. Its facets can be oriented so that neighbours agree and the centre lies
 * strictly behind each of them. One ray from the centre meets only one facet. Then the projection
 * of the facets onto a sphere round the centre is a closed surface with the same orientation
 * everywhere. So every ray off the edges meets the same number of facets: one. Facets without area
 * project to nothing. Facets with two coincident corners are not linked and do not count at all.
 * All tests are exact, and take O(n) together. */
#ifndef MW_SRC_STAR_PREPARE_KERNEL_CHECK_H
#define MW_SRC_STAR_PREPARE_KERNEL_CHECK_H

#include "base/job.h"
#include "mesh/defect.h"
#include "star/star.h"

/* Are the corners of a facet finite, and, in a welded surface, still where those are with which
 * they are one? */
bool mw__star_corners_hold(const mw_star *star, const uint32_t v[3]);

/* Does the one ray meet a facet with these corners, counter-clockwise from outside, which has an
 * area and is not in a plane with the centre? Exact; no edge lies on the ray. */
bool mw__star_ray_meets(const mw_star *star, const uint32_t v[3]);

/* Turn the facets of star->tri for which turned[i] is greater than 0. */
void mw__facets_turn(mw_star *star, const int8_t *turned);

/* Decide whether the surface is star-shaped, and orient star->tri, which holds its triangles, as
 * star.h says. Sets star->area_count. Adds all defects to *defects; that of the ray
 * (MW_DEFECT_COVERED) only if there is no other. Without any, the surface is star-shaped. Stages of
 * the present part of the job. Returns false when out of memory, or cancelled. */
bool mw__star_kernel_check(mw_star *star, mw_job *job, mw_defects *defects);

/* Decide the same without memory, for a surface that has no flat facets but void ones: true, with
 * star->area_count set. False: it is not star-shaped, or has flat facets, or the job is to stop.
 * Nothing is oriented. A stage that takes the present part of the job. */
bool mw__star_kernel_holds(mw_star *star, mw_job *job);

#endif
