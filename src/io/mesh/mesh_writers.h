/* mesh_writers.h - the writers of meshes, each in the file of its format, and what they share.
 * Private. */
#ifndef MW_SRC_IO_MESH_MESH_WRITERS_H
#define MW_SRC_IO_MESH_MESH_WRITERS_H

#include "io/text/output.h"

mw_status mw__write_off(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_obj(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_ply(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_ply_ascii(const char *path, const mw_mesh_file *file, mw_job *job,
                              mw_error *error);
mw_status mw__write_stl(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_node_ele(const char *path, const mw_mesh_file *file, mw_job *job,
                             mw_error *error);
mw_status mw__write_vtk(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
mw_status mw__write_csv(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);

/* Write one file: open it, let `body` fill it, close it. */
typedef void mw_write_body(mw_output *output, const mw_mesh_file *file);
mw_status mw__write_file(const char *path, const mw_mesh_file *file, mw_write_body *body,
                         mw_job *job, mw_error *error);

/* What several formats share: lines "x y z" of the vertices, and lines "3 a b c" of the
 * triangles, numbered from 0. */
void mw__output_points(mw_output *output, const mw_mesh_file *file);
void mw__output_triangles(mw_output *output, const mw_mesh_file *file);

/* Make the name of a field one word that differs from x, y, z and from the words of the fields
 * before it. A byte that is neither a letter, a digit nor part of a UTF-8 character becomes '_'. If
 * the word is taken, the number of the field is appended. */
void mw__output_field_name(mw_output *output, char *const *names, size_t field);

/* About how many bytes a mesh takes as text, for the steps of a job. */
uint64_t mw__expected_bytes(const mw_mesh_file *file);

#endif
