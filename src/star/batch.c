/* batch.c - many queries: one after the other within the chunk of a thread. */
#include "base/batch.h"
#include "base/random.h"
#include "star/locate.h"

typedef struct batch {
    mw_batch queries;
    const mw_star *star;
    mw_star_cursor cursor; /* resolved options */
    bool chained;          /* each query begins where the one before it in its chunk ended */
} batch;

static mw_counters answer(const mw_batch *queries, uint32_t first, uint32_t count)
{
    const batch *b = (const batch *)queries; /* its first member */
    mw_counters counters = {0};
    uint32_t last = MW_NONE;
    for (uint32_t i = first; i < first + count; i++) {
        uint32_t item = queries->order ? queries->order[i].item : i, none = MW_NONE;
        uint64_t random = mw__random_seed(queries->seed, item);
        mw__surface_enter(b->star->surface);
        queries->locations[item] = mw__star_answer(b->star, &b->cursor, queries->points + item * queries->stride,
                                                   b->chained ? &last : &none, &random, &counters, NULL);
        mw__surface_leave(b->star->surface);
    }
    return counters;
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

/* Along a Hilbert curve of that square. */
static void sort(const mw_batch *queries, size_t n, mw_key *keys, mw_key *scratch)
{
    static const double low[2] = {-1, -1}, high[2] = {1, 1};
    const mw_star *star = ((const batch *)queries)->star;
    mw_hilbert hilbert = mw__hilbert(low, high);
    for (size_t i = 0; i < n; i++) {
        double x, y;
        unfold(star, queries->points + i * queries->stride, &x, &y);
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
    mw_status status = mw_star_cursor_init(&b.cursor, star, options, error);
    if (status) return status;
    if (n && (!points || !locations)) return mw__fail(error, MW_ERROR_ARGUMENT, "no points, or no place for results");
    if (b.queries.stride < 3) return mw__fail(error, MW_ERROR_ARGUMENT, "a stride of %zu holds no x, y, z", stride);
    if (b.cursor.start == MW_STAR_START_AUTO && n >= MW_SORT_WORTHWHILE) b.cursor.start = MW_STAR_START_SORTED;
    bool sorted = b.cursor.start == MW_STAR_START_SORTED;
    b.chained = sorted || b.cursor.start == MW_STAR_START_LAST || b.cursor.start == MW_STAR_START_AUTO;
    b.queries.sort = sorted ? sort : NULL;
    return mw__batch_run(&b.queries, n, options->threads, counters, error);
}
