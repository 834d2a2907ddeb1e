/* grid_writers.h - the writers of the meshes of simulations, and what they share. Private. */
#ifndef MW_SRC_IO_GRID_GRID_WRITERS_H
#define MW_SRC_IO_GRID_GRID_WRITERS_H

#include "io/mesh/face_fan.h"
#include "io/mesh/mesh_writers.h"

mw_status mw__write_fort14(const char *path, const mw_mesh_file *file, mw_job *job,
                           mw_error *error);
mw_status mw__write_gr3(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_2dm(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_msh(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_vtu(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);

/* The values of that name, of vertices or of triangles; NULL if there are none. */
const double *mw__vertex_values(const mw_mesh_file *file, const char *name);
const double *mw__triangle_values(const mw_mesh_file *file, const char *name);

/* The depth of vertex v, positive downwards: the field "depth", else the height turned round. */
double mw__vertex_depth(const mw_mesh_file *file, const double *depths, size_t v);

/* The sign before an integer. */
void mw__output_signed(mw_output *output, int64_t value);

#endif
