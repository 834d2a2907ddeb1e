/* trap_figures.h - what is asked of a trap, and what it comes to. */
#ifndef MW_BENCH_WORST_TRAP_FIGURES_H
#define MW_BENCH_WORST_TRAP_FIGURES_H

#include "bench/worst/trap_mesh.h"
#include "bench/worst/trap_peers.h"

/* What one trap of one size comes to; NaN where there is no such figure. */
typedef struct trap_figures {
    double build; /* seconds until the first query                          */
    double batch; /* microseconds a query in a batch, one thread            */
    double alone; /* the same one by one                                    */
    double steps; /* triangles that a query visits, and tests of an index   */
    double bytes; /* beside the mesh                                        */
    trap_peer_figures peers[ENGINES];
} trap_figures;

typedef struct trap_plan {
    size_t vertices, queries, rounds;
    uint64_t seed;
    uint32_t engines; /* to be asked the same, where the trap is a mesh of the plane */
} trap_plan;

#endif
