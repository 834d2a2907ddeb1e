/* comparison_print.h - the rows of a comparison as text. */
#ifndef MW_BENCH_PEERS_COMPARISON_PRINT_H
#define MW_BENCH_PEERS_COMPARISON_PRINT_H

#include "bench/peers/comparison.h"
#include "cli/frame/text.h"

/* `format`: one of settings.h. */
void comparison_print(const comparison_table *table, const comparison_plan *plan, int format,
                      text *t);

#endif
