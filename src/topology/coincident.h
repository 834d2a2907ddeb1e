/* coincident.h - coincident vertices: vertices with equal coordinates. Private.
 *
 * The lowest-numbered of some coincident vertices represents them all, as in union-find. */
#ifndef MW_SRC_TOPOLOGY_COINCIDENT_H
#define MW_SRC_TOPOLOGY_COINCIDENT_H

#include "base/base.h"

/* The representative of each vertex; points are x, y, z, packed. -0.0 equals 0.0. A vertex that is
 * not finite coincides with no other. O(n) expected, for any points. Release with free(). NULL when
 * out of memory. */
uint32_t *mw__coincident_create(const double *point, uint32_t count);

/* The representative of a vertex. `coincident` NULL: no two vertices coincide. */
static MW_INLINE uint32_t mw__representative(const uint32_t *coincident, uint32_t vertex)
{
    return coincident ? coincident[vertex] : vertex;
}

#endif
