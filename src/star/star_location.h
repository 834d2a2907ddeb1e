/* star_location.h - the location of a ray in a facet that it meets: inside, edge or vertex, and the
 * weights. Private. */
#ifndef MW_SRC_STAR_STAR_LOCATION_H
#define MW_SRC_STAR_STAR_LOCATION_H

#include "star/star.h"

/* The determinants of the edges of a facet, with vertices v, that the ray meets. area[k] is that of
 * the edge opposite to corner k. All have the same sign; zeros are exact, others are off by less
 * than 2^-36 of their sum. */
void mw__star_areas(const mw_star *star, const uint32_t v[3], const double q[3], double area[3]);

/* The location in a facet of the user that the ray meets. area: as above, of the facet as the user
 * gave it; is overwritten. */
void mw__star_location_in_facet(const mw_star *star, uint32_t number, const double q[3],
                                double area[3], mw_location *location);

/* A location without a facet. */
mw_location mw__star_location_none(void);

#endif
