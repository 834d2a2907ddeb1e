/* batch.c - many queries: lanes of walks in flight within the chunk of a thread. Plain ones take the fast way (flight.c).
 *
 * Answers are exact and therefore the same for any threads, lanes and order. The counters too do not depend on the
 * threads: chunks have a fixed size, and the random numbers of a query come from its own number (base/batch.c). */
#include "base/batch.h"
#include "base/random.h"
#include "locate/flight.h"
#include "locate/index.h"
#include "start/start.h"

enum { CACHE = 1 << 20 }; /* bytes of tiles and points that second-level caches commonly hold */

typedef struct batch {
    mw_batch queries;
    const mw_locator *locator;
    mw_cursor cursor; /* resolved options */
    uint32_t lanes;
    bool chained; /* each query begins where the one before it in its lane ended */
    bool plain;   /* flight.c answers them                                       */
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
static MW_INLINE void fetch_ahead(const mw_batch *b, uint32_t query, uint32_t end)
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
    const mw_batch *queries = &b->queries;
    while (c->next[lane] < c->end[lane]) {
        uint32_t query = c->next[lane]++;
        if (queries->order) {
            fetch_ahead(queries, query, c->end[lane]);
            query = queries->order[query].item;
        }
        mw_point q = {queries->points[query * queries->stride], queries->points[query * queries->stride + 1]};
        if (MW_UNLIKELY(!isfinite(q.x) || !isfinite(q.y))) {
            queries->locations[query] = mw__nowhere(MW_BAD);
            continue;
        }
        uint64_t random = mw__random_seed(queries->seed, query);
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
        b->queries.locations[c->query[lane]] = mw__conclude(b->locator, &b->cursor, walk, verdict, &c->counters);
        if (b->chained) c->last[lane] = walk->t;
    }
    return depart(c, lane, walk);
}

/* Share the queries of a chunk out to the lanes, and walk. */
static mw_counters answer(const mw_batch *queries, uint32_t first, uint32_t count)
{
    const batch *b = (const batch *)queries; /* its first member */
    if (b->plain) {
        mw__fly(&(mw_flight){queries, b->locator, &b->cursor, b->chained, false}, first, count, b->lanes);
        return (mw_counters){0};
    }
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

/* Along a Hilbert curve. */
static void sort(const mw_batch *queries, size_t n, mw_key *keys, mw_key *scratch)
{
    const mw_locator *locator = ((const batch *)queries)->locator;
    mw__sort_queries(queries->points, n, queries->stride, locator->low, locator->high, keys, scratch);
}

/* Walks in flight hide the time that memory takes. A chained query stays near the one before it, in cache already; side by
 * side several go faster even so. */
static uint32_t choose_lanes(const batch *b, uint32_t asked)
{
    if (asked) return asked < MW_MAX_LANES ? asked : MW_MAX_LANES;
    const mw_tiling *tiling = &b->locator->tiling;
    size_t bytes = tiling->tri_count * sizeof(mw_triangle) + tiling->point_count * sizeof(mw_point);
    if (b->chained) return b->plain ? 8 : 1;
    return bytes < CACHE ? b->plain ? 16 : 1 : 32;
}

/* Does flight.c answer? */
static bool is_plain(const batch *b, const mw_query_options *options)
{
    if (options->lanes && options->lanes < MW_FLIGHT_WIDTH) return false;
    return mw__flies(&b->locator->tiling, options) && b->cursor.start != MW_START_AUTO;
}

/* How queries begin where nothing is said: by the locator's guide, else sorted; few, where the one before ended or at the
 * nearest of a sample. */
static void choose_start(batch *b, size_t n)
{
    if (b->cursor.start != MW_START_AUTO) return;
    const mw_index *guide = &b->locator->guide;
    if (guide->start != MW_START_AUTO) {
        b->cursor.start = (uint8_t)guide->start;
        b->cursor.index = guide;
    } else if (n >= MW_SORT_WORTHWHILE) {
        b->cursor.start = MW_START_SORTED;
    }
}

static mw_status run(batch *b, size_t n, const mw_query_options *options, mw_counters *counters, mw_error *error)
{
    mw_start_kind start = (mw_start_kind)b->cursor.start;
    b->chained = start == MW_START_SORTED || start == MW_START_LAST || start == MW_START_AUTO;
    b->plain = is_plain(b, options);
    b->lanes = choose_lanes(b, options->lanes);
    if (b->plain) b->lanes -= b->lanes % MW_FLIGHT_WIDTH;
    b->queries.sort = start == MW_START_SORTED ? sort : NULL;
    return mw__batch_run(&b->queries, n, options->threads, counters, error);
}

mw_status mw_locate_batch(const mw_locator *locator, const double *points, size_t n, size_t stride,
                          const mw_query_options *options, mw_location *locations, mw_counters *counters,
                          mw_error *error)
{
    static const mw_query_options defaults;
    if (!options) options = &defaults;
    batch b = {.queries = {.points = points,
                           .locations = locations,
                           .stride = stride ? stride : 2,
                           .seed = options->seed,
                           .answer = answer},
               .locator = locator};
    mw_status status = mw_cursor_init(&b.cursor, locator, options, error);
    if (status) return status;
    if (n && (!points || !locations)) return mw__fail(error, MW_ERROR_ARGUMENT, "no points, or no place for results");
    if (b.queries.stride == 1) return mw__fail(error, MW_ERROR_ARGUMENT, "a stride of 1 holds no y");
    choose_start(&b, n);
    return run(&b, n, options, counters, error);
}
