/* min_max_angle.h - the search for the smallest largest angle, with limits. Private. */
#ifndef MW_SRC_TRIANGULATE_KINDS_MIN_MAX_ANGLE_H
#define MW_SRC_TRIANGULATE_KINDS_MIN_MAX_ANGLE_H

#include "triangulate/kinds/kind_maker.h"

/* What all insertions together, and each of them, may take: see edge_insertion.h. */
typedef struct mw_angle_limits {
    uint64_t most_work;
    size_t most_seen;
} mw_angle_limits;

/* Seek the smallest largest angle until a limit is reached; then, or after that, the local optimum.
 * No work: that only. *proved: the largest angle is the smallest that there is. MW_ERROR_MEMORY. */
mw_status mw__min_max_angle_within(mw_triangulation *t, mw_angle_limits limits, bool *proved);

#endif
