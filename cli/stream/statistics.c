#include "cli/stream/statistics.h"
#include "cli/frame/monotonic_clock.h"

void location_statistics_add(location_statistics *s, const mw_location *locations, size_t count,
                             const mw_counters *counters)
{
    for (size_t i = 0; i < count; i++) s->where[locations[i].where]++;
    mw_counters_add(&s->counters, counters);
}

void statistics_report_mean(report *r, const char *name, uint64_t sum, uint64_t count)
{
    report_rounded(r, name, count ? (double)sum / (double)count : 0);
}

void statistics_report_settings(report *r, const common_settings *common)
{
    report_count(r, "seed", common->seed);
    report_count(r, "threads", (uint64_t)options_threads(common->threads));
}

void statistics_report_walks(report *r, const mw_counters *counters)
{
    uint64_t tests =
        counters->orient_init + counters->orient + counters->orient_final + counters->orient_border;
    statistics_report_mean(r, "triangles_per_query", counters->triangles_visited,
                           counters->queries);
    report_count(r, "triangles_max", counters->triangles_max);
    statistics_report_mean(r, "triangles_init", counters->triangles_init, counters->queries);
    statistics_report_mean(r, "triangles", counters->triangles, counters->queries);
    statistics_report_mean(r, "triangles_final", counters->triangles_final, counters->queries);
    report_count(r, "triangles_final_max", counters->triangles_final_max);
    statistics_report_mean(r, "tests_per_query", tests, counters->queries);
    statistics_report_mean(r, "orient_init", counters->orient_init, counters->queries);
    statistics_report_mean(r, "orient", counters->orient, counters->queries);
    statistics_report_mean(r, "orient_final", counters->orient_final, counters->queries);
    statistics_report_mean(r, "comparisons", counters->comparisons, counters->queries);
    report_count(r, "cycles", counters->cycles);
    report_count(r, "handovers", counters->handovers);
}

void statistics_report_times(report *r, const stream_statistics *s)
{
    report_rounded(r, "seconds", monotonic_seconds() - s->begin);
    report_rounded(r, "preparing_seconds", s->ready - s->begin);
    report_rounded(r, "locating_seconds", s->answering);
    double rate = s->answering > 0 ? (double)s->queries / s->answering : 0;
    report_count(r, "queries_per_second", (uint64_t)rate);
}
