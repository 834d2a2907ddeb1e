/* probe_batch.c - many probes, in chunks for the threads.
 *
 * Chunks have a fixed size and are independent of each other, and the number of a probe seeds its
 * random numbers. So answers and counters do not depend on the threads. If walks race, the races
 * use the threads. */
#include "base/job.h"
#include "base/posix.h"
#include "base/random.h"
#include "probe/plane_walk.h"
#include "probe/ray.h"

enum { CHUNK = 1 << 12 }; /* probes that one thread takes at a time */

typedef struct probe_batch {
    const mw_prober *prober;
    const double *queries;
    size_t n, stride;
    mw_probe_cursor cursor; /* at the start of each chunk */
    uint64_t seed;
    mw_touch *touches;
} probe_batch;

static mw_probe_counters probe_batch_answer(const probe_batch *b, size_t first)
{
    mw_probe_cursor cursor = b->cursor;
    size_t end = b->n - first < CHUNK ? b->n : first + CHUNK;
    for (size_t i = first; cursor.options.certain && i < end; i += MW_PROBE_BLOCK) {
        uint32_t n = (uint32_t)(end - i < MW_PROBE_BLOCK ? end - i : MW_PROBE_BLOCK);
        mw__probe_certain_block(b->prober, &cursor, b->queries + i * b->stride, b->stride, n,
                                b->touches + i);
    }
    for (size_t i = first; !cursor.options.certain && i < end; i++) {
        const double *query = b->queries + i * b->stride;
        cursor.random = mw__random_seed(b->seed, i);
        b->touches[i] = mw_probe(b->prober, &cursor, query, query + 3);
    }
    return cursor.counters;
}

typedef struct probe_loop {
    const probe_batch *batch;
    pthread_mutex_t lock;
    mw_probe_counters sum; /* of the chunks that are done */
} probe_loop;

static void probe_loop_answer(void *work, uint64_t chunk, uint32_t member)
{
    probe_loop *loop = work;
    (void)member;
    mw_probe_counters more = probe_batch_answer(loop->batch, (size_t)chunk * CHUNK);
    pthread_mutex_lock(&loop->lock);
    mw_probe_counters_add(&loop->sum, &more);
    pthread_mutex_unlock(&loop->lock);
}

/* If walks race, the races use the threads. */
static mw_probe_counters probe_batch_run(const probe_batch *b, mw_job *job)
{
    uint64_t chunks = b->n / CHUNK + (b->n % CHUNK != 0);
    bool races = b->cursor.options.race > 1 && !b->cursor.options.certain;
    probe_loop loop = {.batch = b};
    mw__job_stage(job, "answering queries", 1);
    pthread_mutex_init(&loop.lock, NULL);
    mw__job_chunks(job, races ? 1 : mw__job_team(job, chunks), chunks, probe_loop_answer, &loop);
    pthread_mutex_destroy(&loop.lock);
    return loop.sum;
}

mw_status mw_probe_batch(const mw_prober *prober, const double *queries, size_t n, size_t stride,
                         const mw_probe_options *options, mw_touch *touches,
                         mw_probe_counters *counters, mw_error *error)
{
    probe_batch b = {.prober = prober,
                     .queries = queries,
                     .n = n,
                     .stride = stride ? stride : 6,
                     .touches = touches};
    mw_status status = mw_probe_cursor_init(prober, options, &b.cursor, error);
    if (status) return status;
    if (n && (!queries || !touches))
        return mw__fail(error, MW_ERROR_ARGUMENT, "queries or results are NULL");
    if (b.stride < 6)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the stride must be at least 6 (point and motion)");
    b.seed = b.cursor.options.seed;
    mw_job job = mw__job(b.cursor.options.threads, b.cursor.options.progress);
    mw_probe_counters sum = probe_batch_run(&b, &job);
    if (counters) *counters = sum;
    return mw__job_end(&job, MW_OK, error);
}
