/* icosphere.h - an icosahedron whose triangles are cut into four again and again. Private. */
#ifndef MW_SRC_REMESH_ICOSPHERE_H
#define MW_SRC_REMESH_ICOSPHERE_H

#include "base/job.h"

#include <meshwalk/remesh.h>

/* As mw_icosphere_create, as stages of the present part of the job; `triangles` may be NULL.
 * Returns false where there is no memory or the job is to stop. */
bool mw__icosphere_fill(uint32_t level, double *points, uint32_t *triangles, mw_job *job);

#endif
