/* tie.h - which facet owns a ray through an edge or a vertex: the lowest-numbered of those that it meets. Private.
 *
 * Two facets meet at an edge, and the owner of a vertex is found beforehand. Only facets without area, which own nothing,
 * need more: a ray through the middle one of their three vertices meets the inside of an edge on their other side, too.
 * They are grouped, linked ones together, and where a ray meets one, all that borders on its group is asked. */
#ifndef MW_SRC_TIE_H
#define MW_SRC_TIE_H

#include "star/star.h"

/* Do a and b lie on one ray from c? Exact. */
bool mw__same_ray(const double c[3], const double a[3], const double b[3]);

/* The lowest facet with an area that the ray through q meets, where it meets edge `edge` of facet t between its ends. */
uint32_t mw__star_edge_owner(const mw_star *star, uint32_t t, uint32_t edge, const double q[3]);

/* Fill in star->owner and the groups. Facets are oriented; arrays of the last time are reused. Returns false when out of
 * memory. */
bool mw__star_fill_owners(mw_star *star);

#endif
