/* connect.h - triangles become neighbours. Private. */
#ifndef MW_SRC_MESH_CONNECT_H
#define MW_SRC_MESH_CONNECT_H

#include "base/job.h"
#include "mesh/match.h"

/* Link the triangles tri[0..n), whose vertices are below vertex_count, along their edges, in O(n).
 * They have no links before. Of an edge with more than two triangles, the first two are linked. The
 * orientation does not matter. A triangle that names a vertex twice gets no link. `links` may be
 * NULL. Stages of the present part of the job. Returns false when out of memory, or cancelled. */
bool mw__connect(mw_triangle *tri, uint32_t n, uint32_t vertex_count, mw_job *job, mw_links *links);

#endif
