/* paper_domains.h - App. D of the thesis: walks in meshes with pockets and holes. */
#ifndef MW_BENCH_PAPER_PAPER_DOMAINS_H
#define MW_BENCH_PAPER_PAPER_DOMAINS_H

#include "bench/paper/paper.h"

/* Meshes that are made: those of the table, or of the sizes, which a 0 ends. Returns 0 or an exit
 * code. */
int paper_domains_made(paper *p, const size_t *sizes);
/* The mesh of a file. Returns 0 or an exit code. */
int paper_domains_file(paper *p, const char *path, const char *name);

#endif
