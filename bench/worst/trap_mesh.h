/* trap_mesh.h - meshes on which point location can be slow, and queries for them. */
#ifndef MW_BENCH_WORST_TRAP_MESH_H
#define MW_BENCH_WORST_TRAP_MESH_H

#include <meshwalk/meshwalk.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The arrays of a mesh; it owns them. Without triangles it is a set of points to triangulate. */
typedef struct trap_mesh {
    double *points;
    uint32_t *triangles;
    size_t point_count, triangle_count;
    size_t first_few; /* queries are in triangles with a point from this one on; 0: in all */
} trap_mesh;

/* Fill *m with about n vertices; false when memory runs out. Release it in either case. */
typedef bool trap_mesh_make(trap_mesh *m, size_t n, uint64_t seed);

trap_mesh_make trap_strip_30, trap_strip_300, trap_strip_2000, trap_fan, trap_half_fan, trap_hubs,
    trap_rings, trap_uniform, trap_tiny, trap_tinier, trap_huge, trap_least, trap_denormal,
    trap_clusters, trap_circle;
/* --- trap_few.c --- */
trap_mesh_make trap_few_cluster, trap_few_graded, trap_few_comb, trap_few_wheel, trap_few_wheels;

/* --- trap_shapes.c --- */
trap_mesh_make trap_hub_within, trap_fan_within, trap_spiral, trap_comb, trap_weave, trap_quadtree,
    trap_layers_round;

void trap_mesh_release(trap_mesh *m);

/* Where queries lie. */
typedef enum trap_position {
    TRAP_IN_TRIANGLES, /* in random triangles, at a random point of each */
    TRAP_ON_VERTICES,
    TRAP_ON_EDGES /* at rounded middles of edges */
} trap_position;

/* Set n queries, x0 y0 x1 y1 ..., in triangles with a vertex from `first` on. False when out of
 * memory. */
bool trap_draw(const mw_mesh *mesh, size_t first, trap_position position, double *queries, size_t n,
               uint64_t seed);

#endif
