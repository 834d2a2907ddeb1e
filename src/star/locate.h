/* locate.h - the steps of a query that the single and the batch query share. Private. */
#ifndef MW_SRC_STAR_LOCATE_H
#define MW_SRC_STAR_LOCATE_H

#include "star/star.h"

/* The facets (as the user numbers them) that a walk visits. */
typedef struct mw_star_trace {
    uint32_t *facet;
    size_t count, capacity; /* more may come than there is room for */
} mw_star_trace;

/* Is q a point that a ray goes through, and the star what it was? */
bool mw__star_answerable(const mw_star *star, const double q[3]);

/* --- a query in two halves, for those who have many in flight --- */

/* The walk of a query (answerable) that begins where the cursor's start says; `last` is where the one before it ended,
 * or MW_NONE. It is counted in *work, unless that is NULL. */
void mw__star_begin(mw_star_walk *walk, const mw_star *star, const mw_star_cursor *cursor, const double q[3],
                    uint32_t last, uint64_t random, mw_star_work *work);
const mw_star_kernels *mw__star_kernels_of(const mw_star_cursor *cursor);
/* From where the walk ended, in facet walk->t, to the answer. */
void mw__star_end(const mw_star_cursor *cursor, mw_star_walk *walk, mw_star_verdict verdict, mw_location *location);

/* --- a query as a whole --- */

/* Answer the query at `point` by the cursor's options; `last` is where the one before it ended, or MW_NONE; it becomes
 * the facet (as stored) where this one ended. Counts into *counters if the cursor counts. trace may be NULL. */
mw_location mw__star_answer(const mw_star *star, const mw_star_cursor *cursor, const double point[3], uint32_t *last,
                            uint64_t *random, mw_counters *counters, mw_star_trace *trace);

#endif
