/* delaunay.h - the Delaunay triangulation as records, for the rooms above. Private. */
#ifndef MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_H
#define MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_H

#include "base/job.h"
#include "mesh/mesh.h"

#include <meshwalk/triangulate.h>

/* Triangulate n points: *tri is set to an array of *tri_count counter-clockwise, linked records
 * with vertex numbers of `points`, in spatial order, `user` being the index; released with free(),
 * NULL on failure. duplicate_of and report as for mw_delaunay; errors too, and MW_ERROR_MEMORY,
 * MW_ERROR_LIMIT. Stages of the present part of the job; MW_ERROR_MEMORY if it is cancelled. */
mw_status mw__delaunay_triangles(const mw_point *points, uint32_t n, mw_job *job,
                                 uint32_t *duplicate_of, mw_delaunay_report *report,
                                 mw_triangle **tri, uint32_t *tri_count, mw_error *error);

typedef struct mw_delaunay_setup {
    uint32_t patch; /* most points of a patch, 0 = what is fastest */
    /* If not NULL, vertices are named by their slots along the curve, and *order is set to the
     * numbers of the points by slot; released with free(), NULL on failure. */
    uint32_t **order;
} mw_delaunay_setup;

/* The same by a setup. */
mw_status mw__delaunay_set_up(const mw_point *points, uint32_t n, const mw_delaunay_setup *setup,
                              mw_job *job, uint32_t *duplicate_of, mw_delaunay_report *report,
                              mw_triangle **tri, uint32_t *tri_count, mw_error *error);

/* A mesh of its own, as mw_delaunay makes it. With `laid_out` its vertices lie along the curve if
 * the points are many and do not. Job and errors as above. */
mw_status mw__delaunay_mesh(mw_job *job, bool laid_out, const double *points, size_t n,
                            size_t stride, uint32_t *duplicate_of, mw_delaunay_report *report,
                            mw_mesh **out, mw_error *error);

#endif
