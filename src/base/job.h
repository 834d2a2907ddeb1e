/* job.h - one long call of a user: its threads, who watches its progress, and whether it goes on.
 * Private.
 *
 * A public function makes a job from its options, passes it down, and ends it:
 *
 *     mw_job job = mw__job(options->threads, options->progress);
 *     mw_status status = ...the work, which takes &job...;
 *     status = mw__job_end(&job, status, error);    then release everything if that is not MW_OK
 *
 * The work is a sequence of stages, and each stage takes a share of the whole. A function below may
 * have stages of its own; its caller gives it a part of the whole (mw__job_part). The shares of
 * one function add up to 1. A job that the user has cancelled goes back the same way as a failed
 * allocation: functions return false, or MW_ERROR_MEMORY, and mw__job_end makes that
 * MW_CANCELLED. */
#ifndef MW_SRC_BASE_JOB_H
#define MW_SRC_BASE_JOB_H

#include "base/base.h"
#include "base/threads.h"

#include <stdatomic.h>

/* The part of the whole that a stage or a function takes, and where it begins. */
typedef struct mw_job_span {
    double from, size;
} mw_job_span;

typedef struct mw_job {
    uint32_t threads;            /* asked for; 0: as many as processors        */
    const mw_progress *progress; /* NULL: nobody watches                       */
    const char *stage;           /* the name of the present stage              */
    mw_job_span part;            /* the part of the present function           */
    mw_job_span span;            /* the present stage                          */
    double told, next;           /* fractions: reported last, and next          */
    uint32_t stages;             /* that have begun                            */
    atomic_bool stopped;         /* the user has cancelled                     */
} mw_job;

static inline mw_job mw__job(uint32_t threads, const mw_progress *progress)
{
    return (mw_job){.threads = threads, .progress = progress, .stage = "beginning", .part = {0, 1}};
}

/* A job that nobody watches, on the calling thread alone. */
#define MW_ALONE (&(mw_job){.threads = 1})

/* The next stage begins, and takes `share` of the present part. Reported, unless there have been
 * many stages. */
void mw__job_stage(mw_job *job, const char *name, double share);

/* The stages that follow are those of a function that takes `share` of the present part.
 * mw__job_part_end with the result goes back to the present part. */
mw_job_span mw__job_part(mw_job *job, double share);
void mw__job_part_end(mw_job *job, mw_job_span outer);

bool mw__job_report(mw_job *job, double fraction); /* for mw__job_step */

static inline bool mw__job_stopped(const mw_job *job)
{
    return atomic_load_explicit(&job->stopped, memory_order_relaxed);
}

/* `done` of `total` of the present stage are done. Reported when the fraction of the whole has
 * grown enough: 256 times a job at most. Only the calling thread of the user may call this.
 * Returns false if the job is to stop. */
static inline bool mw__job_step(mw_job *job, uint64_t done, uint64_t total)
{
    return MW_LIKELY(!job->progress) ||
           mw__job_report(job, (double)done / (double)(total ? total : 1));
}

/* The steps that follow are those of items done .. done + count - 1 of `total` in the present
 * stage. Give the result to mw__job_steps_end. */
mw_job_span mw__job_steps_of(mw_job *job, uint64_t done, uint64_t count, uint64_t total);
static inline void mw__job_steps_end(mw_job *job, mw_job_span outer)
{
    job->span = outer;
}

/* The status of the whole: MW_CANCELLED if the user has cancelled, otherwise `status`. After a
 * success the fraction 1 is reported, and nothing can cancel any more. */
mw_status mw__job_end(mw_job *job, mw_status status, mw_error *error);

/* --- loops that threads share --- */

static inline uint32_t mw__job_team(const mw_job *job, uint64_t chunks)
{
    return mw__team(job->threads, chunks);
}

/* Do chunk `chunk` of some work; `member` is the member of the team that does it. */
typedef void mw_chunk_work(void *work, uint64_t chunk, uint32_t member);

/* Do the chunks 0 .. chunks - 1 with a team (from mw__job_team). Members take them in order, one at
 * a time. Steps of the present stage. Returns false if the job is to stop; then some chunks are
 * missing. */
bool mw__job_chunks(mw_job *job, uint32_t team, uint64_t chunks, mw_chunk_work *chunk_work,
                    void *work);

/* Do the items from .. to - 1 of some work. */
typedef void mw_range_work(void *work, uint64_t from, uint64_t to);

/* Do the items 0 .. n - 1, in ranges of a few thousand. Otherwise as mw__job_chunks. */
bool mw__job_ranges(mw_job *job, uint64_t n, mw_range_work *range_work, void *work);

#endif
