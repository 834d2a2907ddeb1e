/* bench_ranks.h - bench scale --ranks: the routing of libmeshwalk-mpi on many ranks, replayed. */
#ifndef MW_BENCH_RANKS_BENCH_RANKS_H
#define MW_BENCH_RANKS_BENCH_RANKS_H

#include "bench/core/settings.h"

/* Print imbalance and traffic of queries on each of s->ranks ranks, in a triangulation of a set of
 * points (NULL: "grid"). Returns the exit code. */
int bench_ranks(const bench_settings *s, const char *set);

#endif
