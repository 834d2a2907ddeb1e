/* probe_batch.c - many probes: chunks for the threads.
 *
 * Chunks have a fixed size, a chunk knows nothing of the one before it, and the random numbers of a probe come from
 * its own number: so answers and counters do not depend on the threads. Where walks race, the threads are theirs. */
#include "base/random.h"
#include "base/threads.h"
#include "surface/walk.h"

enum { CHUNK = 1 << 12 }; /* probes that one thread takes at a time */

typedef struct batch {
    const mw_prober *prober;
    const double *queries;
    size_t n, stride;
    mw_probe_cursor cursor; /* as each chunk begins with */
    uint64_t seed;
    mw_touch *touches;
} batch;

static mw_probe_counters answer(const batch *b, size_t first)
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

/* Threads for `chunks` chunks: as many as asked for, or as OpenMP gives, but none without work; one where walks
 * race. */
mw_status mw_probe_batch(const mw_prober *prober, const double *queries, size_t n, size_t stride,
                         const mw_probe_options *options, mw_touch *touches, mw_probe_counters *counters,
                         mw_error *error)
{
    batch b = {.prober = prober, .queries = queries, .n = n, .stride = stride ? stride : 6, .touches = touches};
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
        mw_probe_counters more = answer(&b, (size_t)i * CHUNK);
#ifdef _OPENMP
#pragma omp critical(mw_probe_counters)
#endif
        mw_probe_counters_add(&sum, &more);
    }
    if (counters) *counters = sum;
    return MW_OK;
}
