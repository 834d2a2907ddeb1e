/* answers.h - answers compared: whatever the walk or the start, they are the same. */
#ifndef MW_BENCH_CORE_ANSWERS_H
#define MW_BENCH_CORE_ANSWERS_H

#include <meshwalk/meshwalk.h>

/* Two ways to locate the same queries, with what they found. */
typedef struct locations_pair {
    const char *way, *other; /* names of walks or starts */
    const mw_location *found, *expected;
} locations_pair;

/* Complains where the two found different triangles for n queries: x0 y0 x1 y1 ...; `data` names
 * the set of points. Returns 0 or an exit code. */
int locations_compare(const char *data, const double *queries, size_t n,
                      const locations_pair *pair);

#endif
