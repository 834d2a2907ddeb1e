/* bench_paper.h - the measurement 'meshwalk bench paper TABLE'. */
#ifndef MW_BENCH_PAPER_BENCH_PAPER_H
#define MW_BENCH_PAPER_BENCH_PAPER_H

#include "bench/core/settings.h"

/* `table`: the name of a table of the thesis. Complains about NULL. Returns the exit code. */
int bench_paper(const bench_settings *s, const char *table);

#endif
