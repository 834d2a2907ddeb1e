#include "measure.h"
#include "message.h"
#include "progress.h"
#include "tally.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK ((size_t)1 << 18) /* queries in memory at a time */

const char *quantity_name(quantity q)
{
    static const char *const names[QUANTITIES] = {
        "triangles_init", "triangles", "triangles_final", "triangles_final_max",
        "orient_init",    "orient",    "orient_final",    "implicit",
        "comparisons",    "layers",    "time_us",         "time_exact_us",
    };
    return names[q];
}

/* A triangulation made ready, and a block of queries with their answers. */
typedef struct scene {
    const trial *trial;
    size_t algorithms;
    mw_mesh *mesh;
    mw_locator *locator[2]; /* without and with stored areas */
    mw_index *index;
    double *queries;
    mw_location *answers, *locations;
    uint64_t random; /* of the queries */
} scene;

static void release(scene *s)
{
    free(s->queries);
    free(s->answers);
    free(s->locations);
    mw_index_destroy(s->index);
    for (int areas = 0; areas < 2; areas++) mw_locator_destroy(s->locator[areas]);
    mw_mesh_destroy(s->mesh);
}

static int fail(const trial *t, const mw_error *error)
{
    return fail_mesh(t->name, error);
}

static int make_locators(scene *s)
{
    mw_error error;
    for (size_t i = 0; i < s->algorithms; i++) {
        int areas = s->trial->algorithms[i]->areas;
        mw_locator_options options = {.areas = areas};
        if (!s->locator[areas] && mw_locator_create(s->mesh, &options, &s->locator[areas], &error) != MW_OK)
            return fail(s->trial, &error);
    }
    /* Queries are drawn by means of the first; without any other it is made for that alone. */
    if (!s->locator[0] && mw_locator_create(s->mesh, NULL, &s->locator[0], &error) != MW_OK)
        return fail(s->trial, &error);
    if (!s->trial->layered) return 0;
    mw_index_options options = {.layers = s->trial->layers, .seed = s->trial->seed};
    if (mw_index_create(s->locator[0], mw_start_by_name("layers"), &options, &s->index, &error) != MW_OK)
        return fail(s->trial, &error);
    return 0;
}

static int prepare(scene *s, outcome *o)
{
    mw_error error;
    mw_triangulation_report report;
    const dataset *data = s->trial->data;
    progress_phase("triangulating", s->trial->name);
    if (mw_delaunay(data->points, data->count, 2, NULL, &report, &s->mesh, &error) != MW_OK)
        return fail(s->trial, &error);
    o->vertices = report.points - report.duplicates;
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

/* n queries in the mesh, and their answers. */
static int draw(scene *s, size_t n)
{
    mw_error error;
    mw_query_options options = {.seed = s->trial->seed, .threads = s->trial->threads};
    size_t found = 0, drawn = 0;
    while (found < n) {
        if (drawn > 1000 * found + DRAWN_IN_VAIN) {
            complain("%s: the mesh fills less than a thousandth of the extent of its points", s->trial->name);
            return END_INPUT;
        }
        size_t more = n - found;
        double *queries = s->queries + 2 * found;
        dataset_draw(s->trial->data, queries, more, &s->random);
        if (mw_locate_batch(s->locator[0], queries, more, 2, &options, s->answers + found, NULL, &error) != MW_OK)
            return fail(s->trial, &error);
        for (size_t i = 0, end = found + more, begin = found; begin + i < end; i++) {
            if (!in_mesh(&s->answers[begin + i])) continue;
            memmove(s->queries + 2 * found, queries + 2 * i, 2 * sizeof *queries);
            s->answers[found++] = s->answers[begin + i];
        }
        drawn += more;
    }
    return 0;
}

static mw_query_options options_of(const scene *s, const algorithm *a, mw_arithmetic arithmetic)
{
    return (mw_query_options){
        .walk = mw_walk_by_name(a->walk),
        .finish = mw_walk_by_name(s->trial->finish),
        .start = mw_start_by_name(s->trial->layered ? "layers" : "random"),
        .index = s->index,
        .arithmetic = arithmetic,
        .threads = s->trial->threads,
    };
}

int measure_compare(const char *name, const double *queries, size_t n, const char *walk, const mw_location *found,
                    const char *other, const mw_location *expected)
{
    for (size_t i = 0; i < n; i++) {
        if (found[i].triangle == expected[i].triangle && found[i].where == expected[i].where) continue;
        complain("%s: the walks %s and %s found different triangles at %.17g %.17g", name, walk, other, queries[2 * i],
                 queries[2 * i + 1]);
        return END_INTERNAL;
    }
    return 0;
}

static int count_block(scene *s, size_t n, uint64_t block, mw_counters *sums)
{
    mw_error error;
    for (size_t i = 0; i < s->algorithms; i++) {
        const algorithm *a = s->trial->algorithms[i];
        mw_counters counters;
        mw_query_options options = options_of(s, a, MW_EXACT);
        options.count = 1;
        options.seed = s->trial->seed + block; /* other random numbers in each block */
        if (mw_locate_batch(s->locator[a->areas], s->queries, n, 2, &options, s->locations, &counters, &error) != MW_OK)
            return fail(s->trial, &error);
        mw_counters_add(&sums[i], &counters);
        int end = measure_compare(s->trial->name, s->queries, n, a->walk, s->locations, "auto", s->answers);
        if (end) return end;
    }
    return 0;
}

static void take_means(const mw_counters *c, double value[QUANTITIES])
{
    const uint64_t sum[QUANTITIES] = {
        [TRIANGLES_INIT] = c->triangles_init,
        [TRIANGLES] = c->triangles,
        [TRIANGLES_FINAL] = c->triangles_final,
        [ORIENT_INIT] = c->orient_init,
        [ORIENT] = c->orient,
        [ORIENT_FINAL] = c->orient_final,
        [IMPLICIT] = c->implicit,
        [COMPARISONS] = c->comparisons,
    };
    for (int q = 0; q < QUANTITIES; q++) value[q] = (double)sum[q] / (double)c->queries;
    value[TRIANGLES_FINAL_MAX] = (double)c->triangles_final_max;
}

static int count(scene *s, outcome *o)
{
    mw_counters sums[MOST_ALGORITHMS] = {0};
    uint64_t done = 0;
    progress_phase("counting", s->trial->name);
    for (uint64_t block = 0; done < s->trial->queries; block++) {
        uint64_t left = s->trial->queries - done;
        size_t n = left < BLOCK ? (size_t)left : BLOCK;
        int end = draw(s, n);
        if (end == 0) end = count_block(s, n, block, sums);
        if (end) return end;
        done += n;
        progress_points(done);
    }
    mw_index_info info = {.layers = 1};
    if (s->index) mw_index_describe(s->index, &info);
    for (size_t i = 0; i < s->algorithms; i++) {
        take_means(&sums[i], o->value[i]);
        o->value[i][LAYERS] = info.layers;
    }
    return 0;
}

/* Microseconds per query of n queries from `begin` on, one after the other. */
static int time_one(const scene *s, const algorithm *a, mw_arithmetic arithmetic, size_t begin, size_t n, double *time)
{
    mw_error error;
    mw_cursor cursor;
    mw_query_options options = options_of(s, a, arithmetic);
    options.seed = s->trial->seed + begin;
    if (mw_cursor_init(&cursor, s->locator[a->areas], &options, &error) != MW_OK) return fail(s->trial, &error);
    const double *q = s->queries + 2 * begin;
    double clock = tally_clock();
    for (size_t i = 0; i < n; i++) s->locations[i] = mw_locate(s->locator[a->areas], &cursor, q[2 * i], q[2 * i + 1]);
    *time = 1e6 * (tally_clock() - clock) / (double)n;
    return 0;
}

static double median(double *times)
{
    for (int i = 1; i < TIMED_ROUNDS; i++)
        for (int k = i; k > 0 && times[k] < times[k - 1]; k--) {
            double other = times[k];
            times[k] = times[k - 1];
            times[k - 1] = other;
        }
    return times[TIMED_ROUNDS / 2];
}

/* Walks and arithmetics in turn, each round begun by another one. Round -1 warms up, with the first share of queries. */
static int time_all(scene *s, outcome *o)
{
    double times[MOST_ALGORITHMS][2][TIMED_ROUNDS];
    size_t all = s->trial->queries < TIMED_QUERIES ? (size_t)s->trial->queries : TIMED_QUERIES;
    size_t share = all < TIMED_ROUNDS ? 1 : all / TIMED_ROUNDS, entries = 2 * s->algorithms;
    s->random = ~s->trial->seed;
    int end = draw(s, TIMED_ROUNDS * share);
    progress_phase("timing", s->trial->name);
    for (int round = -1; round < TIMED_ROUNDS; round++)
        for (size_t k = 0; k < entries && end == 0; k++) {
            size_t entry = (k + (size_t)(round + 1)) % entries, i = entry / 2, turn = round < 0 ? 0 : (size_t)round;
            mw_arithmetic arithmetic = entry % 2 ? MW_EXACT : MW_DOUBLE;
            end = time_one(s, s->trial->algorithms[i], arithmetic, turn * share, share, &times[i][entry % 2][turn]);
        }
    for (size_t i = 0; i < s->algorithms && end == 0; i++) {
        o->value[i][TIME_US] = median(times[i][0]);
        o->value[i][TIME_EXACT_US] = median(times[i][1]);
    }
    return end;
}

int measure(const trial *t, outcome *o)
{
    scene s = {.trial = t, .random = ~t->seed};
    while (t->algorithms[s.algorithms]) s.algorithms++;
    *o = (outcome){0};
    int end = prepare(&s, o);
    if (end == 0) end = count(&s, o);
    if (end == 0 && t->times) end = time_all(&s, o);
    release(&s);
    return end;
}
