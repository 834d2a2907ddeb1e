/* place.h - the answer about a ray in a facet that it meets: inside, edge or vertex, and the weights. Private. */
#ifndef MW_SRC_STAR_PLACE_H
#define MW_SRC_STAR_PLACE_H

#include "star/star.h"

/* The determinants of the edges of a facet, with vertices v, that the ray meets, area[k] of that opposite to corner k:
 * exactly 0 where they are 0, off by less than 2^-36 of their sum, all of one sign. */
void mw__star_areas(const mw_star *star, const uint32_t v[3], const double q[3], double area[3]);

/* The location in a facet of the user's that the ray meets; area as above, of the facet as the user gave it
 * (overwritten). */
void mw__star_place(const mw_star *star, uint32_t number, const double q[3], double area[3], mw_location *location);

/* A location that names no facet. */
mw_location mw__star_nowhere(void);

#endif
