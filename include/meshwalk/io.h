/* io.h - reading and writing meshes and points.
 *
 * Formats are recognised by content where it tells, else by the name; every reader takes gzip. Readers trust no count
 * in a header. Errors read "FILE:LINE: what is wrong" (binary files: "FILE: at byte N: ..."). A written file appears
 * under its final name only when it is complete. "-" is standard input or output. */
#ifndef MESHWALK_IO_H
#define MESHWALK_IO_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A mesh as read: arrays owned by the structure; release with mw_mesh_file_release. Faces of more than three corners
 * are cut into triangles, a fan from the first corner. */
typedef struct mw_mesh_file {
    double *points;       /* 3 per vertex: x y z (z = 0 where the file has none) */
    uint32_t *triangles;  /* 3 per triangle */
    size_t point_count, triangle_count;
    int has_z;
    char **field_names;   /* further values per vertex (attributes of .node, properties of PLY) */
    double **fields;      /* field_count arrays of point_count */
    size_t field_count;
    size_t welded;        /* STL: vertices merged because their coordinates are equal */
} mw_mesh_file;

/* Read a mesh: Triangle .node/.ele (name either, or the name without ending), OFF, OBJ, PLY, STL; gzip of any.
 * MW_ERROR_SYSTEM: cannot be opened; MW_ERROR_INPUT: malformed, with the line; MW_ERROR_LIMIT; MW_ERROR_MEMORY. */
MW_API mw_status mw_read_mesh(const char *path, mw_mesh_file *file, mw_error *error);
MW_API void mw_mesh_file_release(mw_mesh_file *file);

/* The mesh of a file as arrays for mw_mesh_create and mw_check_arrays. */
MW_API mw_arrays mw_mesh_file_arrays(const mw_mesh_file *file);

/* Write a mesh. The format follows `format` ("off", "ply", "node", "csv", "vtk", "obj", "stl"), or the ending of path
 * where it is NULL. "node" writes two files, .node and .ele. Doubles round-trip. */
MW_API mw_status mw_write_mesh(const char *path, const char *format, const mw_mesh_file *file, mw_error *error);

typedef struct mw_points_options {
    const char *columns;     /* NULL = first columns; else names or 1-based numbers, "x,y", "3,4,5", "lon,lat,z"     */
    uint8_t classes[256];    /* LAS: 1 = take points of this class; all zero = take all                            */
    uint32_t reserved[4];
} mw_points_options;

/* A stream of points: text with comma, semicolon, tab or white space between columns, header or not; LAS 1.0-1.4. */
typedef struct mw_point_reader mw_point_reader;

MW_API mw_status mw_points_open(const char *path, const mw_points_options *options, mw_point_reader **out,
                                mw_error *error);
/* Values per point: the columns of the file (or the selected ones); at least 2. */
MW_API size_t mw_points_width(const mw_point_reader *reader);
/* Name of a column, "x", "y", "z", ... where the file gives none. Owned by the reader. */
MW_API const char *mw_points_column(const mw_point_reader *reader, size_t column);
/* Read up to `capacity` points, mw_points_width doubles each, into values. *count = 0 at the end. */
MW_API mw_status mw_points_read(mw_point_reader *reader, double *values, size_t capacity, size_t *count,
                                mw_error *error);
MW_API void mw_points_close(mw_point_reader *reader); /* NULL is allowed */

/* A file that appears under its name only when it is complete: written without a name, or under a temporary one beside it, then
 * given its name. */
typedef struct mw_output mw_output;
MW_API mw_status mw_output_open(const char *path, mw_output **out, mw_error *error);
MW_API void mw_output_write(mw_output *output, const void *bytes, size_t size); /* errors are kept for mw_output_close */
MW_API void mw_output_printf(mw_output *output, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The shortest text that reads back as the same double: mw_format_double(text, v) returns its length, at most 31. */
MW_API size_t mw_format_double(char text[32], double value);
MW_API void mw_output_double(mw_output *output, double value);
/* Has a write failed yet? Long jobs ask, and stop. */
MW_API int mw_output_failed(const mw_output *output);
/* commit = 1: finish and rename; 0: remove. Reports the first failed write ("FILE: No space left on device").
 * Frees the output in any case. */
MW_API mw_status mw_output_close(mw_output *output, int commit, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
