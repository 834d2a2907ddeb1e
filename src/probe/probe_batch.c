/* probe_batch.c - many probes, in chunks for the threads.
 *
 * Chunks have a fixed size and are independent of each other, and the number of a probe seeds its
 * random numbers. So answers and counters do not depend on the threads. If walks race, the races
 * use the threads. */
#include "base/random.h"
#include "base/threads.h"
#include "probe/plane_walk.h"

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
    for (size_t i = first; i < end; i++) {
        const double *query = b->queries + i * b->stride;
        cursor.random = mw__random_seed(b->seed, i);
        b->touches[i] = mw_probe(b->prober, &cursor, query, query + 3);
    }
    return cursor.counters;
}

/* The number of threads for `chunks` chunks: as requested, or OpenMP's choice, but none without
 * work; one if walks race. */
mw_status mw_probe_batch(const mw_prober *prober, const double *queries, size_t n, size_t stride,
                         const mw_probe_options *options, mw_touch *touches, mw_probe_counters *counters,
                         mw_error *error)
{
    probe_batch b = {.prober = prober, .queries = queries, .n = n, .stride = stride ? stride : 6, .touches = touches};
    mw_status status = mw_probe_cursor_init(prober, options, &b.cursor, error);
    if (status) return status;
    if (n && (!queries || !touches)) return mw__fail(error, MW_ERROR_ARGUMENT, "no queries, or no place for results");
    if (b.stride < 6) return mw__fail(error, MW_ERROR_ARGUMENT, "a stride below 6 holds no point and motion");
    b.seed = b.cursor.options.seed;
    int64_t chunks = (int64_t)(n / CHUNK + (n % CHUNK != 0));
    bool races = b.cursor.options.race > 1 && !b.cursor.options.certain;
    int team = mw__team(races ? 1 : b.cursor.options.threads, chunks);
    (void)team; /* unused without OpenMP */
    mw_probe_counters sum = {0};
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic) num_threads(team) if (team > 1)
#endif
    for (int64_t i = 0; i < chunks; i++) {
        mw_probe_counters more = probe_batch_answer(&b, (size_t)i * CHUNK);
#ifdef _OPENMP
#pragma omp critical(mw_probe_counters)
#endif
        mw_probe_counters_add(&sum, &more);
    }
    if (counters) *counters = sum;
    return MW_OK;
}
