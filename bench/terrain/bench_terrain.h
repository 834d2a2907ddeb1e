/* bench_terrain.h - the measurement 'meshwalk bench terrain'. */
#ifndef MW_BENCH_TERRAIN_BENCH_TERRAIN_H
#define MW_BENCH_TERRAIN_BENCH_TERRAIN_H

#include "bench/core/settings.h"

/* `table` has to be NULL. Returns the exit code. */
int bench_terrain(const bench_settings *s, const char *table);

#endif
