/* place.h - vertices with equal coordinates are at one place. Private. */
#ifndef MW_SRC_PLACE_H
#define MW_SRC_PLACE_H

#include "base/base.h"

/* For each vertex (x, y, z packed) the lowest-numbered one with equal coordinates; -0.0 equals 0.0. A vertex that is
 * not finite has its place for itself. O(n) is to be expected, whatever the points. Released with free(); NULL when out
 * of memory. */
uint32_t *mw__places_create(const double *point, uint32_t count);

/* The place of a vertex; `place` NULL: each vertex is its own. */
static MW_INLINE uint32_t mw__place_of(const uint32_t *place, uint32_t vertex)
{
    return place ? place[vertex] : vertex;
}

#endif
