/* query.c - cursors, single queries and batches. */
#include "base/hilbert.h"
#include "base/random.h"
#include "base/threads.h"
#include "star/index.h"
#include "star/locate.h"

#include <stdlib.h>

mw_status mw_star_cursor_init(mw_star_cursor *cursor, const mw_star *star, const mw_star_query_options *options,
                              mw_error *error)
{
    static const mw_star_query_options defaults;
    if (!cursor || !star) return mw__fail(error, MW_ERROR_ARGUMENT, "no cursor, or no star");
    if (!options) options = &defaults;
    mw_star_start_kind start = options->start;
    if ((unsigned)options->walk >= MW_STAR_WALK_COUNT) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown walk");
    if ((unsigned)start >= MW_STAR_START_COUNT) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown start");
    if (options->walk == MW_STAR_WALK_ORTHOGONAL && !star->angle)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the orthogonal walk needs a star with angles");
    if (start == MW_STAR_START_AUTO && options->index) start = mw__star_index_start(options->index);
    if (mw_star_start_has_index(start) && !options->index)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the start %s needs its index", mw_star_start_name(start));
    if (options->index && mw__star_index_start(options->index) != start)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the index is one of another start");
    *cursor = (mw_star_cursor){
        .index = options->index,
        .random = mw__random_seed(options->seed, 0),
        .last = MW_NONE,
        .sample = options->sample,
        .walk = (uint8_t)options->walk,
        .start = (uint8_t)start,
        .count = options->count != 0,
    };
    return MW_OK;
}

static mw_location query(const mw_star *star, mw_star_cursor *cursor, const double point[3], mw_star_trace *trace)
{
    mw__surface_enter(star->surface);
    mw_location location =
        mw__star_answer(star, cursor, point, &cursor->last, &cursor->random, &cursor->counters, trace);
    mw__surface_leave(star->surface);
    return location;
}

mw_location mw_star_locate(const mw_star *star, mw_star_cursor *cursor, const double point[3])
{
    return query(star, cursor, point, NULL);
}

size_t mw_star_path(const mw_star *star, mw_star_cursor *cursor, const double point[3], uint32_t *facets,
                    size_t capacity, mw_location *location)
{
    mw_star_trace trace = {.facet = facets, .capacity = facets ? capacity : 0};
    mw_location found = query(star, cursor, point, &trace);
    if (location) *location = found;
    return trace.count;
}

/* --- batches ------------------------------------------------------------------------------------------------------ */

enum {
    CHUNK = 1 << 14,     /* queries that one thread takes at a time     */
    PIECE = 1 << 22,     /* queries sorted at a time: 64 MiB of keys    */
    SORT_WORTHWHILE = 64 /* fewer queries are not sorted by `auto`      */
};

typedef struct batch {
    const mw_star *star;
    const double *points;
    size_t stride;
    const mw_key *order; /* NULL, or order[i].item is the i-th query to answer */
    mw_star_cursor cursor;
    uint64_t seed;
    bool chained; /* each query begins where the one before it in its chunk ended */
    mw_location *locations;
} batch;

/* Queries first .. first + count - 1 (of the order). */
static mw_counters answer(const batch *b, uint32_t first, uint32_t count)
{
    mw_counters counters = {0};
    uint32_t last = MW_NONE;
    for (uint32_t i = first; i < first + count; i++) {
        uint32_t item = b->order ? b->order[i].item : i, none = MW_NONE;
        uint64_t random = mw__random_seed(b->seed, item);
        mw__surface_enter(b->star->surface);
        b->locations[item] = mw__star_answer(b->star, &b->cursor, b->points + item * b->stride,
                                             b->chained ? &last : &none, &random, &counters, NULL);
        mw__surface_leave(b->star->surface);
    }
    return counters;
}

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
#pragma omp critical(mw_star_counters)
#endif
        mw_counters_add(sum, &counters);
    }
}

/* The direction of a query on the regular octahedron, its lower half folded out: a square from -1 to 1. */
static void unfold(const mw_star *star, const double q[3], double *x, double *y)
{
    double d[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = q[k] / 2 - star->centre[k] / 2;
        sum += fabs(d[k]);
    }
    double u = d[0] / sum, v = d[1] / sum;
    bool below = d[2] < 0;
    *x = below ? copysign(1 - fabs(v), u) : u;
    *y = below ? copysign(1 - fabs(u), v) : v;
}

static void sort_queries(const batch *b, size_t n, mw_key *keys, mw_key *scratch)
{
    static const double low[2] = {-1, -1}, high[2] = {1, 1};
    mw_hilbert hilbert = mw__hilbert(low, high);
    for (size_t i = 0; i < n; i++) {
        double x, y;
        unfold(b->star, b->points + i * b->stride, &x, &y);
        keys[i] = (mw_key){mw__hilbert_key(&hilbert, x, y), (uint32_t)i};
    }
    mw__sort_keys(keys, scratch, n);
}

mw_status mw_star_locate_batch(const mw_star *star, const double *points, size_t n, size_t stride,
                               const mw_star_query_options *options, mw_location *locations, mw_counters *counters,
                               mw_error *error)
{
    static const mw_star_query_options defaults;
    if (!options) options = &defaults;
    batch b = {.star = star, .stride = stride ? stride : 3};
    mw_status status = mw_star_cursor_init(&b.cursor, star, options, error);
    if (status) return status;
    if (n && (!points || !locations)) return mw__fail(error, MW_ERROR_ARGUMENT, "no points, or no place for results");
    if (b.stride < 3) return mw__fail(error, MW_ERROR_ARGUMENT, "a stride of %zu holds no x, y, z", b.stride);
    if (b.cursor.start == MW_STAR_START_AUTO && n >= SORT_WORTHWHILE) b.cursor.start = MW_STAR_START_SORTED;
    bool sorted = b.cursor.start == MW_STAR_START_SORTED;
    b.chained = sorted || b.cursor.start == MW_STAR_START_LAST || b.cursor.start == MW_STAR_START_AUTO;

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
        if (sorted) sort_queries(&b, piece, keys, keys + piece);
        answer_piece(&b, (uint32_t)piece, options->threads, &sum);
    }
    free(keys);
    if (counters) *counters = sum;
    return MW_OK;
}
