/* batch.h - what batches of queries have in common: blocks, each sorted along a curve or not, and
 * chunks of a block for the threads. Private. */
#ifndef MW_SRC_BATCH_BATCH_H
#define MW_SRC_BATCH_BATCH_H

#include "base/hilbert.h"
#include "base/job.h"

#include <meshwalk/locate.h>

#define MW_SORT_WORTHWHILE 64 /* fewer queries are not sorted by `auto` */

/* The first members of each room's record of a batch. Points, locations, hints and seed are those
 * of one block while it is answered; its queries are numbered from 0, and the random numbers of a
 * query come from the seed and its number. */
typedef struct mw_batch mw_batch;
struct mw_batch {
    const double *points;
    mw_location *locations;
    uint32_t *hints; /* NULL, or one for each query; only the room of the batch reads them */
    size_t stride;   /* doubles from point to point */
    uint64_t seed;
    const mw_key *order; /* NULL, or order[i].item is the i-th query to answer */

    /* Makes the keys of n queries, in order, in the present stage; NULL: they stay as they are. */
    void (*sort)(const mw_batch *batch, size_t n, mw_key *keys, mw_key *scratch, mw_job *job);
    /* Answers the queries first .. first + count - 1 (of the order), on one thread. */
    mw_counters (*answer)(const mw_batch *batch, uint32_t first, uint32_t count);
};

/* Answer n queries, as stages of the present part of the job. The counts are added to *sum.
 * Returns MW_OK, also if the job is to stop, or MW_ERROR_MEMORY. */
mw_status mw__batch_run_part(mw_batch *batch, size_t n, mw_job *job, mw_counters *sum,
                             mw_error *error);

/* Answer n queries as a job of its own. The counts go to *counters unless that is NULL.
 * Fails with MW_ERROR_MEMORY or MW_CANCELLED. */
mw_status mw__batch_run(mw_batch *batch, size_t n, uint32_t threads, const mw_progress *progress,
                        mw_counters *counters, mw_error *error);

#endif
