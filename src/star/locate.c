/* locate.c - one query: first facet, walk, exact conclusion. */
#include "star/locate.h"

#include "base/random.h"
#include "star/place.h"
#include "star/walk.h"

static const mw_star_kernels *const kernels[MW_STAR_WALK_COUNT] = {
    [MW_STAR_WALK_AUTO] = &mw__star_stochastic,
#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) [MW_STAR_WALK_##id] = &mw__star_##symbol,
#include <meshwalk/star_walks.def>
};

/* --- walks -------------------------------------------------------------------------------------------------------- */

/* Squares of such lengths, and what counts of their parts, are normal doubles. */
#define SHORT 0x1p-200
#define LONG 0x1p200

/* In place: what a walk remembers is too long to be handed about. */
static void begin(mw_star_walk *walk, const mw_star *star, const double q[3], uint64_t random, mw_star_work *work)
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

/* Let the walk begin in facet t, or go on there with another kernel, in a stage of its own. */
static void enter(mw_star_walk *walk, uint32_t t, uint32_t stage, uint32_t fuel)
{
    walk->t = t;
    walk->e = MW_STAR_NO_EDGE;
    walk->phase = 0;
    walk->fuel = fuel;
    walk->stage = stage;
    if (walk->work) walk->work->triangles[stage]++;
}

/* Of a facet in pieces each counts. */
static void record(mw_star_trace *trace, const mw_star_walk *walk)
{
    if (trace->count++ < trace->capacity) trace->facet[trace->count - 1] = walk->facet[walk->t].user & MW_USER_MASK;
}

/* Step by step, for those who want to see each facet; else at full speed. */
static mw_star_verdict run(mw_star_walk *walk, const mw_star_kernels *kernel, mw_star_trace *trace)
{
    mw_star_verdict verdict = MW_STAR_GO;
    if (MW_LIKELY(!trace)) return kernel->run[walk->work != NULL](walk);
    while (verdict == MW_STAR_GO) {
        if (walk->fuel-- == 0) return MW_STAR_DRY;
        verdict = kernel->step(walk);
        if (verdict == MW_STAR_GO) record(trace, walk);
    }
    return verdict;
}

/* The straight walk visits no facet twice, but for those that it turned round at first. */
static void go_straight(mw_star_walk *walk, mw_star_trace *trace)
{
    enter(walk, walk->t, MW_STAR_STAGE_FINAL, UINT32_MAX);
    run(walk, &mw__star_straight, trace);
}

/* From where a walk ended to the facet that the ray meets: what a cheap one leaves is ended by `finish`. Returns true
 * if another walk had to end what these could not. */
static bool go_on(mw_star_walk *walk, mw_star_verdict verdict, const mw_star_kernels *finish, mw_star_trace *trace)
{
    if (verdict == MW_STAR_CLOSE) {
        enter(walk, walk->t, MW_STAR_STAGE_FINAL, walk->star->fuel);
        verdict = run(walk, finish, trace);
    }
    if (MW_LIKELY(verdict == MW_STAR_FOUND)) return false;
    go_straight(walk, trace);
    return true;
}

/* --- conclusion --------------------------------------------------------------------------------------------------- */

/* The ray meets facet t: the lowest-numbered of those that it meets. */
static uint32_t owner(const mw_star *star, uint32_t t, const double area[3])
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

/* The ray meets facet t (as stored). */
static void settle(const mw_star *star, uint32_t t, const double q[3], mw_location *location)
{
    double area[3];
    mw__star_areas(star, star->facet[t].v, q, area);
    uint32_t number = owner(star, t, area);
    if (MW_UNLIKELY(number != star->facet[t].user)) /* another one, or with marks */
        mw__star_areas(star, star->surface->tri[number].v, q, area);
    mw__star_place(star, number, q, area, location);
}

/* --- the query ---------------------------------------------------------------------------------------------------- */

static void count(mw_counters *counters, const mw_star_work *work, bool handed_over)
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

static bool is_centre(const mw_star *star, const double q[3])
{
    const double *c = star->centre;
    return q[0] == c[0] && q[1] == c[1] && q[2] == c[2];
}

bool mw__star_answerable(const mw_star *star, const double q[3])
{
    return star->ready && star->version == star->surface->version && mw__is_finite3(q) && !is_centre(star, q);
}

const mw_star_kernels *mw__star_kernels_of(const mw_star_cursor *cursor)
{
    return kernels[cursor->walk];
}

void mw__star_begin(mw_star_walk *walk, const mw_star *star, const mw_star_cursor *cursor, const double q[3],
                    uint32_t last, uint64_t random, mw_star_work *work)
{
    begin(walk, star, q, random, work);
    uint32_t t = mw__star_start(star, cursor, last, walk);
    enter(walk, t, MW_STAR_STAGE_WALK, cursor->walk == MW_STAR_WALK_STRAIGHT ? UINT32_MAX : star->fuel);
    if (work) work->visited++;
}

void mw__star_end(const mw_star_cursor *cursor, mw_star_walk *walk, mw_star_verdict verdict, mw_location *location)
{
    go_on(walk, verdict, kernels[cursor->finish], NULL);
    settle(walk->star, walk->t, walk->q, location);
}

mw_location mw__star_answer(const mw_star *star, const mw_star_cursor *cursor, const double point[3], uint32_t *last,
                            uint64_t *random, mw_counters *counters, mw_star_trace *trace)
{
    if (MW_UNLIKELY(!mw__star_answerable(star, point))) return mw__star_nowhere();
    mw_star_work work = {0};
    mw_star_walk walk;
    mw__star_begin(&walk, star, cursor, point, *last, *random, cursor->count || trace ? &work : NULL);
    if (trace) record(trace, &walk);
    mw_star_verdict verdict = run(&walk, kernels[cursor->walk], trace);
    bool handed_over = go_on(&walk, verdict, kernels[cursor->finish], trace);
    mw_location location;
    settle(star, walk.t, point, &location);
    if (cursor->count) count(counters, &work, handed_over);
    *last = walk.t;
    *random = walk.random;
    return location;
}

uint32_t mw__star_facet(const mw_star *star, const double d[3], uint32_t t)
{
    double q[3];
    for (int k = 0; k < 3; k++) q[k] = star->centre[k] + star->reach * d[k];
    if (!mw__is_finite3(q) || is_centre(star, q)) return t; /* at the rim of the range of doubles: any facet will do */
    mw_star_walk walk;
    begin(&walk, star, q, 0, NULL);
    enter(&walk, t, MW_STAR_STAGE_WALK, star->fuel);
    go_on(&walk, run(&walk, &mw__star_stochastic, NULL), NULL, NULL);
    return walk.t;
}
