/* meshes.h - small planar meshes for tests, as the arrays that a user would bring, and queries
 * that find fault with them. */
#ifndef MW_TESTS_SUPPORT_MESHES_H
#define MW_TESTS_SUPPORT_MESHES_H

#include <meshwalk/meshwalk.h>
#include <stddef.h>
#include <stdint.h>

#include "base/random.h"

/* A mesh as a user has it: x, y of each point, three vertices of each triangle. Owns both
 * arrays: arrays_free. */
typedef struct arrays {
    double *points;
    uint32_t *triangles;
    uint32_t point_count, triangle_count;
} arrays;

/* A number in [0, 1) of 53 random bits. */
static inline double random_unit(uint64_t *random)
{
    return (double)(mw__random(random) >> 11) * 0x1p-53;
}

/* Ends the program with the message of the error, if the status is not MW_OK. `what`: what was
 * tried. */
void expect_ok(mw_status status, const char *what, const mw_error *error);

/* --- arrays ----------------------------------------------------------------------------------- */

/* Arrays that hold nothing yet, with room for that many points and triangles. */
arrays arrays_make(uint32_t point_room, uint32_t triangle_room);
void arrays_free(arrays *a);

/* Adds a point where there is room for it. Returns its number. */
uint32_t arrays_point(arrays *a, double x, double y);

/* Adds a triangle where there is room for it. */
void arrays_triangle(arrays *a, uint32_t u, uint32_t v, uint32_t w);

/* The same arrays as the library takes them. They stay the caller's. */
mw_arrays arrays_view(const arrays *a);

/* A copy of the vertices and triangles of a mesh, in the order of their numbers. */
arrays arrays_of_mesh(const mw_mesh *mesh);

/* The neighbours of all triangles of a mesh, three each, opposite to their vertices; MW_NONE where
 * there is none. The caller frees them. */
uint32_t *mesh_neighbours(const mw_mesh *mesh);

/* --- made ------------------------------------------------------------------------------------- */

/* The square from 0 to n in n x n cells, each cut along a random diagonal. Inner points are
 * moved by up to half of `jitter` along each axis. jitter 0: points on integers, many of them
 * collinear and cocircular. */
arrays arrays_grid(uint32_t n, double jitter, uint64_t *random);

/* A fan of n thin triangles round the origin, in a circle: vertex 0 has degree n. */
arrays arrays_fan(uint32_t n);

/* Seven triangles on which a celestial walk cycles that does not begin at the first edge of the
 * chain. */
arrays arrays_trap(void);

/* --- changed ---------------------------------------------------------------------------------- */

/* Numbers the triangles at random and begins each at a random corner. mixed: turns about half of
 * them round. */
void arrays_scramble(arrays *a, int mixed, uint64_t *random);

/* Each point is multiplied by `scale`, then moved by (dx, dy). */
void arrays_transform(arrays *a, double scale, double dx, double dy);

/* Removes a share (0 to 1) of the triangles: holes, pinched vertices, several components. One
 * triangle stays. */
void arrays_punch(arrays *a, double share, uint64_t *random);

/* --- meshes and locators -------------------------------------------------------------------- */

/* Where one cannot be made the program ends. The caller destroys them. */
mw_mesh *arrays_mesh(const arrays *a, mw_mesh_options options);

/* The Delaunay triangulation of n points, x y each. */
mw_mesh *mesh_delaunay(const double *points, uint32_t n);

/* A scrambled grid of 16 x 16 unit squares, laid out or not, with a hole whose corners are 5, 4
 * and `right`, 9. */
mw_mesh *mesh_with_hole(uint32_t right, uint64_t *random);

mw_locator *mesh_locator(const mw_mesh *mesh, mw_locator_options options);

/* --- queries ---------------------------------------------------------------------------------- */

/* Queries that find fault: n of each of eight kinds, among them anywhere, at vertices, on edges,
 * a rounding away from both, outside, and far. Returns *count places, x y each; the caller frees
 * them. */
double *arrays_queries(const arrays *a, size_t n, size_t *count, uint64_t *random);

#endif
