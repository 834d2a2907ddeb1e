/* batch.c - many queries: within the chunk of a thread many walks are in flight. */
#include "batch/batch.h"
#include "base/random.h"
#include "star/locate.h"
#include "star/place.h"

typedef struct batch {
    mw_batch queries;
    const mw_star *star;
    mw_star_cursor cursor; /* resolved options */
    bool chained;          /* each query begins where the one before it in its part ended */
    bool guided;           /* or, if that is farther, where its key on the curve leads    */
} batch;

/* --- one after the other ------------------------------------------------------------------------------------------ */

static const double *point_of(const mw_batch *queries, uint32_t item)
{
    return queries->points + item * queries->stride;
}

static uint32_t item_of(const mw_batch *queries, uint32_t i)
{
    return queries->order ? queries->order[i].item : i;
}

/* Where the i-th query begins that ought to begin at the facet before it, `last`. */
static uint32_t near_facet(const batch *b, uint32_t i, uint32_t last)
{
    return b->guided ? mw__star_by_curve(b->star, b->queries.order[i].key) : last;
}

static void answer_in_turn(const batch *b, uint32_t first, uint32_t end, mw_counters *counters)
{
    uint32_t last = MW_NONE;
    for (uint32_t i = first; i < end; i++) {
        uint32_t item = item_of(&b->queries, i);
        uint64_t random = mw__random_seed(b->queries.seed, item);
        mw__surface_enter(b->star->surface);
        uint32_t begin = near_facet(b, i, last);
        b->queries.locations[item] =
            mw__star_answer(b->star, &b->cursor, point_of(&b->queries, item), &begin, &random, counters, NULL);
        mw__surface_leave(b->star->surface);
        if (b->chained) last = begin;
    }
}

/* --- many in flight ----------------------------------------------------------------------------------------------- */

/* Each lane answers a part of the chunk, one query after the other. */
typedef struct feed {
    mw_star_feed base;
    const batch *b;
    uint32_t next[MW_STAR_LANES], end[MW_STAR_LANES], item[MW_STAR_LANES], last[MW_STAR_LANES];
} feed;

static void prefetch(const mw_batch *queries, uint32_t item)
{
    const char *point = (const char *)point_of(queries, item), *location = (const char *)&queries->locations[item];
    __builtin_prefetch(point);
    __builtin_prefetch(point + 2 * sizeof(double));
    __builtin_prefetch(location, 1);
    __builtin_prefetch(location + sizeof(mw_location) - 1, 1);
}

static bool deliver(mw_star_feed *base, uint32_t lane, mw_star_walk *walk, mw_star_verdict verdict)
{
    feed *f = (feed *)base; /* its first member */
    const batch *b = f->b;
    if (verdict != MW_STAR_GO) {
        mw__star_end(&b->cursor, walk, verdict, &b->queries.locations[f->item[lane]]);
        if (b->chained) f->last[lane] = walk->t;
    }
    while (f->next[lane] < f->end[lane]) {
        uint32_t i = f->next[lane]++, item = f->item[lane] = item_of(&b->queries, i);
        if (f->next[lane] < f->end[lane]) prefetch(&b->queries, item_of(&b->queries, f->next[lane]));
        const double *point = point_of(&b->queries, item);
        if (MW_LIKELY(mw__star_answerable(b->star, point))) {
            uint64_t random = mw__random_seed(b->queries.seed, item);
            mw__star_begin(walk, b->star, &b->cursor, point, near_facet(b, i, f->last[lane]), random, NULL);
            return true;
        }
        b->queries.locations[item] = mw__star_nowhere();
    }
    return false;
}

static void answer_in_flight(const batch *b, uint32_t first, uint32_t count, uint32_t lanes)
{
    feed f = {.base = {deliver}, .b = b};
    for (uint32_t i = 0; i < lanes; i++) {
        f.next[i] = first + (uint32_t)((uint64_t)count * i / lanes);
        f.end[i] = first + (uint32_t)((uint64_t)count * (i + 1) / lanes);
        f.last[i] = MW_NONE;
    }
    mw__star_kernels_of(&b->cursor)->ring(&f.base, lanes);
}

/* --- a chunk ------------------------------------------------------------------------------------------------------ */

/* A part of a chunk is not so short that to find its first facet, which the part before it knows, would cost much. */
#define LEAST_PART 128

/* In parts, which are the same where each query is counted, or passes a gate, and so comes after the one before. */
static mw_counters answer(const mw_batch *queries, uint32_t first, uint32_t count)
{
    const batch *b = (const batch *)queries; /* its first member */
    mw_counters counters = {0};
    uint32_t parts = count / LEAST_PART < MW_STAR_LANES ? count / LEAST_PART : MW_STAR_LANES;
    if (parts > 1 && !b->cursor.count && !b->star->surface->gate) {
        answer_in_flight(b, first, count, parts);
        return counters;
    }
    if (parts == 0) parts = 1;
    for (uint64_t i = 0; i < parts; i++)
        answer_in_turn(b, first + (uint32_t)(count * i / parts), first + (uint32_t)(count * (i + 1) / parts),
                       &counters);
    return counters;
}

/* --- order -------------------------------------------------------------------------------------------------------- */

/* Along a Hilbert curve over the sphere, the same as that of the facets. */
static void sort(const mw_batch *queries, size_t n, mw_key *keys, mw_key *scratch)
{
    static const double low[2] = {-1, -1}, high[2] = {1, 1};
    const mw_star *star = ((const batch *)queries)->star;
    mw_hilbert hilbert = mw__hilbert(low, high);
    for (size_t i = 0; i < n; i++) {
        double d[3], x, y;
        for (int k = 0; k < 3; k++) d[k] = queries->points[i * queries->stride + (size_t)k] / 2 - star->centre[k] / 2;
        mw__star_unfold(d, &x, &y);
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
    batch b = {.queries = {.points = points,
                           .locations = locations,
                           .stride = stride ? stride : 3,
                           .seed = options->seed,
                           .answer = answer},
               .star = star};
    mw_status status = mw_star_cursor_init(star, options, &b.cursor, error);
    if (status) return status;
    if (n && (!points || !locations)) return mw__fail(error, MW_ERROR_ARGUMENT, "no points, or no place for results");
    if (b.queries.stride < 3) return mw__fail(error, MW_ERROR_ARGUMENT, "a stride of %zu holds no x, y, z", stride);
    if (b.cursor.start == MW_STAR_START_AUTO && n >= MW_SORT_WORTHWHILE) b.cursor.start = MW_STAR_START_SORTED;
    bool sorted = b.cursor.start == MW_STAR_START_SORTED;
    b.chained = sorted || b.cursor.start == MW_STAR_START_LAST || b.cursor.start == MW_STAR_START_AUTO;
    b.guided = sorted && n < star->tri_count;
    b.queries.sort = sorted ? sort : NULL;
    return mw__batch_run(&b.queries, n, options->threads, counters, error);
}
