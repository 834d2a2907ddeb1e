/* kind_maker.h - what the kinds of triangulation work on: records of a Delaunay triangulation that
 * they turn into their own. Private.
 *
 * All triangulations of a set of points have the same number of triangles, or fewer if points are
 * left out. So each kind works in place, by exchanging diagonals or by writing all records anew. */
#ifndef MW_SRC_TRIANGULATE_KINDS_KIND_MAKER_H
#define MW_SRC_TRIANGULATE_KINDS_KIND_MAKER_H

#include "base/job.h"
#include "mesh/mesh.h"

#include <meshwalk/triangulate.h>

typedef struct mw_triangulation {
    const mw_point *point; /* points equal to an earlier one are in no triangle */
    uint32_t point_count;
    mw_triangle *tri; /* counter-clockwise, linked, filling the convex hull */
    uint32_t tri_count;
    mw_job *job;
} mw_triangulation;

/* Turn a Delaunay triangulation into one of the kind; order and `user` of the records are free.
 * Fills what concerns the kind in the report: `optimal` (1 at first) and the faces.
 * Stages of the present part of the job. MW_ERROR_MEMORY, also if it is cancelled. */
typedef mw_status mw_make_kind(mw_triangulation *t, const mw_kind_options *options,
                               mw_kind_report *report, mw_error *error);

#define MW_KIND_ENTRY(id, symbol, name, source, help) mw_make_kind mw__make_##symbol;
#include <meshwalk/kinds.def>

#endif
