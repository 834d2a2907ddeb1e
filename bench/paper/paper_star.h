/* paper_star.h - App. F of the thesis: walks on star-shaped polyhedra. */
#ifndef MW_BENCH_PAPER_PAPER_STAR_H
#define MW_BENCH_PAPER_PAPER_STAR_H

#include "bench/paper/paper.h"

/* `model`: NULL, or of a file of the user: the model that it stands in for, or empty. Returns 0 or
 * an exit code. */
int paper_star(paper *p, const mw_arrays *arrays, const char *name, const char *model);

#endif
