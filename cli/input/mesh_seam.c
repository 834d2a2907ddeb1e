#include "cli/input/mesh_seam.h"
#include "cli/frame/message.h"

#include <stdlib.h>

/* The same points, with a height of 0. */
static double *points_raise(const mw_seam_pieces *pieces)
{
    double *points = calloc(3 * pieces->point_count + 1, sizeof *points);
    for (size_t i = 0; points && i < pieces->point_count; i++) {
        points[3 * i] = pieces->points[2 * i];
        points[3 * i + 1] = pieces->points[2 * i + 1];
    }
    return points;
}

int mesh_seam_cut(mw_mesh_file *file, const char *path, mw_seam_pieces *pieces)
{
    mw_error error;
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    if (mw_seam_cut(&arrays, file->faces, pieces, &error) != MW_OK) return fail_mesh(path, &error);
    double *points = points_raise(pieces);
    if (!points) return fail_memory();
    if (!file->faces) file->face_count = file->triangle_count;
    free(file->points);
    free(file->triangles);
    free(file->faces);
    file->points = points;
    file->point_count = pieces->point_count;
    file->triangles = pieces->triangles;
    file->triangle_count = pieces->triangle_count;
    file->faces = pieces->faces;
    free(pieces->points);
    pieces->points = NULL;
    pieces->triangles = NULL;
    pieces->faces = NULL;
    return 0;
}

void mesh_seam_explain(const char *path, const mw_seam_pieces *pieces)
{
    complain("%s: goes round the globe and was cut at the meridian of %g degrees. Numbers of "
             "triangles are those of the pieces; edges are straight in longitude and latitude",
             path, pieces->west);
}
