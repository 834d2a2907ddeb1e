/* star_shapes.h - star-shaped polyhedra for tests, in arrays that grow. */
#ifndef MW_TESTS_SUPPORT_STAR_SHAPES_H
#define MW_TESTS_SUPPORT_STAR_SHAPES_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>
#include <stdint.h>

/* All zero: empty. point: x y z each; corner: three vertices a triangle. Owns both:
 * star_shape_free. */
typedef struct star_shape {
    double *point;
    uint32_t *corner;
    uint32_t points, triangles;
} star_shape;

/* Add a point, or a triangle. Return its number. */
uint32_t star_shape_point(star_shape *p, double x, double y, double z);
uint32_t star_shape_triangle(star_shape *p, uint32_t a, uint32_t b, uint32_t c);

/* Frees the arrays: it is empty then. */
void star_shape_free(star_shape *p);

/* The shape as the library takes it. The arrays stay the shape's. */
mw_arrays star_shape_arrays(const star_shape *p);

/* The regular octahedron of radius 2^levels, its faces cut into 4^levels triangles each; all
 * coordinates are integers. */
star_shape star_shape_octahedron(unsigned levels);

/* A sphere with a vertex at each pole and `rings` parallels of `around` vertices between. */
star_shape star_shape_globe(uint32_t around, uint32_t rings);

/* Moves each vertex outwards along its ray by a factor of 1 to `most`; integers stay integers. */
void star_shape_stretch(star_shape *p, unsigned most, uint64_t *seed);

/* Numbers the triangles anew, turns some round, begins each at another corner. */
void star_shape_shuffle(star_shape *p, uint64_t *seed);

/* Puts a vertex into the middle of the edge from corner k of triangle t, but only on the other
 * side of it, and a triangle without area between: the surface stays closed. All triangles must
 * be oriented alike. Returns false, and changes nothing, where the middle is no lattice point. */
bool star_shape_add_flat(star_shape *p, uint32_t t, uint32_t k);

/* Gives each corner a vertex of its own. */
void star_shape_tear(star_shape *p);

#endif
