/* borrowed_batch.c - many queries in the caller's arrays. */
#include "batch/batch.h"
#include "borrow/borrowed_locate.h"
#include "locate/location.h"
#include "start/start.h"

typedef struct borrowed_batch {
    mw_batch queries; /* the first member: see batch.h */
    const mw_borrowed *mesh;
    mw_borrowed_cursor cursor;
} borrowed_batch;

/* Each query of a chunk but the first begins where the one before it ended. */
static mw_counters borrowed_batch_answer(const mw_batch *queries, uint32_t first, uint32_t count)
{
    const borrowed_batch *b = (const borrowed_batch *)queries;
    mw_borrowed_cursor cursor = b->cursor;
    bool chained = false;
    for (uint32_t i = first; i < first + count; i++) {
        uint32_t item = queries->order ? queries->order[i].item : i;
        const double *q = queries->points + item * queries->stride;
        if (!isfinite(q[0]) || !isfinite(q[1])) {
            queries->locations[item] = mw__location_nowhere(MW_BAD);
            continue;
        }
        queries->locations[item] =
            mw__borrowed_locate(b->mesh, &cursor, (mw_point){q[0], q[1]}, chained);
        chained = queries->order != NULL;
    }
    return cursor.counters;
}

static void borrowed_batch_sort(const mw_batch *queries, size_t n, mw_key *keys, mw_key *scratch,
                                mw_job *job)
{
    (void)job;
    const mw_borrowed *mesh = ((const borrowed_batch *)queries)->mesh;
    mw__sort_queries(queries->points, n, queries->stride, mesh->low, mesh->high, keys, scratch);
}

static void borrowed_batch_nowhere(const mw_batch *queries, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const double *q = queries->points + i * queries->stride;
        bool bad = !isfinite(q[0]) || !isfinite(q[1]);
        queries->locations[i] = mw__location_nowhere(bad ? MW_BAD : MW_OUTSIDE);
    }
}

mw_status mw_borrowed_locate_batch(const mw_borrowed *mesh, const double *points, size_t n,
                                   size_t stride, const mw_borrowed_query_options *options,
                                   mw_location *locations, mw_counters *counters, mw_error *error)
{
    static const mw_borrowed_query_options defaults;
    if (!options) options = &defaults;
    borrowed_batch b = {.queries = {.points = points,
                                    .locations = locations,
                                    .stride = stride ? stride : 2,
                                    .seed = options->seed,
                                    .answer = borrowed_batch_answer},
                        .mesh = mesh};
    mw_status status = mw_borrowed_cursor_init(options, &b.cursor, error);
    if (status) return status;
    if (!mesh) return mw__fail(error, MW_ERROR_ARGUMENT, "no mesh");
    if (n && (!points || !locations))
        return mw__fail(error, MW_ERROR_ARGUMENT, "points or results are NULL");
    if (b.queries.stride == 1)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the stride must be at least 2 (x and y), not 1");
    if (mesh->tri_count == 0) borrowed_batch_nowhere(&b.queries, n);
    if (!options->in_order && n >= MW_SORT_WORTHWHILE) b.queries.sort = borrowed_batch_sort;
    return mw__batch_run(&b.queries, mesh->tri_count ? n : 0, options->threads, options->progress,
                         counters, error);
}
