/* probe_query.c - one probe [thesis App. G]. Published mode: the triangle that walks find. Certain
 * mode: a search of the BVH; a short walk from the triangle touched last gives the first bound. */
#include "base/random.h"
#include "base/options.h"
#include "probe/plane_walk.h"

enum {
    ITERATIONS = 10, /* as in the thesis */
    /* Of the walk in certain mode: a probe that slides on the surface touches close to its last
     * touch. */
    SEED_STEPS = 64
};

/* --- names --- */

const char *mw_touch_state_name(mw_touch_state state)
{
    static const char *const names[MW_TOUCH_STATE_COUNT] = {"hit", "none", "limit", "bad"};
    return (unsigned)state < MW_TOUCH_STATE_COUNT ? names[state] : NULL;
}

const char *mw_probe_start_name(mw_probe_start start)
{
    static const char *const names[MW_PROBE_START_COUNT] = {"auto", "last", "sample", "random"};
    return (unsigned)start < MW_PROBE_START_COUNT ? names[start] : NULL;
}

/* --- counters --- */

static void probe_count(mw_probe_counters *sum, mw_probe_counters *work, bool hit)
{
    work->queries = 1;
    work->hits = hit;
    work->triangles_max = work->triangles;
    work->tests_max = work->tests;
    work->iterations_max = work->iterations;
    mw_probe_counters_add(sum, work);
}

/* --- the cursor --- */

/* k of Alg. 1, but at most the number of triangles: a query must end soon. The roots are rounded
 * down, which gives all values of k in the thesis. */
static uint32_t probe_sample_count(const mw_surface *surface, uint32_t samples)
{
    if (samples == 0) samples = 2 * (uint32_t)cbrt(surface->point_count);
    return samples < surface->tri_count ? samples : surface->tri_count;
}

static mw_probe_options probe_options_resolve(const mw_probe_options *options,
                                              const mw_surface *surface)
{
    mw_probe_options all = *options;
    if (isinf(all.max_distance)) all.max_distance = 0;
    all.samples = probe_sample_count(surface, all.samples);
    if (all.iterations == 0) all.iterations = ITERATIONS;
    return all;
}

mw_status mw_probe_cursor_init(const mw_prober *prober, const mw_probe_options *options,
                               mw_probe_cursor *cursor, mw_error *error)
{
    static const mw_probe_options defaults;
    if (!cursor || !prober)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the cursor or the prober is NULL");
    if (!options) options = &defaults;
    if ((unsigned)options->start >= MW_PROBE_START_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown start");
    if (!(options->max_distance >= 0))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the distance must be at least 0");
    if (options->certain && !prober->has_bvh)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "certain probes need a prober with options.boxes");
    mw_status status = MW_RESERVED_CHECK(mw_probe_options, options, error);
    if (status) return status;
    *cursor = (mw_probe_cursor){
        .options = probe_options_resolve(options, prober->surface),
        .prober = prober,
        .random = mw__random_seed(options->seed, 0),
        .last = MW_NONE,
    };
    return MW_OK;
}

/* --- one probe --- */

/* Is triangle t probably nearer to q than the nearest of a sample? If k points are spread over a
 * ball of radius r, the nearest has an expected distance of about 2 r / sqrt(k). */
static bool probe_beats_sample(const mw_prober *prober, uint32_t t, const double q[3],
                               uint32_t samples)
{
    const double *p = mw__surface_corner(prober->surface, t, 0);
    double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    return (x * x + y * y + z * z) * samples < 4 * prober->variance;
}

/* Does the search start at the triangle touched last? */
static bool probe_is_coherent(const mw_prober *prober, const mw_probe_cursor *cursor,
                              const double q[3])
{
    mw_probe_start start = cursor->options.start;
    if (cursor->prober != prober || cursor->last >= prober->surface->tri_count) return false;
    return start == MW_PROBE_START_LAST ||
           (start == MW_PROBE_START_AUTO &&
            probe_beats_sample(prober, cursor->last, q, cursor->options.samples));
}

static mw_probe_search probe_plan(const mw_prober *prober, mw_probe_cursor *cursor,
                                  const double q[3], const double m[3])
{
    const mw_probe_options *options = &cursor->options;
    return (mw_probe_search){
        .surface = prober->surface,
        .line = {{q[0], q[1], q[2]}, {m[0], m[1], m[2]}},
        .reach = options->max_distance > 0 ? options->max_distance : INFINITY,
        .last = probe_is_coherent(prober, cursor, q) ? cursor->last : MW_NONE,
        .samples = options->samples,
        .nearest = options->start != MW_PROBE_START_RANDOM,
        .iterations = options->iterations,
        .race = options->race,
        .steps = prober->surface->tri_count,
        .random = mw__random(&cursor->random),
        .count = options->counters != 0,
    };
}

/* A probe that moves in small steps usually touches the triangle that it touched last. Its first
 * walk would start and end there, so no walk is needed, unless it is counted or traced. */
static mw_touch probe_answer_published(const mw_probe_search *search, mw_probe_counters *work,
                                       mw_probe_trace *trace)
{
    mw_touch again;
    bool stays =
        search->last != MW_NONE && mw__touch_surely_inside(search->surface, &search->line,
                                                           search->last, search->reach, &again);
    if (stays && !work) return again;
    uint32_t t = mw__probe_search_all(search, work, trace);
    if (stays) return again;
    if (t == MW_NONE) return mw__touch_none(MW_TOUCH_LIMIT);
    return mw__touch_of_lowest(search->surface, &search->line, t);
}

static mw_touch probe_answer_certain(const mw_prober *prober, mw_probe_search *search,
                                     double max_distance, mw_probe_counters *work,
                                     mw_probe_trace *trace)
{
    if (!prober->has_bvh || prober->version != search->surface->version)
        return mw__touch_none(MW_TOUCH_BAD);
    uint32_t seed = MW_NONE;
    search->steps = SEED_STEPS < search->steps ? SEED_STEPS : search->steps;
    if (search->last != MW_NONE && mw__probe_faces(search, search->last, work))
        seed = mw__probe_search_from(search, 0, search->last, NULL, work, trace);
    uint32_t t = mw__probe_certain(prober, &search->line, max_distance, seed, work);
    return t == MW_NONE ? mw__touch_none(MW_TOUCH_NONE)
                        : mw__touch_of(search->surface, &search->line, t);
}

static mw_touch probe_answer(const mw_prober *prober, mw_probe_cursor *cursor, const double q[3],
                             const double m[3], mw_probe_trace *trace)
{
    if (!cursor->prober) mw_probe_cursor_init(prober, NULL, cursor, NULL); /* was all zero */
    /* a walk with a trace counts */
    bool counted = cursor->options.counters || trace;
    mw_probe_counters work = {0};
    mw_touch touch = mw__touch_none(MW_TOUCH_BAD);
    if (mw__is_finite3(q) && mw__is_finite3(m) && (m[0] != 0 || m[1] != 0 || m[2] != 0)) {
        mw__surface_read_lock(prober->surface);
        mw_probe_search search = probe_plan(prober, cursor, q, m);
        mw_probe_counters *to = counted ? &work : NULL;
        touch = cursor->options.certain
                    ? probe_answer_certain(prober, &search, cursor->options.max_distance, to, trace)
                    : probe_answer_published(&search, to, trace);
        mw__surface_read_unlock(prober->surface);
    }
    bool hit = touch.state == MW_TOUCH_HIT;
    if (hit) {
        cursor->prober = prober;
        cursor->last = touch.triangle;
    }
    if (cursor->options.counters) probe_count(&cursor->counters, &work, hit);
    return touch;
}

mw_touch mw_probe(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                  const double motion[3])
{
    return probe_answer(prober, cursor, point, motion, NULL);
}

size_t mw_probe_path(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                     const double motion[3], uint32_t *triangles, uint32_t *iteration,
                     size_t capacity, mw_touch *touch)
{
    mw_probe_trace trace = {
        .triangles = triangles, .iteration = iteration, .capacity = triangles ? capacity : 0};
    mw_touch end = probe_answer(prober, cursor, point, motion, &trace);
    if (touch) *touch = end;
    return trace.count;
}
