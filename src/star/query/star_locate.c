/* star_locate.c - one query: first facet, walk, exact conclusion. This file decides ties: the
 * lowest-numbered of the facets that the ray meets is the answer (lowest_facet). */
#include "star/query/star_locate.h"

#include "star/borrow/star_borrowed.h"
#include "star/star_hubs.h"
#include "star/star_location.h"
#include "star/star_walk_run.h"

static const mw_star_kernels *const kernels[MW_STAR_WALK_COUNT] = {
    [MW_STAR_WALK_AUTO] = &mw__star_stochastic,
#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) [MW_STAR_WALK_##id] = &mw__star_##symbol,
#include <meshwalk/star_walks.def>
};

/* --- conclusion --- */

/* The lowest-numbered of all facets that the ray meets. It meets facet t. */
static uint32_t lowest_facet(const mw_star *star, uint32_t t, const double area[3])
{
    const mw_star_facet *facet = &star->facet[t];
    uint32_t zeros = 0, on = 0, at = 0, own = facet->user & MW_USER_MASK;
    for (uint32_t k = 0; k < 3; k++)
        if (area[k] == 0) {
            zeros++;
            on = mw__next(k); /* the edge opposite to vertex k */
        } else {
            at = k;
        }
    if (MW_LIKELY(zeros == 0)) return own;
    if (zeros == 2) return star->owner[facet->v[at]];
    uint32_t across = star->facet[mw__link_triangle(facet->link[on])].user & MW_USER_MASK;
    return across < own ? across : own;
}

/* Set the location of a ray that meets stored facet t. */
static void star_settle(const mw_star *star, uint32_t t, const double q[3], mw_location *location)
{
    double area[3];
    mw__star_areas(star, star->facet[t].v, q, area);
    uint32_t number = lowest_facet(star, t, area);
    if (MW_UNLIKELY(number != star->facet[t].user)) /* another facet, or a mark */
        mw__star_areas(star, star->surface->tri[number].v, q, area);
    mw__star_location_in_facet(star, number, q, area, location);
}

/* --- the query --- */

static void star_count(mw_counters *counters, const mw_star_work *work, bool handed_over)
{
    mw_counters_add(counters, &(mw_counters){
                                  .queries = 1,
                                  .triangles_visited = work->visited,
                                  .triangles_max = work->visited,
                                  .triangles_init = work->triangles[MW_STAR_STAGE_INIT],
                                  .triangles = work->triangles[MW_STAR_STAGE_WALK],
                                  .triangles_walk_max = work->triangles[MW_STAR_STAGE_WALK],
                                  .triangles_final = work->triangles[MW_STAR_STAGE_FINAL],
                                  .triangles_final_max = work->triangles[MW_STAR_STAGE_FINAL],
                                  .orient_init = work->orient[MW_STAR_STAGE_INIT],
                                  .orient = work->orient[MW_STAR_STAGE_WALK],
                                  .orient_final = work->orient[MW_STAR_STAGE_FINAL],
                                  .comparisons = work->comparisons,
                                  .cycles = handed_over,
                                  .handovers = handed_over,
                              });
}

bool mw__star_answerable(const mw_star *star, const double q[3])
{
    return mw__star_is_current(star) && mw__is_finite3(q) && !mw__star_point_is_centre(star, q);
}

const mw_star_kernels *mw__star_kernels_of(const mw_star_cursor *cursor)
{
    return kernels[cursor->walk];
}

/* --- hubs --- */

/* On a star with hubs a walk of the library's choice goes so many steps before it looks for a hub.
 * From a good start most walks are much shorter. */
#define STEPS_BETWEEN_HUBS 12u

static bool star_query_minds_hubs(const mw_star *star, const mw_star_cursor *cursor)
{
    return star->hubs.count > 0 && cursor->walk == MW_STAR_WALK_AUTO;
}

static uint32_t star_query_fuel(const mw_star *star, const mw_star_cursor *cursor)
{
    if (cursor->walk == MW_STAR_WALK_STRAIGHT) return UINT32_MAX;
    return star_query_minds_hubs(star, cursor) ? STEPS_BETWEEN_HUBS : star->fuel;
}

/* Where the walk goes on: from the facet of the n-th hub of its facet that faces the ray, counted
 * round; from where it is if the facet has none. */
static uint32_t star_facet_to_go_on(const mw_star_walk *walk, uint32_t n)
{
    const mw_star_hub *hub[3];
    uint32_t count = 0;
    for (uint32_t k = 0; k < 3; k++) {
        hub[count] = mw__star_hub_at(walk->star, walk->t, k);
        count += hub[count] != NULL;
    }
    return count ? mw__star_hub_facet(walk->star, hub[n % count], walk->q) : walk->t;
}

static void star_walk_jump(mw_star_walk *walk, uint32_t t, mw_star_trace *trace)
{
    mw__star_walk_enter(walk, t, MW_STAR_STAGE_WALK, 0);
    if (walk->work) walk->work->visited++;
    if (trace) mw__star_trace_add(trace, walk);
}

/* Go on with a walk that took long. If it takes too long in all, another walk has to end it. */
static mw_star_verdict star_query_walk_on(mw_star_walk *walk, mw_star_trace *trace)
{
    mw_star_verdict verdict = MW_STAR_DRY;
    for (uint32_t n = 0; n < walk->star->fuel / STEPS_BETWEEN_HUBS && verdict == MW_STAR_DRY; n++) {
        uint32_t t = star_facet_to_go_on(walk, n);
        if (t != walk->t) star_walk_jump(walk, t, trace);
        walk->fuel = STEPS_BETWEEN_HUBS;
        verdict = mw__star_walk_run(walk, kernels[MW_STAR_WALK_AUTO], trace);
    }
    return verdict;
}

void mw__star_query_begin(mw_star_walk *walk, const mw_star *star, const mw_star_cursor *cursor,
                          const double q[3], uint32_t last, uint64_t random, mw_star_work *work)
{
    mw__star_walk_begin(walk, star, q, random, work);
    uint32_t t = mw__star_start(star, cursor, last, walk);
    mw__star_walk_enter(walk, t, MW_STAR_STAGE_WALK, star_query_fuel(star, cursor));
    if (work) work->visited++;
}

void mw__star_query_end(const mw_star_cursor *cursor, mw_star_walk *walk, mw_star_verdict verdict,
                        mw_location *location)
{
    if (MW_UNLIKELY(verdict == MW_STAR_DRY) && star_query_minds_hubs(walk->star, cursor))
        verdict = star_query_walk_on(walk, NULL);
    mw__star_walk_go_on(walk, verdict, kernels[cursor->finish], NULL);
    star_settle(walk->star, walk->t, walk->q, location);
}

/* May the library choose how to go, with nobody watching? */
static bool star_query_may_glide(const mw_star_cursor *cursor, const mw_star_trace *trace)
{
    return cursor->walk == MW_STAR_WALK_AUTO && !cursor->count && !trace &&
           (cursor->start == MW_STAR_START_AUTO || cursor->start == MW_STAR_START_LAST);
}

static mw_location star_answer_borrowed(const mw_star *star, const mw_star_cursor *cursor,
                                        const double point[3], uint32_t *last, uint64_t *random,
                                        mw_counters *counters, mw_star_trace *trace)
{
    mw_star_work work;
    bool scanned;
    mw_location location =
        mw__star_borrowed_answer(star, cursor, point, last, random, &work, &scanned, trace);
    if (cursor->count) star_count(counters, &work, scanned);
    return location;
}

mw_location mw__star_query_answer(const mw_star *star, const mw_star_cursor *cursor,
                                  const double point[3], uint32_t *last, uint64_t *random,
                                  mw_counters *counters, mw_star_trace *trace)
{
    if (MW_UNLIKELY(!mw__star_answerable(star, point))) return mw__star_location_none();
    if (star->borrowed)
        return star_answer_borrowed(star, cursor, point, last, random, counters, trace);
    mw_location location;
    if (MW_LIKELY(star_query_may_glide(cursor, trace))) {
        uint32_t t = mw__star_glide(star, cursor->start == MW_STAR_START_AUTO, point, *last);
        if (MW_LIKELY(t != MW_NONE)) {
            star_settle(star, t, point, &location);
            *last = t;
            return location;
        }
    }
    mw_star_work work = {0};
    mw_star_walk walk;
    mw__star_query_begin(&walk, star, cursor, point, *last, *random,
                         cursor->count || trace ? &work : NULL);
    if (trace) mw__star_trace_add(trace, &walk);
    mw_star_verdict verdict = mw__star_walk_run(&walk, kernels[cursor->walk], trace);
    if (MW_UNLIKELY(verdict == MW_STAR_DRY) && star_query_minds_hubs(star, cursor))
        verdict = star_query_walk_on(&walk, trace);
    bool handed_over = mw__star_walk_go_on(&walk, verdict, kernels[cursor->finish], trace);
    star_settle(star, walk.t, point, &location);
    if (cursor->count) star_count(counters, &work, handed_over);
    *last = walk.t;
    *random = walk.random;
    return location;
}
