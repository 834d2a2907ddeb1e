/* bench_near_vertices.h - the measurement 'meshwalk bench near-vertices [SET]'. */
#ifndef MW_BENCH_PAPER_BENCH_NEAR_VERTICES_H
#define MW_BENCH_PAPER_BENCH_NEAR_VERTICES_H

#include "bench/core/settings.h"

/* `set`: the name of a set of points, or NULL. Returns the exit code. */
int bench_near_vertices(const bench_settings *s, const char *set);

#endif
