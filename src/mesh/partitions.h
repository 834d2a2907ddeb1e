/* partitions.h - the triangles of a mesh from buckets, in order and linked. Private. */
#ifndef MW_SRC_MESH_PARTITIONS_H
#define MW_SRC_MESH_PARTITIONS_H

#include "base/job.h"
#include "mesh/match.h"
#include "mesh/buckets.h"

/* Fill in the triangles of a mesh that has its vertices, and their slots: sorted by their lowest
 * vertices, counter-clockwise, linked. A stage that takes 0.3 of the present part. Returns false
 * when out of memory, or cancelled. */
bool mw__partitions_build(mw_mesh *mesh, const mw_buckets *buckets, mw_job *job, mw_links *links);

#endif
