/* damage.h - what makes arrays unusable, in the plane or in space: numbers out of range, repeated and non-finite
 * vertices, edges of more than two triangles. Private. */
#ifndef MW_SRC_DAMAGE_H
#define MW_SRC_DAMAGE_H

#include "mesh/defect.h"
#include "mesh/mesh.h"

/* Arrays of which a tolerant mesh can be made: triangles with numbers out of range are replaced by 0 0 0. */
typedef struct mw_repair {
    mw_arrays arrays;
    uint32_t *triangles;
    uint8_t *replaced; /* per triangle */
} mw_repair;

/* Adds the numbers out of range to `defects`. MW_ERROR_MEMORY. Release in either case. */
mw_status mw__repair(mw_repair *repair, const mw_arrays *arrays, mw_defects *defects, mw_error *error);
void mw__repair_release(mw_repair *repair);

/* Add what makes triangle t of vertices v unusable; finite[k]: are the coordinates of v[k]? *usable tells whether
 * nothing does. Returns false when out of memory. */
bool mw__find_unusable(const uint32_t v[3], const bool finite[3], uint32_t t, mw_defects *defects, bool *usable);

/* Add the edges of more than two triangles, of which the first two are linked. O(n log b) for b edges without link;
 * returns false when out of memory. */
bool mw__find_shared(const mw_triangle *tri, uint32_t n, mw_defects *defects);

#endif
