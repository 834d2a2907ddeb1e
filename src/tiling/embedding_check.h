/* embedding_check.h - decides whether a mesh is an embedding. Private. */
#ifndef MW_SRC_TILING_EMBEDDING_CHECK_H
#define MW_SRC_TILING_EMBEDDING_CHECK_H

#include "base/job.h"
#include "tiling/region.h"

typedef struct mw_embedding_check {
    const mw_mesh *mesh;
    mw_defects defects; /* sorted */
    bool embedding;     /* no defects except flat triangles */
    bool convex;        /* an embedding that is its own tiling: the members below stay empty */
    mw_outline outline;
    mw_coverage coverage;
    mw_regions regions;
} mw_embedding_check;

/* Find all defects of a mesh, which must outlive the check. O(n + b log^2 b) expected for b outline
 * edges, if flips are as few as in practice (constrain.h). MW_ERROR_MEMORY (also if cancelled),
 * MW_ERROR_LIMIT. Release in either case. Stages of the present part of the job. */
mw_status mw__embedding_check_create(mw_embedding_check *check, const mw_mesh *mesh, mw_job *job,
                                     mw_error *error);
void mw__embedding_check_release(mw_embedding_check *check);

#endif
