/* point_order.c - sorts points along a Hilbert curve.
 *
 * Keys are first distributed to buckets by their upper bits. Then any thread sorts a bucket in
 * cache. Points that crowd in one cell of the curve are sorted again, along a curve of their
 * own. */
#include "mesh/point_order.h"
#include "base/posix.h"

#include <stdlib.h>

enum {
    CHUNK = 1 << 16, /* points that one thread takes at a time */
    SMALL = 1 << 12, /* points of a bucket, about */
    MOST_BITS = 12   /* of the key, that choose the bucket */
};

static uint32_t point_chunk_count(uint32_t n)
{
    return (uint32_t)(((uint64_t)n + CHUNK - 1) / CHUNK);
}

static MW_INLINE void extent_widen(mw_extent *e, mw_point p)
{
    if (!isfinite(p.x) || !isfinite(p.y)) return;
    e->low[0] = p.x < e->low[0] ? p.x : e->low[0];
    e->low[1] = p.y < e->low[1] ? p.y : e->low[1];
    e->high[0] = p.x > e->high[0] ? p.x : e->high[0];
    e->high[1] = p.y > e->high[1] ? p.y : e->high[1];
}

typedef struct extent_search {
    const mw_point *points;
    pthread_mutex_t lock; /* of what follows */
    mw_extent extent;
    bool finite;
} extent_search;

static void extent_search_run(void *work, uint64_t from, uint64_t to)
{
    extent_search *s = work;
    bool finite = true;
    mw_extent here = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint64_t i = from; i < to; i++) {
        mw_point p = s->points[i];
        if (MW_LIKELY(isfinite(p.x) && isfinite(p.y)))
            extent_widen(&here, p);
        else
            finite = false;
    }
    pthread_mutex_lock(&s->lock);
    extent_widen(&s->extent, (mw_point){here.low[0], here.low[1]});
    extent_widen(&s->extent, (mw_point){here.high[0], here.high[1]});
    s->finite = s->finite && finite;
    pthread_mutex_unlock(&s->lock);
}

/* If no point is finite, the extent is empty, and all keys are equal. */
mw_extent mw__points_extent(const mw_point *points, uint32_t n, mw_job *job, bool *all_finite)
{
    extent_search s = {
        .points = points, .extent = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}}, .finite = true};
    pthread_mutex_init(&s.lock, NULL);
    mw__job_ranges(job, n, extent_search_run, &s);
    pthread_mutex_destroy(&s.lock);
    *all_finite = s.finite;
    return s.extent;
}

/* Sort along the curve through the extent of these points. Recurses into crowded cells. A cell has
 * at most 2^-16 of the extent, so this ends after about 130 levels of doubles, or earlier, where
 * all points fall into one cell. */
static void crowd_sort(const mw_point *points, mw_key *keys, mw_key *scratch, size_t n);

/* Sort keys that differ in their lower bits only. */
static void point_keys_sort(const mw_point *points, mw_key *keys, mw_key *scratch, size_t n,
                            uint32_t bits, bool again)
{
    mw__sort_keys_by(keys, scratch, n, bits);
    for (size_t from = 0, to; from < n; from = to) {
        for (to = from + 1; to < n && keys[to].key == keys[from].key;) to++;
        if (to - from > MW_LONG_RUN && (to - from < n || again))
            crowd_sort(points, keys + from, scratch, to - from);
    }
}

void mw__points_set_keys(const mw_point *points, mw_key *keys, size_t n)
{
    mw_extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < n; i++) extent_widen(&e, points[keys[i].item]);
    mw_hilbert hilbert = mw__hilbert(e.low, e.high);
    for (size_t i = 0; i < n; i++) {
        mw_point p = points[keys[i].item];
        keys[i].key = mw__hilbert_key(&hilbert, p.x, p.y);
    }
}

/* The points of a crowd keep the key of their cell. */
static void crowd_sort(const mw_point *points, mw_key *keys, mw_key *scratch, size_t n)
{
    uint32_t key = keys[0].key;
    mw__points_set_keys(points, keys, n);
    point_keys_sort(points, keys, scratch, n, 32, false);
    for (size_t i = 0; i < n; i++) keys[i].key = key;
}

typedef struct point_sorting {
    const mw_point *points;
    uint32_t n, chunks, buckets, shift;
    mw_hilbert hilbert;
    mw_key *keys, *scratch; /* sorted keys end up in scratch */
    uint32_t *first;        /* per chunk and bucket: number of keys, then where the next goes */
} point_sorting;

static uint32_t point_chunk_end(const point_sorting *s, uint32_t chunk)
{
    uint64_t end = ((uint64_t)chunk + 1) * CHUNK; /* there may be nearly 2^32 points */
    return end < s->n ? (uint32_t)end : s->n;
}

/* Make the keys of a chunk and count those of each bucket. */
static void point_keys_make(void *work, uint64_t number, uint32_t member)
{
    const point_sorting *s = work;
    uint32_t chunk = (uint32_t)number;
    (void)member;
    uint32_t *count = s->first + (size_t)chunk * s->buckets, end = point_chunk_end(s, chunk);
    for (uint32_t i = chunk * CHUNK; i < end; i++) {
        uint32_t key = mw__hilbert_key(&s->hilbert, s->points[i].x, s->points[i].y);
        s->keys[i] = (mw_key){key, i};
        count[key >> s->shift]++;
    }
}

/* By bucket, then by chunk, so that equal keys keep the order of the points. */
static void point_buckets_sum_counts(const point_sorting *s)
{
    uint32_t sum = 0;
    for (uint32_t b = 0; b < s->buckets; b++)
        for (uint32_t c = 0; c < s->chunks; c++) {
            uint32_t *first = &s->first[(size_t)c * s->buckets + b], here = *first;
            *first = sum;
            sum += here;
        }
}

static void point_keys_distribute(void *work, uint64_t number, uint32_t member)
{
    const point_sorting *s = work;
    uint32_t chunk = (uint32_t)number;
    (void)member;
    uint32_t *next = s->first + (size_t)chunk * s->buckets, end = point_chunk_end(s, chunk);
    for (uint32_t i = chunk * CHUNK; i < end; i++)
        s->scratch[next[s->keys[i].key >> s->shift]++] = s->keys[i];
}

/* After distributing, `first` of the last chunk is the end of each bucket. */
static void point_bucket_sort(void *work, uint64_t b, uint32_t member)
{
    const point_sorting *s = work;
    (void)member;
    const uint32_t *end = s->first + (size_t)(s->chunks - 1) * s->buckets;
    uint32_t from = b > 0 ? end[b - 1] : 0;
    point_keys_sort(s->points, s->scratch + from, s->keys + from, end[b] - from, s->shift, true);
}

static bool points_sort_all(point_sorting *s, mw_job *job)
{
    uint32_t team = mw__job_team(job, s->chunks);
    mw__job_stage(job, "placing points on a curve", 0.3);
    if (!mw__job_chunks(job, team, s->chunks, point_keys_make, s)) return false;
    point_buckets_sum_counts(s);
    mw__job_stage(job, "distributing points", 0.3);
    if (!mw__job_chunks(job, team, s->chunks, point_keys_distribute, s)) return false;
    mw__job_stage(job, "sorting points", 0.4);
    return mw__job_chunks(job, team, s->buckets, point_bucket_sort, s);
}

bool mw__points_sort(const mw_point *points, uint32_t n, const mw_extent *extent, mw_job *job,
                     mw_key *keys, mw_key *scratch)
{
    uint32_t bits = 1;
    while (bits < MOST_BITS && n >> bits > SMALL) bits++;
    point_sorting s = {.points = points,
                       .n = n,
                       .chunks = point_chunk_count(n),
                       .buckets = UINT32_C(1) << bits,
                       .shift = 32 - bits,
                       .hilbert = mw__hilbert(extent->low, extent->high),
                       .keys = scratch,
                       .scratch = keys};
    s.first = mw__calloc((size_t)s.chunks * s.buckets, sizeof *s.first);
    bool done = s.first && (n == 0 || points_sort_all(&s, job));
    free(s.first);
    return done;
}

bool mw__points_order(const mw_point *points, uint32_t n, mw_job *job, uint32_t *order)
{
    if (n == 0) return true;
    mw_key *keys = mw__alloc(n, sizeof *keys), *scratch = mw__alloc(n, sizeof *scratch);
    bool finite;
    mw__job_stage(job, "measuring the extent", 0.1);
    mw_extent extent = mw__points_extent(points, n, job, &finite);
    mw_job_span outer = mw__job_part(job, 0.9);
    bool done = keys && scratch && mw__points_sort(points, n, &extent, job, keys, scratch);
    mw__job_part_end(job, outer);
    for (uint32_t i = 0; i < n && done; i++) order[i] = keys[i].item;
    free(keys);
    free(scratch);
    return done;
}
