#include "tally.h"
#include "message.h"
#include "progress.h"
#include "report.h"

#include <stdio.h>
#include <time.h>
#ifdef _OPENMP
#include <omp.h>
#endif

double tally_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int tally_threads(uint32_t wanted)
{
#ifdef _OPENMP
    return wanted > 0 ? (int)wanted : omp_get_max_threads();
#else
    (void)wanted;
    return 1;
#endif
}

void tally_begin(tally *t)
{
    *t = (tally){.begin = tally_clock()};
}

void tally_block(tally *t, const mw_location *locations, size_t count, const mw_counters *counters, double seconds)
{
    for (size_t i = 0; i < count; i++) t->where[locations[i].where]++;
    mw_counters_add(&t->counters, counters);
    t->points += count;
    t->locating += seconds;
    t->blocks++;
}

static double per(uint64_t sum, uint64_t count)
{
    return count ? (double)sum / (double)count : 0;
}

/* Three digits after the point are plenty for times and means. */
static double rounded(double value)
{
    return (double)(int64_t)(value * 1000 + 0.5) / 1000;
}

static uint64_t tests_of(const mw_counters *c)
{
    return c->orient_init + c->orient + c->orient_final + c->orient_border;
}

static void report_walks(report *r, const tally *t)
{
    const mw_counters *c = &t->counters;
    report_number(r, "triangles_per_query", rounded(per(c->triangles_visited, c->queries)));
    report_count(r, "triangles_max", c->triangles_max);
    report_number(r, "triangles_init", rounded(per(c->triangles_init, c->queries)));
    report_number(r, "triangles", rounded(per(c->triangles, c->queries)));
    report_number(r, "triangles_final", rounded(per(c->triangles_final, c->queries)));
    report_count(r, "triangles_final_max", c->triangles_final_max);
    report_number(r, "tests_per_query", rounded(per(tests_of(c), c->queries)));
    report_number(r, "orient_init", rounded(per(c->orient_init, c->queries)));
    report_number(r, "orient", rounded(per(c->orient, c->queries)));
    report_number(r, "orient_final", rounded(per(c->orient_final, c->queries)));
    report_number(r, "implicit", rounded(per(c->implicit, c->queries)));
    report_number(r, "comparisons", rounded(per(c->comparisons, c->queries)));
    report_number(r, "walk_runs", rounded(per(c->walk_runs, c->queries)));
    report_count(r, "triangles_walk_max", c->triangles_walk_max);
    report_number(r, "border_runs", rounded(per(c->border_runs, c->queries)));
    report_number(r, "triangles_border", rounded(per(c->triangles_border, c->queries)));
    report_count(r, "triangles_border_max", c->triangles_border_max);
    report_number(r, "orient_border", rounded(per(c->orient_border, c->queries)));
    report_number(r, "border_edges", rounded(per(c->border_edges, c->queries)));
    report_count(r, "border_edges_max", c->border_edges_max);
    report_count(r, "cycles", c->cycles);
    report_count(r, "handovers", c->handovers);
}

static void report_memory(report *r, const query *q)
{
    mw_locator_info locator;
    mw_index_info index = {0};
    mw_locator_describe(q->locator, &locator);
    if (q->index) mw_index_describe(q->index, &index);
    report_count(r, "mesh_bytes", mw_mesh_bytes(q->mesh));
    report_count(r, "locator_bytes", locator.bytes);
    report_count(r, "area_bytes", locator.area_bytes);
    report_count(r, "start_bytes", index.bytes);
    report_number(r, "start_seconds", rounded(index.seconds));
    report_count(r, "ghost_triangles", locator.ghost_triangles);
    report_count(r, "fill_bytes", locator.fill_bytes);
    report_count(r, "pieces", locator.pieces);
}

/* The whole, and of it reading and preparing the mesh, and locating; the rest is reading points and writing rows. */
static void report_times(report *r, const tally *t, const query *q)
{
    report_number(r, "seconds", rounded(tally_clock() - q->begin));
    report_number(r, "preparing_seconds", rounded(t->begin - q->begin));
    report_number(r, "locating_seconds", rounded(t->locating));
    double rate = t->locating > 0 ? (double)t->points / t->locating : 0;
    report_count(r, "queries_per_second", (uint64_t)rate);
}

int tally_print(const tally *t, const query *q)
{
    const query_settings *settings = q->settings;
    report r;
    report_begin(&r, settings->json);
    report_count(&r, "points", t->points);
    for (int i = 0; i < MW_WHERE_COUNT; i++) report_count(&r, mw_where_name((mw_where)i), t->where[i]);
    report_string(&r, "walk", mw_walk_name((mw_walk_kind)settings->walk));
    report_string(&r, "start", mw_start_name((mw_start_kind)settings->start));
    report_string(&r, "arithmetic", settings->arithmetic == MW_EXACT ? "exact" : "double");
    report_count(&r, "seed", settings->common.seed);
    report_count(&r, "threads", (uint64_t)tally_threads(settings->common.threads));
    report_walks(&r, t);
    report_memory(&r, q);
    report_times(&r, t, q);
    report_end(&r);
    progress_end();
    int end = r.text.failed ? fail_memory() : 0;
    if (end == 0) fwrite(r.text.bytes, 1, r.text.size, stderr);
    text_release(&r.text);
    return end;
}
