/* delaunay_order.c - where points lie close in memory, and when each is inserted.
 *
 * Points are numbered along a Hilbert curve, so that what lies close in the plane lies close in memory. They are
 * inserted in that order too, but in rounds ("biased randomized insertion order" [Amenta, Choi, Rote 2003]): each point
 * belongs to the last round with probability 7/8, to the one before with 7/64, and so on. Inserted along the curve
 * alone, n points on a parabola can destroy of the order of n^2 triangles; in random rounds the expected number is at
 * most of the order of n log n wherever the points lie, and walks still go from a point to a near one. The factor 8 was
 * the fastest for uniform points: 4.2 triangles destroyed for each, against 5.8 along the curve alone, and shorter
 * walks. */
#include "triangulate/delaunay_order.h"

#include "base/random.h"
#include "base/threads.h"

#include <stdlib.h>
#include <string.h>

static mw_extent extent_of(const mw_point *points, const mw_key *keys, size_t n)
{
    mw_point p = points[keys[0].item];
    mw_extent e = {{p.x, p.y}, {p.x, p.y}};
    for (size_t i = 1; i < n; i++) {
        p = points[keys[i].item];
        if (p.x < e.low[0]) e.low[0] = p.x;
        if (p.y < e.low[1]) e.low[1] = p.y;
        if (p.x > e.high[0]) e.high[0] = p.x;
        if (p.y > e.high[1]) e.high[1] = p.y;
    }
    return e;
}

void mw__set_keys(const mw_point *points, mw_key *keys, size_t n)
{
    mw_extent extent = extent_of(points, keys, n);
    mw_hilbert hilbert = mw__hilbert(extent.low, extent.high);
    for (size_t i = 0; i < n; i++) {
        const mw_point *p = &points[keys[i].item];
        keys[i].key = mw__hilbert_key(&hilbert, p->x, p->y);
    }
}

/* The end of the run of equal keys that begins at `from`. */
static size_t end_of_run(const mw_key *keys, size_t from, size_t n)
{
    size_t to = from + 1;
    while (to < n && keys[to].key == keys[from].key) to++;
    return to;
}

/* Sort crowded cells along curves of their own; all their points keep the key of the cell. A cell has at most 2^-16 of
 * the extent, so doubles end the recursion after some 130 levels, and in any case it ends where all points fall into one
 * cell. */
static void sort_runs(const mw_point *points, mw_key *keys, mw_key *scratch, size_t n, size_t all)
{
    for (size_t from = 0, to; from < n; from = to) {
        to = end_of_run(keys, from, n);
        if (to - from <= MW_LONG_RUN || to - from == all) continue;
        uint32_t key = keys[from].key;
        mw__set_keys(points, keys + from, to - from);
        mw__sort_keys(keys + from, scratch + from, to - from);
        sort_runs(points, keys + from, scratch + from, to - from, to - from);
        for (size_t i = from; i < to; i++) keys[i].key = key;
    }
}

/* --- on several threads: each takes a piece of the keys; how many there are does not change the order --- */

enum { DIGIT = 11, BUCKETS = 1 << DIGIT, MOST_PIECES = 64, LEAST_PIECE = 1 << 13 };

typedef struct sorting {
    const mw_point *points;
    size_t n;
    int pieces;
    uint32_t (*bucket)[BUCKETS]; /* for each piece: where its next key of a digit goes */
} sorting;

static size_t begin_of_piece(const sorting *s, int piece)
{
    return s->n / (size_t)s->pieces * (size_t)piece + s->n % (size_t)s->pieces * (size_t)piece / (size_t)s->pieces;
}

static MW_INLINE uint32_t digit(mw_key key, int shift)
{
    return key.key >> shift & (BUCKETS - 1);
}

static void make_keys(const sorting *s, const mw_extent *extent, mw_key *keys)
{
    mw_hilbert hilbert = mw__hilbert(extent->low, extent->high);
#ifdef _OPENMP
#pragma omp parallel for num_threads(s->pieces) if (s->pieces > 1)
#endif
    for (int piece = 0; piece < s->pieces; piece++)
        for (size_t i = begin_of_piece(s, piece), end = begin_of_piece(s, piece + 1); i < end; i++)
            keys[i] = (mw_key){mw__hilbert_key(&hilbert, s->points[i].x, s->points[i].y), (uint32_t)i};
}

/* One pass of a radix sort. */
static void sort_digit(const sorting *s, const mw_key *from, mw_key *to, int shift)
{
#ifdef _OPENMP
#pragma omp parallel for num_threads(s->pieces) if (s->pieces > 1)
#endif
    for (int piece = 0; piece < s->pieces; piece++) {
        memset(s->bucket[piece], 0, sizeof s->bucket[piece]);
        for (size_t i = begin_of_piece(s, piece), end = begin_of_piece(s, piece + 1); i < end; i++)
            s->bucket[piece][digit(from[i], shift)]++;
    }
    uint32_t sum = 0;
    for (int b = 0; b < BUCKETS; b++)
        for (int piece = 0; piece < s->pieces; piece++) {
            uint32_t here = s->bucket[piece][b];
            s->bucket[piece][b] = sum;
            sum += here;
        }
#ifdef _OPENMP
#pragma omp parallel for num_threads(s->pieces) if (s->pieces > 1)
#endif
    for (int piece = 0; piece < s->pieces; piece++) {
        uint32_t *bucket = s->bucket[piece];
        for (size_t i = begin_of_piece(s, piece), end = begin_of_piece(s, piece + 1); i < end; i++)
            to[bucket[digit(from[i], shift)]++] = from[i];
    }
}

/* Pieces that begin with the first key of a run. */
static void sort_runs_of_pieces(const sorting *s, mw_key *keys, mw_key *scratch)
{
    size_t begin[MOST_PIECES + 1] = {0};
    for (int piece = 1; piece <= s->pieces; piece++) {
        begin[piece] = begin_of_piece(s, piece);
        if (begin[piece] < begin[piece - 1]) begin[piece] = begin[piece - 1];
        while (begin[piece] < s->n && keys[begin[piece]].key == keys[begin[piece] - 1].key) begin[piece]++;
    }
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic) num_threads(s->pieces) if (s->pieces > 1)
#endif
    for (int piece = 0; piece < s->pieces; piece++) {
        size_t from = begin[piece];
        sort_runs(s->points, keys + from, scratch + from, begin[piece + 1] - from, s->n);
    }
}

bool mw__hilbert_order(const mw_point *points, uint32_t n, const mw_extent *extent, uint32_t threads, mw_key *keys,
                       mw_key *scratch)
{
    int64_t pieces = n / LEAST_PIECE;
    sorting s = {.points = points, .n = n, .pieces = mw__team(threads, pieces < MOST_PIECES ? pieces : MOST_PIECES)};
    if (s.pieces < 1) s.pieces = 1;
    s.bucket = mw__alloc((size_t)s.pieces, sizeof *s.bucket);
    if (!s.bucket) return false;
    make_keys(&s, extent, scratch);
    sort_digit(&s, scratch, keys, 0);
    sort_digit(&s, keys, scratch, DIGIT);
    sort_digit(&s, scratch, keys, 2 * DIGIT);
    sort_runs_of_pieces(&s, keys, scratch);
    free(s.bucket);
    return true;
}

enum { ROUNDS = 11, ROUND_BITS = 3 };

/* Round of point i, 0 being the last and largest. */
static uint32_t round_of(uint32_t i)
{
    uint64_t bits = mw__mix(i + UINT64_C(1)) | UINT64_C(1) << (ROUND_BITS * (ROUNDS - 1));
    return (uint32_t)__builtin_ctzll(bits) / ROUND_BITS;
}

void mw__insertion_sequence(uint32_t first, uint32_t n, uint32_t *sequence)
{
    uint32_t next[ROUNDS + 1] = {0};
    for (uint32_t i = 0; i < n; i++) next[round_of(first + i)]++;
    for (uint32_t r = ROUNDS; r-- > 0;) next[r] += next[r + 1]; /* the end of each round */
    for (uint32_t i = n; i-- > 0;) sequence[--next[round_of(first + i)]] = first + i;
}
