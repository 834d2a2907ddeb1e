/* point_order.h - points in order along a Hilbert curve, crowded ones too. Private. */
#ifndef MW_SRC_MESH_POINT_ORDER_H
#define MW_SRC_MESH_POINT_ORDER_H

#include "base/hilbert.h"
#include "base/job.h"
#include "predicates/predicates.h"

typedef struct mw_extent {
    double low[2], high[2];
} mw_extent;

/* The extent of the finite points; low > high where there are none. *all_finite: are all points
 * finite? Steps of the present stage. */
mw_extent mw__points_extent(const mw_point *points, uint32_t n, mw_job *job, bool *all_finite);

/* A cell with more points than this is sorted again, on a finer curve through their own extent. */
#define MW_LONG_RUN 256

/* Sort the numbers of n points, in keys[i].item, along a curve through an extent. keys[i].key is
 * the position on that curve. `scratch` has room for n keys, too. The result is the same for any
 * number of threads. Stages of the present part of the job. Returns false when out of memory, or
 * cancelled. */
bool mw__points_sort(const mw_point *points, uint32_t n, const mw_extent *extent, mw_job *job,
                     mw_key *keys, mw_key *scratch);

/* Set the keys of the points keys[i].item along the curve through the extent of these points. */
void mw__points_set_keys(const mw_point *points, mw_key *keys, size_t n);

/* Fill order[n] with the numbers of the points along a curve through their extent. Points that are
 * not finite come anywhere. Job and result as above. */
bool mw__points_order(const mw_point *points, uint32_t n, mw_job *job, uint32_t *order);

#endif
