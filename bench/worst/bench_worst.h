/* bench_worst.h - the measurement 'meshwalk bench worst [TRAP]'. */
#ifndef MW_BENCH_WORST_BENCH_WORST_H
#define MW_BENCH_WORST_BENCH_WORST_H

#include "bench/core/settings.h"

/* `traps`: names of traps, with commas between them, or NULL. Returns the exit code. */
int bench_worst(const bench_settings *s, const char *traps);

#endif
