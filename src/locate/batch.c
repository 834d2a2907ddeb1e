/* batch.c - many queries: chunks for the threads, lanes of walks in flight within a chunk.
 *
 * Answers are exact and therefore the same for any threads, lanes and order. The counters too do not depend on the
 * threads: chunks have a fixed size, and the random numbers of a query come from its own number. */
#include "base/hilbert.h"
#include "base/random.h"
#include "base/threads.h"
#include "locate/locator.h"
#include "start/start.h"

#include <stdlib.h>

enum {
    CHUNK = 1 << 14,      /* queries that one thread takes at a time                                      */
    PIECE = 1 << 22,      /* queries sorted at a time: 64 MiB of keys                                     */
    SORT_WORTHWHILE = 64, /* fewer queries are not sorted by `auto`                                       */
    CACHE = 1 << 20       /* bytes of tiles and points that second-level caches commonly hold             */
};

typedef struct batch {
    const mw_locator *locator;
    const double *points;
    size_t stride;
    const mw_key *order; /* NULL, or order[i].item is the i-th query to answer */
    mw_cursor cursor;    /* resolved options                                   */
    uint64_t seed;
    uint32_t lanes;
    bool chained; /* each query begins where the one before it in its lane ended */
    mw_location *locations;
} batch;

/* The queries of one chunk, shared out to the lanes: lane i answers from next[i] to before end[i]. */
typedef struct chunk {
    mw_feed feed;
    const batch *batch;
    uint32_t next[MW_MAX_LANES], end[MW_MAX_LANES], query[MW_MAX_LANES], last[MW_MAX_LANES];
    mw_work work[MW_MAX_LANES];
    mw_counters counters;
} chunk;

/* Sorted queries lie anywhere in the caller's arrays: have those of a few queries later on their way. */
static MW_INLINE void fetch_ahead(const batch *b, uint32_t query, uint32_t end)
{
    enum { AHEAD = 8 };
    if (query + AHEAD >= end) return;
    uint32_t later = b->order[query + AHEAD].item;
    __builtin_prefetch(&b->points[later * b->stride]);
    __builtin_prefetch(&b->locations[later], 1);
}

/* Put the next query of a lane into *walk; queries that are no points are answered on the way. */
static bool depart(chunk *c, uint32_t lane, mw_walk *walk)
{
    const batch *b = c->batch;
    while (c->next[lane] < c->end[lane]) {
        uint32_t query = c->next[lane]++;
        if (b->order) {
            fetch_ahead(b, query, c->end[lane]);
            query = b->order[query].item;
        }
        mw_point q = {b->points[query * b->stride], b->points[query * b->stride + 1]};
        if (MW_UNLIKELY(!isfinite(q.x) || !isfinite(q.y))) {
            b->locations[query] = mw__nowhere(MW_BAD);
            continue;
        }
        uint64_t random = mw__random_seed(b->seed, query);
        *walk = mw__depart(b->locator, &b->cursor, c->last[lane], q, &random, &c->work[lane]);
        c->query[lane] = query;
        return true;
    }
    return false;
}

static bool deliver(mw_feed *feed, uint32_t lane, mw_walk *walk, mw_verdict verdict)
{
    chunk *c = (chunk *)feed; /* the feed is its first member */
    const batch *b = c->batch;
    if (verdict != MW_GO) {
        b->locations[c->query[lane]] = mw__conclude(b->locator, &b->cursor, walk, verdict, &c->counters);
        if (b->chained) c->last[lane] = walk->t;
    }
    return depart(c, lane, walk);
}

/* Answer the queries first .. first + count - 1 (of the order). */
static mw_counters answer(const batch *b, uint32_t first, uint32_t count)
{
    chunk c;
    c.feed.deliver = deliver;
    c.batch = b;
    c.counters = (mw_counters){0};
    uint32_t lanes = b->lanes < count ? b->lanes : count;
    for (uint32_t i = 0; i < lanes; i++) {
        c.next[i] = first + (uint32_t)((uint64_t)count * i / lanes);
        c.end[i] = first + (uint32_t)((uint64_t)count * (i + 1) / lanes);
        c.last[i] = b->chained ? MW_NONE : b->cursor.last;
    }
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)b->cursor.walk, &b->locator->tiling);
    bool exact = b->cursor.arithmetic == MW_EXACT;
    if (lanes == 1) {
        mw_walk walk;
        mw_verdict verdict = MW_GO;
        while (deliver(&c.feed, 0, &walk, verdict)) verdict = kernels->run[exact][b->cursor.count](&walk);
    } else {
        kernels->ring[exact][b->cursor.count](&c.feed, lanes);
    }
    return c.counters;
}

static void raise(uint64_t *most, uint64_t value)
{
    if (value > *most) *most = value;
}

void mw_counters_add(mw_counters *sum, const mw_counters *more)
{
    sum->queries += more->queries;
    sum->triangles_visited += more->triangles_visited;
    raise(&sum->triangles_max, more->triangles_max);
    sum->triangles_init += more->triangles_init;
    sum->triangles += more->triangles;
    raise(&sum->triangles_walk_max, more->triangles_walk_max);
    sum->triangles_final += more->triangles_final;
    raise(&sum->triangles_final_max, more->triangles_final_max);
    sum->orient_init += more->orient_init;
    sum->orient += more->orient;
    sum->orient_final += more->orient_final;
    sum->implicit += more->implicit;
    sum->comparisons += more->comparisons;
    sum->walk_runs += more->walk_runs;
    sum->border_runs += more->border_runs;
    sum->triangles_border += more->triangles_border;
    raise(&sum->triangles_border_max, more->triangles_border_max);
    sum->orient_border += more->orient_border;
    sum->border_edges += more->border_edges;
    raise(&sum->border_edges_max, more->border_edges_max);
    sum->cycles += more->cycles;
    sum->handovers += more->handovers;
}

/* Answer one piece of the batch, chunk by chunk on all threads. */
static void answer_piece(const batch *b, uint32_t n, uint32_t threads, mw_counters *sum)
{
    int64_t chunks = ((int64_t)n + CHUNK - 1) / CHUNK;
    int team = mw__team(threads, chunks);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic) num_threads(team) if (team > 1)
#endif
    for (int64_t i = 0; i < chunks; i++) {
        uint32_t first = (uint32_t)(i * CHUNK);
        mw_counters counters = answer(b, first, n - first < CHUNK ? n - first : CHUNK);
#ifdef _OPENMP
#pragma omp critical(mw_counters)
#endif
        mw_counters_add(sum, &counters);
    }
}

/* Walks in flight hide the time that memory takes. A chained query stays near the one before it, in cache already. */
static uint32_t choose_lanes(const mw_locator *locator, const mw_query_options *options, bool chained)
{
    if (options->lanes) return options->lanes < MW_MAX_LANES ? options->lanes : MW_MAX_LANES;
    size_t bytes = locator->tiling.tri_count * sizeof(mw_triangle) + locator->tiling.point_count * sizeof(mw_point);
    return chained || bytes < CACHE ? 1 : 32;
}

mw_status mw_locate_batch(const mw_locator *locator, const double *points, size_t n, size_t stride,
                          const mw_query_options *options, mw_location *locations, mw_counters *counters,
                          mw_error *error)
{
    static const mw_query_options defaults;
    if (!options) options = &defaults;
    batch b = {.locator = locator,
               .points = points,
               .stride = stride ? stride : 2,
               .locations = locations,
               .seed = options->seed};
    mw_status status = mw_cursor_init(&b.cursor, locator, options, error);
    if (status) return status;
    if (n && (!points || !locations)) return mw__fail(error, MW_ERROR_ARGUMENT, "no points, or no place for results");
    if (b.stride == 1) return mw__fail(error, MW_ERROR_ARGUMENT, "a stride of 1 holds no y");
    if (b.cursor.start == MW_START_AUTO && n >= SORT_WORTHWHILE) b.cursor.start = MW_START_SORTED;
    bool sorted = b.cursor.start == MW_START_SORTED;
    b.chained = sorted || b.cursor.start == MW_START_LAST || b.cursor.start == MW_START_AUTO;
    b.lanes = choose_lanes(locator, options, b.chained);

    size_t piece = n < PIECE ? n : PIECE;
    mw_key *keys = sorted ? mw__alloc(2 * piece, sizeof *keys) : NULL;
    if (sorted && !keys) return mw__fail_memory(error);
    b.order = keys;
    mw_counters sum = {0};
    for (size_t done = 0; done < n; done += piece) {
        if (n - done < piece) piece = n - done;
        b.points = points + done * b.stride;
        b.locations = locations + done;
        b.seed = mw__random_seed(options->seed, done); /* the queries of each piece are numbered from 0 */
        if (sorted) mw__sort_queries(b.points, piece, b.stride, locator->low, locator->high, keys, keys + piece);
        answer_piece(&b, (uint32_t)piece, options->threads, &sum);
    }
    free(keys);
    if (counters) *counters = sum;
    return MW_OK;
}
