/* bench.h - what the command 'meshwalk bench' needs to know of the measurements. */
#ifndef MW_BENCH_BENCH_H
#define MW_BENCH_BENCH_H

#include "bench/core/settings.h"

/* The options of all measurements, those of every command excepted. */
extern const option bench_options[];

/* Run a measurement, 'meshwalk bench MEASUREMENT [TABLE]'. `table` is a table of the thesis or a
 * list of sets of points; NULL if it was not given. Complains about an unknown name. Returns the
 * exit code. */
int bench_run(const bench_settings *s, const char *measurement, const char *table);

#endif
