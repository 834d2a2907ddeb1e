/* tally.h - what --stats counts and prints. */
#ifndef CLI_TALLY_H
#define CLI_TALLY_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

struct report;

/* Of any stream of queries. Seconds are those of tally_clock. */
typedef struct tally {
    double begin, ready; /* when the command began, and when it was ready for queries */
    double answering;    /* that answering took, without reading and writing          */
    uint64_t blocks, queries;
    uint64_t unanswered; /* rows without an answer */
} tally;

/* Seconds of a clock that only goes forward. */
double tally_clock(void);
/* Threads that a request means: 0 = all there are. */
int tally_threads(uint32_t wanted);

/* Where points were found, and what the walks did. */
typedef struct location_tally {
    uint64_t where[MW_WHERE_COUNT];
    mw_counters counters;
} location_tally;
void tally_locations(location_tally *t, const mw_location *locations, size_t count, const mw_counters *counters);

/* Parts of a report. */
void tally_report_run(struct report *r, const common_settings *common); /* seed, threads */
void tally_report_walks(struct report *r, const mw_counters *c);        /* of walks of any kind */
void tally_report_times(struct report *r, const tally *t);
/* A mean with three digits after the point, plenty for means and times; 0 where nothing was counted. */
void tally_report_mean(struct report *r, const char *name, uint64_t sum, uint64_t count);
void tally_report_seconds(struct report *r, const char *name, double seconds);

/* Print a report on standard error and release it. Returns 0 or an exit code. */
int tally_print(struct report *r);

#endif
