/* star_follow.h - a star follows single vertices of its surface. Private. */
#ifndef MW_SRC_STAR_STAR_FOLLOW_H
#define MW_SRC_STAR_STAR_FOLLOW_H

#include "star/star.h"

/* Bring a star up to date in which nothing has changed since but the places of `count` vertices;
 * all its facets have an area. Returns false, with nothing changed but star->place, where all
 * facets must be decided: because there are many vertices, the surface is not star-shaped any more,
 * a facet has lost its area, or memory is short. O(k log k) for the k facets round the vertices,
 * and O(n) when star->place is made. */
bool mw__star_follow(mw_star *star, const uint32_t *moved, size_t count);

#endif
