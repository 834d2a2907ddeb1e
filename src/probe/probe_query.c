/* probe_query.c - one probe [thesis App. G]. Published mode: the triangle that walks find. Certain
 * mode: a search of the BVH; a short walk from the triangle touched last gives the first bound. */
#include "base/random.h"
#include "base/options.h"
#include "probe/plane_walk.h"
#include "probe/ray_bundle.h"

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

const char *mw_probe_faces_name(mw_probe_faces faces)
{
    static const char *const names[MW_PROBE_FACES_COUNT] = {"front", "back", "both"};
    return (unsigned)faces < MW_PROBE_FACES_COUNT ? names[faces] : NULL;
}

const char *mw_probe_extent_name(mw_probe_extent extent)
{
    static const char *const names[MW_PROBE_EXTENT_COUNT] = {"line", "ray", "segment"};
    return (unsigned)extent < MW_PROBE_EXTENT_COUNT ? names[extent] : NULL;
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

/* Options that only certain probes have. */
static mw_status probe_check_ray(const mw_probe_options *options, mw_error *error)
{
    bool limited = options->max_distance > 0;
    if ((unsigned)options->faces >= MW_PROBE_FACES_COUNT ||
        (unsigned)options->extent >= MW_PROBE_EXTENT_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the option 'faces' or 'extent' has an unknown value");
    if (!(options->min_distance >= 0) || isinf(options->min_distance) ||
        (limited && options->min_distance > options->max_distance))
        return mw__fail(
            error, MW_ERROR_ARGUMENT,
            "the least distance must be finite, at least 0, and not above the greatest");
    if (!options->certain && (options->min_distance > 0 || options->faces != MW_PROBE_FRONT ||
                              options->extent != MW_PROBE_LINE))
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the options 'min_distance', 'faces' and 'extent' need 'certain'");
    return MW_OK;
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
    mw_status status = probe_check_ray(options, error);
    if (status == MW_OK) status = MW_RESERVED_CHECK(mw_probe_options, options, error);
    if (status) return status;
    *cursor = (mw_probe_cursor){
        .options = probe_options_resolve(options, prober->surface),
        .prober = prober,
        .random = mw__random_seed(options->seed, 0),
        .last = MW_NONE,
        .before = MW_NONE,
    };
    return MW_OK;
}

/* --- one probe --- */

/* Is triangle t near q: nearer than what another start would probably find? */
static bool probe_is_near(const mw_prober *prober, uint32_t t, const double q[3], uint32_t samples)
{
    const double *p = mw__surface_corner(prober->surface, t, 0);
    double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2], square = x * x + y * y + z * z;
    if (prober->guide.cell) return square < prober->guide.near2;
    /* of k points that are spread over a ball of radius r, the nearest to q has an expected
     * distance of about 2 r / sqrt(k) */
    return square * samples < 4 * prober->variance;
}

/* The triangle touched last, or one that took its place in edits; MW_NONE: none is known. */
static uint32_t probe_last(const mw_prober *prober, const mw_probe_cursor *cursor)
{
    enum { HEIRS = 16 };
    const mw_surface *surface = prober->surface;
    uint32_t t = cursor->prober == prober ? cursor->last : MW_NONE;
    for (int i = 0; i < HEIRS && t < surface->tri_count; i++) {
        if (MW_LIKELY(!mw__surface_is_freed(surface, t))) return t;
        t = surface->tri[t].user & MW_USER_MASK;
    }
    return MW_NONE;
}

/* Where the search starts: the triangle touched last, or MW_NONE. */
static uint32_t probe_coherent(const mw_prober *prober, const mw_probe_cursor *cursor,
                               const double q[3])
{
    mw_probe_start start = cursor->options.start;
    uint32_t last = probe_last(prober, cursor);
    bool starts =
        last != MW_NONE &&
        (start == MW_PROBE_START_LAST ||
         (start == MW_PROBE_START_AUTO && probe_is_near(prober, last, q, cursor->options.samples)));
    return starts ? last : MW_NONE;
}

/* Where the first walk starts, if m points at the front of that triangle; MW_NONE: at the best of a
 * sample. Certain probes need no guide: their boxes are one. */
static uint32_t probe_first(const mw_prober *prober, const mw_probe_cursor *cursor,
                            const double q[3])
{
    uint32_t last = probe_coherent(prober, cursor, q);
    if (last != MW_NONE || !prober->guide.cell || cursor->options.certain ||
        cursor->options.start != MW_PROBE_START_AUTO)
        return last;
    uint32_t t = mw__probe_guide_triangle(&prober->guide, q);
    return t < prober->surface->tri_count && !mw__surface_is_freed(prober->surface, t) ? t
                                                                                       : MW_NONE;
}

static mw_probe_search probe_plan(const mw_prober *prober, mw_probe_cursor *cursor,
                                  const double q[3], const double m[3])
{
    const mw_probe_options *options = &cursor->options;
    return (mw_probe_search){
        .surface = prober->surface,
        .line = {{q[0], q[1], q[2]}, {m[0], m[1], m[2]}, {0}},
        .reach = options->max_distance > 0 ? options->max_distance : INFINITY,
        .first = probe_first(prober, cursor, q),
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
        search->first != MW_NONE && mw__touch_surely_inside(search->surface, &search->line,
                                                            search->first, search->reach, &again);
    if (stays && !work) return again;
    uint32_t t = mw__probe_search_all(search, work, trace);
    if (stays) return again;
    if (t == MW_NONE) return mw__touch_none(MW_TOUCH_LIMIT);
    return mw__touch_of_lowest(search->surface, &search->line, t);
}

/* A short walk from the triangle touched last, which finds fronts on a line only. Returns the
 * triangle that it finds, or that triangle. */
static uint32_t probe_guess_by_walk(const mw_prober *prober, mw_probe_cursor *cursor,
                                    const mw_line *line, mw_probe_counters *work,
                                    mw_probe_trace *trace)
{
    mw_probe_search walk = probe_plan(prober, cursor, line->q, line->m);
    if (walk.first == MW_NONE || !mw__probe_faces(&walk, walk.first, work))
        return probe_last(prober, cursor);
    walk.steps = SEED_STEPS < walk.steps ? SEED_STEPS : walk.steps;
    return mw__probe_search_from(&walk, 0, walk.first, NULL, work, trace);
}

/* The first bound of a certain probe. Rays and segments only look at the triangle touched last, and
 * only if it was touched twice: other series seldom come back to it. */
static void probe_guess(mw_ray_search *search, mw_probe_cursor *cursor, mw_probe_counters *work,
                        mw_probe_trace *trace)
{
    const mw_ray_query *ray = search->ray;
    bool walks = ray->extent == MW_PROBE_LINE && ray->faces == MW_PROBE_FRONT && ray->least == 0;
    uint32_t last = MW_NONE;
    if (cursor->options.start > MW_PROBE_START_LAST) return;
    if (walks)
        last = probe_guess_by_walk(search->prober, cursor, &ray->line, work, trace);
    else if (cursor->last == cursor->before)
        last = probe_last(search->prober, cursor);
    if (last != MW_NONE) mw__ray_search_guess(search, last);
}

bool mw__prober_is_current(const mw_prober *prober)
{
    return prober->has_bvh && prober->version == prober->surface->version;
}

static mw_touch probe_answer_certain(const mw_prober *prober, mw_probe_cursor *cursor,
                                     const mw_ray_query *ray, mw_probe_counters *work,
                                     mw_probe_trace *trace)
{
    mw_ray_search search;
    if (!mw__prober_is_current(prober)) return mw__touch_none(MW_TOUCH_BAD);
    mw__ray_search_begin(&search, prober, ray, mw__ray_found_nearest, NULL);
    probe_guess(&search, cursor, work, trace);
    mw__ray_search_run(&search);
    if (work) mw__ray_search_count(&search, work);
    return mw__ray_touch_found(&search);
}

/* The answer of a query, and the state of the series after it. */
static mw_touch probe_conclude(const mw_prober *prober, mw_probe_cursor *cursor, mw_touch touch,
                               mw_probe_counters *work)
{
    bool hit = touch.state == MW_TOUCH_HIT;
    if (hit) {
        cursor->before = cursor->prober == prober ? cursor->last : MW_NONE;
        cursor->prober = prober;
        cursor->last = touch.triangle;
    }
    if (cursor->options.counters) mw__probe_count(&cursor->counters, work, hit);
    return touch;
}

static mw_touch probe_answer(const mw_prober *prober, mw_probe_cursor *cursor, const double q[3],
                             const double m[3], mw_probe_trace *trace)
{
    if (!cursor->prober) mw_probe_cursor_init(prober, NULL, cursor, NULL); /* was all zero */
    /* a walk with a trace counts */
    bool counted = cursor->options.counters || trace;
    mw_probe_counters work = {0};
    mw_touch touch = mw__touch_none(MW_TOUCH_BAD);
    mw_ray_query ray;
    if (mw__probe_ray(&cursor->options, q, m, &ray)) {
        mw__surface_read_lock(prober->surface);
        mw_probe_counters *to = counted ? &work : NULL;
        if (cursor->options.certain) {
            touch = probe_answer_certain(prober, cursor, &ray, to, trace);
        } else {
            mw_probe_search search = probe_plan(prober, cursor, q, m);
            touch = probe_answer_published(&search, to, trace);
        }
        mw__surface_read_unlock(prober->surface);
    }
    return probe_conclude(prober, cursor, touch, &work);
}

uint32_t mw__probe_certain(const mw_prober *prober, const mw_line *line, double max_distance,
                           uint32_t seed, mw_probe_counters *counters)
{
    mw_ray_query ray = {.line = *line,
                        .faces = MW_PROBE_FRONT,
                        .greatest = max_distance > 0 ? max_distance : INFINITY};
    mw_ray_search search;
    mw__ray_search_begin(&search, prober, &ray, mw__ray_found_nearest, NULL);
    if (seed != MW_NONE) mw__ray_search_guess(&search, seed);
    mw__ray_search_run(&search);
    if (counters) mw__ray_search_count(&search, counters);
    return search.nearest;
}

/* --- several at a time --- */

/* A block of probes, some of which are searched at a time. */
typedef struct probe_block {
    const mw_prober *prober;
    mw_probe_cursor *cursor;
    const double *queries;
    size_t stride;
    mw_touch *touches;
    uint32_t waiting[MW_PROBE_BLOCK], n, next, begun; /* those that no bundle answered */
    uint32_t query[MW_RAYS_AT_A_TIME];                /* of each search */
    mw_ray_query ray[MW_RAYS_AT_A_TIME];
    mw_probe_counters work[MW_RAYS_AT_A_TIME];
    mw_ray_search search[MW_RAYS_AT_A_TIME];
} probe_block;

static void probe_block_keep(probe_block *b, uint32_t query, const mw_ray_search *search,
                             mw_probe_counters *work)
{
    mw__ray_search_count(search, work);
    b->touches[query] = probe_conclude(b->prober, b->cursor, mw__ray_touch_found(search), work);
}

static mw_ray_search *probe_block_next(void *self, mw_ray_search *ended)
{
    probe_block *b = self;
    mw_ray_search *search = ended ? ended : &b->search[b->begun++];
    size_t i = (size_t)(search - b->search);
    if (ended) probe_block_keep(b, b->query[i], ended, &b->work[i]);
    for (; b->next < b->n; b->next++) {
        const double *q = b->queries + b->waiting[b->next] * b->stride;
        b->work[i] = (mw_probe_counters){0};
        if (MW_LIKELY(mw__probe_ray(&b->cursor->options, q, q + 3, &b->ray[i]))) break;
        b->touches[b->waiting[b->next]] =
            probe_conclude(b->prober, b->cursor, mw__touch_none(MW_TOUCH_BAD), &b->work[i]);
    }
    if (b->next == b->n) return NULL;
    b->query[i] = b->waiting[b->next++];
    mw__ray_search_begin(search, b->prober, &b->ray[i], mw__ray_found_nearest, NULL);
    probe_guess(search, b->cursor, b->cursor->options.counters ? &b->work[i] : NULL, NULL);
    return search;
}

/* Answer what lies close together. A bundle that was none makes the next ones wait. */
static void probe_block_bundle(probe_block *b, uint32_t n)
{
    uint32_t pause = 0, left = 0;
    for (uint32_t first = 0, count; first < n; first += count) {
        count = n - first < MW_BUNDLE_RAYS ? n - first : MW_BUNDLE_RAYS;
        bool tried = count == MW_BUNDLE_RAYS && left == 0,
             bundle = tried && mw__ray_bundle_run(b->prober, &b->cursor->options,
                                                  b->queries + first * b->stride, b->stride, b->ray,
                                                  b->search);
        for (uint32_t i = first; i < first + count; i++) {
            mw_probe_counters work = {0};
            if (bundle)
                probe_block_keep(b, i, &b->search[i - first], &work);
            else
                b->waiting[b->n++] = i;
        }
        if (tried)
            pause = left = bundle ? 0 : pause < 3 ? 2 * pause + 1 : 3;
        else if (left)
            left--;
    }
}

static void probe_block_run(probe_block *b, uint32_t n)
{
    mw_ray_source source = {probe_block_next, b};
    probe_block_bundle(b, n);
    mw__ray_searches_run(b->prober, &source);
}

void mw__probe_certain_block(const mw_prober *prober, mw_probe_cursor *cursor,
                             const double *queries, size_t stride, uint32_t n, mw_touch *touches)
{
    probe_block b;
    b.prober = prober;
    b.cursor = cursor;
    b.queries = queries;
    b.stride = stride;
    b.touches = touches;
    b.n = b.next = b.begun = 0;
    mw__surface_read_lock(prober->surface);
    bool current = mw__prober_is_current(prober);
    if (current) probe_block_run(&b, n);
    mw__surface_read_unlock(prober->surface);
    for (uint32_t i = 0; !current && i < n; i++) {
        mw_probe_counters none = {0};
        touches[i] = probe_conclude(prober, cursor, mw__touch_none(MW_TOUCH_BAD), &none);
    }
}

/* --- any, and all --- */

/* Run a search of all that a query meets. Returns its state. */
static mw_touch_state probe_search(const mw_prober *prober, mw_probe_cursor *cursor,
                                   const double q[3], const double m[3], mw_ray_found *found,
                                   void *self, void (*finish)(const mw_ray_search *search))
{
    mw_touch_state state = MW_TOUCH_BAD;
    mw_probe_counters work = {0};
    mw_ray_query ray;
    if (!cursor->prober) mw_probe_cursor_init(prober, NULL, cursor, NULL); /* was all zero */
    if (!mw__probe_ray(&cursor->options, q, m, &ray)) return state;
    mw__surface_read_lock(prober->surface);
    if (mw__prober_is_current(prober)) {
        mw_ray_search search;
        mw__ray_search_begin(&search, prober, &ray, found, self);
        uint32_t last = finish ? MW_NONE : probe_last(prober, cursor);
        if (last != MW_NONE) mw__ray_search_guess(&search, last);
        mw__ray_search_run(&search);
        mw__ray_search_count(&search, &work);
        state = search.hits ? MW_TOUCH_HIT : MW_TOUCH_NONE;
        if (finish) finish(&search);
        if (search.nearest != MW_NONE) cursor->last = search.nearest;
    }
    mw__surface_read_unlock(prober->surface);
    if (cursor->options.counters) mw__probe_count(&cursor->counters, &work, state == MW_TOUCH_HIT);
    return state;
}

mw_touch_state mw_probe_any(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                            const double motion[3])
{
    return probe_search(prober, cursor, point, motion, mw__ray_found_any, NULL, NULL);
}

static void hit_list_finish(const mw_ray_search *search)
{
    mw__hit_list_sort(search);
    mw__hit_list_complete(search);
}

size_t mw_probe_all(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                    const double motion[3], mw_touch *touches, size_t capacity,
                    mw_touch_state *state)
{
    mw_hit_list list = {.touches = touches, .capacity = touches ? capacity : 0};
    mw_touch_state found =
        probe_search(prober, cursor, point, motion, mw__hit_list_found, &list, hit_list_finish);
    if (state) *state = found;
    return list.count;
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
