/* paper_probe.c - thesis, App. G, Tables 1 to 3: which triangle of a surface a probe touches.
 *
 * A query is made from a point of the surface: a random triangle, each as likely as the others, and
 * a point uniform in it. Table 1: the probe is there, and moves along the inverted normal. Table 2:
 * it moves in a direction uniform among those that deviate from the inverted normal by less than a
 * right angle, and is up to D before the point. Table 3: the same, but a little farther than D, and
 * nothing else is within D. D itself is not published, nor is how triangles and directions were
 * drawn: with these the counts come near to the published ones. Every touch that is told is
 * compared with what a complete search finds. */
#include "bench/paper/paper_probe.h"
#include "bench/core/query_rounds.h"
#include "bench/data/dataset.h"
#include "bench/data/polyhedra.h"
#include "bench/paper/paper_models.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/monotonic_clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK ((size_t)1 << 16) /* queries in memory at a time */

#define DISTANCE 0.003 /* D, of the diagonal of the surface's extent */
#define FARTHER 1.1    /* times D at most, in Table 3 */

/* Walks at most. Table 1 has no limit: this is many times what any search has taken that came to an
 * end. */
#define LIMIT 10
#define NO_LIMIT 100000

enum { ON_SURFACE = 1, NEAR_SURFACE, OFF_SURFACE };

/* A surface, and a block of queries with their answers. */
typedef struct probe_measurement {
    const paper *paper;
    const char *name;
    const mw_surface *surface;
    mw_prober *prober;
    double distance;
    double *queries;
    mw_touch *answers, *touches;
    uint64_t random; /* of the queries */
} probe_measurement;

static void probe_measurement_release(probe_measurement *s)
{
    mw_prober_destroy(s->prober);
    free(s->queries);
    free(s->answers);
    free(s->touches);
}

/* Its corners, its normal as long as twice its area. */
static void probe_measurement_corners(const probe_measurement *s, uint32_t triangle,
                                      double corner[3][3], double normal[3])
{
    uint32_t v[3];
    double u[3], w[3];
    mw_surface_triangle(s->surface, triangle, v);
    for (size_t k = 0; k < 3; k++) mw_surface_vertex(s->surface, v[k], corner[k]);
    for (size_t k = 0; k < 3; k++) {
        u[k] = corner[1][k] - corner[0][k];
        w[k] = corner[2][k] - corner[0][k];
    }
    for (size_t k = 0; k < 3; k++)
        normal[k] = u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3];
}

static double motion_length(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* Is the normal a direction? Not so of a triangle without area, or beyond the range of doubles. */
static bool normal_is_usable(const double normal[3])
{
    double length = motion_length(normal);
    return length > 0 && isfinite(length);
}

static bool probe_measurement_has_usable(const probe_measurement *s)
{
    double corner[3][3], normal[3];
    for (uint32_t i = 0; i < mw_surface_triangle_count(s->surface); i++) {
        probe_measurement_corners(s, i, corner, normal);
        if (normal_is_usable(normal)) return true;
    }
    return false;
}

static int probe_measurement_prepare(probe_measurement *s, const mw_surface_info *info)
{
    mw_error error;
    mw_prober_options options = {.boxes = 1};
    double diagonal[3];
    progress_phase("preparing", s->name);
    for (size_t k = 0; k < 3; k++) diagonal[k] = info->high[k] - info->low[k];
    s->distance = DISTANCE * motion_length(diagonal);
    if (!probe_measurement_has_usable(s) || !isfinite(s->distance)) {
        complain("%s: the surface has no area, or one too large for a double", s->name);
        return END_INPUT;
    }
    s->queries = malloc(6 * BLOCK * sizeof *s->queries);
    s->answers = malloc(BLOCK * sizeof *s->answers);
    s->touches = malloc(BLOCK * sizeof *s->touches);
    if (!s->queries || !s->answers || !s->touches) return fail_memory();
    return mw_prober_create(s->surface, &options, &s->prober, &error) == MW_OK
               ? 0
               : fail_mesh(s->name, &error);
}

/* --- queries */

/* A point of a random triangle, and its normal of length 1. */
static void probe_measurement_draw_point(probe_measurement *s, double point[3], double normal[3])
{
    double corner[3][3], count = mw_surface_triangle_count(s->surface);
    do {
        probe_measurement_corners(s, (uint32_t)(dataset_unit(&s->random) * count), corner, normal);
    } while (!normal_is_usable(normal));
    double a = dataset_unit(&s->random), b = dataset_unit(&s->random),
           length = motion_length(normal);
    if (a + b > 1) {
        a = 1 - a;
        b = 1 - b;
    }
    for (size_t k = 0; k < 3; k++) {
        point[k] =
            corner[0][k] + a * (corner[1][k] - corner[0][k]) + b * (corner[2][k] - corner[0][k]);
        normal[k] /= length;
    }
}

/* Uniform among the directions against the normal. */
static void probe_measurement_deviate(probe_measurement *s, const double normal[3],
                                      double motion[3])
{
    double along;
    do {
        polyhedron_direction(motion, &s->random);
        along = motion[0] * normal[0] + motion[1] * normal[1] + motion[2] * normal[2];
    } while (along == 0);
    for (size_t k = 0; k < 3 && along > 0; k++) motion[k] = -motion[k];
}

static void probe_measurement_draw_query(probe_measurement *s, double query[6])
{
    double normal[3], *motion = query + 3, before = 0;
    probe_measurement_draw_point(s, query, normal);
    for (size_t k = 0; k < 3; k++) motion[k] = -normal[k];
    if (s->paper->table->variant != ON_SURFACE) probe_measurement_deviate(s, normal, motion);
    if (s->paper->table->variant == NEAR_SURFACE) before = s->distance * dataset_unit(&s->random);
    if (s->paper->table->variant == OFF_SURFACE)
        before = s->distance * (1 + (FARTHER - 1) * (1 - dataset_unit(&s->random)));
    for (size_t k = 0; k < 3; k++) query[k] -= before * motion[k];
}

static mw_probe_options paper_probe_options(const probe_measurement *s)
{
    return (mw_probe_options){
        .max_distance = s->distance,
        .start = MW_PROBE_START_SAMPLE,
        .samples = 2 * (uint32_t)cbrt((double)mw_surface_vertex_count(s->surface)),
        .iterations = s->paper->table->variant == ON_SURFACE ? NO_LIMIT : LIMIT,
        .seed = s->paper->settings->common.seed,
        .threads = s->paper->settings->common.threads,
    };
}

/* What a complete search finds. */
static int probe_measurement_search(probe_measurement *s, const double *queries, size_t n,
                                    mw_touch *found)
{
    mw_error error;
    mw_probe_options options = paper_probe_options(s);
    options.certain = 1;
    return mw_probe_batch(s->prober, queries, n, 6, &options, found, NULL, &error) == MW_OK
               ? 0
               : fail_mesh(s->name, &error);
}

/* So many drawn in vain, beyond a thousand for each found, are no accident. */
#define DRAWN_IN_VAIN 100000

/* n queries and what a complete search finds. Those that should touch nothing, and do, are drawn
 * anew; so are those on the surface that by rounding miss it, since the search has no limit. */
static int probe_measurement_draw(probe_measurement *s, size_t n)
{
    int variant = s->paper->table->variant;
    size_t found = 0, drawn = 0;
    while (found < n) {
        if (drawn > 1000 * found + DRAWN_IN_VAIN) {
            complain("%s: hardly a point to draw queries from", s->name);
            return END_INPUT;
        }
        size_t more = n - found;
        double *queries = s->queries + 6 * found;
        for (size_t i = 0; i < more; i++) probe_measurement_draw_query(s, queries + 6 * i);
        int end = probe_measurement_search(s, queries, more, s->touches);
        if (end) return end;
        for (size_t i = 0; i < more; i++) {
            bool touches = s->touches[i].state == MW_TOUCH_HIT;
            if ((variant == ON_SURFACE && !touches) || (variant == OFF_SURFACE && touches))
                continue;
            memmove(s->queries + 6 * found, queries + 6 * i, 6 * sizeof *queries);
            s->answers[found++] = s->touches[i];
        }
        drawn += more;
    }
    return 0;
}

/* --- counts and times */

/* A touch told of is one, at most as near as the nearest. */
static int probe_measurement_compare(const probe_measurement *s, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const mw_touch *a = &s->touches[i], *b = &s->answers[i];
        const double *q = s->queries + 6 * i;
        double slack = 1e-9 * s->distance;
        if (a->state == MW_TOUCH_LIMIT) continue;
        if (a->state == MW_TOUCH_HIT && b->state == MW_TOUCH_HIT &&
            fabs(a->distance) >= fabs(b->distance) - slack)
            continue;
        complain("%s: a touch that a complete search does not find, from %.17g %.17g %.17g along "
                 "%.17g %.17g %.17g",
                 s->name, q[0], q[1], q[2], q[3], q[4], q[5]);
        return END_RESOURCE;
    }
    return 0;
}

static void probe_measurement_take_counts(const mw_probe_counters *c, uint32_t samples,
                                          double value[QUANTITIES])
{
    double queries = (double)c->queries;
    value[SAMPLE] = samples;
    value[FOUND_PER_MILLION] = 1e6 * (double)c->hits / queries;
    value[TRIANGLES] = (double)c->triangles / queries;
    value[TRIANGLES_WALK_MAX] = (double)c->triangles_max;
    value[ORIENT] = (double)c->tests / queries;
    value[ORIENT_MAX] = (double)c->tests_max;
    value[INTERSECTIONS] = (double)c->intersections / queries;
    value[ITERATIONS] = (double)c->iterations / queries;
    value[ITERATIONS_MAX] = (double)c->iterations_max;
}

static int probe_measurement_count(probe_measurement *s, walk_outcome *o)
{
    mw_probe_counters sum = {0};
    mw_probe_options options = paper_probe_options(s);
    uint64_t done = 0, queries = s->paper->queries;
    options.counters = 1;
    progress_phase("counting", s->name);
    for (; done < queries; options.seed++) { /* other random numbers in each block */
        mw_error error;
        mw_probe_counters counters;
        size_t n = queries - done < BLOCK ? (size_t)(queries - done) : BLOCK;
        int end = probe_measurement_draw(s, n);
        if (end) return end;
        if (mw_probe_batch(s->prober, s->queries, n, 6, &options, s->touches, &counters, &error) !=
            MW_OK)
            return fail_mesh(s->name, &error);
        mw_probe_counters_add(&sum, &counters);
        end = probe_measurement_compare(s, n);
        if (end) return end;
        done += n;
        progress_points(done, (double)done / (double)queries);
    }
    probe_measurement_take_counts(&sum, options.samples, o->value[0]);
    return 0;
}

static int probe_measurement_time_share(void *self, size_t entry, size_t begin, size_t n,
                                        double *time)
{
    probe_measurement *s = self;
    mw_error error;
    mw_probe_cursor cursor;
    mw_probe_options options = paper_probe_options(s);
    options.seed += begin + entry;
    if (mw_probe_cursor_init(s->prober, &options, &cursor, &error) != MW_OK)
        return fail_mesh(s->name, &error);
    const double *q = s->queries + 6 * begin;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < n; i++)
        s->touches[i] = mw_probe(s->prober, &cursor, q + 6 * i, q + 6 * i + 3);
    *time = 1e6 * (monotonic_seconds() - clock) / (double)n;
    return 0;
}

static int probe_measurement_time(probe_measurement *s, walk_outcome *o)
{
    size_t share = query_rounds_share(s->paper->queries);
    int end = probe_measurement_draw(s, TIMED_ROUNDS * share);
    progress_phase("timing", s->name);
    return end ? end
               : query_rounds_measure(1, share, probe_measurement_time_share, s,
                                      &o->value[0][TIME_EXACT_US]);
}

/* --- surfaces */

int paper_probe(paper *p, const mw_arrays *arrays, const char *name, const char *model)
{
    mw_error error;
    mw_surface *surface = NULL;
    mw_surface_info info;
    mw_surface_options options = {.weld = 1};
    paper_result *r = paper_add(p, name, model != NULL);
    if (!r) return fail_memory();
    if (mw_surface_create(arrays, &options, &surface, &error) != MW_OK ||
        mw_surface_describe(surface, &info, &error) != MW_OK) {
        mw_surface_destroy(surface);
        return fail_mesh(name, &error);
    }
    probe_measurement s = {
        .paper = p, .name = name, .surface = surface, .random = ~p->settings->common.seed};
    r->walks = r->whole = true;
    r->outcome.vertices = info.vertices - info.unused_vertices;
    r->outcome.whole[MESH_TRIANGLES] = info.triangles;
    if (model) paper_models_match(p->table, model, "", info.triangles, r);
    int end = probe_measurement_prepare(&s, &info);
    if (end == 0) end = probe_measurement_count(&s, &r->outcome);
    if (end == 0 && !p->settings->no_times) end = probe_measurement_time(&s, &r->outcome);
    probe_measurement_release(&s);
    mw_surface_destroy(surface);
    progress_phase("measuring", NULL); /* the name may go */
    return end;
}
