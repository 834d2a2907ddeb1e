/* rounds.h - times of things beside each other, taken in rounds so that they meet the same machine. */
#ifndef CLI_ROUNDS_H
#define CLI_ROUNDS_H

#include <stddef.h>
#include <stdint.h>

/* Most queries that are timed, and in how many rounds: each round takes its share of them. */
#define TIMED_QUERIES 20000
#define TIMED_ROUNDS 5
#define MOST_TIMED 16 /* things */

/* The share of a round, of as many queries as there may be. */
size_t rounds_share(uint64_t queries);

/* Do the queries from `begin` on, `count` of them, one after the other, with thing `entry`; set the microseconds that
 * each took. Returns 0 or an exit code. */
typedef int time_share(void *self, size_t entry, size_t begin, size_t count, double *microseconds);

/* The median of the rounds for each of the things, at most MOST_TIMED. In each round all take the same share of the
 * queries 0 to TIMED_ROUNDS * share - 1, begun by another one; a round before warms up. Returns 0 or an exit code. */
int rounds_time(size_t entries, size_t share, time_share *run, void *self, double *medians);

/* The median of count > 0 times, which are put in order. */
double rounds_median(double *times, size_t count);

#endif
