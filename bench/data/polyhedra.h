/* polyhedra.h - closed surfaces in space to measure with, made from a seed. */
#ifndef MW_BENCH_DATA_POLYHEDRA_H
#define MW_BENCH_DATA_POLYHEDRA_H

#include <meshwalk/meshwalk.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum polyhedron_kind {
    /* each facet cut in four, again and again, and its vertices moved to the unit sphere:
     * 2 * 4^level + 2, 4 * 4^level + 2 or 10 * 4^level + 2 of them */
    POLYHEDRON_TETRAHEDRON,
    POLYHEDRON_OCTAHEDRON,
    POLYHEDRON_ICOSAHEDRON,
    /* the hull of points uniform on the unit sphere, each then moved in or out by a random factor
     * from 0.8 to 1.2: star-shaped about the origin */
    POLYHEDRON_STAR,
    /* the same hull, its points moved by a sum of waves: star-shaped, too, and smooth */
    POLYHEDRON_BUMPS,
    /* a tube round a trefoil knot, a grid of its length and girth; below 40 vertices it meets
     * itself */
    POLYHEDRON_KNOT,
    POLYHEDRON_KINDS
} polyhedron_kind;

/* "tetrahedron", "octahedron", "icosahedron", "star", "bumps", "knot"; NULL for another number. */
const char *polyhedron_name(int kind);

/* Facets are counter-clockwise seen from outside. */
typedef struct polyhedron {
    double *points; /* x0 y0 z0 x1 y1 z1 ... */
    size_t point_count;
    uint32_t *triangles; /* 3 each */
    size_t triangle_count;
} polyhedron;

/* Make one of n vertices, at least 10; the same for the same seed. A subdivided one has the level
 * that comes nearest to n from below, a knot about n. MW_ERROR_MEMORY, or what the triangulation
 * says; then it is empty. */
mw_status polyhedron_make(polyhedron *p, polyhedron_kind kind, size_t n, uint64_t seed,
                          mw_error *error);
void polyhedron_release(polyhedron *p);

mw_arrays polyhedron_arrays(const polyhedron *p);

/* The tetrahedron, octahedron or icosahedron of which some level has so many vertices: no two have
 * the same; `other` if there is none. */
polyhedron_kind polyhedron_subdivided(size_t n, polyhedron_kind other);

/* A direction uniform on the unit sphere; *random goes on from call to call. */
void polyhedron_direction(double direction[3], uint64_t *random);

#ifdef __cplusplus
}
#endif

#endif
