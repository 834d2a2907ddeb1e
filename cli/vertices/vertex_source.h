/* vertex_source.h - where POINTS of a triangulation come from: a table of text, LAS, or what GDAL
 * reads. */
#ifndef MW_CLI_VERTICES_VERTEX_SOURCE_H
#define MW_CLI_VERTICES_VERTEX_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How POINTS are read. */
typedef struct vertex_source_options {
    const char *columns, *classes; /* the options of these names; NULL: not given */
    const char *layer, *where;     /* of a file that GDAL reads; NULL: not given */
} vertex_source_options;

typedef struct vertex_source vertex_source;

/* Returns 0, or an exit code after a complaint. Close it in both cases. */
int vertex_source_open(vertex_source **source, const char *path,
                       const vertex_source_options *options);
void vertex_source_close(vertex_source *s); /* NULL is allowed */

/* Are POINTS features with a geometry, or the rows of a table? */
bool vertex_source_has_features(const vertex_source *s);

/* The values of a point: x and y, then the columns that are read. */
size_t vertex_source_width(const vertex_source *s);
const char *vertex_source_column(const vertex_source *s, size_t k);

/* After reading: which value is the height? SIZE_MAX: none. The third of those that the user has
 * chosen; else the third coordinate of features; else one that is called z, or height; else, in a
 * table, the third if it has no name, or is the only one and follows x and y. */
size_t vertex_source_height(const vertex_source *s);

/* After reading: a further value of features that is called z, or height; SIZE_MAX: none. */
size_t vertex_source_named_height(const vertex_source *s);

/* After reading: do texts stand in a column? *place is the first line, or feature, with one. */
bool vertex_source_has_texts(const vertex_source *s, size_t k, int64_t *place);

/* After reading: does a column hold any number? */
bool vertex_source_has_numbers(const vertex_source *s, size_t k);

/* Do the names of the columns mean longitude and latitude? */
bool vertex_source_is_lonlat(const vertex_source *s);

/* The coordinate system that the file tells, as WKT or "EPSG:n"; NULL: none. */
const char *vertex_source_crs(const vertex_source *s);

/* Read up to `capacity` points. *count is 0 at the end. Returns 0, or an exit code after a
 * complaint. */
int vertex_source_read(vertex_source *s, double *values, size_t capacity, size_t *count);

/* How much of the file has been read, from 0 to 1; -1: not known. */
double vertex_source_fraction(const vertex_source *s);

#endif
