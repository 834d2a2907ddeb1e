/* rounds.h - competitors measured beside each other, in interleaved rounds.
 *
 * In every round each competitor runs once, so that a disturbance of the machine hits all of them
 * alike. Each round starts with a different competitor, so that none always runs after the same
 * one. The median over the rounds ignores a single bad round. Every measurement of bench/ that
 * compares times uses this loop. */
#ifndef MW_BENCH_CORE_ROUNDS_H
#define MW_BENCH_CORE_ROUNDS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rounds_plan {
    size_t entries; /* the competitors */
    size_t leaders; /* the first ones, which run first in every round, in order: others need them */
    size_t figures; /* that one run yields, such as seconds to build and seconds to locate */
    size_t warmups; /* rounds before those that count; their figures are dropped */
    size_t rounds;  /* that count: at least 1 */
} rounds_plan;

/* The number of the round that a warm-up run is told. */
#define ROUNDS_WARMUP ((size_t)-1)

/* Run one entry once and set its figures. The callback takes the time itself: it alone knows what
 * belongs to it.
 *   round    from 0, or ROUNDS_WARMUP
 *   figures  rounds_plan.figures numbers; NaN where there is none
 * Returns 0, or an exit code, which ends the rounds. */
typedef int rounds_run(void *self, size_t entry, size_t round, double *figures);

/* The figures of all runs, and what they come to. Zero-initialised it is empty. */
typedef struct rounds_results {
    rounds_plan plan;
    double *values;  /* by entry, then by figure, then by round */
    double *medians; /* by entry, then by figure */
    double *minima;
} rounds_results;

/* Run all entries in all rounds. `self` is passed on to `run`. The results are to be released in
 * any case. Returns 0, or the exit code of the run that ended the rounds, or that of missing memory
 * after a complaint. */
int rounds_measure(const rounds_plan *plan, rounds_run *run, void *self, rounds_results *results);

double rounds_median(const rounds_results *results, size_t entry, size_t figure);
double rounds_minimum(const rounds_results *results, size_t entry, size_t figure);

void rounds_release(rounds_results *results);

#ifdef __cplusplus
}
#endif

#endif
