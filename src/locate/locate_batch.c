/* locate_batch.c - many queries. Each thread takes chunks of them; in a chunk several walks take
 * turns, one in each lane. Queries that may take the fast path do so (interleaved.c).
 *
 * Answers are exact and therefore the same for any threads, lanes and order. The counters too do
 * not depend on the threads: chunks have a fixed size, and the random numbers of a query come from
 * its own number (batch/batch.c). */
#include "batch/batch.h"
#include "base/random.h"
#include "locate/conclude.h"
#include "locate/fast_path.h"
#include "locate/hints.h"
#include "locate/index.h"
#include "locate/interleaved.h"
#include "locate/query.h"
#include "locate/batch_profile.h"
#include "start/start.h"

typedef struct locate_batch {
    mw_batch queries;
    const mw_locator *locator;
    mw_cursor cursor;      /* resolved options */
    uint32_t lanes, asked; /* walks at a time; 0, or as many as the options ask for */
    bool chained;          /* each query begins where the one before it in its lane ended */
    bool guided;           /* the locator's guide was chosen for the start                */
    bool fast;             /* interleaved.c answers them                                  */
} locate_batch;

/* The queries of one chunk, divided among the lanes: lane i answers queries next[i] to end[i] - 1.
 */
typedef struct batch_chunk {
    mw_feed feed;
    const locate_batch *batch;
    uint32_t next[MW_MAX_LANES], end[MW_MAX_LANES], query[MW_MAX_LANES], last[MW_MAX_LANES];
    mw_work work[MW_MAX_LANES];
    mw_counters counters;
} batch_chunk;

/* Sorted queries may lie anywhere in the caller's arrays: prefetch those that come a few queries
 * later. */
static MW_INLINE void chunk_prefetch_query(const mw_batch *b, uint32_t query, uint32_t end)
{
    enum { AHEAD = 8 };
    if (query + AHEAD >= end) return;
    uint32_t later = b->order[query + AHEAD].item;
    __builtin_prefetch(&b->points[later * b->stride]);
    __builtin_prefetch(&b->locations[later], 1);
}

static mw_walk chunk_begin_walk(batch_chunk *c, uint32_t lane, uint32_t query, mw_point q)
{
    const locate_batch *b = c->batch;
    uint64_t random = mw__random_seed(b->queries.seed, query);
    const uint32_t *hints = b->queries.hints;
    uint32_t t = hints ? mw__hint_first(b->locator, &b->cursor, hints[query], q) : MW_NONE;
    return t == MW_NONE
               ? mw__query_begin(b->locator, &b->cursor, c->last[lane], q, &random, &c->work[lane])
               : mw__query_begin_at(b->locator, &b->cursor, t, q, &random, &c->work[lane]);
}

/* Put the next query of a lane into *walk. Queries that are not finite are answered here. */
static bool chunk_next_query(batch_chunk *c, uint32_t lane, mw_walk *walk)
{
    const locate_batch *b = c->batch;
    const mw_batch *queries = &b->queries;
    while (c->next[lane] < c->end[lane]) {
        uint32_t query = c->next[lane]++;
        if (queries->order) {
            chunk_prefetch_query(queries, query, c->end[lane]);
            query = queries->order[query].item;
        }
        mw_point q = {queries->points[query * queries->stride],
                      queries->points[query * queries->stride + 1]};
        if (MW_UNLIKELY(!isfinite(q.x) || !isfinite(q.y))) {
            queries->locations[query] = mw__location_nowhere(MW_BAD);
            continue;
        }
        *walk = chunk_begin_walk(c, lane, query, q);
        c->query[lane] = query;
        return true;
    }
    return false;
}

static bool chunk_deliver(mw_feed *feed, uint32_t lane, mw_walk *walk, mw_verdict verdict)
{
    batch_chunk *c = (batch_chunk *)feed; /* the feed is its first member */
    const locate_batch *b = c->batch;
    if (verdict != MW_VERDICT_GO_ON) {
        b->queries.locations[c->query[lane]] =
            mw__query_conclude(b->locator, &b->cursor, walk, verdict, &c->counters);
        if (b->chained) c->last[lane] = walk->t;
    }
    return chunk_next_query(c, lane, walk);
}

/* Is each query of a chunk so near the one before it that the guide would lead no nearer? */
static bool chunk_is_dense(const locate_batch *b, uint32_t first, uint32_t count)
{
    enum { FEW = 2 * MW_GROUP_LANES };
    const mw_batch *queries = &b->queries;
    if (!b->guided || b->cursor.start == MW_START_CHAINS || queries->hints || count < FEW)
        return false;
    return mw__queries_are_dense(
        b->locator,
        &(mw_queries){queries->points + first * queries->stride, count, queries->stride});
}

/* Answer a chunk on the fast path. Where each query is close to the one before it, few walks wait
 * for memory; then fewer lanes with longer ranges are quicker. */
static void chunk_answer_fast(const locate_batch *b, uint32_t first, uint32_t count, bool dense)
{
    uint32_t lanes = dense && !b->asked ? MW_GROUP_LANES : b->lanes;
    mw__locate_interleaved(
        &(mw_interleaved){&b->queries, b->locator, &b->cursor, b->chained || dense, false}, first,
        count, lanes);
}

/* Share the queries of a chunk out to the lanes, and walk. Where each query is close to the one
 * before it, one walk after the other finds everything in the cache. */
static mw_counters chunk_answer_by_walks(const locate_batch *b, uint32_t first, uint32_t count,
                                         bool dense)
{
    batch_chunk c;
    c.feed.deliver = chunk_deliver;
    c.batch = b;
    c.counters = (mw_counters){0};
    uint32_t lanes = dense && !b->asked ? 1 : b->lanes < count ? b->lanes : count;
    for (uint32_t i = 0; i < lanes; i++) {
        c.next[i] = first + (uint32_t)((uint64_t)count * i / lanes);
        c.end[i] = first + (uint32_t)((uint64_t)count * (i + 1) / lanes);
        c.last[i] = b->chained ? MW_NONE : b->cursor.last;
    }
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)b->cursor.walk, &b->locator->tiling);
    bool exact = b->cursor.arithmetic == MW_EXACT;
    if (lanes == 1) {
        mw_walk walk;
        mw_verdict verdict = MW_VERDICT_GO_ON;
        while (chunk_deliver(&c.feed, 0, &walk, verdict))
            verdict = kernels->run[exact][b->cursor.count](&walk);
    } else {
        kernels->ring[exact][b->cursor.count](&c.feed, lanes);
    }
    return c.counters;
}

static mw_counters chunk_answer(const mw_batch *queries, uint32_t first, uint32_t count)
{
    const locate_batch *b = (const locate_batch *)queries; /* its first member */
    bool dense = chunk_is_dense(b, first, count);
    mw_counters counters = {0};
    if (b->fast)
        chunk_answer_fast(b, first, count, dense);
    else
        counters = chunk_answer_by_walks(b, first, count, dense);
    if (queries->hints) mw__hints_update(&queries->locations[first], count, &queries->hints[first]);
    return counters;
}

/* Sort queries along a Hilbert curve. */
static void batch_sort(const mw_batch *queries, size_t n, mw_key *keys, mw_key *scratch,
                       mw_job *job)
{
    (void)job;
    const mw_locator *locator = ((const locate_batch *)queries)->locator;
    mw__sort_queries(queries->points, n, queries->stride, locator->low, locator->high, keys,
                     scratch);
}

/* Do walks begin near their queries, so that they touch the mesh there only? */
static bool batch_begins_near(const locate_batch *b)
{
    return b->cursor.index != NULL || b->cursor.start == MW_START_AUTO || b->queries.hints;
}

/* Walks that take turns hide the time that memory takes. The slower the memory, the more of them
 * are needed. Uniform queries, ns each in 8, 16 and 32 lanes: 43, 47, 48 in 80 KB of tiles and
 * points, 52, 51, 63 in 0.8 MB, 55, 48, 55 in 4 MB, 100, 77, 70 in 8 MB, 179, 109, 88 in 80 MB,
 * where the second-level cache has 0.5 MB. The ring of single walks gains nothing as long as all is
 * in that. A chained query stays near the one before it, in cache already; side by side several go
 * faster even so. */
static uint32_t batch_choose_lanes(const locate_batch *b, size_t n)
{
    static const uint8_t lanes[2][3] = {{1, 16, 32}, {8, 16, 32}};
    if (b->chained) return lanes[b->fast][MW_CACHE_OWN];
    mw_caches caches = mw__caches();
    mw_queries queries = {b->queries.points, n, b->queries.stride};
    mw_cache_level level = batch_begins_near(b)
                               ? mw__cache_level_of_queries(b->locator, &caches, &queries)
                               : mw__cache_level_of_mesh(b->locator, &caches);
    return lanes[b->fast][level];
}

/* With fewer than two queries for each lane, use fewer lanes: a lane with one query would end
 * before the others do. */
static uint32_t batch_limit_lanes(uint32_t lanes, size_t n)
{
    size_t most = (n / 2 + MW_GROUP_LANES - 1) / MW_GROUP_LANES * MW_GROUP_LANES;
    if (most < MW_GROUP_LANES) return MW_GROUP_LANES;
    return lanes < most ? lanes : (uint32_t)most;
}

/* Does interleaved.c answer? */
static bool batch_is_fast(const locate_batch *b, const mw_query_options *options)
{
    if (options->lanes && options->lanes < MW_GROUP_LANES) return false;
    return mw__has_fast_path(&b->locator->tiling, options) && b->cursor.start != MW_START_AUTO;
}

/* A query with a hint begins at its hint, not where the query before it ended. A query without one
 * does not begin there either: its answer's counters must not depend on other queries. */
static void batch_choose_start_beside_hints(locate_batch *b)
{
    mw_start_kind start = (mw_start_kind)b->cursor.start;
    if (start == MW_START_AUTO || start == MW_START_SORTED || start == MW_START_LAST)
        b->cursor.start = MW_START_SAMPLE;
}

/* Choose how queries begin if the caller leaves it open: by the locator's guide if there is one.
 * Otherwise large batches are sorted, unless their order is good already, and small ones begin
 * where the query before ended or at the nearest of a sample. */
static void batch_choose_start(locate_batch *b, size_t n)
{
    if (b->cursor.start != MW_START_AUTO) return;
    /* with fewer tiles for each query than this, it is not far from query to query */
    enum { TILES_PER_QUERY = 128 };
    const mw_index *guide = &b->locator->guide;
    const bool sorts = guide->sort_batches && !b->queries.hints &&
                       n >= b->locator->tiling.tri_count / TILES_PER_QUERY;
    b->guided = guide->start != MW_START_AUTO && !sorts;
    if (b->guided) {
        b->cursor.start = (uint8_t)guide->start;
        b->cursor.index = guide;
    } else if (n >= MW_SORT_WORTHWHILE && !b->queries.hints) {
        mw_queries queries = {b->queries.points, n, b->queries.stride};
        b->cursor.start =
            mw__queries_are_in_order(b->locator, &queries) ? MW_START_LAST : MW_START_SORTED;
    }
}

static mw_status batch_run(locate_batch *b, size_t n, const mw_query_options *options,
                           mw_counters *counters, mw_error *error)
{
    mw_start_kind start = (mw_start_kind)b->cursor.start;
    b->chained = start == MW_START_SORTED || start == MW_START_LAST || start == MW_START_AUTO;
    b->fast = batch_is_fast(b, options);
    b->asked = options->lanes < MW_MAX_LANES ? options->lanes : MW_MAX_LANES;
    b->lanes = b->asked ? b->asked : batch_choose_lanes(b, n);
    if (b->fast)
        b->lanes = b->asked ? b->asked - b->asked % MW_GROUP_LANES : batch_limit_lanes(b->lanes, n);
    b->queries.sort = start == MW_START_SORTED ? batch_sort : NULL;
    return mw__batch_run(&b->queries, n, options->threads, options->progress, counters, error);
}

mw_status mw_locate_batch(const mw_locator *locator, const double *points, size_t n, size_t stride,
                          const mw_query_options *options, mw_location *locations,
                          mw_counters *counters, mw_error *error)
{
    static const mw_query_options defaults;
    if (!options) options = &defaults;
    locate_batch b = {.queries = {.points = points,
                                  .locations = locations,
                                  .hints = options->hints,
                                  .stride = stride ? stride : 2,
                                  .seed = options->seed,
                                  .answer = chunk_answer},
                      .locator = locator};
    mw_status status = mw_cursor_init(locator, options, &b.cursor, error);
    if (status) return status;
    if (n && (!points || !locations))
        return mw__fail(error, MW_ERROR_ARGUMENT, "points or results are NULL");
    if (b.queries.stride == 1)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the stride must be at least 2 (x and y), not 1");
    batch_choose_start(&b, n);
    if (options->hints) batch_choose_start_beside_hints(&b);
    return batch_run(&b, n, options, counters, error);
}
