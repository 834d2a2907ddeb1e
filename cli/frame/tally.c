#include "cli/frame/tally.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"

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

void tally_locations(location_tally *t, const mw_location *locations, size_t count, const mw_counters *counters)
{
    for (size_t i = 0; i < count; i++) t->where[locations[i].where]++;
    mw_counters_add(&t->counters, counters);
}

void tally_report_seconds(report *r, const char *name, double seconds)
{
    report_number(r, name, (double)(int64_t)(seconds * 1000 + 0.5) / 1000);
}

void tally_report_mean(report *r, const char *name, uint64_t sum, uint64_t count)
{
    double mean = count ? (double)sum / (double)count : 0;
    report_number(r, name, (double)(int64_t)(mean * 1000 + 0.5) / 1000);
}

void tally_report_run(report *r, const common_settings *common)
{
    report_count(r, "seed", common->seed);
    report_count(r, "threads", (uint64_t)tally_threads(common->threads));
}

void tally_report_walks(report *r, const mw_counters *c)
{
    uint64_t tests = c->orient_init + c->orient + c->orient_final + c->orient_border;
    tally_report_mean(r, "triangles_per_query", c->triangles_visited, c->queries);
    report_count(r, "triangles_max", c->triangles_max);
    tally_report_mean(r, "triangles_init", c->triangles_init, c->queries);
    tally_report_mean(r, "triangles", c->triangles, c->queries);
    tally_report_mean(r, "triangles_final", c->triangles_final, c->queries);
    report_count(r, "triangles_final_max", c->triangles_final_max);
    tally_report_mean(r, "tests_per_query", tests, c->queries);
    tally_report_mean(r, "orient_init", c->orient_init, c->queries);
    tally_report_mean(r, "orient", c->orient, c->queries);
    tally_report_mean(r, "orient_final", c->orient_final, c->queries);
    tally_report_mean(r, "comparisons", c->comparisons, c->queries);
    report_count(r, "cycles", c->cycles);
    report_count(r, "handovers", c->handovers);
}

/* The whole, and of it reading and preparing the mesh, and answering; the rest is reading queries and writing rows. */
void tally_report_times(report *r, const tally *t)
{
    tally_report_seconds(r, "seconds", tally_clock() - t->begin);
    tally_report_seconds(r, "preparing_seconds", t->ready - t->begin);
    tally_report_seconds(r, "locating_seconds", t->answering);
    double rate = t->answering > 0 ? (double)t->queries / t->answering : 0;
    report_count(r, "queries_per_second", (uint64_t)rate);
}

int tally_print(report *r)
{
    progress_end();
    int end = r->text.failed ? fail_memory() : 0;
    if (end == 0) fwrite(r->text.bytes, 1, r->text.size, stderr);
    text_release(&r->text);
    return end;
}
