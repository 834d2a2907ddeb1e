/* array_defects.h - the defects that make arrays unusable, in the plane or in space: vertex numbers
 * out of range, repeated and non-finite vertices, edges of more than two triangles. Private. */
#ifndef MW_SRC_MESH_ARRAY_DEFECTS_H
#define MW_SRC_MESH_ARRAY_DEFECTS_H

#include "mesh/defect.h"
#include "mesh/mesh.h"

/* Arrays that a tolerant mesh can be made from: a triangle with a vertex number out of range
 * becomes 0 0 0. */
typedef struct mw_repair {
    mw_arrays arrays;
    uint32_t *triangles;
    uint8_t *replaced; /* per triangle */
} mw_repair;

/* Add the vertex numbers out of range to `defects`. MW_ERROR_MEMORY. Release in either case. */
mw_status mw__repair_create(mw_repair *repair, const mw_arrays *arrays, mw_defects *defects,
                            mw_error *error);
void mw__repair_release(mw_repair *repair);

/* Add the defects that make triangle t with vertices v unusable. finite[k]: are the coordinates of
 * v[k] finite? *usable becomes true where there is none. Returns false when out of memory. */
bool mw__find_unusable(const uint32_t v[3], const bool finite[3], uint32_t t, mw_defects *defects,
                       bool *usable);

/* Add the edges of more than two triangles, of which the first two are linked. O(n log b) for b
 * edges without a link. Returns false when out of memory. */
bool mw__find_non_manifold_edges(const mw_triangle *tri, uint32_t n, mw_defects *defects);

#endif
