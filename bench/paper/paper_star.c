/* paper_star.c - thesis, App. F, Tables 1 and 2: walks on star-shaped polyhedra.
 *
 * All walks locate the same rays, uniform over the sphere; what they find is compared. The
 * polyhedra are the subdivided tetrahedron, octahedron and icosahedron, as the authors had, and
 * hulls of random points moved in and out.
 * Table 2 has the same queries begin by indexes of 128, 512 and 2048 elements, each a data set of
 * its own. */
#include "bench/paper/paper_star.h"
#include "bench/core/query_rounds.h"
#include "bench/data/polyhedra.h"
#include "bench/paper/paper_models.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/monotonic_clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK ((size_t)1 << 18) /* queries in memory at a time */

/* A star, and a block of queries with their answers. */
typedef struct star_measurement {
    const paper *paper;
    const char *name;
    const mw_star *star;
    double centre[3], reach; /* queries are so far from the centre */
    size_t algorithms;
    mw_star_index *index[MOST_ALGORITHMS]; /* by algorithm; NULL: none */
    double *queries;
    mw_location *answers, *locations;
    uint64_t random; /* of the queries */
} star_measurement;

static const algorithm *star_measurement_algorithm(const star_measurement *s, size_t i)
{
    return s->paper->table->algorithms[i];
}

/* Where the table is about indexes, an algorithm has the name of its start. */
static mw_star_start_kind star_measurement_start(const star_measurement *s, size_t i)
{
    const char *start = s->paper->table->start;
    return mw_star_start_by_name(
        strcmp(start, "index") == 0 ? star_measurement_algorithm(s, i)->name : start);
}

static void star_measurement_release(star_measurement *s)
{
    for (size_t i = 0; i < s->algorithms; i++) mw_star_index_destroy(s->index[i]);
    free(s->queries);
    free(s->answers);
    free(s->locations);
}

/* An octahedron of 8 facets, each level with four times as many. */
static uint32_t octahedron_levels(uint32_t elements)
{
    uint32_t level = 0;
    while (UINT32_C(8) << 2 * level < elements) level++;
    return level;
}

static int star_measurement_prepare(star_measurement *s, uint32_t elements)
{
    mw_error error;
    mw_star_index_options options = {.cells = elements, .levels = octahedron_levels(elements) + 1};
    progress_phase("preparing", s->name);
    while (star_measurement_algorithm(s, s->algorithms)) s->algorithms++;
    s->random = ~s->paper->settings->common.seed;
    s->queries = malloc(3 * BLOCK * sizeof *s->queries);
    s->answers = malloc(BLOCK * sizeof *s->answers);
    s->locations = malloc(BLOCK * sizeof *s->locations);
    if (!s->queries || !s->answers || !s->locations) return fail_memory();
    for (size_t i = 0; i < s->algorithms; i++)
        if (mw_star_start_has_index(star_measurement_start(s, i)) &&
            mw_star_index_create(s->star, star_measurement_start(s, i), &options, &s->index[i],
                                 &error) != MW_OK)
            return fail_mesh(s->name, &error);
    return 0;
}

static void star_measurement_draw(star_measurement *s, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        double *q = s->queries + 3 * i;
        polyhedron_direction(q, &s->random);
        for (size_t k = 0; k < 3; k++) q[k] = s->centre[k] + s->reach * q[k];
    }
}

static mw_star_query_options paper_star_options(const star_measurement *s, size_t i)
{
    return (mw_star_query_options){
        .walk = mw_star_walk_by_name(star_measurement_algorithm(s, i)->walk),
        .start = star_measurement_start(s, i),
        .finish = mw_star_walk_by_name(s->paper->table->finish),
        .index = s->index[i],
        .seed = s->paper->settings->common.seed,
        .threads = s->paper->settings->common.threads,
    };
}

static int star_measurement_compare(const star_measurement *s, size_t n, const char *walk)
{
    for (size_t i = 0; i < n; i++) {
        const mw_location *a = &s->locations[i], *b = &s->answers[i];
        const double *q = s->queries + 3 * i;
        if (a->triangle == b->triangle && a->where == b->where) continue;
        complain("%s: the walks %s and auto found different facets towards %.17g %.17g %.17g",
                 s->name, walk, q[0], q[1], q[2]);
        return END_RESOURCE;
    }
    return 0;
}

static int star_measurement_count_block(star_measurement *s, size_t n, uint64_t block,
                                        mw_counters *sums)
{
    mw_error error;
    mw_star_query_options automatic = {.threads = s->paper->settings->common.threads};
    if (mw_star_locate_batch(s->star, s->queries, n, 3, &automatic, s->answers, NULL, &error) !=
        MW_OK)
        return fail_mesh(s->name, &error);
    for (size_t i = 0; i < s->algorithms; i++) {
        mw_counters counters;
        mw_star_query_options options = paper_star_options(s, i);
        options.counters = 1;
        options.seed += block; /* other random numbers in each block */
        if (mw_star_locate_batch(s->star, s->queries, n, 3, &options, s->locations, &counters,
                                 &error) != MW_OK)
            return fail_mesh(s->name, &error);
        mw_counters_add(&sums[i], &counters);
        int end = star_measurement_compare(s, n, star_measurement_algorithm(s, i)->name);
        if (end) return end;
    }
    return 0;
}

/* The paper's orthogonal walk counts the facets that it enters, and two comparisons for each; ours
 * the first one, too. */
static void star_values_leave_out_first(double value[QUANTITIES])
{
    value[TRIANGLES] -= 1;
    value[COMPARISONS] -= 2;
}

static void star_measurement_take_counts(const star_measurement *s, size_t i, const mw_counters *c,
                                         double value[QUANTITIES])
{
    double queries = (double)c->queries;
    value[TRIANGLES_INIT] = (double)c->triangles_init / queries;
    value[TRIANGLES] = (double)c->triangles / queries;
    value[TRIANGLES_FINAL] = (double)c->triangles_final / queries;
    value[ORIENT_INIT] = (double)c->orient_init / queries;
    value[ORIENT] = (double)c->orient / queries;
    value[ORIENT_FINAL] = (double)c->orient_final / queries;
    value[COMPARISONS] = (double)c->comparisons / queries;
    if (c->comparisons) star_values_leave_out_first(value);
    if (!s->index[i]) return;
    mw_star_index_info info;
    mw_star_index_describe(s->index[i], &info);
    value[LOCATOR_BYTES] = (double)info.bytes;
    value[LOCATOR_SECONDS] = info.seconds;
}

static int star_measurement_count(star_measurement *s, walk_outcome *o)
{
    mw_counters sums[MOST_ALGORITHMS] = {0};
    uint64_t done = 0, queries = s->paper->queries;
    progress_phase("counting", s->name);
    for (uint64_t block = 0; done < queries; block++) {
        size_t n = queries - done < BLOCK ? (size_t)(queries - done) : BLOCK;
        star_measurement_draw(s, n);
        int end = star_measurement_count_block(s, n, block, sums);
        if (end) return end;
        done += n;
        progress_points(done, (double)done / (double)queries);
    }
    for (size_t i = 0; i < s->algorithms; i++)
        star_measurement_take_counts(s, i, &sums[i], o->value[i]);
    return 0;
}

static int star_measurement_time_share(void *self, size_t i, size_t begin, size_t n, double *time)
{
    star_measurement *s = self;
    mw_error error;
    mw_star_cursor cursor;
    mw_star_query_options options = paper_star_options(s, i);
    options.seed += begin;
    if (mw_star_cursor_init(s->star, &options, &cursor, &error) != MW_OK)
        return fail_mesh(s->name, &error);
    const double *q = s->queries + 3 * begin;
    double clock = monotonic_seconds();
    for (size_t k = 0; k < n; k++) s->locations[k] = mw_star_locate(s->star, &cursor, q + 3 * k);
    *time = 1e6 * (monotonic_seconds() - clock) / (double)n;
    return 0;
}

static int star_measurement_time(star_measurement *s, walk_outcome *o)
{
    double times[MOST_ALGORITHMS];
    size_t share = query_rounds_share(s->paper->queries);
    star_measurement_draw(s, TIMED_ROUNDS * share);
    progress_phase("timing", s->name);
    int end = query_rounds_measure(s->algorithms, share, star_measurement_time_share, s, times);
    for (size_t i = 0; i < s->algorithms && end == 0; i++) o->value[i][TIME_EXACT_US] = times[i];
    return end;
}

/* With an index of so many elements; 0: without one. */
static int paper_measure_star(paper *p, const mw_surface *surface, const mw_star *star,
                              const char *set, const char *model, uint32_t elements)
{
    char name[256], suffix[16] = "";
    mw_star_info info;
    star_measurement s = {.paper = p, .name = name, .star = star};
    if (elements) snprintf(suffix, sizeof suffix, "-%u", elements);
    snprintf(name, sizeof name, "%.230s%s", set, suffix);
    paper_result *r = paper_add(p, name, model != NULL);
    if (!r) return fail_memory();
    if (model) paper_models_match(p->table, model, suffix, mw_surface_triangle_count(surface), r);
    r->walks = r->whole = true;
    r->outcome.vertices = mw_surface_vertex_count(surface);
    r->outcome.whole[MESH_TRIANGLES] = mw_surface_triangle_count(surface);
    mw_star_describe(star, &info);
    for (uint32_t i = 0; i < mw_surface_vertex_count(surface); i++) {
        double q[3];
        mw_surface_vertex(surface, i, q);
        for (size_t k = 0; k < 3; k++) s.reach = fmax(s.reach, fabs(q[k] - info.centre[k]));
    }
    memcpy(s.centre, info.centre, sizeof s.centre);
    int end = star_measurement_prepare(&s, elements);
    if (end == 0) end = star_measurement_count(&s, &r->outcome);
    if (end == 0 && !p->settings->no_times) end = star_measurement_time(&s, &r->outcome);
    star_measurement_release(&s);
    progress_phase("measuring", NULL); /* the name may go */
    return end;
}

/* The origin; or the mean of the vertices, where that will not do. */
static mw_status star_make_checked(const mw_surface *surface, mw_star **star, mw_error *error)
{
    mw_star_options options = {.angles = 1};
    uint32_t count = mw_surface_vertex_count(surface);
    mw_status status = mw_star_create(surface, &options, star, error);
    if (status != MW_ERROR_INPUT) return status;
    for (uint32_t i = 0; i < count; i++) {
        double q[3];
        mw_surface_vertex(surface, i, q);
        for (size_t k = 0; k < 3; k++) options.centre[k] += q[k] / count;
    }
    return mw_star_create(surface, &options, star, error);
}

int paper_star(paper *p, const mw_arrays *arrays, const char *name, const char *model)
{
    static const uint32_t elements[] = {128, 512, 2048};
    mw_error error;
    mw_surface *surface = NULL;
    mw_star *star = NULL;
    mw_surface_options options = {.weld = 1};
    int end = 0;
    if (mw_surface_create(arrays, &options, &surface, &error) != MW_OK ||
        star_make_checked(surface, &star, &error) != MW_OK)
        end = fail_mesh(name, &error);
    else if (strcmp(p->table->start, "index") != 0)
        end = paper_measure_star(p, surface, star, name, model, 0);
    else
        for (size_t i = 0; i < sizeof elements / sizeof *elements && end == 0; i++)
            end = paper_measure_star(p, surface, star, name, model, elements[i]);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    return end;
}
