/* bench near-vertices: queries as near to vertices as doubles allow, where walks in plain doubles
 * go round in circles [thesis App. E, sec. 8]. Counts, for every walk and arithmetic, the walks
 * that ran out of steps and those that the celestial walk had to end.
 *
 * A query lies within 1e-15 of a random vertex in each coordinate or, where doubles are coarser
 * than that, is one of the doubles next to it. Queries are sorted along a Hilbert curve, and each
 * begins where the one before it ended: nearby, and from all sides. */
#include "bench/paper/bench_near_vertices.h"
#include "bench/core/answers.h"
#include "bench/core/word_list.h"
#include "bench/data/dataset.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/spelling.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 1 << 17, DEFAULT_QUERIES = 1000000, DEFAULT_VERTICES = 100000 };

static const dataset_kind sets[] = {DATASET_UNIFORM, DATASET_GRID, DATASET_RINGS, DATASET_SLIVERS,
                                    DATASET_OFFSET};

#define SETS (sizeof sets / sizeof *sets)

/* --- the measurement -------------------------------------------------------------------------- */

/* One walk in one arithmetic. */
typedef struct near_entry {
    mw_walk_kind walk;
    mw_arithmetic arithmetic;
    bool areas; /* direct: with stored areas */
    mw_counters counters;
} near_entry;

#define MOST_ENTRIES (2 * (MW_WALK_COUNT + 1))

typedef struct near_vertices {
    const bench_settings *settings;
    const char *name;
    const dataset *data;
    mw_mesh *mesh;
    mw_locator *locator[2]; /* without and with stored areas */
    double *queries;
    mw_location *answers, *locations;
    uint64_t random;
    near_entry entries[MOST_ENTRIES];
    size_t entry_count;
} near_vertices;

static void near_vertices_add(near_vertices *s, mw_walk_kind walk, bool areas)
{
    for (mw_arithmetic arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++)
        s->entries[s->entry_count++] =
            (near_entry){.walk = walk, .arithmetic = arithmetic, .areas = areas};
}

static int near_vertices_fail(const near_vertices *s, const mw_error *error)
{
    return fail_mesh(s->name, error);
}

static int near_vertices_prepare(near_vertices *s)
{
    mw_error error;
    for (mw_walk_kind walk = MW_WALK_AUTO + 1; walk < MW_WALK_COUNT; walk++) {
        near_vertices_add(s, walk, false);
        if (walk == MW_WALK_DIRECT) near_vertices_add(s, walk, true);
    }
    progress_phase("triangulating", s->name);
    if (mw_delaunay(s->data->points, s->data->count, 2, NULL, NULL, NULL, &s->mesh, &error) !=
        MW_OK)
        return near_vertices_fail(s, &error);
    for (int areas = 0; areas < 2; areas++)
        if (mw_locator_create(s->mesh, &(mw_locator_options){.areas = areas}, &s->locator[areas],
                              &error) != MW_OK)
            return near_vertices_fail(s, &error);
    s->queries = malloc(2 * BLOCK * sizeof *s->queries);
    s->answers = malloc(BLOCK * sizeof *s->answers);
    s->locations = malloc(BLOCK * sizeof *s->locations);
    return s->queries && s->answers && s->locations ? 0 : fail_memory();
}

static void near_vertices_release(near_vertices *s)
{
    free(s->queries);
    free(s->answers);
    free(s->locations);
    for (int areas = 0; areas < 2; areas++) mw_locator_destroy(s->locator[areas]);
    mw_mesh_destroy(s->mesh);
}

static double value_nudged(double value, uint64_t *random)
{
    double spacing = nextafter(fabs(value), INFINITY) - fabs(value);
    return value + (2 * dataset_unit(random) - 1) * fmax(1e-15, 1.5 * spacing);
}

static void near_vertices_draw(near_vertices *s, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        size_t v = (size_t)(dataset_unit(&s->random) * (double)s->data->count);
        for (size_t k = 0; k < 2; k++)
            s->queries[2 * i + k] = value_nudged(s->data->points[2 * v + k], &s->random);
    }
}

static int near_entry_run(near_vertices *s, near_entry *e, size_t n, uint64_t seed)
{
    mw_error error;
    mw_counters counters;
    mw_query_options options = {
        .walk = e->walk,
        .start = MW_START_SORTED,
        .arithmetic = e->arithmetic,
        .seed = seed,
        .threads = s->settings->common.threads,
        .counters = 1,
    };
    mw_location *locations = e == s->entries ? s->answers : s->locations;
    if (mw_locate_batch(s->locator[e->areas], s->queries, n, 2, &options, locations, &counters,
                        &error) != MW_OK)
        return near_vertices_fail(s, &error);
    mw_counters_add(&e->counters, &counters);
    locations_pair pair = {mw_walk_name(e->walk), mw_walk_name(s->entries[0].walk), locations,
                           s->answers};
    return locations_compare(s->name, s->queries, n, &pair);
}

static int near_vertices_run(near_vertices *s)
{
    uint64_t queries = s->settings->queries ? s->settings->queries : DEFAULT_QUERIES;
    int end = 0;
    progress_phase("locating near vertices", s->name);
    for (uint64_t done = 0; done < queries && end == 0; done += BLOCK) {
        size_t n = queries - done < BLOCK ? (size_t)(queries - done) : BLOCK;
        near_vertices_draw(s, n);
        for (size_t i = 0; i < s->entry_count && end == 0; i++)
            end = near_entry_run(s, &s->entries[i], n, s->settings->common.seed + done);
        progress_points(done + n, (double)(done + n) / (double)queries);
    }
    return end;
}

/* --- the rows --------------------------------------------------------------------------------- */

static double count_per_million(uint64_t count, uint64_t queries)
{
    return 1e6 * (double)count / (double)queries;
}

static void near_vertices_print(const near_vertices *s, text *t)
{
    bool tsv = s->settings->format == FORMAT_TSV;
    if (!tsv)
        text_printf(t, "%s, %zu vertices, %llu queries: per million\n  %-24s %-8s %12s %12s\n",
                    s->name, s->data->count, (unsigned long long)s->entries[0].counters.queries,
                    "walk", "", "cycles", "hand-overs");
    for (size_t i = 0; i < s->entry_count; i++) {
        const near_entry *e = &s->entries[i];
        const mw_counters *c = &e->counters;
        const char *walk = mw_walk_name(e->walk), *form = e->areas ? "-areas" : "";
        const char *arithmetic = e->arithmetic == MW_EXACT ? "exact" : "double";
        double cycles = count_per_million(c->cycles, c->queries),
               handovers = count_per_million(c->handovers, c->queries);
        if (tsv)
            text_printf(t, "%s\t%zu\t%s%s\t%s\t%llu\t%llu\t%llu\t%.6g\t%.6g\n", s->name,
                        s->data->count, walk, form, arithmetic, (unsigned long long)c->queries,
                        (unsigned long long)c->cycles, (unsigned long long)c->handovers, cycles,
                        handovers);
        else
            text_printf(t, "  %s%-*s %-8s %12.6g %12.6g\n", walk, 24 - (int)strlen(walk), form,
                        arithmetic, cycles, handovers);
    }
    if (!tsv) text_string(t, "\n");
}

static int near_vertices_measure(const bench_settings *settings, const char *name,
                                 const dataset *data, text *t)
{
    near_vertices s = {
        .settings = settings, .name = name, .data = data, .random = settings->common.seed};
    int end = near_vertices_prepare(&s);
    if (end == 0) end = near_vertices_run(&s);
    if (end == 0) near_vertices_print(&s, t);
    near_vertices_release(&s);
    return end;
}

/* --- the command ------------------------------------------------------------------------------ */

static int near_vertices_measure_made(const bench_settings *settings, size_t i, size_t vertices,
                                      text *t)
{
    dataset data;
    if (!dataset_make(&data, sets[i], vertices, false, settings->common.seed)) return fail_memory();
    int end = near_vertices_measure(settings, dataset_name((int)sets[i]), &data, t);
    dataset_release(&data);
    return end;
}

static int near_vertices_check_settings(const bench_settings *s)
{
    if (s->format == FORMAT_JSON || s->plot || s->data || s->enclose != ENCLOSE_AUTO) {
        complain(
            "bench near-vertices makes its own points and prints them with --format table or tsv");
        return END_USAGE;
    }
    if (s->no_times) {
        complain("bench near-vertices takes no times: leave out --no-times");
        return END_USAGE;
    }
    return 0;
}

/* The set of that name. Complains; returns SETS if there is none. */
static size_t near_vertices_set_named(const char *name)
{
    spelling s = spelling_of(name);
    for (size_t i = 0; i < SETS; i++) {
        const char *set = dataset_name((int)sets[i]);
        if (strcmp(set, name) == 0) return i;
        spelling_try(&s, set);
    }
    spelling_complain(&s, "set", "");
    return SETS;
}

int bench_near_vertices(const bench_settings *s, const char *set)
{
    size_list sizes = {.size = {DEFAULT_VERTICES}, .count = 1};
    text t = {0};
    size_t only = set ? near_vertices_set_named(set) : 0;
    int end = only == SETS ? END_USAGE : near_vertices_check_settings(s);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &sizes);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    if (end == 0 && s->format == FORMAT_TSV)
        text_string(
            &t,
            "dataset\tvertices\twalk\tarithmetic\tqueries\tcycles\thandovers\tcycles_per_million\t"
            "handovers_per_million\n");
    for (size_t i = 0; i < SETS; i++)
        for (size_t k = 0; k < sizes.count && end == 0 && (!set || i == only); k++)
            end = near_vertices_measure_made(s, i, sizes.size[k], &t);
    if (end == 0) return files_write_text(s->common.output, &t);
    text_release(&t);
    return end;
}
