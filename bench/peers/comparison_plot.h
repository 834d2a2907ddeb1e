/* comparison_plot.h - the rows of a comparison as a picture, over the number of vertices. */
#ifndef MW_BENCH_PEERS_COMPARISON_PLOT_H
#define MW_BENCH_PEERS_COMPARISON_PLOT_H

#include "bench/peers/comparison.h"

/* A panel for each set and task, a curve for each engine. The table is not empty. Returns 0 or an
 * exit code after a complaint. */
int comparison_plot(const comparison_table *table, const char *path);

#endif
