/* locate.c - one query: first facet, walk, exact conclusion. */
#include "star/locate.h"

#include "base/random.h"
#include "star/tie.h"
#include "star/walk.h"

#include <limits.h>

static const mw_star_kernels *const kernels[MW_STAR_WALK_COUNT] = {
    [MW_STAR_WALK_AUTO] = &mw__star_stochastic,
#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) [MW_STAR_WALK_##id] = &mw__star_##symbol,
#include <meshwalk/star_walks.def>
};

/* --- walks -------------------------------------------------------------------------------------------------------- */

static mw_star_walk begin(const mw_star *star, const double q[3], uint64_t random, mw_star_work *work)
{
    mw_star_walk walk = {.star = star, .point = star->surface->point, .tri = star->tri, .random = random, .work = work};
    for (int k = 0; k < 3; k++) {
        walk.c[k] = star->centre[k];
        walk.q[k] = q[k];
        walk.d[k] = q[k] - star->centre[k];
    }
    return walk;
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

/* About 45 times the square root of the number of facets is far above the length of any walk on a Delaunay sphere of spread
 * points; a constant for small ones. Who needs more cycles, or nearly. */
static uint32_t fuel(const mw_star *star)
{
    return (uint32_t)(4096 + 45 * sqrt(star->tri_count));
}

static void record(mw_star_trace *trace, uint32_t t)
{
    if (trace->count++ < trace->capacity) trace->facet[trace->count - 1] = t;
}

/* Step by step, for those who want to see each facet; else at full speed. */
static mw_star_verdict run(mw_star_walk *walk, const mw_star_kernels *kernel, mw_star_trace *trace)
{
    mw_star_verdict verdict = MW_STAR_GO;
    if (MW_LIKELY(!trace)) return kernel->run[walk->work != NULL](walk);
    while (verdict == MW_STAR_GO) {
        if (walk->fuel-- == 0) return MW_STAR_DRY;
        verdict = kernel->step(walk);
        if (verdict == MW_STAR_GO) record(trace, walk->t);
    }
    return verdict;
}

/* The straight walk visits no facet twice, but for those that it turned round at first. */
static void go_straight(mw_star_walk *walk, mw_star_trace *trace)
{
    enter(walk, walk->t, MW_STAR_STAGE_FINAL, UINT32_MAX);
    run(walk, &mw__star_straight, trace);
}

/* To the facet that the ray meets, from facet t. Returns true if another walk had to end what the first could not. */
static bool walk_to(mw_star_walk *walk, const mw_star_kernels *kernel, uint32_t t, mw_star_trace *trace)
{
    enter(walk, t, MW_STAR_STAGE_WALK, kernel == &mw__star_straight ? UINT32_MAX : fuel(walk->star));
    if (walk->work) walk->work->visited++;
    if (trace) record(trace, t);
    mw_star_verdict verdict = run(walk, kernel, trace);
    if (verdict == MW_STAR_CLOSE) {
        enter(walk, walk->t, MW_STAR_STAGE_FINAL, fuel(walk->star));
        verdict = run(walk, &mw__star_stochastic, trace);
    }
    if (MW_LIKELY(verdict == MW_STAR_FOUND)) return false;
    go_straight(walk, trace);
    return true;
}

/* --- conclusion --------------------------------------------------------------------------------------------------- */

static const double *corner(const mw_star *star, const mw_triangle *facet, uint32_t k)
{
    return mw__surface_point(star->surface, facet->v[k]);
}

/* The determinants of the edges opposite to the corners, of a facet that the ray meets: exact in sign. Rounded ones are off by
 * less than their bound; where that is not less than 2^-42 of their sum, exact ones are, by 2^-50 each. */
static void measure(const mw_star *star, const mw_triangle *facet, const double q[3], double area[3])
{
    const double *c = star->centre;
    double sum = 0, off = 0;
    bool sure = true;
    for (uint32_t k = 0; k < 3; k++) {
        double bound;
        area[k] =
            -mw__orient3d_rounded(corner(star, facet, mw__next(k)), corner(star, facet, mw__prev(k)), q, c, &bound);
        sure = sure && fabs(area[k]) > bound;
        sum += area[k];
        off += bound;
    }
    if (MW_LIKELY(sure && off < 0x1p-42 * sum)) return;
    for (uint32_t k = 0; k < 3; k++)
        area[k] = -mw__orient3d_exact(corner(star, facet, mw__next(k)), corner(star, facet, mw__prev(k)), q, c);
}

/* Beyond the range of doubles the determinants are those of the facet and the ray made about 1: scaling rounds them where
 * they underflow only, but the differences from the centre are rounded. What was exactly 0 stays so. */
static void rescale(const mw_star *star, const mw_triangle *facet, const double q[3], double area[3])
{
    const double *c = star->centre;
    double v[4][3], most[4] = {0, 0, 0, 0};
    for (uint32_t i = 0; i < 4; i++) {
        const double *p = i < 3 ? corner(star, facet, i) : q;
        for (int k = 0; k < 3; k++) {
            v[i][k] = p[k] / 2 - c[k] / 2; /* halves: no overflow */
            most[i] = fmax(most[i], fabs(v[i][k]));
        }
    }
    double scale = fmax(most[0], fmax(most[1], most[2]));
    int exponent;
    for (uint32_t i = 0; i < 4; i++) {
        frexp(i < 3 ? scale : most[3], &exponent);
        for (int k = 0; k < 3; k++) v[i][k] = ldexp(v[i][k], -exponent);
    }
    for (uint32_t k = 0; k < 3; k++) {
        const double *a = v[mw__next(k)], *b = v[mw__prev(k)], *r = v[3];
        double turned = r[0] * (a[1] * b[2] - a[2] * b[1]) + r[1] * (a[2] * b[0] - a[0] * b[2]) +
                        r[2] * (a[0] * b[1] - a[1] * b[0]);
        if (area[k] != 0) area[k] = fmax(turned, DBL_MIN);
    }
}

static mw_location nowhere(void)
{
    return (mw_location){
        .weight = {NAN, NAN, NAN}, .triangle = MW_NONE, .hole = MW_NONE, .where = MW_BAD, .local = 255};
}

/* The answer in a facet, by its user's number, that the ray meets. */
static mw_location place(const mw_star *star, uint32_t number, const double q[3], double area[3])
{
    const mw_triangle *facet = &star->tri[number];
    double sum = area[0] + area[1] + area[2];
    if (MW_UNLIKELY(!(sum > 0x1p-900 && sum < 0x1p900))) {
        rescale(star, facet, q, area);
        sum = area[0] + area[1] + area[2];
    }
    mw_location location = {.triangle = number, .hole = MW_NONE, .where = MW_INSIDE, .local = 255};
    uint32_t zeros = 0, on = 0, at = 0;
    for (uint32_t k = 0; k < 3; k++) {
        location.weight[mw__user_vertex(facet->user, k)] = area[k] / sum;
        if (area[k] != 0) {
            at = k;
        } else {
            zeros++;
            on = mw__next(k); /* the edge opposite to vertex k */
        }
    }
    if (zeros == 1) {
        location.where = MW_ON_EDGE;
        location.local = (uint8_t)mw__user_edge(facet->user, on);
    } else if (zeros == 2) {
        location.where = MW_ON_VERTEX;
        location.local = (uint8_t)mw__user_vertex(facet->user, at);
    }
    return location;
}

/* The facet that owns the ray, of those that meet it; it meets facet t. */
static uint32_t owner(const mw_star *star, uint32_t t, const double area[3], const double q[3])
{
    const mw_triangle *facet = &star->tri[t];
    uint32_t zeros = 0, on = 0, at = 0;
    for (uint32_t k = 0; k < 3; k++)
        if (area[k] == 0) {
            zeros++;
            on = mw__next(k);
        } else {
            at = k;
        }
    if (zeros == 2) return star->owner[facet->v[at]];
    return zeros == 1 ? mw__star_edge_owner(star, t, on, q) : t;
}

/* The ray meets facet walk->t. */
static mw_location settle(mw_star_walk *walk, mw_star_trace *trace)
{
    const mw_star *star = walk->star;
    double area[3];
    measure(star, &star->tri[walk->t], walk->q, area);
    if (MW_UNLIKELY(area[0] == 0 && area[1] == 0 && area[2] == 0)) { /* one without area, on whose circle q lies */
        go_straight(walk, trace);
        measure(star, &star->tri[walk->t], walk->q, area);
    }
    uint32_t t = owner(star, walk->t, area, walk->q);
    if (MW_UNLIKELY(t != walk->t)) measure(star, &star->tri[t], walk->q, area);
    return place(star, t, walk->q, area);
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

/* Is q a point that a ray goes through, and the star what it was? */
static bool answerable(const mw_star *star, const double q[3])
{
    return star->ready && star->version == star->surface->version && mw__is_finite3(q) && !is_centre(star, q);
}

mw_location mw__star_answer(const mw_star *star, const mw_star_cursor *cursor, const double point[3], uint32_t *last,
                            uint64_t *random, mw_counters *counters, mw_star_trace *trace)
{
    if (MW_UNLIKELY(!answerable(star, point))) return nowhere();
    mw_star_work work = {0};
    mw_star_walk walk = begin(star, point, *random, cursor->count || trace ? &work : NULL);
    uint32_t t = mw__star_start(star, cursor, *last, &walk);
    bool handed_over = walk_to(&walk, kernels[cursor->walk], t, trace);
    mw_location location = settle(&walk, trace);
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
    mw_star_walk walk = begin(star, q, 0, NULL);
    walk_to(&walk, &mw__star_stochastic, t, NULL);
    return walk.t;
}
