/* bench_segments.h - the measurement 'meshwalk bench segments'. */
#ifndef MW_BENCH_SEGMENTS_BENCH_SEGMENTS_H
#define MW_BENCH_SEGMENTS_BENCH_SEGMENTS_H

#include "bench/core/settings.h"

/* `table` has to be NULL. Returns the exit code. */
int bench_segments(const bench_settings *s, const char *table);

#endif
