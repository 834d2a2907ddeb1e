/* nearest_batch.c - the nearest points of many: sorted along a curve in space, in chunks for the
 * threads. The triangle found last is the first guess of the next search, which then visits little
 * more than the boxes round its answer. */
#include "base/team_sort.h"
#include "base/options.h"
#include "base/posix.h"
#include "probe/prober.h"

#include <stdlib.h>

enum {
    CHUNK = 1 << 10, /* points that one thread takes at a time */
    BLOCK = 1 << 20, /* points that are sorted at a time */
    FEWEST = 64,     /* fewer are not worth sorting */
    AHEAD = 4        /* searches before a point's own when memory is asked for it */
};

typedef struct nearest_batch {
    const mw_prober *prober;
    const double *points; /* of the present block, as the answers */
    size_t n, stride;
    double max_distance;
    mw_nearest_surface_point *nearest;
    mw_key *keys; /* NULL: in the order of the points */
    atomic_bool outdated;
} nearest_batch;

/* --- the order --- */

/* The lower ten bits of x, two apart. */
static uint32_t spread_bits(uint32_t x)
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

/* The place of a point on a Z-order curve [Morton 1966] over the frame of the boxes and as much
 * round it. */
static uint32_t point_place(const mw_bvh *bvh, const double point[3])
{
    double at[3];
    uint32_t place = 0;
    mw__bvh_to_frame(bvh, point, at);
    for (int k = 0; k < 3; k++) {
        double cell = (at[k] + 2) * 256;
        uint32_t bits = cell > 0 ? cell < 1023 ? (uint32_t)cell : 1023 : 0; /* NaN: 0 */
        place |= spread_bits(bits) << k;
    }
    return place;
}

static void points_key(void *work, uint64_t from, uint64_t to)
{
    const nearest_batch *b = work;
    for (uint64_t i = from; i < to; i++)
        b->keys[i] = (mw_key){point_place(&b->prober->bvh, b->points + i * b->stride), (uint32_t)i};
}

/* --- the answers --- */

/* Sorted points lie anywhere in memory. */
static void nearest_prefetch(const nearest_batch *b, size_t item)
{
    __builtin_prefetch(b->points + item * b->stride);
    __builtin_prefetch(&b->nearest[item], 1);
    __builtin_prefetch((const char *)(&b->nearest[item] + 1) - 1, 1);
}

static void nearest_chunk_answer(const nearest_batch *b, size_t first, size_t end)
{
    uint32_t guess = MW_NONE;
    for (size_t i = first; i < end; i++) {
        size_t item = b->keys ? b->keys[i].item : i;
        if (b->keys && i + AHEAD < end) nearest_prefetch(b, b->keys[i + AHEAD].item);
        mw_nearest_surface_point *nearest = &b->nearest[item];
        mw__nearest_find(b->prober, b->points + item * b->stride, b->max_distance, guess, nearest);
        if (nearest->triangle != MW_NONE) guess = nearest->triangle;
    }
}

static void batch_answer_chunk(void *work, uint64_t chunk, uint32_t member)
{
    nearest_batch *b = work;
    size_t first = (size_t)chunk * CHUNK, end = b->n - first < CHUNK ? b->n : first + CHUNK;
    (void)member;
    mw__surface_read_lock(b->prober->surface);
    bool current = mw__prober_is_current(b->prober);
    if (current) nearest_chunk_answer(b, first, end);
    mw__surface_read_unlock(b->prober->surface);
    if (!current) atomic_store_explicit(&b->outdated, true, memory_order_relaxed);
}

/* The points of one block. False if the job is to stop. */
static bool nearest_block_answer(nearest_batch *b, mw_job *job)
{
    uint64_t chunks = b->n / CHUNK + (b->n % CHUNK != 0);
    if (b->keys) {
        mw__job_stage(job, "sorting queries", 0.1);
        mw__surface_read_lock(b->prober->surface);
        bool done = mw__job_ranges(job, b->n, points_key, b);
        mw__surface_read_unlock(b->prober->surface);
        if (!done) return false;
        mw__sort_keys_in_team(b->keys, b->keys + b->n, b->n,
                              mw__job_team(job, b->n >> MW_TEAM_SORT_BITS));
    }
    mw__job_stage(job, "answering queries", b->keys ? 0.9 : 1);
    return mw__job_chunks(job, mw__job_team(job, chunks), chunks, batch_answer_chunk, b);
}

static mw_status batch_answer(nearest_batch *b, size_t n, mw_job *job, mw_error *error)
{
    const double *points = b->points;
    mw_nearest_surface_point *nearest = b->nearest;
    for (size_t done = 0; done < n; done += b->n) {
        b->n = n - done < BLOCK ? n - done : BLOCK;
        b->points = points + done * b->stride;
        b->nearest = nearest + done;
        mw_job_span outer = mw__job_part(job, (double)b->n / (double)n);
        bool goes_on = nearest_block_answer(b, job);
        mw__job_part_end(job, outer);
        if (b->outdated) return mw__nearest_fail_outdated(error);
        if (!goes_on) break; /* cancelled */
    }
    return MW_OK;
}

static mw_status nearest_batch_check(const mw_prober *prober, const double *points, size_t n,
                                     size_t stride, double max_distance,
                                     const mw_nearest_options *options,
                                     const mw_nearest_surface_point *nearest, mw_error *error)
{
    mw_status status = MW_RESERVED_CHECK(mw_nearest_options, options, error);
    if (status) return status;
    if (!prober || (n && (!points || !nearest)))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the prober, the points or the result is NULL");
    if (stride != 0 && stride < 3)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the stride must be at least 3 (x, y, z)");
    return mw__nearest_check(prober, max_distance, error);
}

mw_status mw_nearest_on_surface_batch(const mw_prober *prober, const double *points, size_t n,
                                      size_t stride, double max_distance,
                                      const mw_nearest_options *options,
                                      mw_nearest_surface_point *nearest, mw_error *error)
{
    static const mw_nearest_options defaults;
    if (!options) options = &defaults;
    mw_status status =
        nearest_batch_check(prober, points, n, stride, max_distance, options, nearest, error);
    if (status) return status;
    nearest_batch b = {.prober = prober,
                       .points = points,
                       .stride = stride ? stride : 3,
                       .max_distance = max_distance,
                       .nearest = nearest};
    bool sorts = !options->in_order && n >= FEWEST;
    size_t room = n < BLOCK ? n : BLOCK;
    if (sorts) b.keys = mw__alloc(2 * room, sizeof *b.keys);
    if (sorts && !b.keys) return mw__fail_memory(error);
    mw_job job = mw__job(options->threads, options->progress);
    status = batch_answer(&b, n, &job, error);
    free(b.keys);
    return mw__job_end(&job, status, error);
}
