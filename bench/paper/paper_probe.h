/* paper_probe.h - App. G of the thesis: probes of surfaces. */
#ifndef MW_BENCH_PAPER_PAPER_PROBE_H
#define MW_BENCH_PAPER_PAPER_PROBE_H

#include "bench/paper/paper.h"

/* `users_file`: it is a file of the user's. Returns 0 or an exit code. */
int paper_probe(paper *p, const mw_arrays *arrays, const char *name, bool users_file);

#endif
