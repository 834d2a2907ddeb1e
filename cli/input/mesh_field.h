/* mesh_field.h - the values that a mesh's file has at the vertices, heights or a field, or at
 * the triangles. */
#ifndef MW_CLI_INPUT_MESH_FIELD_H
#define MW_CLI_INPUT_MESH_FIELD_H

#include "cli/input/nodata.h"

#include <meshwalk/meshwalk.h>

/* Which values are meant. */
typedef struct mesh_field_choice {
    const char *field; /* "z", or the name of a field */
    nodata_rule nodata;
    bool quiet;
    bool recover; /* values of triangles become values of vertices, continuous ones */
    /* Where values of triangles go: one for each triangle, for free(); NULL: they are refused
     * without `recover`. Then the mesh gets no field. */
    double **triangles;
} mesh_field_choice;

/* Copy the field from the file of a mesh to the mesh, NaN for values that are missing. A field of
 * vertices comes before one of triangles of the same name. `self` is a mesh_field_choice. Returns
 * 0, or an exit code after a complaint. */
int mesh_field_load(mw_mesh *mesh, const char *path, const mw_mesh_file *file, const void *self);

/* The same values of a field of vertices, one for each, without a mesh. *values is for free(). */
int mesh_field_copy(const char *path, const mw_mesh_file *file, const mesh_field_choice *choice,
                    double **values);

/* The same for values of vertices, or else for those of triangles: *values stays NULL then, and
 * *choice->triangles has them. */
int mesh_field_copy_either(const char *path, const mw_mesh_file *file,
                           const mesh_field_choice *choice, double **values);

#endif
