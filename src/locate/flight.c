/* flight.c - the fast way through a batch: walk and conclusion in one, four walks side by side, many in flight.
 *
 * Nearly every query is plain: it walks over a few tiles and ends inside a triangle of the user's, and rounded arithmetic is
 * sure of each turn. A step here computes the three areas that q makes with the sides of its tile. Where one is surely
 * negative, q lies beyond that side; the walk leaves over the first such side, so it takes the way of the remembering walk.
 * Where all are surely positive, they are the weights of the answer, the same as settle and mw__place would find (query.c).
 * Where the edge is on the hull, or the tile a ghost, q is in no triangle.
 * What is not plain - q on an edge or nearly so, thin tiles, ways that are long - goes on by the walk of the
 * cursor, from the tile where it was met.
 *
 * Four walks step together, in vectors of four doubles. While they wait for memory other groups of four step: after a step
 * the new tiles are prefetched, half a lap later their vertices. Nothing is guessed but whether a walk ended.
 *
 * 10^6 uniform vertices and queries in random order, one thread, ns a query, from a grid: 350 by the ring of single walks
 * with its conclusion apart, 124 as above but one walk at a time, 90 with four; 10^4 vertices: 188, 90, 53. Without AVX2
 * four take 1.4 and 1.9 times as long. */
#include "locate/flight.h"

#include "base/random.h"
#include "locate/index.h"
#include "locate/plain.h"

#include <string.h>

enum {
    WIDTH = MW_FLIGHT_WIDTH,
    ALL = (1 << WIDTH) - 1, /* a bit for each walk of a group */
    GROUPS = MW_MAX_LANES / WIDTH,
    BOARDING = MW_INDEX_MANY, /* queries that get their first tile at a time */
    SHORT = 64                /* laps before the ways are looked at, and in which other than remembering walks end */
};

typedef double reals __attribute__((vector_size(8 * WIDTH)));
typedef int64_t flags __attribute__((vector_size(8 * WIDTH))); /* 0 or all bits */
typedef double pair __attribute__((vector_size(16), aligned(8)));

/* Walks side by side. */
typedef struct group {
    double x[WIDTH], y[WIDTH];           /* q; NaN where there is none any more */
    uint32_t t[WIDTH];                   /* current tile */
    uint32_t query[WIDTH], begun[WIDTH]; /* number of the query, MW_NONE; lap in which it departed */
    uint32_t next[WIDTH], end[WIDTH];    /* chained: what is left of the lane's stretch */
    uint32_t alive;
} group;

typedef struct crew {
    const mw_flight *flight;
    uint32_t next, end;      /* not chained: what is left to board */
    uint32_t lap, patience;  /* laps so far, and those after which the way of a walk is long */
    uint32_t boarded, count; /* queries that have their first tile: the next to depart, and how many there are */
    uint32_t query[BOARDING], t[BOARDING];
    mw_point q[BOARDING];
} crew;

/* Which of the flags are set, as bits. */
typedef uint32_t (*bits_of)(const flags *set);

static MW_INLINE uint32_t bits_anywhere(const flags *set)
{
    flags bit = *set & (flags){1, 2, 4, 8};
    return (uint32_t)(bit[0] | bit[1] | bit[2] | bit[3]);
}

/* --- departure ---------------------------------------------------------------------------------------------------- */

static uint32_t first_tile(const mw_flight *f, mw_point q, uint32_t query)
{
    uint64_t random = mw__random_seed(f->queries->seed, query);
    return mw__first_tile(f->locator, f->cursor, f->chained ? MW_NONE : f->cursor->last, q, &random, NULL);
}

/* Point of a query; one that is no point is answered at once, and false returned. */
static MW_INLINE bool read_point(const mw_flight *f, uint32_t query, mw_point *q)
{
    const double *at = &f->queries->points[query * f->queries->stride];
    *q = (mw_point){at[0], at[1]};
    if (MW_LIKELY(isfinite(q->x) && isfinite(q->y))) return true;
    mw__put_nowhere(&f->queries->locations[query], MW_BAD, MW_NONE);
    return false;
}

/* Give the next queries their first tiles. */
static void board(crew *c)
{
    const mw_flight *f = c->flight;
    const mw_index *index = f->cursor->index;
    uint32_t n = 0;
    for (; n < BOARDING && c->next < c->end; c->next++) {
        c->query[n] = c->next;
        n += read_point(f, c->next, &c->q[n]);
    }
    c->boarded = 0;
    c->count = n;
    if (index && index->start != MW_START_LAYERS)
        mw__index_first_many(&f->locator->tiling, index, c->q, n, c->t);
    else
        for (uint32_t i = 0; i < n; i++) c->t[i] = first_tile(f, c->q[i], c->query[i]);
}

static MW_INLINE void put(crew *c, group *g, uint32_t k, mw_point q, uint32_t query, uint32_t t)
{
    g->x[k] = q.x;
    g->y[k] = q.y;
    g->query[k] = query;
    g->t[k] = t;
    g->begun[k] = c->lap;
}

/* Sorted queries lie anywhere in the caller's arrays: have those of a few queries later on their way. */
static MW_INLINE void fetch_ahead(const mw_batch *b, uint32_t i, uint32_t end)
{
    enum { AHEAD = 8 };
    if (i + AHEAD >= end) return;
    uint32_t later = b->order[i + AHEAD].item;
    __builtin_prefetch(&b->points[later * b->stride]);
    __builtin_prefetch(&b->locations[later], 1);
    __builtin_prefetch((const char *)&b->locations[later + 1] - 1, 1);
}

/* Put the next query of the lane in place k, beginning in tile `last`; MW_NONE: there was none before. */
static MW_INLINE bool follow(crew *c, group *g, uint32_t k, uint32_t last)
{
    const mw_flight *f = c->flight;
    const mw_batch *queries = f->queries;
    while (g->next[k] < g->end[k]) {
        uint32_t query = g->next[k]++;
        if (queries->order) {
            fetch_ahead(queries, query, g->end[k]);
            query = queries->order[query].item;
        }
        mw_point q;
        if (!read_point(f, query, &q)) continue;
        put(c, g, k, q, query, MW_LIKELY(last != MW_NONE) ? last : first_tile(f, q, query));
        return true;
    }
    return false;
}

static MW_INLINE bool take(crew *c, group *g, uint32_t k)
{
    while (c->boarded == c->count) {
        if (c->next == c->end) return false;
        board(c);
    }
    uint32_t i = c->boarded++;
    put(c, g, k, c->q[i], c->query[i], c->t[i]);
    return true;
}

/* The next query in place k of a group; without one the place stays empty. */
static MW_INLINE void depart(crew *c, group *g, uint32_t k, uint32_t last, bool chained)
{
    if (MW_LIKELY(chained ? follow(c, g, k, last) : take(c, g, k))) return;
    put(c, g, k, (mw_point){NAN, NAN}, MW_NONE, 0);
    g->alive--;
}

/* --- the walk ----------------------------------------------------------------------------------------------------- */

/* Go on by the walk of the cursor from tile t. Returns the tile where it ended. */
static __attribute__((noinline)) uint32_t walk_on(const mw_flight *f, mw_point q, uint32_t query, uint32_t t)
{
    const mw_locator *locator = f->locator;
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)f->cursor->walk, &locator->tiling);
    mw_walk walk = mw__walk_begin(&locator->tiling, q, t, f->cursor->fuel, 0, NULL);
    mw_verdict verdict = kernels->run[true][false](&walk);
    f->queries->locations[query] = mw__conclude(locator, f->cursor, &walk, verdict, NULL);
    return walk.t;
}

/* What the walks of a group found in their tiles. */
typedef struct view {
    const mw_triangle *tile[WIDTH];
    reals area[3], off; /* areas, area[k] opposite to corner k, and by how much they may be off */
} view;

/* Corner v of each tile, seen from q. */
static MW_INLINE void see_corner(const view *s, const group *g, const mw_point *point, uint32_t v, reals *x, reals *y)
{
    pair p[WIDTH];
    reals qx, qy;
    for (uint32_t k = 0; k < WIDTH; k++) p[k] = *(const pair *)&point[s->tile[k]->v[v]];
    memcpy(&qx, g->x, sizeof qx);
    memcpy(&qy, g->y, sizeof qy);
    reals even = __builtin_shufflevector(p[0], p[1], 0, 2, 1, 3), odd = __builtin_shufflevector(p[2], p[3], 0, 2, 1, 3);
    *x = __builtin_shufflevector(even, odd, 0, 1, 4, 5) - qx;
    *y = __builtin_shufflevector(even, odd, 2, 3, 6, 7) - qy;
}

#define MAGNITUDE(a) ((reals)((flags)(a)&INT64_MAX))

/* The areas as mw__areas has them. The bound is that of orient2d, with the products of all three in the place of the two of
 * each: no less than any of theirs. */
static MW_INLINE void see(view *s, const group *g, const mw_triangle *tri, const mw_point *point)
{
    reals x[3], y[3];
    for (uint32_t k = 0; k < WIDTH; k++) s->tile[k] = &tri[g->t[k]];
    for (uint32_t v = 0; v < 3; v++) see_corner(s, g, point, v, &x[v], &y[v]);
    reals bc = x[1] * y[2], cb = y[1] * x[2], ca = x[2] * y[0], ac = y[2] * x[0], ab = x[0] * y[1], ba = y[0] * x[1];
    s->area[0] = bc - cb;
    s->area[1] = ca - ac;
    s->area[2] = ab - ba;
    s->off = MW_ORIENT2D_ERROR *
                 ((MAGNITUDE(bc) + MAGNITUDE(cb)) + (MAGNITUDE(ca) + MAGNITUDE(ac)) + (MAGNITUDE(ab) + MAGNITUDE(ba))) +
             MW_UNDERFLOW_ERROR;
}

/* Cross the first edge beyond which q surely lies, in all tiles where there is one. Returns the others as bits, and those
 * where the edge is on the hull: these are *left. */
static MW_INLINE uint32_t cross_edges(const view *s, group *g, uint32_t *left, bits_of bits)
{
    flags beyond[3] = {s->area[2] < -s->off, s->area[0] < -s->off, s->area[1] < -s->off}; /* edges 0, 1, 2 */
    flags any = beyond[0] | beyond[1] | beyond[2], first = (2 + beyond[1]) & ~beyond[0];
    int64_t edge[WIDTH];
    memcpy(edge, &first, sizeof edge);
    uint32_t hull = 0;
    for (uint32_t k = 0; k < WIDTH; k++) {
        uint32_t link = s->tile[k]->link[edge[k]];
        hull |= (uint32_t)(link == MW_NONE) << k;
        g->t[k] = mw__link_triangle(link);
    }
    *left = bits(&any) & hull;
    return (bits(&any) ^ ALL) | hull;
}

/* The weights, and as bits in which tiles q is plainly inside. */
static MW_INLINE uint32_t weigh(const view *s, double weight[3][WIDTH], bits_of bits)
{
    reals sum = s->area[0] + s->area[1] + s->area[2];
    flags inside = (s->area[0] > s->off) & (s->area[1] > s->off) & (s->area[2] > s->off) & (s->off < MW_PLAIN * sum) &
                   (sum > MW_LEAST) & (sum < MW_MOST);
    for (uint32_t v = 0; v < 3; v++) {
        reals w = s->area[v] / sum;
        memcpy(weight[v], &w, sizeof w);
    }
    return bits(&inside);
}

/* Answer a walk that has ended: in tile `tile`, plainly inside or, if it left, beyond an edge of the hull. False: it is not
 * plain. */
static MW_INLINE bool answer(const mw_flight *f, const mw_triangle *tile, uint32_t query, bool left, bool in,
                             double weight[3][WIDTH], uint32_t k)
{
    mw_location *location = &f->queries->locations[query];
    if (MW_LIKELY(in && !(tile->user & MW_GHOST))) {
        mw__put_inside(location, tile->user, weight[0][k], weight[1][k], weight[2][k]);
        return true;
    }
    if (f->cursor->tolerance > 0 || !f->locator->tiling.embedding || !(in || left)) return false;
    mw__put_in_none(location, in ? tile->user : 0);
    return true;
}

/* One step of a group. */
static MW_INLINE void step(crew *c, group *g, const mw_triangle *tri, const mw_point *point, bool chained, bits_of bits)
{
    view s;
    see(&s, g, tri, point);
    uint32_t left, ended = cross_edges(&s, g, &left, bits);
    if (!ended) return;
    double weight[3][WIDTH];
    for (uint32_t plain = weigh(&s, weight, bits); ended; ended &= ended - 1) {
        uint32_t k = (uint32_t)__builtin_ctz(ended), t = (uint32_t)(s.tile[k] - tri);
        if (MW_UNLIKELY(g->query[k] == MW_NONE)) {
            g->t[k] = 0;
            continue;
        }
        if (MW_UNLIKELY(!answer(c->flight, s.tile[k], g->query[k], left >> k & 1, plain >> k & 1, weight, k)))
            t = walk_on(c->flight, (mw_point){g->x[k], g->y[k]}, g->query[k], t);
        depart(c, g, k, t, chained);
    }
}

/* --- the crew ----------------------------------------------------------------------------------------------------- */

/* Let the walks that are on a long way, or in a cycle, be ended by the cursor's walk. */
static void end_long_ways(crew *c, group *groups, uint32_t count, bool chained)
{
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < WIDTH; k++) {
            group *g = &groups[i];
            if (g->query[k] == MW_NONE || c->lap - g->begun[k] < c->patience) continue;
            depart(c, g, k, walk_on(c->flight, (mw_point){g->x[k], g->y[k]}, g->query[k], g->t[k]), chained);
        }
}

static void embark(crew *c, group *groups, uint32_t count, bool chained)
{
    uint32_t first = c->next, n = c->end - c->next, lanes = count * WIDTH;
    for (uint32_t lane = 0; lane < lanes; lane++) {
        group *g = &groups[lane / WIDTH];
        uint32_t k = lane % WIDTH;
        if (k == 0) g->alive = WIDTH;
        g->next[k] = first + (uint32_t)((uint64_t)n * lane / lanes);
        g->end[k] = first + (uint32_t)((uint64_t)n * (lane + 1) / lanes);
        depart(c, g, k, MW_NONE, chained);
    }
}

static MW_INLINE void fetch_tiles(const group *g, const mw_triangle *tri)
{
    for (uint32_t k = 0; k < WIDTH; k++) __builtin_prefetch(&tri[g->t[k]]);
}

static MW_INLINE void fetch_corners(const group *g, const mw_triangle *tri, const mw_point *point)
{
    for (uint32_t k = 0; k < WIDTH; k++)
        for (uint32_t v = 0; v < 3; v++) __builtin_prefetch(&point[tri[g->t[k]].v[v]]);
}

static MW_INLINE void fly(crew *c, uint32_t count, bool chained, bits_of bits)
{
    const mw_triangle *tri = c->flight->locator->tiling.tri;
    const mw_point *point = c->flight->locator->tiling.point;
    group groups[GROUPS];
    embark(c, groups, count, chained);
    for (uint32_t i = 0; count;) {
        step(c, &groups[i], tri, point, chained, bits);
        if (MW_UNLIKELY(groups[i].alive == 0)) {
            groups[i] = groups[--count];
        } else {
            fetch_tiles(&groups[i], tri);
            uint32_t ahead = i + count / 2;
            fetch_corners(&groups[ahead < count ? ahead : ahead - count], tri, point);
            i++;
        }
        if (i < count) continue;
        i = 0;
        if (MW_UNLIKELY(++c->lap % SHORT == 0)) end_long_ways(c, groups, count, chained);
    }
}

static void fly_anywhere(crew *c, uint32_t groups, bool chained)
{
    if (chained)
        fly(c, groups, true, bits_anywhere);
    else
        fly(c, groups, false, bits_anywhere);
}

#ifdef __x86_64__

#include <immintrin.h>

__attribute__((target("avx2"))) static inline uint32_t bits_avx2(const flags *set)
{
    return (uint32_t)_mm256_movemask_pd(*(const __m256d *)set);
}

__attribute__((target("avx2"))) static void fly_avx2(crew *c, uint32_t groups, bool chained)
{
    if (chained)
        fly(c, groups, true, bits_avx2);
    else
        fly(c, groups, false, bits_avx2);
}

#endif

void mw__fly(const mw_flight *flight, uint32_t first, uint32_t count, uint32_t lanes)
{
    const mw_cursor *cursor = flight->cursor;
    crew c = {.flight = flight,
              .next = first,
              .end = first + count,
              .patience = cursor->walk == MW_WALK_REMEMBERING ? cursor->fuel : SHORT};
#ifdef __x86_64__
    if (!flight->portable && __builtin_cpu_supports("avx2")) {
        fly_avx2(&c, lanes / WIDTH, flight->chained);
        return;
    }
#endif
    fly_anywhere(&c, lanes / WIDTH, flight->chained);
}
