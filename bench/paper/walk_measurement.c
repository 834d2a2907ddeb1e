#include "bench/paper/walk_measurement.h"
#include "bench/core/answers.h"
#include "bench/core/query_rounds.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/monotonic_clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK ((size_t)1 << 18) /* queries in memory at a time */

enum { DESCENTS = MW_DESCENT_COORDINATE + 1 };

/* Meshes made ready, and a block of queries with their answers. */
typedef struct walk_measurement {
    const walk_trial *trial;
    size_t algorithms;
    mw_mesh *mesh[MW_KIND_COUNT]; /* by kind of triangulation; one that was given is the first */
    mw_locator *locator[MW_KIND_COUNT][PREPARATIONS];
    double seconds[MW_KIND_COUNT][PREPARATIONS]; /* that it took to make them */
    /* the queries are in its mesh; NULL: in that of the trial */
    mw_locator *region;
    mw_index *index[DESCENTS]; /* of layers, by descent */
    double *queries;
    mw_location *answers, *locations;
    uint64_t random; /* of the queries */
    uint64_t inside; /* so many of them were in the mesh */
} walk_measurement;

static void walk_measurement_release(walk_measurement *s)
{
    free(s->queries);
    free(s->answers);
    free(s->locations);
    for (int descent = 0; descent < DESCENTS; descent++) mw_index_destroy(s->index[descent]);
    mw_locator_destroy(s->region);
    for (int kind = 0; kind < MW_KIND_COUNT; kind++) {
        for (int k = 0; k < PREPARATIONS; k++) mw_locator_destroy(s->locator[kind][k]);
        if (s->mesh[kind] != s->trial->mesh) mw_mesh_destroy(s->mesh[kind]);
    }
}

static int walk_trial_fail(const walk_trial *t, const mw_error *error)
{
    return fail_mesh(t->name, error);
}

static int make_locator(walk_measurement *s, mw_triangulation_kind kind, preparation how)
{
    mw_error error;
    mw_locator_options options = {.areas = how == FILLED_WITH_AREAS,
                                  .fill = how == UNFILLED ? 2 : 1,
                                  .threads = s->trial->threads};
    if (s->locator[kind][how]) return 0;
    double clock = monotonic_seconds();
    if (mw_locator_create(s->mesh[kind], &options, &s->locator[kind][how], &error) != MW_OK)
        return walk_trial_fail(s->trial, &error);
    s->seconds[kind][how] = monotonic_seconds() - clock;
    return 0;
}

/* The same layers, gone down as one algorithm or another does. */
static int make_layers(walk_measurement *s, mw_descent descent)
{
    mw_error error;
    mw_index_options options = {
        .layers = s->trial->layers, .descent = descent, .seed = s->trial->seed};
    if (s->index[descent]) return 0;
    if (mw_index_create(s->locator[0][FILLED], MW_START_LAYERS, &options, &s->index[descent],
                        &error) != MW_OK)
        return walk_trial_fail(s->trial, &error);
    return 0;
}

/* Of each kind also one that is filled: what it answers is what all others must find. */
static int make_locators(walk_measurement *s)
{
    mw_error error;
    bool layers = strcmp(s->trial->start, "layers") == 0;
    for (size_t i = 0; i < s->algorithms; i++) {
        const algorithm *a = s->trial->algorithms[i];
        int end = make_locator(s, a->kind, a->preparation);
        if (end == 0) end = make_locator(s, a->kind, FILLED);
        if (end == 0 && layers) end = make_layers(s, a->descent);
        if (end) return end;
    }
    if (s->trial->region && mw_locator_create(s->trial->region, NULL, &s->region, &error) != MW_OK)
        return walk_trial_fail(s->trial, &error);
    return 0;
}

static double border_length(const mw_mesh *mesh)
{
    double sum = 0;
    for (uint32_t i = 0; i < mw_mesh_triangle_count(mesh); i++)
        for (unsigned k = 0; k < 3; k++) {
            uint32_t v[3];
            double a[2], b[2];
            if (mw_mesh_neighbour(mesh, i, k, NULL) != MW_NONE) continue;
            mw_mesh_triangle(mesh, i, v);
            mw_mesh_vertex(mesh, v[k], a);
            mw_mesh_vertex(mesh, v[(k + 1) % 3], b);
            sum += hypot(b[0] - a[0], b[1] - a[1]);
        }
    return sum;
}

static void walk_outcome_take_kind(const walk_measurement *s, size_t i,
                                   const mw_kind_report *report, double seconds, walk_outcome *o)
{
    double *value = o->value[i];
    value[EDGE_LENGTH] = report->edge_length;
    value[SIDE_LENGTH] =
        2 * report->edge_length - border_length(s->mesh[s->trial->algorithms[i]->kind]);
    value[LARGEST_ANGLE] = report->largest_angle * (180 / acos(-1));
    value[OPTIMAL] = report->optimal;
    value[TRIANGULATION_SECONDS] = seconds;
    o->vertices = report->delaunay.points - report->delaunay.duplicates;
}

static int walk_measurement_triangulate(walk_measurement *s, walk_outcome *o)
{
    const dataset *data = s->trial->data;
    mw_kind_report report;
    double seconds = 0;
    for (size_t i = 0; i < s->algorithms; i++) {
        mw_error error;
        mw_triangulation_kind kind = s->trial->algorithms[i]->kind;
        if (!s->mesh[kind]) {
            double clock = monotonic_seconds();
            if (mw_triangulate(kind, data->points, data->count, 2, NULL, NULL, &report,
                               &s->mesh[kind], &error) != MW_OK)
                return walk_trial_fail(s->trial, &error);
            seconds = monotonic_seconds() - clock;
        }
        walk_outcome_take_kind(s, i, &report, seconds, o);
    }
    return 0;
}

static int walk_measurement_prepare(walk_measurement *s, walk_outcome *o)
{
    progress_phase("triangulating", s->trial->name);
    s->mesh[0] = s->trial->mesh;
    int end = s->trial->mesh ? 0 : walk_measurement_triangulate(s, o);
    if (end) return end;
    progress_phase("preparing", s->trial->name);
    s->queries = malloc(2 * BLOCK * sizeof *s->queries);
    s->answers = malloc(BLOCK * sizeof *s->answers);
    s->locations = malloc(BLOCK * sizeof *s->locations);
    return s->queries && s->answers && s->locations ? make_locators(s) : fail_memory();
}

static bool in_mesh(const mw_location *at)
{
    return at->where == MW_INSIDE || at->where == MW_ON_EDGE || at->where == MW_ON_VERTEX;
}

/* So many drawn in vain, beyond a thousand for each found, are no accident. */
#define DRAWN_IN_VAIN 1000000

static int walk_measurement_locate(walk_measurement *s, const mw_locator *locator,
                                   const double *queries, size_t n, mw_location *found)
{
    mw_error error;
    mw_query_options options = {.seed = s->trial->seed, .threads = s->trial->threads};
    if (mw_locate_batch(locator, queries, n, 2, &options, found, NULL, &error) != MW_OK)
        return walk_trial_fail(s->trial, &error);
    return 0;
}

/* n queries in the region. */
static int walk_measurement_draw(walk_measurement *s, size_t n)
{
    const mw_locator *region = s->region ? s->region : s->locator[0][FILLED];
    size_t found = 0, drawn = 0;
    while (found < n) {
        if (drawn > 1000 * found + DRAWN_IN_VAIN) {
            complain("%s: the mesh fills less than a thousandth of the extent of its points",
                     s->trial->name);
            return END_INPUT;
        }
        size_t more = n - found;
        double *queries = s->queries + 2 * found;
        dataset_draw(s->trial->data, queries, more, &s->random);
        int end = walk_measurement_locate(s, region, queries, more, s->locations);
        if (end) return end;
        for (size_t i = 0; i < more; i++)
            if (in_mesh(&s->locations[i]))
                memmove(s->queries + 2 * found++, queries + 2 * i, 2 * sizeof *queries);
        drawn += more;
    }
    return 0;
}

static mw_query_options walk_options(const walk_measurement *s, const algorithm *a,
                                     mw_arithmetic arithmetic)
{
    return (mw_query_options){
        .walk = mw_walk_by_name(s->trial->walk ? s->trial->walk : a->walk),
        .finish = mw_walk_by_name(s->trial->finish),
        .start = mw_start_by_name(s->trial->start),
        .samples = s->trial->sample,
        .index = s->index[a->descent],
        .arithmetic = arithmetic,
        .threads = s->trial->threads,
    };
}

static const mw_locator *locator_for(const walk_measurement *s, const algorithm *a)
{
    return s->locator[a->kind][a->preparation];
}

/* What is right in the mesh of algorithm i: known already where that of the one before it is the
 * same. */
static int walk_measurement_answer(walk_measurement *s, size_t i, size_t n)
{
    const algorithm *const *algorithms = s->trial->algorithms;
    if (i > 0 && algorithms[i]->kind == algorithms[i - 1]->kind) return 0;
    return walk_measurement_locate(s, s->locator[algorithms[i]->kind][FILLED], s->queries, n,
                                   s->answers);
}

static int walk_measurement_count_block(walk_measurement *s, size_t n, uint64_t block,
                                        mw_counters *sums)
{
    mw_error error;
    for (size_t i = 0; i < s->algorithms; i++) {
        const algorithm *a = s->trial->algorithms[i];
        mw_counters counters;
        mw_query_options options = walk_options(s, a, MW_EXACT);
        options.counters = 1;
        options.seed = s->trial->seed + block; /* other random numbers in each block */
        if (mw_locate_batch(locator_for(s, a), s->queries, n, 2, &options, s->locations, &counters,
                            &error) != MW_OK)
            return walk_trial_fail(s->trial, &error);
        mw_counters_add(&sums[i], &counters);
        int end = walk_measurement_answer(s, i, n);
        locations_pair pair = {s->trial->walk ? s->trial->walk : a->walk, "auto", s->locations,
                               s->answers};
        if (end == 0) end = locations_compare(s->trial->name, s->queries, n, &pair);
        if (end) return end;
    }
    for (size_t i = 0; i < n; i++) s->inside += in_mesh(&s->answers[i]);
    return 0;
}

static void walk_outcome_take_means(const mw_counters *c, double value[QUANTITIES])
{
    const struct {
        quantity quantity;
        uint64_t sum;
    } sums[] = {
        {TRIANGLES_INIT, c->triangles_init},
        {TRIANGLES, c->triangles},
        {TRIANGLES_FINAL, c->triangles_final},
        {ORIENT_INIT, c->orient_init},
        {ORIENT, c->orient},
        {ORIENT_FINAL, c->orient_final},
        {IMPLICIT, c->implicit},
        {COMPARISONS, c->comparisons},
        {WALK_RUNS, c->walk_runs},
        {BORDER_RUNS, c->border_runs},
        {TRIANGLES_BORDER, c->triangles_border},
        {ORIENT_BORDER, c->orient_border},
        {BORDER_EDGES, c->border_edges},
        {TRIANGLES_TOTAL, c->triangles_visited},
    };
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++)
        value[sums[i].quantity] = (double)sums[i].sum / (double)c->queries;
    value[TRIANGLES_FINAL_MAX] = (double)c->triangles_final_max;
    value[TRIANGLES_WALK_MAX] = (double)c->triangles_walk_max;
    value[TRIANGLES_BORDER_MAX] = (double)c->triangles_border_max;
    value[BORDER_EDGES_MAX] = (double)c->border_edges_max;
}

static void walk_outcome_take_counts(const walk_measurement *s, size_t i, const mw_counters *sum,
                                     walk_outcome *o)
{
    const algorithm *a = s->trial->algorithms[i];
    mw_index_info index = {.layers = 1};
    mw_locator_info locator;
    if (s->index[a->descent]) mw_index_describe(s->index[a->descent], &index);
    mw_locator_describe(locator_for(s, a), &locator);
    walk_outcome_take_means(sum, o->value[i]);
    o->value[i][SAMPLE] = strcmp(s->trial->start, "sample") == 0 ? s->trial->sample : 1;
    o->value[i][TRIANGLES_TOTAL] += o->value[i][SAMPLE] - 1;
    o->value[i][INSIDE_PERCENT] = 100 * (double)s->inside / (double)s->trial->queries;
    o->value[i][LAYERS] = index.layers;
    o->value[i][LOCATOR_BYTES] = (double)locator.bytes;
    o->value[i][LOCATOR_SECONDS] = s->seconds[a->kind][a->preparation];
}

static int walk_measurement_count(walk_measurement *s, walk_outcome *o)
{
    mw_counters sums[MOST_ALGORITHMS] = {0};
    uint64_t done = 0;
    progress_phase("counting", s->trial->name);
    for (uint64_t block = 0; done < s->trial->queries; block++) {
        uint64_t left = s->trial->queries - done;
        size_t n = left < BLOCK ? (size_t)left : BLOCK;
        int end = walk_measurement_draw(s, n);
        if (end == 0) end = walk_measurement_count_block(s, n, block, sums);
        if (end) return end;
        done += n;
        progress_points(done, (double)done / (double)s->trial->queries);
    }
    for (size_t i = 0; i < s->algorithms; i++) walk_outcome_take_counts(s, i, &sums[i], o);
    return 0;
}

/* Of each walk its time in doubles, then exact. */
static int walk_measurement_time_share(void *self, size_t entry, size_t begin, size_t n,
                                       double *time)
{
    mw_error error;
    mw_cursor cursor;
    const walk_measurement *s = self;
    const algorithm *a = s->trial->algorithms[entry / 2];
    mw_query_options options = walk_options(s, a, entry % 2 ? MW_EXACT : MW_DOUBLE);
    options.seed = s->trial->seed + begin;
    if (mw_cursor_init(locator_for(s, a), &options, &cursor, &error) != MW_OK)
        return walk_trial_fail(s->trial, &error);
    const double *q = s->queries + 2 * begin;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < n; i++)
        s->locations[i] = mw_locate(locator_for(s, a), &cursor, q[2 * i], q[2 * i + 1]);
    *time = 1e6 * (monotonic_seconds() - clock) / (double)n;
    return 0;
}

static int walk_measurement_time(walk_measurement *s, walk_outcome *o)
{
    double times[2 * MOST_ALGORITHMS];
    size_t share = query_rounds_share(s->trial->queries);
    s->random = ~s->trial->seed;
    int end = walk_measurement_draw(s, TIMED_ROUNDS * share);
    progress_phase("timing", s->trial->name);
    if (end == 0)
        end = query_rounds_measure(2 * s->algorithms, share, walk_measurement_time_share, s, times);
    for (size_t i = 0; i < s->algorithms && end == 0; i++) {
        o->value[i][TIME_US] = times[2 * i];
        o->value[i][TIME_EXACT_US] = times[2 * i + 1];
    }
    return end;
}

int walk_measurement_run(const walk_trial *t, walk_outcome *o)
{
    walk_measurement s = {.trial = t, .random = ~t->seed};
    while (t->algorithms[s.algorithms]) s.algorithms++;
    *o = (walk_outcome){0};
    int end = walk_measurement_prepare(&s, o);
    if (end == 0) end = walk_measurement_count(&s, o);
    if (end == 0 && t->times) end = walk_measurement_time(&s, o);
    walk_measurement_release(&s);
    return end;
}
