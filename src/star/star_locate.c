/* star_locate.c - one query: first facet, walk, exact conclusion. This file decides ties: the
 * lowest-numbered of the facets that the ray meets is the answer (lowest_facet). */
#include "star/star_locate.h"

#include "base/random.h"
#include "star/star_location.h"
#include "star/star_walk.h"

static const mw_star_kernels *const kernels[MW_STAR_WALK_COUNT] = {
    [MW_STAR_WALK_AUTO] = &mw__star_stochastic,
#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) [MW_STAR_WALK_##id] = &mw__star_##symbol,
#include <meshwalk/star_walks.def>
};

/* --- walks --- */

/* The squares of lengths in between, and their significant parts, are normal doubles. */
#define SHORT 0x1p-200
#define LONG 0x1p200

/* Initialises the walk in place: its state is too large to return. */
static void star_walk_begin(mw_star_walk *walk, const mw_star *star, const double q[3], uint64_t random,
                            mw_star_work *work)
{
    double d[3], square = 0;
    walk->star = star;
    walk->point = star->surface->point;
    walk->facet = star->facet;
    walk->random = random;
    walk->work = work;
    for (int k = 0; k < 3; k++) {
        walk->c[k] = star->centre[k];
        walk->q[k] = q[k];
        walk->d[k] = d[k] = q[k] - star->centre[k];
        square += d[k] * d[k];
    }
    double scale = square > SHORT * SHORT && square < LONG * LONG ? 1 / sqrt(square) : 0;
    for (int k = 0; k < 3; k++) walk->f[k] = (float)(scale * d[k]);
}

/* Start the walk in facet t, or continue there with another kernel, in another stage. */
static void star_walk_enter(mw_star_walk *walk, uint32_t t, uint32_t stage, uint32_t fuel)
{
    walk->t = t;
    walk->e = MW_STAR_NO_EDGE;
    walk->phase = 0;
    walk->fuel = fuel;
    walk->stage = stage;
    if (walk->work) walk->work->triangles[stage]++;
}

/* A facet that flips have cut is recorded once for each tile. */
static void star_trace_add(mw_star_trace *trace, const mw_star_walk *walk)
{
    if (trace->count++ < trace->capacity) trace->facet[trace->count - 1] = walk->facet[walk->t].user & MW_USER_MASK;
}

/* Run a walk: step by step if there is a trace, else at full speed. */
static mw_star_verdict star_walk_run(mw_star_walk *walk, const mw_star_kernels *kernel, mw_star_trace *trace)
{
    mw_star_verdict verdict = MW_STAR_GO;
    if (MW_LIKELY(!trace)) return kernel->run[walk->work != NULL](walk);
    while (verdict == MW_STAR_GO) {
        if (walk->fuel-- == 0) return MW_STAR_DRY;
        verdict = kernel->step(walk);
        if (verdict == MW_STAR_GO) star_trace_add(trace, walk);
    }
    return verdict;
}

/* The straight walk visits no facet twice, except those that it turns round at first. */
static void star_walk_go_straight(mw_star_walk *walk, mw_star_trace *trace)
{
    star_walk_enter(walk, walk->t, MW_STAR_STAGE_FINAL, UINT32_MAX);
    star_walk_run(walk, &mw__star_straight, trace);
}

/* Continue from where a walk ended to the facet that the ray meets. `finish` ends what a cheap walk
 * leaves. Returns true if the straight walk had to end what these could not. */
static bool star_walk_go_on(mw_star_walk *walk, mw_star_verdict verdict, const mw_star_kernels *finish,
                            mw_star_trace *trace)
{
    if (verdict == MW_STAR_CLOSE) {
        star_walk_enter(walk, walk->t, MW_STAR_STAGE_FINAL, walk->star->fuel);
        verdict = star_walk_run(walk, finish, trace);
    }
    if (MW_LIKELY(verdict == MW_STAR_FOUND)) return false;
    star_walk_go_straight(walk, trace);
    return true;
}

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

static bool point_is_centre(const mw_star *star, const double q[3])
{
    const double *c = star->centre;
    return q[0] == c[0] && q[1] == c[1] && q[2] == c[2];
}

bool mw__star_answerable(const mw_star *star, const double q[3])
{
    return star->ready && star->version == star->surface->version && mw__is_finite3(q) && !point_is_centre(star, q);
}

const mw_star_kernels *mw__star_kernels_of(const mw_star_cursor *cursor)
{
    return kernels[cursor->walk];
}

void mw__star_query_begin(mw_star_walk *walk, const mw_star *star, const mw_star_cursor *cursor, const double q[3],
                          uint32_t last, uint64_t random, mw_star_work *work)
{
    star_walk_begin(walk, star, q, random, work);
    uint32_t t = mw__star_start(star, cursor, last, walk);
    star_walk_enter(walk, t, MW_STAR_STAGE_WALK, cursor->walk == MW_STAR_WALK_STRAIGHT ? UINT32_MAX : star->fuel);
    if (work) work->visited++;
}

void mw__star_query_end(const mw_star_cursor *cursor, mw_star_walk *walk, mw_star_verdict verdict,
                        mw_location *location)
{
    star_walk_go_on(walk, verdict, kernels[cursor->finish], NULL);
    star_settle(walk->star, walk->t, walk->q, location);
}

mw_location mw__star_query_answer(const mw_star *star, const mw_star_cursor *cursor, const double point[3],
                                  uint32_t *last, uint64_t *random, mw_counters *counters, mw_star_trace *trace)
{
    if (MW_UNLIKELY(!mw__star_answerable(star, point))) return mw__star_location_none();
    mw_star_work work = {0};
    mw_star_walk walk;
    mw__star_query_begin(&walk, star, cursor, point, *last, *random, cursor->count || trace ? &work : NULL);
    if (trace) star_trace_add(trace, &walk);
    mw_star_verdict verdict = star_walk_run(&walk, kernels[cursor->walk], trace);
    bool handed_over = star_walk_go_on(&walk, verdict, kernels[cursor->finish], trace);
    mw_location location;
    star_settle(star, walk.t, point, &location);
    if (cursor->count) star_count(counters, &work, handed_over);
    *last = walk.t;
    *random = walk.random;
    return location;
}

uint32_t mw__star_facet_along(const mw_star *star, const double d[3], uint32_t t)
{
    double q[3];
    for (int k = 0; k < 3; k++) q[k] = star->centre[k] + star->reach * d[k];
    if (!mw__is_finite3(q) || point_is_centre(star, q))
        return t; /* at the end of the range of doubles, any facet will do */
    mw_star_walk walk;
    star_walk_begin(&walk, star, q, 0, NULL);
    star_walk_enter(&walk, t, MW_STAR_STAGE_WALK, star->fuel);
    star_walk_go_on(&walk, star_walk_run(&walk, &mw__star_stochastic, NULL), NULL, NULL);
    return walk.t;
}
