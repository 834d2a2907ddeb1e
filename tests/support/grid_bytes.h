/* grid_bytes.h - small meshes of simulations as bytes, for tests of reading and of memory: the
 * vertices (0, 0), (2, 0), (2, 2), (0, 2), (4, 0), the quadrilateral 0 1 2 3, the triangle 1 4 2,
 * and the field "q", ten times the number of the vertex. */
#ifndef MW_TESTS_SUPPORT_GRID_BYTES_H
#define MW_TESTS_SUPPORT_GRID_BYTES_H

#include "support/files.h"

/* Bytes that are put together. */
typedef struct grid_bytes {
    char *bytes;
    size_t size;
} grid_bytes;

/* How the numbers of a file are written. */
typedef struct grid_form {
    bool big;    /* byte order */
    bool wide;   /* doubles, integers of 8 bytes; else floats, 4 bytes */
    bool packed; /* by zlib */
} grid_form;

/* TELEMAC's file with two times, of which the second has the values plus 1; with triangles only,
 * the quadrilateral cut along 0 2. */
grid_bytes grid_selafin(grid_form form);
/* Gmsh's file: version 22 or 41; the quadrilateral is in the physical group 7, and the line 0 1
 * in the group 3, "shore". */
grid_bytes grid_msh(int version, bool big);
/* VTK: legacy as bytes, before version 5 or of it; VTU with appended raw data, or base64. */
grid_bytes grid_vtk(bool old);
grid_bytes grid_vtu(grid_form form, bool text);
/* NumPy's file; with `fortran` the points by columns. */
grid_bytes grid_npz(grid_form form, bool fortran);
void grid_release(grid_bytes *g);

#endif
