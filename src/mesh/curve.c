/* curve.c - points in order along a Hilbert curve.
 *
 * Keys are parted by their upper bits first, so that each part is sorted in cache, by any thread. Where many points share
 * a cell of the curve, they are sorted again along a curve of their own. */
#include "mesh/curve.h"

#include "base/threads.h"

#include <stdlib.h>

enum {
    CHUNK = 1 << 16, /* points that one thread takes at a time                                         */
    SMALL = 1 << 12, /* points of a part, about                                                        */
    MOST_BITS = 12   /* of the key, by which it is parted                                              */
};

static uint32_t chunks_of(uint32_t n)
{
    return (uint32_t)(((uint64_t)n + CHUNK - 1) / CHUNK);
}

static MW_INLINE void widen(mw_extent *e, mw_point p)
{
    if (!isfinite(p.x) || !isfinite(p.y)) return;
    e->low[0] = p.x < e->low[0] ? p.x : e->low[0];
    e->low[1] = p.y < e->low[1] ? p.y : e->low[1];
    e->high[0] = p.x > e->high[0] ? p.x : e->high[0];
    e->high[1] = p.y > e->high[1] ? p.y : e->high[1];
}

/* Where no point is finite the extent is empty, and so is the one of all keys. */
mw_extent mw__find_extent(const mw_point *points, uint32_t n, uint32_t threads, bool *all_finite)
{
    int team = mw__team(threads, chunks_of(n));
    bool finite = true;
    mw_extent all = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    (void)team;
#ifdef _OPENMP
#pragma omp parallel num_threads(team) if (team > 1)
#endif
    {
        bool mine_finite = true;
        mw_extent mine = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
#ifdef _OPENMP
#pragma omp for schedule(static) nowait
#endif
        for (uint32_t i = 0; i < n; i++) {
            mw_point p = points[i];
            if (MW_LIKELY(isfinite(p.x) && isfinite(p.y)))
                widen(&mine, p);
            else
                mine_finite = false;
        }
#ifdef _OPENMP
#pragma omp critical(mw_extent)
#endif
        {
            widen(&all, (mw_point){mine.low[0], mine.low[1]});
            widen(&all, (mw_point){mine.high[0], mine.high[1]});
            finite = finite && mine_finite;
        }
    }
    *all_finite = finite;
    return all;
}

/* Sort along the curve of an extent. Recurses into crowded cells: each has at most 2^-16 of the extent, so doubles end
 * this after some 130 levels, and in any case where all points fall into one cell. */
static void sort_crowd(const mw_point *points, mw_key *keys, mw_key *scratch, size_t n);

/* The keys differ in their lower bits only. */
static void sort_part(const mw_point *points, mw_key *keys, mw_key *scratch, size_t n, uint32_t bits, bool again)
{
    mw__sort_keys_by(keys, scratch, n, bits);
    for (size_t from = 0, to; from < n; from = to) {
        for (to = from + 1; to < n && keys[to].key == keys[from].key;) to++;
        if (to - from > MW_LONG_RUN && (to - from < n || again)) sort_crowd(points, keys + from, scratch, to - from);
    }
}

void mw__set_keys(const mw_point *points, mw_key *keys, size_t n)
{
    mw_extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < n; i++) widen(&e, points[keys[i].item]);
    mw_hilbert hilbert = mw__hilbert(e.low, e.high);
    for (size_t i = 0; i < n; i++) {
        mw_point p = points[keys[i].item];
        keys[i].key = mw__hilbert_key(&hilbert, p.x, p.y);
    }
}

/* All of a crowd keep the key of their cell. */
static void sort_crowd(const mw_point *points, mw_key *keys, mw_key *scratch, size_t n)
{
    uint32_t key = keys[0].key;
    mw__set_keys(points, keys, n);
    sort_part(points, keys, scratch, n, 32, false);
    for (size_t i = 0; i < n; i++) keys[i].key = key;
}

typedef struct sorting {
    const mw_point *points;
    uint32_t n, chunks, buckets, shift;
    int team;
    mw_key *keys, *scratch; /* the sorted ones end in scratch */
    uint32_t *first;        /* per chunk and bucket: their number, then where they go */
} sorting;

static uint32_t chunk_end(const sorting *s, uint32_t chunk)
{
    uint64_t end = ((uint64_t)chunk + 1) * CHUNK; /* there may be nearly 2^32 points */
    return end < s->n ? (uint32_t)end : s->n;
}

/* Keys of one chunk, and how many of them go to each bucket. */
static void make_keys(const sorting *s, const mw_hilbert *hilbert, uint32_t chunk)
{
    uint32_t *count = s->first + (size_t)chunk * s->buckets, end = chunk_end(s, chunk);
    for (uint32_t i = chunk * CHUNK; i < end; i++) {
        uint32_t key = mw__hilbert_key(hilbert, s->points[i].x, s->points[i].y);
        s->keys[i] = (mw_key){key, i};
        count[key >> s->shift]++;
    }
}

/* Bucket by bucket, chunk by chunk: so equal keys keep the order of the points. */
static void add_up(const sorting *s)
{
    uint32_t sum = 0;
    for (uint32_t b = 0; b < s->buckets; b++)
        for (uint32_t c = 0; c < s->chunks; c++) {
            uint32_t *first = &s->first[(size_t)c * s->buckets + b], here = *first;
            *first = sum;
            sum += here;
        }
}

static void part_keys(const sorting *s, uint32_t chunk)
{
    uint32_t *next = s->first + (size_t)chunk * s->buckets, end = chunk_end(s, chunk);
    for (uint32_t i = chunk * CHUNK; i < end; i++) s->scratch[next[s->keys[i].key >> s->shift]++] = s->keys[i];
}

/* The parting leaves, for the last chunk, the end of each bucket. */
static void sort_bucket(const sorting *s, uint32_t b)
{
    const uint32_t *end = s->first + (size_t)(s->chunks - 1) * s->buckets;
    uint32_t from = b > 0 ? end[b - 1] : 0;
    sort_part(s->points, s->scratch + from, s->keys + from, end[b] - from, s->shift, true);
}

static void sort_all(const sorting *s, const mw_extent *extent)
{
    mw_hilbert hilbert = mw__hilbert(extent->low, extent->high);
#ifdef _OPENMP
#pragma omp parallel num_threads(s->team) if (s->team > 1)
#endif
    {
#ifdef _OPENMP
#pragma omp for schedule(static)
#endif
        for (uint32_t c = 0; c < s->chunks; c++) make_keys(s, &hilbert, c);
#ifdef _OPENMP
#pragma omp single
#endif
        add_up(s);
#ifdef _OPENMP
#pragma omp for schedule(static)
#endif
        for (uint32_t c = 0; c < s->chunks; c++) part_keys(s, c);
#ifdef _OPENMP
#pragma omp for schedule(dynamic, 8)
#endif
        for (uint32_t b = 0; b < s->buckets; b++) sort_bucket(s, b);
    }
}

bool mw__curve_sort(const mw_point *points, uint32_t n, const mw_extent *extent, uint32_t threads, mw_key *keys,
                    mw_key *scratch)
{
    uint32_t bits = 1;
    while (bits < MOST_BITS && n >> bits > SMALL) bits++;
    sorting s = {.points = points,
                 .n = n,
                 .chunks = chunks_of(n),
                 .buckets = UINT32_C(1) << bits,
                 .shift = 32 - bits,
                 .team = mw__team(threads, chunks_of(n)),
                 .keys = scratch,
                 .scratch = keys};
    s.first = mw__calloc((size_t)s.chunks * s.buckets, sizeof *s.first);
    if (s.first && n > 0) sort_all(&s, extent);
    free(s.first);
    return s.first != NULL;
}

bool mw__curve_order(const mw_point *points, uint32_t n, uint32_t threads, uint32_t *order)
{
    if (n == 0) return true;
    mw_key *keys = mw__alloc(n, sizeof *keys), *scratch = mw__alloc(n, sizeof *scratch);
    bool finite;
    mw_extent extent = mw__find_extent(points, n, threads, &finite);
    bool done = keys && scratch && mw__curve_sort(points, n, &extent, threads, keys, scratch);
    for (uint32_t i = 0; i < n && done; i++) order[i] = keys[i].item;
    free(keys);
    free(scratch);
    return done;
}
