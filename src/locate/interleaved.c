/* interleaved.c - a batch on the fast path: many walks, four to a vector, in turn.
 *
 * The step is that of walk/remembering_vector.h. This file drives it: it gives the lanes their
 * queries, writes answers, and lets groups of four lanes take turns, so that some step while others
 * wait for memory: after a step the new tiles are prefetched, half a lap later their corners. */
#include "locate/interleaved.h"

#include "base/random.h"
#include "locate/conclude.h"
#include "locate/fast_path.h"
#include "locate/hints.h"
#include "locate/index.h"
#include "locate/query.h"
#include "walk/remembering_vector.h"

_Static_assert(MW_GROUP_LANES == MW_VECTOR_LANES, "a group is a vector");

enum {
    LANES = MW_GROUP_LANES,
    GROUPS = MW_MAX_LANES / LANES,
    READY = MW_INDEX_MANY /* so many queries get their first tiles together */
};

/* Lanes that step together. */
typedef struct lane_group {
    mw_vector_walk walk;
    uint32_t query[LANES], begun[LANES]; /* number of the query, MW_NONE; lap in which it began */
    uint32_t next[LANES], end[LANES];    /* chained: what is left of the lane's range           */
    uint32_t alive;
} lane_group;

/* What all lanes share. */
typedef struct lane_schedule {
    const mw_interleaved *of;
    uint32_t next, end; /* if not chained: the queries that have no first tile yet */
    /* so far; a walk of so many is long: looked for every MW_FAST_STEPS laps */
    uint32_t lap, most_laps;
    /* among the queries that have their first tile: the next one, and their number */
    uint32_t ready_next, ready_count;
    uint32_t query[READY], tile[READY]; /* these queries */
    mw_point q[READY];
} lane_schedule;

/* --- where queries begin --- */

static uint32_t query_tile(const mw_interleaved *of, mw_point q, uint32_t query)
{
    uint64_t random = mw__random_seed(of->queries->seed, query);
    return mw__query_first_tile(of->locator, of->cursor, of->chained ? MW_NONE : of->cursor->last,
                                q, &random, NULL);
}

/* Read the point of a query. A point that is not finite is answered at once, and the function
 * returns false. */
static MW_INLINE bool query_point(const mw_interleaved *of, uint32_t query, mw_point *q)
{
    const double *at = &of->queries->points[query * of->queries->stride];
    *q = (mw_point){at[0], at[1]};
    if (MW_LIKELY(isfinite(q->x) && isfinite(q->y))) return true;
    mw__location_write_nowhere(&of->queries->locations[query], MW_BAD, MW_NONE);
    return false;
}

/* The first tiles of n queries, at most READY. */
static void queries_first_tiles(const mw_interleaved *of, const uint32_t *query, const mw_point *q,
                                uint32_t n, uint32_t *t)
{
    const mw_index *index = of->cursor->index;
    if (index && !mw__index_counts(index))
        mw__index_first_many(&of->locator->tiling, index, q, n, t);
    else
        for (uint32_t i = 0; i < n; i++) t[i] = query_tile(of, q[i], query[i]);
}

/* Begin queries at their hints. Queries without a hint are gathered and begin as others do. */
static void schedule_take_hints(lane_schedule *s)
{
    const mw_interleaved *of = s->of;
    uint32_t which[READY], query[READY], tile[READY], count = 0;
    mw_point q[READY];
    const uint32_t *hints = of->queries->hints, later = s->end - s->next;
    mw__hints_first_many(&(mw_hinted){of->locator, of->cursor, hints, s->query, s->q,
                                      s->ready_count, &hints[s->next],
                                      later < READY ? later : READY},
                         s->tile);
    for (uint32_t i = 0; i < s->ready_count; i++) {
        if (MW_LIKELY(s->tile[i] != MW_NONE)) continue;
        which[count] = i;
        query[count] = s->query[i];
        q[count++] = s->q[i];
    }
    if (count == 0) return;
    queries_first_tiles(of, query, q, count, tile);
    for (uint32_t i = 0; i < count; i++) s->tile[which[i]] = tile[i];
}

/* Give the next queries their first tiles. */
static void schedule_refill(lane_schedule *s)
{
    const mw_interleaved *of = s->of;
    uint32_t n = 0;
    for (; n < READY && s->next < s->end; s->next++) {
        s->query[n] = s->next;
        n += query_point(of, s->next, &s->q[n]);
    }
    s->ready_next = 0;
    s->ready_count = n;
    if (of->queries->hints)
        schedule_take_hints(s);
    else
        queries_first_tiles(of, s->query, s->q, n, s->tile);
}

static MW_INLINE void lane_set(const lane_schedule *s, lane_group *g, uint32_t k, mw_point q,
                               uint32_t query, uint32_t t)
{
    g->walk.x[k] = q.x;
    g->walk.y[k] = q.y;
    g->query[k] = query;
    g->walk.t[k] = t;
    g->begun[k] = s->lap;
}

/* Sorted queries may lie anywhere in the caller's arrays: prefetch those that come a few queries
 * later. */
static MW_INLINE void lane_prefetch_query(const mw_batch *b, uint32_t i, uint32_t end)
{
    enum { AHEAD = 8 };
    if (i + AHEAD >= end) return;
    uint32_t later = b->order[i + AHEAD].item;
    __builtin_prefetch(&b->points[later * b->stride]);
    __builtin_prefetch(&b->locations[later], 1);
    __builtin_prefetch((const char *)&b->locations[later + 1] - 1, 1);
}

/* Begin the next query of the lane's range in tile `last`. MW_NONE: there was no query before. */
static MW_INLINE bool lane_next_chained(const lane_schedule *s, lane_group *g, uint32_t k,
                                        uint32_t last)
{
    const mw_interleaved *of = s->of;
    const mw_batch *queries = of->queries;
    while (g->next[k] < g->end[k]) {
        uint32_t query = g->next[k]++;
        if (queries->order) {
            lane_prefetch_query(queries, query, g->end[k]);
            query = queries->order[query].item;
        }
        mw_point q;
        if (!query_point(of, query, &q)) continue;
        lane_set(s, g, k, q, query, MW_LIKELY(last != MW_NONE) ? last : query_tile(of, q, query));
        return true;
    }
    return false;
}

/* Begin the next of the queries that have their first tile. */
static MW_INLINE bool lane_next_ready(lane_schedule *s, lane_group *g, uint32_t k)
{
    while (s->ready_next == s->ready_count) {
        if (s->next == s->end) return false;
        schedule_refill(s);
    }
    uint32_t i = s->ready_next++;
    lane_set(s, g, k, s->q[i], s->query[i], s->tile[i]);
    return true;
}

/* Put the next query into lane k of a group. If there is none, the lane stays empty. */
static MW_INLINE void lane_next(lane_schedule *s, lane_group *g, uint32_t k, uint32_t last,
                                bool chained)
{
    if (MW_LIKELY(chained ? lane_next_chained(s, g, k, last) : lane_next_ready(s, g, k))) return;
    lane_set(s, g, k, (mw_point){NAN, NAN}, MW_NONE, 0);
    g->alive--;
}

/* --- steps --- */

/* Answer the lane's query in its tile, or let the cursor's walk go on from there. Returns the tile
 * where the query ended. */
static __attribute__((noinline)) uint32_t lane_finish(const mw_interleaved *of, mw_point q,
                                                      uint32_t query, uint32_t t)
{
    const mw_locator *locator = of->locator;
    if (mw__query_answer_here(locator, of->cursor, t, q, &of->queries->locations[query])) return t;
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)of->cursor->walk, &locator->tiling);
    mw_walk walk = mw__walk_begin(&locator->tiling, q, t, of->cursor->fuel, 0, NULL);
    mw_verdict verdict = kernels->run[true][false](&walk);
    of->queries->locations[query] = mw__query_conclude(locator, of->cursor, &walk, verdict, NULL);
    return walk.t;
}

/* Answer a walk that has ended in `tile`: inside it, or, if it left, beyond an edge of the hull. */
static MW_INLINE bool lane_answer(const mw_interleaved *of, const mw_triangle *tile, uint32_t query,
                                  bool left, bool inside, double weight[3][LANES], uint32_t k)
{
    mw_location *location = &of->queries->locations[query];
    if (MW_LIKELY(inside && !(tile->user & MW_GHOST))) {
        mw__location_write_inside(location, tile->user, weight[0][k], weight[1][k], weight[2][k]);
        return true;
    }
    return mw__fast_path_outside(&of->locator->tiling, of->cursor, tile, inside, left, location);
}

static MW_INLINE void group_step(lane_schedule *s, lane_group *g, const mw_triangle *tri,
                                 const mw_point *point, double scale, bool chained,
                                 mw_vector_bits bits)
{
    mw_vector_areas areas;
    mw__vector_areas(&areas, &g->walk, tri, point, scale);
    uint32_t left, ended = mw__vector_cross(&areas, &g->walk, &left, bits);
    if (!ended) return;
    double weight[3][LANES];
    for (uint32_t inside = mw__vector_weights(&areas, weight, bits); ended; ended &= ended - 1) {
        uint32_t k = (uint32_t)__builtin_ctz(ended), t = (uint32_t)(areas.tile[k] - tri);
        if (MW_UNLIKELY(g->query[k] == MW_NONE)) {
            g->walk.t[k] = 0;
            continue;
        }
        if (MW_UNLIKELY(!lane_answer(s->of, areas.tile[k], g->query[k], left >> k & 1,
                                     inside >> k & 1, weight, k)))
            t = lane_finish(s->of, (mw_point){g->walk.x[k], g->walk.y[k]}, g->query[k], t);
        lane_next(s, g, k, t, chained);
    }
}

/* --- laps --- */

/* Walks that are long, or go round in a cycle, are ended by the cursor's walk. */
static void groups_end_long_walks(lane_schedule *s, lane_group *groups, uint32_t count,
                                  bool chained)
{
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < LANES; k++) {
            lane_group *g = &groups[i];
            if (g->query[k] == MW_NONE || s->lap - g->begun[k] < s->most_laps) continue;
            mw_point q = {g->walk.x[k], g->walk.y[k]};
            lane_next(s, g, k, lane_finish(s->of, q, g->query[k], g->walk.t[k]), chained);
        }
}

static void groups_begin(lane_schedule *s, lane_group *groups, uint32_t count, bool chained)
{
    uint32_t first = s->next, n = s->end - s->next, lanes = count * LANES;
    for (uint32_t lane = 0; lane < lanes; lane++) {
        lane_group *g = &groups[lane / LANES];
        uint32_t k = lane % LANES;
        if (k == 0) g->alive = LANES;
        g->next[k] = first + (uint32_t)((uint64_t)n * lane / lanes);
        g->end[k] = first + (uint32_t)((uint64_t)n * (lane + 1) / lanes);
        lane_next(s, g, k, MW_NONE, chained);
    }
}

static MW_INLINE void group_prefetch_tiles(const lane_group *g, const mw_triangle *tri)
{
    for (uint32_t k = 0; k < LANES; k++) __builtin_prefetch(&tri[g->walk.t[k]]);
}

static MW_INLINE void group_prefetch_corners(const lane_group *g, const mw_triangle *tri,
                                             const mw_point *point)
{
    for (uint32_t k = 0; k < LANES; k++)
        for (uint32_t v = 0; v < 3; v++) __builtin_prefetch(&point[tri[g->walk.t[k]].v[v]]);
}

static MW_INLINE void groups_run(lane_schedule *s, uint32_t count, double scale, bool chained,
                                 mw_vector_bits bits)
{
    const mw_triangle *tri = s->of->locator->tiling.tri;
    const mw_point *point = s->of->locator->tiling.point;
    lane_group groups[GROUPS];
    groups_begin(s, groups, count, chained);
    for (uint32_t i = 0; count;) {
        group_step(s, &groups[i], tri, point, scale, chained, bits);
        if (MW_UNLIKELY(groups[i].alive == 0)) {
            groups[i] = groups[--count];
        } else {
            group_prefetch_tiles(&groups[i], tri);
            uint32_t ahead = i + count / 2;
            group_prefetch_corners(&groups[ahead < count ? ahead : ahead - count], tri, point);
            i++;
        }
        if (i < count) continue;
        i = 0;
        if (MW_UNLIKELY(++s->lap % MW_FAST_STEPS == 0))
            groups_end_long_walks(s, groups, count, chained);
    }
}

static void groups_run_portable(lane_schedule *s, uint32_t groups, bool chained)
{
    if (chained)
        groups_run(s, groups, 1, true, mw__vector_bits_portable);
    else
        groups_run(s, groups, 1, false, mw__vector_bits_portable);
}

/* As groups_run, for a mesh whose coordinates are too small or too large to be multiplied. */
static __attribute__((noinline)) void groups_run_scaled(lane_schedule *s, uint32_t groups,
                                                        bool chained)
{
    groups_run(s, groups, s->of->locator->scale, chained, mw__vector_bits_portable);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void groups_run_avx2(lane_schedule *s, uint32_t groups,
                                                            bool chained)
{
    if (chained)
        groups_run(s, groups, 1, true, mw__vector_bits_avx2);
    else
        groups_run(s, groups, 1, false, mw__vector_bits_avx2);
}

#endif

void mw__locate_interleaved(const mw_interleaved *of, uint32_t first, uint32_t count,
                            uint32_t lanes)
{
    const mw_cursor *cursor = of->cursor;
    lane_schedule s = {.of = of,
                       .next = first,
                       .end = first + count,
                       .most_laps =
                           cursor->walk == MW_WALK_REMEMBERING ? cursor->fuel : MW_FAST_STEPS};
    if (MW_UNLIKELY(of->locator->scale != 1)) {
        groups_run_scaled(&s, lanes / LANES, of->chained);
        return;
    }
#ifdef __x86_64__
    if (!of->portable && __builtin_cpu_supports("avx2")) {
        groups_run_avx2(&s, lanes / LANES, of->chained);
        return;
    }
#endif
    groups_run_portable(&s, lanes / LANES, of->chained);
}
