/* mesh_formats.h - the table of file formats: who reads and writes which. Private.
 *
 * A new format is one file with its reader or writer, their lines in mesh_readers.h and
 * mesh_writers.h, and one row in mesh_formats.c. CONTRIBUTING.md lists what else names the
 * formats. */
#ifndef MW_SRC_IO_FORMATS_MESH_FORMATS_H
#define MW_SRC_IO_FORMATS_MESH_FORMATS_H

#include "io/mesh/mesh_builder.h"
#include "io/text/byte_source.h"

#include <meshwalk/io.h>

typedef struct mw_mesh_format {
    const char *name;    /* for mw_write_mesh and messages: "off" */
    const char *endings; /* of file names, each ended by NUL, without ".gz": ".off\0" */
    /* Does the first word of a text name the format? NULL: nothing does. */
    bool (*first_word)(const char *word);
    /* The same of the first bytes of any file, whose name does not matter then. */
    bool (*first_bytes)(const char *head, size_t size);
    /* a table of points may begin like this; then the name of the file decides */
    bool common_words;
    /* the first line is free text: if a file has the ending, its words name no format */
    bool titled;
    mw_status (*read)(mw_source *source, mw_mesh_builder *builder, mw_error *error);
    /* Instead of `read`, for formats of two files. */
    mw_status (*read_path)(const char *path, mw_mesh_builder *builder, mw_error *error);
    mw_status (*write)(const char *path, const mw_mesh_file *file, mw_job *job, mw_error *error);
} mw_mesh_format;

/* The first format of that name, or ending of the path; NULL if there is none. */
const mw_mesh_format *mw__mesh_format_by_name(const char *name);
const mw_mesh_format *mw__mesh_format_by_path(const char *path);
/* The format recognised from the beginning of a file; NULL if none is. */
const mw_mesh_format *mw__mesh_format_by_content(const char *head, size_t size);
/* The same, or else by its name; NULL if neither tells. */
const mw_mesh_format *mw__mesh_format_of(const char *path, const char *head, size_t size);

/* Names of the formats that can be read or written, "off, ply, ...". */
void mw__mesh_format_list(bool writers, char *text, size_t size);

#endif
