/* contour_mesh.h - the triangles of a file's mesh that levels cross, as a mesh of their own.
 *
 * The lines of the levels pass through these triangles only. They are often few, and making a mesh
 * of all triangles would take longer than tracing the lines. */
#ifndef MW_CLI_LINES_CONTOUR_MESH_H
#define MW_CLI_LINES_CONTOUR_MESH_H

#include <meshwalk/meshwalk.h>

typedef struct contour_mesh {
    mw_mesh *mesh;
    double *values; /* one for each of its vertices */
} contour_mesh;

/* Make the mesh of the triangles that levels cross, in their order, with their vertices. If the
 * file has a place that is refused wherever it stands (a coordinate that is no number, a face with
 * a vertex twice), or one of these triangles cannot be taken, the error is that of the whole mesh.
 *   path    for messages
 *   values  one for each vertex of the file; NaN: none
 *   levels  ascending
 * Returns 0, or an exit code after a complaint. Release with contour_mesh_release either way. */
int contour_mesh_create(contour_mesh *made, const char *path, const mw_mesh_file *file,
                        const double *values, const double *levels, size_t level_count,
                        const mw_mesh_options *options);
void contour_mesh_release(contour_mesh *made);

#endif
