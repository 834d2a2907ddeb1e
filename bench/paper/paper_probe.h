/* paper_probe.h - App. G of the thesis: probes of surfaces. */
#ifndef MW_BENCH_PAPER_PAPER_PROBE_H
#define MW_BENCH_PAPER_PAPER_PROBE_H

#include "bench/paper/paper.h"

/* `model`: NULL, or of a file of the user: the model that it stands in for, or empty. Returns 0 or
 * an exit code. */
int paper_probe(paper *p, const mw_arrays *arrays, const char *name, const char *model);

#endif
