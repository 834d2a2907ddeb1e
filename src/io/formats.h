/* formats.h - the table of file formats: who reads and writes which. Private.
 *
 * A new format is one file with its reader or writer and one row in formats.c; the program learns its name from there
 * (mw_mesh_format_name). */
#ifndef MW_SRC_IO_FORMATS_H
#define MW_SRC_IO_FORMATS_H

#include "io/builder.h"
#include "io/source.h"

#include <meshwalk/io.h>

typedef struct mw_mesh_format {
    const char *name;                     /* for mw_write_mesh and messages: "off"                            */
    const char *endings;                  /* of file names, each ended by NUL, without ".gz": ".off\0"        */
    bool (*first_word)(const char *word); /* does the first word of a text name the format? NULL: nothing does */
    mw_status (*read)(mw_source *source, mw_builder *builder, mw_error *error);
    mw_status (*read_path)(const char *path, mw_builder *builder,
                           mw_error *error); /* instead, for formats of two files */
    mw_status (*write)(const char *path, const mw_mesh_file *file, mw_error *error);
} mw_mesh_format;

/* The first format of that name, or ending of the path; NULL if there is none. */
const mw_mesh_format *mw__format_by_name(const char *name);
const mw_mesh_format *mw__format_by_path(const char *path);
/* The format that the beginning of a file tells, NULL if it tells none. */
const mw_mesh_format *mw__format_by_content(const char *head, size_t size);

/* Names of the formats that can be read or written, "off, ply, ...". */
void mw__format_list(bool writers, char *text, size_t size);

/* Whether a path ends so, in letters of any case, ".gz" disregarded. */
bool mw__path_ends(const char *path, const char *ending);

/* The readers, each in its file. They begin at the start of the source. */
mw_status mw__read_off(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_obj(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_ply(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_stl(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_node(mw_source *node, mw_builder *builder, mw_error *error); /* the vertices */
/* The same where more may follow them; tells how many coordinates they have: 2 or 3. */
mw_status mw__read_node_rows(mw_source *node, mw_builder *builder, int64_t *dimension, mw_error *error);
mw_status mw__read_node_file(const char *path, mw_builder *builder, mw_error *error); /* the .node of that name */
mw_status mw__read_ele(mw_source *ele, mw_builder *builder, mw_error *error);         /* the triangles, after them */
mw_status mw__read_node_ele(const char *path, mw_builder *builder, mw_error *error);
/* Is there PATH.node or PATH.node.gz? */
mw_status mw__node_ele_exists(const char *path, bool *exists, mw_error *error);

/* The writers. */
mw_status mw__write_off(const char *path, const mw_mesh_file *file, mw_error *error);
mw_status mw__write_obj(const char *path, const mw_mesh_file *file, mw_error *error);
mw_status mw__write_ply(const char *path, const mw_mesh_file *file, mw_error *error);
mw_status mw__write_ply_ascii(const char *path, const mw_mesh_file *file, mw_error *error);
mw_status mw__write_stl(const char *path, const mw_mesh_file *file, mw_error *error);
mw_status mw__write_node_ele(const char *path, const mw_mesh_file *file, mw_error *error);
mw_status mw__write_vtk(const char *path, const mw_mesh_file *file, mw_error *error);
mw_status mw__write_csv(const char *path, const mw_mesh_file *file, mw_error *error);

/* Write one file: open it, let `body` fill it, close it. */
typedef void mw_write_body(mw_output *output, const mw_mesh_file *file);
mw_status mw__write_file(const char *path, const mw_mesh_file *file, mw_write_body *body, mw_error *error);

/* What several formats share: lines "x y z" of the vertices, and lines "3 a b c" of the triangles, numbered from 0. */
void mw__output_points(mw_output *output, const mw_mesh_file *file);
void mw__output_triangles(mw_output *output, const mw_mesh_file *file);

#endif
