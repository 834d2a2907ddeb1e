/* domains.h - meshes with pockets and holes to measure in, made from a seed.
 *
 * The outline is a star about the origin: corners at equal angles, their distances the exponential
 * of a sum of low waves, and a little noise, with narrow arms. Holes are smaller stars without
 * arms, which touch neither the outline nor each other. Points lie between them, closer in some
 * parts than in others, and the outline and the holes constrain their Delaunay triangulation. */
#ifndef MW_BENCH_DATA_DOMAINS_H
#define MW_BENCH_DATA_DOMAINS_H

#include <meshwalk/meshwalk.h>

typedef struct domain_shape {
    size_t vertices, border_edges; /* at least 10, and of them at least 8 at the border */
    size_t holes;                  /* each with at least three of the border edges      */
    double share;                  /* of the convex hull, in the mesh: met to a hundredth or so */
} domain_shape;

/* The same mesh for the same seed. MW_ERROR_MEMORY, or what the triangulation says. */
mw_status domain_make(const domain_shape *shape, uint64_t seed, mw_mesh **out, mw_error *error);

#endif
