/* rank_queries.h - who asks where: queries as applications spread them over space and ranks. */
#ifndef MW_BENCH_RANKS_RANK_QUERIES_H
#define MW_BENCH_RANKS_RANK_QUERIES_H

#include "bench/data/dataset.h"

typedef enum rank_spread {
    RANK_SPREAD_UNIFORM, /* anywhere, each asked by any rank: a file that is read in parts */
    RANK_SPREAD_HOT,     /* normal round one place, with a deviation of a hundredth of the extent */
    /* particles, normal with a twentieth, that cross the mesh in 20 steps; the rank that had a
     * particle's triangle asks for it, as after mwp_migrate */
    RANK_SPREAD_CLOUD,
    RANK_SPREADS
} rank_spread;

enum { RANK_CLOUD_STEPS = 20 };

/* "uniform", "hot spot", "cloud". */
const char *rank_spread_name(rank_spread spread);

/* Draw n points. In a cloud the points of one step come one after another, n / RANK_CLOUD_STEPS of
 * them, in the same order of particles; n is a multiple of the steps. */
void rank_spread_draw(const dataset *domain, rank_spread spread, double *points, size_t n,
                      uint64_t seed);

#endif
