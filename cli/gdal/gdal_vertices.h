/* gdal_vertices.h - points of a vector file that GDAL reads, with their attributes as numbers. */
#ifndef MW_CLI_GDAL_GDAL_VERTICES_H
#define MW_CLI_GDAL_GDAL_VERTICES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct gdal_vertices gdal_vertices;

/* Which points and columns are read; NULL: not given. */
typedef struct gdal_vertices_options {
    const char *layer, *where;
    const char *columns; /* x, y and further columns; NULL: x, y, z if there are any, attributes */
} gdal_vertices_options;

/* The functions with a result of type int return 0, or an exit code after a complaint. */

int gdal_vertices_open(gdal_vertices **vertices, const char *path,
                       const gdal_vertices_options *options);
void gdal_vertices_close(gdal_vertices *v); /* NULL is allowed */

/* The values of a vertex: x and y, then the columns that are read. */
size_t gdal_vertices_width(const gdal_vertices *v);
const char *gdal_vertices_column(const gdal_vertices *v, size_t k);

/* Is value `k` the third coordinate? */
bool gdal_vertices_is_z(const gdal_vertices *v, size_t k);

/* How many numbers, and how many texts, the features read so far have as value `k`. A text reads
 * as NaN; *feature becomes the number of the first feature that has one. */
uint64_t gdal_vertices_numbers(const gdal_vertices *v, size_t k);
uint64_t gdal_vertices_texts(const gdal_vertices *v, size_t k, int64_t *feature);

/* The coordinate system of the points, as WKT; NULL: not known. */
const char *gdal_vertices_crs(const gdal_vertices *v);

/* Read up to `capacity` points; *count is less only at the end. A feature of several points gives
 * several, all with its attributes. A value that a feature does not have is NaN. */
int gdal_vertices_read(gdal_vertices *v, double *values, size_t capacity, size_t *count);

/* How many of the features have been read, from 0 to 1; -1: not known. */
double gdal_vertices_fraction(const gdal_vertices *v);

#endif
