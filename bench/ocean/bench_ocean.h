/* bench_ocean.h - the measurement 'meshwalk bench ocean'. */
#ifndef MW_BENCH_OCEAN_BENCH_OCEAN_H
#define MW_BENCH_OCEAN_BENCH_OCEAN_H

#include "bench/core/settings.h"

/* `table` has to be NULL. Returns the exit code. */
int bench_ocean(const bench_settings *s, const char *table);

#endif
