/* rim.h - the rim of the whole mesh: what decides about points that lie in no triangle. Private.
 *
 * Edges of triangles with an area beyond which there is nothing, or a triangle without area, are
 * the outline of the whole mesh. The rim are all triangles that contain an end of such an edge, and
 * all triangles without area, and what is at their corners. Every rank has all of it.
 *
 * The parts of the plane that the rim leaves open are the holes and the outside of the whole mesh,
 * and voids, which other triangles fill. A void has no edge of the outline at its border, a hole no
 * other. So:
 *   - A point in no triangle of the mesh is in a hole or outside, and the rim tells which.
 *   - Holes of the rim that are no voids are those of the mesh, in the same order, since the order
 *     is that of the lowest triangles along them.
 *   - The border edge nearest to such a point is that of the mesh: the way to the border of a void
 *     leads over the outline first, and no edge of a void touches the outline.
 *   - The mesh overlaps itself only if the rim does: where the mesh becomes covered twice, there is
 *     an end of an edge of the outline, and all triangles at that place are in the rim.
 * docs/mpi.md has the arguments. */
#ifndef MWP_MESH_RIM_H
#define MWP_MESH_RIM_H

#include "mpi/mesh/records.h"
#include "mpi/mesh/router.h"

#include <meshwalk/locate.h>

typedef struct mwp_rim {
    mwp_union all;
    mw_mesh *mesh;
    mw_locator *locator; /* with the border */
    uint32_t *hole;      /* per hole of the rim: that of the whole mesh, or MW_NONE for a void */
    uint32_t holes;      /* of the whole mesh */
} mwp_rim;

/* A rank's piece, ready for queries. */
typedef struct mwp_part {
    mwp_own own;
    mw_mesh *mesh;       /* of `own` */
    mw_locator *locator; /* NULL: no triangle has an area */
    uint8_t *joined;     /* as mwp__stars_join tells */
    uint32_t threads;
} mwp_part;

/* Collective. Refuses a mesh that overlaps itself. Release in either case. */
mw_status mwp__rim_create(mwp_rim *rim, const mwp_wire *wire, const mwp_part *part,
                          const mwp_router *router, mwp_error *error);
void mwp__rim_release(mwp_rim *rim);
size_t mwp__rim_bytes(const mwp_rim *rim);

#endif
