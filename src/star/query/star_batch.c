/* star_batch.c - many queries. A thread interleaves many walks of its chunk. */
#include "batch/batch.h"
#include "base/team_sort.h"
#include "base/random.h"
#include "star/query/star_locate.h"
#include "star/star_location.h"

#include <stdlib.h>

typedef struct star_batch {
    mw_batch queries;
    const mw_star *star;
    mw_star_cursor cursor; /* resolved options */
    bool chained;          /* each query starts where the previous one of its part ended */
    bool guided;           /* or where its key on the curve leads, as that is nearer */
    double *meetings;      /* NULL, or of all queries of the call, as the first locations are */
    const mw_location *first_location;
} star_batch;

/* The query at `point` of the present block has its location: find where its ray ends. */
static void star_batch_meet(const star_batch *b, uint32_t item, const double *point)
{
    const mw_location *location = &b->queries.locations[item];
    if (b->meetings)
        mw__star_meeting(b->star, location, point,
                         b->meetings + 3 * (size_t)(location - b->first_location));
}

/* --- one after the other --- */

static const double *batch_point(const mw_batch *queries, uint32_t item)
{
    return queries->points + item * queries->stride;
}

static uint32_t batch_item(const mw_batch *queries, uint32_t i)
{
    return queries->order ? queries->order[i].item : i;
}

/* The first facet of the i-th query of a star that is up to date. `last`: where the previous query
 * ended. */
static uint32_t star_batch_first_facet(const star_batch *b, uint32_t i, uint32_t last)
{
    return b->guided ? mw__star_guide_facet(b->star, b->queries.order[i].key) : last;
}

static void star_batch_in_turn(const star_batch *b, uint32_t first, uint32_t end,
                               mw_counters *counters)
{
    uint32_t last = MW_NONE;
    for (uint32_t i = first; i < end; i++) {
        uint32_t item = batch_item(&b->queries, i);
        uint64_t random = mw__random_seed(b->queries.seed, item);
        mw__surface_read_lock(b->star->surface);
        uint32_t begin = last;
        if (mw__star_is_current(b->star)) begin = star_batch_first_facet(b, i, last);
        const double *point = batch_point(&b->queries, item);
        b->queries.locations[item] =
            mw__star_query_answer(b->star, &b->cursor, point, &begin, &random, counters, NULL);
        star_batch_meet(b, item, point);
        mw__surface_read_unlock(b->star->surface);
        if (b->chained) last = begin;
    }
}

/* --- many interleaved --- */

/* Each lane answers a part of the chunk, one query after the other. */
typedef struct star_batch_feed {
    mw_star_feed base;
    const star_batch *b;
    uint32_t next[MW_STAR_LANES], end[MW_STAR_LANES], item[MW_STAR_LANES], last[MW_STAR_LANES];
} star_batch_feed;

static void star_batch_prefetch(const mw_batch *queries, uint32_t item)
{
    const char *point = (const char *)batch_point(queries, item),
               *location = (const char *)&queries->locations[item];
    __builtin_prefetch(point);
    __builtin_prefetch(point + 2 * sizeof(double));
    __builtin_prefetch(location, 1);
    __builtin_prefetch(location + sizeof(mw_location) - 1, 1);
}

static bool star_batch_deliver(mw_star_feed *base, uint32_t lane, mw_star_walk *walk,
                               mw_star_verdict verdict)
{
    star_batch_feed *f = (star_batch_feed *)base; /* its first member */
    const star_batch *b = f->b;
    if (verdict != MW_STAR_GO) {
        mw__star_query_end(&b->cursor, walk, verdict, &b->queries.locations[f->item[lane]]);
        star_batch_meet(b, f->item[lane], walk->q);
        if (b->chained) f->last[lane] = walk->t;
    }
    while (f->next[lane] < f->end[lane]) {
        uint32_t i = f->next[lane]++, item = f->item[lane] = batch_item(&b->queries, i);
        if (f->next[lane] < f->end[lane])
            star_batch_prefetch(&b->queries, batch_item(&b->queries, f->next[lane]));
        const double *point = batch_point(&b->queries, item);
        if (MW_LIKELY(mw__star_answerable(b->star, point))) {
            uint64_t random = mw__random_seed(b->queries.seed, item);
            mw__star_query_begin(walk, b->star, &b->cursor, point,
                                 star_batch_first_facet(b, i, f->last[lane]), random, NULL);
            return true;
        }
        b->queries.locations[item] = mw__star_location_none();
        star_batch_meet(b, item, point);
    }
    return false;
}

static void star_batch_interleaved(const star_batch *b, uint32_t first, uint32_t count,
                                   uint32_t lanes)
{
    star_batch_feed f = {.base = {star_batch_deliver}, .b = b};
    for (uint32_t i = 0; i < lanes; i++) {
        f.next[i] = first + (uint32_t)((uint64_t)count * i / lanes);
        f.end[i] = first + (uint32_t)((uint64_t)count * (i + 1) / lanes);
        f.last[i] = MW_NONE;
    }
    mw__star_kernels_of(&b->cursor)->ring(&f.base, lanes);
}

/* --- a chunk --- */

/* Shorter parts would not pay for the search of their first facets. */
#define LEAST_PART 128

/* Answer a chunk in parts. The parts are the same if queries are counted, or take a lock, and so
 * run one after the other. */
static mw_counters star_batch_answer(const mw_batch *queries, uint32_t first, uint32_t count)
{
    const star_batch *b = (const star_batch *)queries; /* its first member */
    mw_counters counters = {0};
    uint32_t parts = count / LEAST_PART < MW_STAR_LANES ? count / LEAST_PART : MW_STAR_LANES;
    if (parts > 1 && !b->cursor.count && !b->star->surface->rwlock && !b->star->borrowed) {
        star_batch_interleaved(b, first, count, parts);
        return counters;
    }
    if (parts == 0) parts = 1;
    for (uint64_t i = 0; i < parts; i++)
        star_batch_in_turn(b, first + (uint32_t)(count * i / parts),
                           first + (uint32_t)(count * (i + 1) / parts), &counters);
    return counters;
}

/* --- order --- */

typedef struct star_batch_keys {
    const mw_batch *queries;
    mw_key *keys;
    const mw_hilbert *curve;
} star_batch_keys;

/* By any thread. */
static void star_batch_make_keys(void *work, uint64_t from, uint64_t to)
{
    const star_batch_keys *b = work;
    const mw_batch *queries = b->queries;
    const mw_star *star = ((const star_batch *)queries)->star; /* its first member */
    for (uint64_t i = from; i < to; i++) {
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = queries->points[i * queries->stride + (size_t)k] / 2 - star->centre[k] / 2;
        b->keys[i] = (mw_key){mw__star_curve_key(b->curve, d), (uint32_t)i};
    }
}

/* Sort queries along a Hilbert curve over the sphere, the same as that of the facets. Where the job
 * is to stop, keys may be missing: nothing is answered any more. */
static void star_batch_sort(const mw_batch *queries, size_t n, mw_key *keys, mw_key *scratch,
                            mw_job *job)
{
    const mw_star *star = ((const star_batch *)queries)->star;
    mw_hilbert own;
    star_batch_keys work = {queries, keys, star->curve};
    if (!star->curve) { /* borrowed */
        own = mw__star_curve();
        work.curve = &own;
    }
    if (mw__job_ranges(job, n, star_batch_make_keys, &work))
        mw__sort_keys_in_team(keys, scratch, n, mw__job_team(job, n >> MW_TEAM_SORT_BITS));
}

mw_status mw__star_answer_rays(const mw_star *star, const mw_star_rays *rays, mw_job *job,
                               mw_counters *sum, mw_error *error)
{
    const size_t n = rays->n, stride = rays->stride ? rays->stride : 3;
    star_batch b = {.queries = {.points = rays->points,
                                .locations = rays->locations,
                                .stride = stride,
                                .seed = rays->options->seed,
                                .answer = star_batch_answer},
                    .star = star,
                    .meetings = rays->meetings,
                    .first_location = rays->locations};
    mw_status status = mw_star_cursor_init(star, rays->options, &b.cursor, error);
    if (status) return status;
    if (n && (!rays->points || !rays->locations))
        return mw__fail(error, MW_ERROR_ARGUMENT, "points or results are NULL");
    if (stride < 3)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the stride must be at least 3 (x, y, z), not %zu", rays->stride);
    if (b.cursor.start == MW_STAR_START_AUTO && n >= MW_SORT_WORTHWHILE)
        b.cursor.start = MW_STAR_START_SORTED;
    bool sorted = b.cursor.start == MW_STAR_START_SORTED;
    b.chained =
        sorted || b.cursor.start == MW_STAR_START_LAST || b.cursor.start == MW_STAR_START_AUTO;
    mw__surface_read_lock(star->surface);
    b.guided = sorted && n < star->facet_count;
    mw__surface_read_unlock(star->surface);
    b.queries.sort = sorted ? star_batch_sort : NULL;
    return mw__batch_run_part(&b.queries, n, job, sum, error);
}

static mw_status star_batch_run(const mw_star *star, const mw_star_rays *rays,
                                mw_counters *counters, mw_error *error)
{
    mw_counters sum = {0};
    mw_job job = mw__job(rays->options->threads, rays->options->progress);
    mw_status status =
        mw__job_end(&job, mw__star_answer_rays(star, rays, &job, &sum, error), error);
    if (counters) *counters = sum;
    return status;
}

static const mw_star_query_options defaults;

mw_status mw_star_locate_batch(const mw_star *star, const double *points, size_t n, size_t stride,
                               const mw_star_query_options *options, mw_location *locations,
                               mw_counters *counters, mw_error *error)
{
    const mw_star_rays rays = {points, n, stride, options ? options : &defaults, locations, NULL};
    return star_batch_run(star, &rays, counters, error);
}

mw_status mw_star_project_batch(const mw_star *star, const double *points, size_t n, size_t stride,
                                const mw_star_query_options *options, double *meetings,
                                mw_location *locations, mw_error *error)
{
    if (n && !meetings) return mw__fail(error, MW_ERROR_ARGUMENT, "the results are NULL");
    mw_location *own = locations ? NULL : mw__alloc(n, sizeof *own);
    if (!locations && !own) return mw__fail_memory(error);
    const mw_star_rays rays = {
        points, n, stride, options ? options : &defaults, own ? own : locations, meetings};
    mw_status status = star_batch_run(star, &rays, NULL, error);
    free(own);
    return status;
}
