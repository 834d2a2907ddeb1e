/* paper_print.h - the figures of a table as text. */
#ifndef MW_BENCH_PAPER_PAPER_PRINT_H
#define MW_BENCH_PAPER_PAPER_PRINT_H

#include "bench/paper/paper.h"
#include "cli/frame/text.h"

/* In the format of the settings. */
void paper_print(const paper *p, text *t);

#endif
