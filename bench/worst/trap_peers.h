/* trap_peers.h - engines of other libraries, asked the same questions in the mesh of a trap. */
#ifndef MW_BENCH_WORST_TRAP_PEERS_H
#define MW_BENCH_WORST_TRAP_PEERS_H

#include "bench/peers/engine.h"

#include <meshwalk/meshwalk.h>

/* What one engine of one trap comes to; NaN where there is no such figure. */
typedef struct trap_peer_figures {
    double build; /* seconds until the first query, or of a triangulation      */
    double query; /* microseconds a query, one thread                          */
    double wrong; /* the share of answers whose triangle does not have the point */
} trap_peer_figures;

typedef struct trap_peer {
    engine_id id;
    const engine_code *code;
    void *structure;
} trap_peer;

/* Zero-initialised it is empty. */
typedef struct trap_peers {
    double *points;
    uint32_t *triangles;
    engine_mesh mesh;
    uint64_t *answers;
    trap_peer peers[ENGINES]; /* those that could be built */
    size_t count;
} trap_peers;

/* Build those engines of a set that locate points, for n queries, and tell what building took; one
 * that fails, or for which there is no memory, is left out after a complaint. Release them in any
 * case. Returns 0, or an exit code after a complaint. */
int trap_peers_build(trap_peers *p, uint32_t set, const mw_mesh *mesh, size_t n,
                     trap_peer_figures *figures);
void trap_peers_release(trap_peers *p);

/* Let peer k answer n queries. Returns 0 and its seconds, or an exit code after a complaint. */
int trap_peers_locate(trap_peers *p, size_t k, const double *queries, size_t n, double *seconds);

/* The share of n queries that peer k gives a triangle that does not have them, or none. Counts
 * those that have a triangle: `locations` are the right answers. */
double trap_peers_wrong(trap_peers *p, size_t k, const double *queries, size_t n,
                        const mw_location *locations);

/* Triangulate points by those engines of a set that do. */
void trap_peers_triangulate(uint32_t set, const double *points, size_t n,
                            trap_peer_figures *figures);

#endif
