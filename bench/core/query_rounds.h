/* query_rounds.h - the time of a single query, of competitors beside each other: in every round all
 * of them answer the same share of the queries. */
#ifndef MW_BENCH_CORE_QUERY_ROUNDS_H
#define MW_BENCH_CORE_QUERY_ROUNDS_H

#include <stddef.h>
#include <stdint.h>

/* The most queries that are timed, and the number of rounds that share them. */
#define TIMED_QUERIES 20000
#define TIMED_ROUNDS 5

/* How many queries each round gets when there are so many. */
size_t query_rounds_share(uint64_t queries);

/* Answer the queries from `begin` on, `count` of them, one after the other, as competitor `entry`
 * does; set the microseconds that each took. Returns 0 or an exit code. */
typedef int query_rounds_run(void *self, size_t entry, size_t begin, size_t count,
                             double *microseconds);

/* Set the median of each entry over TIMED_ROUNDS rounds, which share the queries from 0 to
 * TIMED_ROUNDS * share - 1. One round before them, with the first share, is a warm-up. Returns 0 or
 * an exit code. */
int query_rounds_measure(size_t entries, size_t share, query_rounds_run *run, void *self,
                         double *medians);

#endif
