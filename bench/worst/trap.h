/* trap.h - what may be slow, one by one, and how long it takes. */
#ifndef MW_BENCH_WORST_TRAP_H
#define MW_BENCH_WORST_TRAP_H

#include "bench/worst/trap_figures.h"

/* The name of a trap, what it is; NULL beyond the last. */
const char *trap_name(int trap);
const char *trap_help(int trap);

/* Make it, and measure it. Returns 0, or an exit code after a complaint. */
int trap_measure(int trap, const trap_plan *plan, trap_figures *figures);

#endif
