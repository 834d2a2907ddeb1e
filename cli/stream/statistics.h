/* statistics.h - what --stats counts and reports. */
#ifndef MW_CLI_STREAM_STATISTICS_H
#define MW_CLI_STREAM_STATISTICS_H

#include "cli/frame/options.h"
#include "cli/frame/report.h"

#include <meshwalk/meshwalk.h>

/* Statistics of a stream of queries. The times are those of monotonic_seconds. */
typedef struct stream_statistics {
    double begin, ready; /* when the command began, and when it was ready for queries      */
    double answering;    /* seconds spent on answers, without reading queries, writing rows */
    uint64_t blocks, queries;
    uint64_t unanswered; /* rows without an answer */
} stream_statistics;

/* Where points were located, and what the walks did. */
typedef struct location_statistics {
    uint64_t where[MW_WHERE_COUNT];
    mw_counters counters;
} location_statistics;
void location_statistics_add(location_statistics *s, const mw_location *locations, size_t count,
                             const mw_counters *counters);

/* Parts of a report:
 *   _settings  seed and threads
 *   _walks     the counters of walks, of any kind of mesh
 *   _times     the seconds in all, to prepare the mesh, and to answer; the rest was spent on
 *              reading queries and on writing rows
 *   _mean      a mean, to three decimals; 0 if nothing was counted */
void statistics_report_settings(report *r, const common_settings *common);
void statistics_report_walks(report *r, const mw_counters *counters);
void statistics_report_times(report *r, const stream_statistics *s);
void statistics_report_mean(report *r, const char *name, uint64_t sum, uint64_t count);

#endif
