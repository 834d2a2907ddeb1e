/* job.c - stages, reports, and loops that threads share. */
#include "base/job.h"

#include <assert.h>

/* reports of a whole job while its fraction grows, one for each such part */
#define REPORTS 256
/* the first stages, so many, report that they begin; later ones only where one is due */
#define STAGES 40

/* Tell the user how far the job is. */
static bool job_tell(mw_job *job, double whole)
{
    const mw_progress *p = job->progress;
    /* rounding may make a stage begin before the last one ended */
    if (whole > job->told) job->told = whole;
    job->next = job->told + 1.0 / REPORTS;
    if (p->report && p->report(p->context, job->stage, job->told))
        atomic_store(&job->stopped, true);
    return !mw__job_stopped(job);
}

bool mw__job_report(mw_job *job, double fraction)
{
    if (mw__job_stopped(job)) return false;
    double whole = job->span.from + job->span.size * (fraction < 1 ? fraction : 1);
    return whole < job->next || whole >= 1 || job_tell(job, whole);
}

void mw__job_stage(mw_job *job, const char *name, double share)
{
    job->stage = name;
    job->span = (mw_job_span){job->span.from + job->span.size, share * job->part.size};
    assert(job->span.from + job->span.size < job->part.from + job->part.size + 1e-9);
    if (!job->progress || mw__job_stopped(job) || job->span.from >= 1) return;
    if (job->stages++ < STAGES || job->span.from >= job->next) job_tell(job, job->span.from);
}

mw_job_span mw__job_part(mw_job *job, double share)
{
    mw_job_span outer = job->part;
    job->part = (mw_job_span){job->span.from + job->span.size, share * outer.size};
    assert(job->part.from + job->part.size < outer.from + outer.size + 1e-9);
    job->span = (mw_job_span){job->part.from, 0};
    return outer;
}

void mw__job_part_end(mw_job *job, mw_job_span outer)
{
    job->span = (mw_job_span){job->part.from + job->part.size, 0};
    job->part = outer;
}

mw_job_span mw__job_steps_of(mw_job *job, uint64_t done, uint64_t count, uint64_t total)
{
    mw_job_span outer = job->span;
    double all = (double)(total ? total : 1);
    job->span.from += outer.size * ((double)done / all);
    job->span.size *= (double)count / all;
    return outer;
}

mw_status mw__job_end(mw_job *job, mw_status status, mw_error *error)
{
    if (mw__job_stopped(job))
        return mw__fail(error, MW_CANCELLED, "cancelled while %s", job->stage);
    if (!status && job->progress && job->progress->report)
        job->progress->report(job->progress->context, job->stage, 1);
    return status;
}

/* --- loops that threads share --- */

typedef struct chunk_loop {
    mw_job *job;
    mw_chunk_work *chunk_work;
    void *work;
    uint64_t chunks;
    _Atomic uint64_t next;
} chunk_loop;

static void chunk_loop_run(void *argument, uint32_t member)
{
    chunk_loop *loop = argument;
    for (;;) {
        uint64_t chunk = atomic_fetch_add_explicit(&loop->next, 1, memory_order_relaxed);
        if (chunk >= loop->chunks || mw__job_stopped(loop->job)) break;
        loop->chunk_work(loop->work, chunk, member);
        if (member == 0) mw__job_step(loop->job, chunk + 1, loop->chunks);
    }
}

bool mw__job_chunks(mw_job *job, uint32_t team, uint64_t chunks, mw_chunk_work *chunk_work,
                    void *work)
{
    chunk_loop loop = {.job = job, .chunk_work = chunk_work, .work = work, .chunks = chunks};
    mw__team_run(team, chunk_loop_run, &loop);
    return !mw__job_stopped(job);
}

typedef struct range_loop {
    mw_range_work *range_work;
    void *work;
    uint64_t n;
} range_loop;

enum { RANGE = 1 << 14 }; /* how many items are worth a thread */

static void range_loop_run(void *argument, uint64_t chunk, uint32_t member)
{
    const range_loop *loop = argument;
    uint64_t from = chunk * RANGE, left = loop->n - from;
    (void)member;
    loop->range_work(loop->work, from, from + (left < RANGE ? left : RANGE));
}

bool mw__job_ranges(mw_job *job, uint64_t n, mw_range_work *range_work, void *work)
{
    range_loop loop = {range_work, work, n};
    uint64_t chunks = n / RANGE + (n % RANGE != 0);
    return mw__job_chunks(job, mw__job_team(job, chunks), chunks, range_loop_run, &loop);
}
