/* trap.h - what may be slow, one by one, and how long it takes. */
#ifndef MW_BENCH_WORST_TRAP_H
#define MW_BENCH_WORST_TRAP_H

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

/* The name of a trap, what it is; NULL beyond the last. */
const char *trap_name(int trap);
const char *trap_help(int trap);

/* Make it, and measure it. Returns 0, or an exit code after a complaint. */
int trap_measure(int trap, const trap_plan *plan, trap_figures *figures);

#endif
