/* survey.h - everything about a mesh that decides whether it is an embedding. Private. */
#ifndef MW_SRC_SURVEY_H
#define MW_SRC_SURVEY_H

#include "domain/region.h"

typedef struct mw_survey {
    const mw_mesh *mesh;
    mw_defects defects; /* sorted                                                       */
    bool embedding;     /* no defect but flat triangles                                 */
    bool convex;        /* an embedding that is its own tiling: nothing below is filled */
    mw_outline outline;
    mw_cover cover;
    mw_regions regions;
} mw_survey;

/* Find all defects of a mesh, which must outlive the survey. O(n + b log^2 b) for b outline edges is
 * expected, if flips are as few as they are in practice (segment_insertion.h). MW_ERROR_MEMORY, MW_ERROR_LIMIT; release it in
 * either case. */
mw_status mw__survey_create(mw_survey *survey, const mw_mesh *mesh, mw_error *error);
void mw__survey_release(mw_survey *survey);

#endif
