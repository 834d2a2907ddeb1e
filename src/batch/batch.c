/* batch.c - many queries. A block of them is sorted at a time; within a block the threads take
 * chunks.
 *
 * Counters do not depend on the threads: chunks have a fixed size, and a chunk knows nothing of the
 * one before it. */
#include "batch/batch.h"

#include "base/random.h"
#include "base/threads.h"

#include <stdlib.h>

enum {
    CHUNK = 1 << 14, /* queries that one thread takes at a time  */
    BLOCK = 1 << 22  /* queries sorted at a time: 64 MiB of keys */
};

static void block_answer(const mw_batch *batch, uint32_t n, uint32_t threads, mw_counters *sum)
{
    int64_t chunks = ((int64_t)n + CHUNK - 1) / CHUNK;
    int team = mw__team(threads, chunks);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic) num_threads(team) if (team > 1)
#endif
    for (int64_t i = 0; i < chunks; i++) {
        uint32_t first = (uint32_t)(i * CHUNK);
        mw_counters counters = batch->answer(batch, first, n - first < CHUNK ? n - first : CHUNK);
#ifdef _OPENMP
#pragma omp critical(mw_counters)
#endif
        mw_counters_add(sum, &counters);
    }
}

mw_status mw__batch_run(mw_batch *batch, size_t n, uint32_t threads, mw_counters *counters, mw_error *error)
{
    size_t block = n < BLOCK ? n : BLOCK;
    mw_key *keys = batch->sort ? mw__alloc_lines(2 * block, sizeof *keys) : NULL;
    if (batch->sort && !keys) return mw__fail_memory(error);
    batch->order = keys;
    uint64_t seed = batch->seed;
    mw_counters sum = {0};
    for (size_t done = 0; done < n; done += block) {
        if (n - done < block) block = n - done;
        batch->seed = mw__random_seed(seed, done);
        if (batch->sort) batch->sort(batch, block, keys, keys + block);
        block_answer(batch, (uint32_t)block, threads, &sum);
        batch->points += block * batch->stride;
        batch->locations += block;
    }
    free(keys);
    if (counters) *counters = sum;
    return MW_OK;
}
