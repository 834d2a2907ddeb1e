/* paper_star.h - App. F of the thesis: walks on star-shaped polyhedra. */
#ifndef MW_BENCH_PAPER_PAPER_STAR_H
#define MW_BENCH_PAPER_PAPER_STAR_H

#include "bench/paper/paper.h"

/* `users_file`: it is a file of the user's. Returns 0 or an exit code. */
int paper_star(paper *p, const mw_arrays *arrays, const char *name, bool users_file);

#endif
