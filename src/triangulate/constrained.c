/* constrained.c - constrained Delaunay triangulation: not made yet. */
#include "triangulate/constrain.h"

#include <meshwalk/triangulate.h>
#include <stdlib.h>

void mw_pieces_release(mw_pieces *pieces)
{
    if (!pieces) return;
    free(pieces->edge);
    free(pieces->segment);
    *pieces = (mw_pieces){0};
}

mw_status mw_constrained_delaunay(const mw_constraints *constraints, const mw_constrain_options *options,
                                  uint32_t *duplicate_of, mw_constrain_report *report, mw_pieces *pieces, mw_mesh **out,
                                  mw_error *error)
{
    (void)constraints;
    (void)options;
    (void)duplicate_of;
    (void)report;
    (void)pieces;
    *out = NULL;
    return mw__fail(error, MW_ERROR_ARGUMENT, "not made yet");
}
