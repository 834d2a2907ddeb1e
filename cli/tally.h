/* tally.h - what --stats counts and prints. */
#ifndef CLI_TALLY_H
#define CLI_TALLY_H

#include "query.h"

typedef struct tally {
    uint64_t where[MW_WHERE_COUNT];
    uint64_t unanswered; /* rows without an answer */
    uint64_t blocks, points;
    mw_counters counters;
    double begin, locating; /* seconds: when the mesh was ready; the locating alone */
} tally;

/* Seconds of a clock that only goes forward. */
double tally_clock(void);
/* Threads that a request means: 0 = all there are. */
int tally_threads(uint32_t wanted);

void tally_begin(tally *t);
void tally_block(tally *t, const mw_location *locations, size_t count, const mw_counters *counters, double seconds);
/* Print on standard error. Returns 0 or an exit code. */
int tally_print(const tally *t, const query *q);

#endif
