/* delaunay_collect.h - from the facets that have grown to triangles. Private. */
#ifndef MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_COLLECT_H
#define MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_COLLECT_H

#include "mesh/mesh.h"
#include "triangulate/delaunay/delaunay_patches.h"

/* Make triangles of all facets that are no ghosts: *tri is set to *tri_count records as of
 * mw__delaunay_triangles. Stages of the present part of the job. With `slots` they name vertices
 * by slot. `scratch` has room for 12 n + 4 bytes. Returns false when out of memory, or cancelled,
 * with *tri NULL. */
bool mw__delaunay_collect(const mw_patches *patches, const mw_patch_arrays *arrays, bool slots,
                          mw_job *job, uint32_t *scratch, mw_triangle **tri, uint32_t *tri_count);

#endif
