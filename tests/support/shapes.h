/* shapes.h - small surfaces for tests, on a lattice so that lines run through their vertices and
 * along their edges, and lines to probe them with. */
#ifndef MW_TESTS_SUPPORT_SHAPES_H
#define MW_TESTS_SUPPORT_SHAPES_H

#include <meshwalk/meshwalk.h>
#include <stddef.h>
#include <stdint.h>

/* A surface as a user has it: x, y, z of each point, three vertices of each triangle. Owns both
 * arrays: shape_free. */
typedef struct shape {
    double *points;
    uint32_t *triangles;
    uint32_t point_count, triangle_count;
} shape;

/* A shape that holds nothing yet, with room for that many points and triangles. */
shape shape_make(uint32_t point_room, uint32_t triangle_room);
void shape_free(shape *s);

/* Adds a point where there is room for it. Returns its number. */
uint32_t shape_point(shape *s, double x, double y, double z);

/* Adds a triangle where there is room for it; seen from its front the vertices go
 * counter-clockwise. */
void shape_triangle(shape *s, uint32_t u, uint32_t v, uint32_t w);

/* --- made ------------------------------------------------------------------------------------- */

/* A closed surface round the origin, star-shaped from there: an octahedron of 8 n^2 triangles
 * whose vertices are pushed to lattice points about `radius` from the origin, off by up to half
 * of `share` of it. */
shape shape_ball(uint32_t n, double radius, double share, uint64_t *random);

/* A torus of n x m quadrangles, each of two triangles, on lattice points; scale is the radius of
 * the tube. */
shape shape_torus(uint32_t n, uint32_t m, double scale);

/* An open patch, fronts up, of n x n cells with heights from 0 to `height`. */
shape shape_patch(uint32_t n, uint32_t height, uint64_t *random);

/* Random triples of vertices: edges of many triangles, triangles that name a vertex twice. */
shape shape_soup(uint32_t points, uint32_t triangles, uint64_t *random);

/* Both shapes in one, the second moved by dx along x. Frees a and b. */
shape shape_join(shape a, shape b, double dx);

/* A copy: each coordinate x becomes x * scale + shift. */
shape shape_scaled(const shape *s, double scale, double shift);

/* --- changed ---------------------------------------------------------------------------------- */

/* Turns a share (0 to 1) of the triangles round. */
void shape_clash(shape *s, double share, uint64_t *random);

/* Puts a vertex of a share (0 to 1) of the triangles where another is, or half-way between the
 * two others, so that triangles are flat. */
void shape_flatten(shape *s, double share, uint64_t *random);

/* Gives each triangle vertices of its own, and begins it at a random one. */
void shape_tear(shape *s, uint64_t *random);

/* Numbers the triangles at random. */
void shape_shuffle(shape *s, uint64_t *random);

/* --- surfaces and queries --------------------------------------------------------------------- */

/* The surface of a shape; ends the program where it cannot be made. The caller destroys it. */
mw_surface *shape_surface(const shape *s, mw_surface_options options);

/* Lines that find fault, six numbers each: a point, then a motion. They go through a vertex, the
 * middle of an edge or of a triangle, or anywhere; along an axis, to another vertex, against a
 * normal, or anywhere; the point is on the surface or away from it. Without rounding, on
 * lattices that are not too wide. Returns n lines; the caller frees them. */
double *shape_queries(const shape *s, size_t n, uint64_t *random);

#endif
