/* bench_space.h - the measurement 'meshwalk bench space'. */
#ifndef MW_BENCH_SPACE_BENCH_SPACE_H
#define MW_BENCH_SPACE_BENCH_SPACE_H

#include "bench/core/settings.h"

/* `table` is a list of models that are made, as in "icosahedron,knot"; NULL: the default. Returns
 * the exit code. */
int bench_space(const bench_settings *s, const char *table);

#endif
