/* batch.c - many queries. A block of them is sorted at a time; within a block the threads take
 * chunks.
 *
 * Counters do not depend on the threads: the size of chunks depends on the number of queries only,
 * and a chunk knows nothing of the one before it. */
#include "batch/batch.h"

#include "base/posix.h"
#include "base/random.h"

#include <stdlib.h>

enum {
    CHUNK = 1 << 14, /* queries that one thread takes at a time  */
    SMALL = 1 << 18, /* queries; of fewer a chunk is a quarter, so that threads end together */
    BLOCK = 1 << 22  /* queries sorted at a time: 64 MiB of keys */
};

typedef struct batch_block {
    const mw_batch *batch;
    uint32_t n, chunk; /* queries, and those of a chunk */
    pthread_mutex_t lock;
    mw_counters sum; /* of the chunks that are done */
} batch_block;

static void block_answer_chunk(void *work, uint64_t chunk, uint32_t member)
{
    batch_block *block = work;
    uint32_t first = (uint32_t)chunk * block->chunk, left = block->n - first;
    (void)member;
    mw_counters counters =
        block->batch->answer(block->batch, first, left < block->chunk ? left : block->chunk);
    pthread_mutex_lock(&block->lock);
    mw_counters_add(&block->sum, &counters);
    pthread_mutex_unlock(&block->lock);
}

/* Returns false if the job is to stop. */
static bool block_answer(const mw_batch *batch, uint32_t n, mw_job *job, mw_counters *sum)
{
    batch_block block = {
        .batch = batch, .n = n, .chunk = n < SMALL ? CHUNK / 4 : CHUNK, .sum = *sum};
    uint64_t chunks = ((uint64_t)n + block.chunk - 1) / block.chunk;
    pthread_mutex_init(&block.lock, NULL);
    bool done = mw__job_chunks(job, mw__job_team(job, chunks), chunks, block_answer_chunk, &block);
    pthread_mutex_destroy(&block.lock);
    *sum = block.sum;
    return done;
}

/* Sort a block of queries, and answer them: both are stages that take `share` of the job. */
static bool block_run(mw_batch *batch, mw_key *keys, size_t block, double share, mw_job *job,
                      mw_counters *sum)
{
    const double sorting = batch->sort ? 0.2 : 0;
    if (batch->sort) {
        mw__job_stage(job, "sorting queries", share * sorting);
        batch->sort(batch, block, keys, keys + block, job);
    }
    mw__job_stage(job, "answering queries", share * (1 - sorting));
    return block_answer(batch, (uint32_t)block, job, sum);
}

mw_status mw__batch_run_part(mw_batch *batch, size_t n, mw_job *job, mw_counters *sum,
                             mw_error *error)
{
    size_t block = n < BLOCK ? n : BLOCK;
    mw_key *keys = batch->sort ? mw__alloc_lines(2 * block, sizeof *keys) : NULL;
    if (batch->sort && !keys) return mw__fail_memory(error);
    batch->order = keys;
    uint64_t seed = batch->seed;
    for (size_t done = 0; done < n; done += block) {
        if (n - done < block) block = n - done;
        batch->seed = mw__random_seed(seed, done);
        if (!block_run(batch, keys, block, (double)block / (double)n, job, sum)) break;
        batch->points += block * batch->stride;
        batch->locations += block;
        if (batch->hints) batch->hints += block;
    }
    free(keys);
    return MW_OK;
}

mw_status mw__batch_run(mw_batch *batch, size_t n, uint32_t threads, const mw_progress *progress,
                        mw_counters *counters, mw_error *error)
{
    mw_job job = mw__job(threads, progress);
    mw_counters sum = {0};
    mw_status status = mw__job_end(&job, mw__batch_run_part(batch, n, &job, &sum, error), error);
    if (counters) *counters = sum;
    return status;
}
