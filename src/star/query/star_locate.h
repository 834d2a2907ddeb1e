/* star_locate.h - the steps of a query that the single and the batch query share. Private. */
#ifndef MW_SRC_STAR_QUERY_STAR_LOCATE_H
#define MW_SRC_STAR_QUERY_STAR_LOCATE_H

#include "star/star_walk_run.h"

/* Can the query be answered: is q finite and not the centre, and the star up to date? */
bool mw__star_answerable(const mw_star *star, const double q[3]);

/* The point where the ray from the centre through q meets the facet of its location, each
 * coordinate rounded once; NaN without a facet. */
void mw__star_meeting(const mw_star *star, const mw_location *location, const double q[3],
                      double meeting[3]);

/* --- star_glide.c --- */

/* The facet that the ray from the centre through q meets, if it is a few steps from where the query
 * before ended (`last`, or MW_NONE), or where the guide leads (`guided`), and floats are sure of
 * all sides on the way. MW_NONE: a walk has to find it. */
uint32_t mw__star_glide(const mw_star *star, bool guided, const double q[3], uint32_t last);

/* --- a query in two halves, for several interleaved walks --- */

/* Start the walk of a query that can be answered, by the cursor's start. `last`: where the previous
 * query ended, or MW_NONE. Counts in *work, unless that is NULL. */
void mw__star_query_begin(mw_star_walk *walk, const mw_star *star, const mw_star_cursor *cursor,
                          const double q[3], uint32_t last, uint64_t random, mw_star_work *work);
const mw_star_kernels *mw__star_kernels_of(const mw_star_cursor *cursor);
/* Go from facet walk->t, where the walk ended, to the answer. */
void mw__star_query_end(const mw_star_cursor *cursor, mw_star_walk *walk, mw_star_verdict verdict,
                        mw_location *location);

/* --- a query as a whole --- */

/* Answer the query at `point` by the cursor's options. *last is where the previous query ended, or
 * MW_NONE; it becomes the stored facet where this one ended. Counts in *counters if the cursor
 * counts. `trace` may be NULL. */
mw_location mw__star_query_answer(const mw_star *star, const mw_star_cursor *cursor,
                                  const double point[3], uint32_t *last, uint64_t *random,
                                  mw_counters *counters, mw_star_trace *trace);

/* --- many --- */

/* Rays of a batch, as of mw_star_project_batch. */
typedef struct mw_star_rays {
    const double *points;
    size_t n, stride;                     /* stride 0: 3 */
    const mw_star_query_options *options; /* not NULL */
    mw_location *locations;               /* receives n locations */
    double *meetings; /* NULL, or receives n points where rays meet the polyhedron */
} mw_star_rays;

/* Answer them, as stages of the present part of the job. What was done is added to *sum. MW_OK also
 * where the job is to stop. */
mw_status mw__star_answer_rays(const mw_star *star, const mw_star_rays *rays, mw_job *job,
                               mw_counters *sum, mw_error *error);

#endif
