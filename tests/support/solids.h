/* solids.h - small surfaces in space as arrays that grow: boxes, soups, spheres. Failures are those
 * of cmocka. */
#ifndef MW_TESTS_SUPPORT_SOLIDS_H
#define MW_TESTS_SUPPORT_SOLIDS_H

#include <meshwalk/surface.h>
#include <stdint.h>

typedef struct solid {
    double *points; /* x y z */
    uint32_t *triangles;
    uint32_t point_count, triangle_count;
} solid;

/* The triangles of a box, whose vertices come with x fastest and z slowest. */
extern const uint32_t cube_triangles[12][3];

/* Room for so many points and triangles. Release with solid_free. */
solid solid_make(uint32_t point_room, uint32_t triangle_room);
void solid_free(solid *s);
/* Append a point, whose number is returned, or a triangle. */
uint32_t solid_point(solid *s, double x, double y, double z);
void solid_triangle(solid *s, uint32_t u, uint32_t v, uint32_t w);
/* The solid as arrays, and as a surface, which the caller destroys. */
mw_arrays solid_view(const solid *s);
mw_surface *solid_surface(const solid *s, mw_surface_options options);
/* A cube with a corner at x, y, z. `soup`: no two triangles share a vertex. */
solid solid_box(double x, double y, double z, double size, int soup);
/* Triangles taken at random; some vertices share coordinates; with `bad` some are not finite. */
solid solid_soup(uint32_t points, uint32_t triangles, int bad, uint64_t *random);
/* A sphere of 8 * 4^levels triangles, somewhat uneven. */
solid solid_sphere(int levels, uint64_t *random);

#endif
