/* paper_seeds.h - a table measured over several seeds: mean and deviation. */
#ifndef MW_BENCH_PAPER_PAPER_SEEDS_H
#define MW_BENCH_PAPER_PAPER_SEEDS_H

#include "bench/paper/paper.h"

/* The results are those of `seeds` runs of the same sets, one after the other. Replace them by one
 * result a set: its values are the means, its deviation their standard deviations over the
 * seeds. */
void paper_seeds_fold(paper *p, size_t seeds);

#endif
