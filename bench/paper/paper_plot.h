/* paper_plot.h - the figures of a table as a picture. */
#ifndef MW_BENCH_PAPER_PAPER_PLOT_H
#define MW_BENCH_PAPER_PAPER_PLOT_H

#include "bench/paper/paper.h"

/* Complains about what can be known before the work. Returns 0 or an exit code. */
int paper_plot_check(const bench_settings *s, const paper_table *table);
/* Returns 0 or an exit code. */
int paper_plot(const paper *p, const char *path);

#endif
