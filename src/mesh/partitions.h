/* partitions.h - the triangles of a mesh from buckets, in order and linked. Private. */
#ifndef MW_SRC_MESH_PARTITIONS_H
#define MW_SRC_MESH_PARTITIONS_H

#include "mesh/match.h"
#include "mesh/buckets.h"

/* Fill in the triangles of a mesh that has its vertices, and their slots: sorted by their lowest
 * vertices, counter-clockwise, linked. Returns false when out of memory. */
bool mw__partitions_build(mw_mesh *mesh, const mw_buckets *buckets, mw_links *links);

#endif
