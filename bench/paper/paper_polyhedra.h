/* paper_polyhedra.h - the polyhedra of App. F and the surfaces of App. G. */
#ifndef MW_BENCH_PAPER_PAPER_POLYHEDRA_H
#define MW_BENCH_PAPER_PAPER_POLYHEDRA_H

#include "bench/paper/paper.h"

/* Those that are made, of the sizes, which a 0 ends. Return 0 or an exit code. */
int paper_polyhedra_stars(paper *p, const size_t *sizes);
int paper_polyhedra_surfaces(paper *p, const size_t *sizes);
/* The one of a file, as the table wants it; `model` is the one that it stands in for, or empty.
 * Returns 0 or an exit code. */
int paper_polyhedra_file(paper *p, const char *path, const char *name, const char *model);

#endif
