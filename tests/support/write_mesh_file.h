/* write_mesh_file.h - small mesh files for tests of reading: a square of two triangles in several
 * formats. */
#ifndef MW_TESTS_SUPPORT_WRITE_MESH_FILE_H
#define MW_TESTS_SUPPORT_WRITE_MESH_FILE_H

#include "support/files.h"

/* The vertices of the square as lines of OFF, PLY and others; the same as lines of OBJ; a facet
 * of an ASCII STL file, its corners as text. */
#define SQUARE_BODY "0 0 0\n1 0 0\n1 1 .5\n0 1 0\n"
#define SQUARE_V "v 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 0\n"
#define STL_FACET(a, b, c)                                                                         \
    "facet normal 0 0 1\n outer loop\n  vertex " a "\n  vertex " b "\n  vertex " c                 \
    "\n endloop\nendfacet\n"

/* What reading the square gives: four points, x y z each, and two triangles. */
extern const double square_points[12];
extern const uint32_t square_triangles[6];

/* A binary STL file of n facets, nine floats each, whose header says `count`. Written to
 * `memory`, 84 + 50 n bytes, where the result points. */
bytes mesh_file_stl(char *memory, const char *header, uint32_t count, const float (*corners)[9],
                    size_t n);

/* The mesh in a file; fails with the reader's message. The caller releases it:
 * mw_mesh_file_release. */
mw_mesh_file mesh_file_read(const char *name);

/* Writes the contents to a file of that name, reads it, also compressed by gzip, and removes
 * both. */
mw_mesh_file mesh_file_read_bytes(const char *name, bytes contents);
mw_mesh_file mesh_file_read_text(const char *name, const char *text);

/* Fails unless the mesh has as many points and triangles, and these triangles, three vertices
 * each. */
void mesh_file_expect_triangles(const mw_mesh_file *file, size_t points, size_t triangles,
                                const uint32_t *wanted);

/* Fails unless the points are these, x y z each. */
void mesh_file_expect_points(const mw_mesh_file *file, const double *wanted);

#endif
