/* published.h - what the thesis prints in its tables. */
#ifndef MW_BENCH_PAPER_PUBLISHED_H
#define MW_BENCH_PAPER_PUBLISHED_H

#include "bench/paper/quantity.h"

#include <stddef.h>

/* The number that a table prints for an algorithm on a set of so many vertices; NaN where it prints
 * none. */
double published_value(const char *table, const char *set, size_t vertices, const char *walk,
                       quantity q);

/* Has the table a column of this quantity for the algorithm, whatever the data? */
bool published_prints(const char *table, const char *walk, quantity q);

/* The sets of real data in a table: the i-th, from 0. Returns false beyond the last. */
bool published_real(const char *table, size_t i, const char **set, size_t *vertices);

#endif
