/* trap_clock.h - how long queries take, in a batch, one by one, and by other libraries. */
#ifndef MW_BENCH_WORST_TRAP_CLOCK_H
#define MW_BENCH_WORST_TRAP_CLOCK_H

#include "bench/worst/trap_figures.h"

/* Answer n queries, either way. Returns an exit code. */
typedef int trap_answer(void *self, size_t n, bool alone);

/* The ways to answer that are timed; after these two, one for each peer. */
enum { TRAP_BATCH, TRAP_ALONE, TRAP_PEERS, TRAP_MOST = TRAP_PEERS + ENGINES };

typedef struct trap_clock {
    trap_answer *answer;
    void *self;
    size_t queries;          /* that there are */
    size_t count[TRAP_MOST]; /* that each way answers */
    trap_peers *peers;       /* NULL: none */
    const double *points;    /* their queries */
} trap_clock;

/* Set the times of all ways, medians of rounds in turn, and how many queries each answers. */
int trap_take_times(trap_clock *c, const trap_plan *plan, trap_figures *f);

#endif
