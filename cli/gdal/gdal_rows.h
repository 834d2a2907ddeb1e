/* gdal_rows.h - rows of CSV, with a point each, written as the features of any vector format that
 * GDAL writes; the ending of the name chooses it. */
#ifndef MW_CLI_GDAL_GDAL_ROWS_H
#define MW_CLI_GDAL_GDAL_ROWS_H

#include <stdbool.h>
#include <stddef.h>

/* Does the name end as that of a vector file which GDAL could write? */
bool gdal_rows_known(const char *path);

/* Find out before long work whether such a file can be written here, and begin to load GDAL, whose
 * answer gdal_rows_open has. Returns 0, or an exit code after a complaint. */
int gdal_rows_check(const char *path);

/* How the rows are to be read. */
typedef struct gdal_rows_form {
    const char *header; /* the first row; need not last */
    size_t header_size;
    char separator, decimal;
    size_t dimensions;   /* of the points: 2 or 3 */
    size_t dropped;      /* so many first columns are not written: the points have them */
    const char *answers; /* the kinds of the last columns: 't' text, 'i' integer, 'r' real */
    const char *crs;     /* of the points, see gdal_crs.h; NULL: not known */
    bool quiet;          /* no remarks */
    bool lines;          /* the rows have a line each, for gdal_rows_write_line */
    bool polygons;       /* the rows have a polygon each, for gdal_rows_write_polygon */
} gdal_rows_form;

typedef struct gdal_rows gdal_rows;

/* Begin a file, which gets its name when it is closed. The other columns are integers or reals if
 * all cells that gdal_rows_learn has seen are numbers, missing ones apart, and text otherwise.
 * Returns 0, or an exit code after a complaint; close it in both cases. */
int gdal_rows_open(gdal_rows **rows, const char *path, const gdal_rows_form *form);
int gdal_rows_learn(gdal_rows *rows, const char *bytes, size_t size);

/* Write rows; point i is at points[i * stride]. A point with a coordinate that is not finite
 * becomes a feature without a geometry. Returns 0, or an exit code after a complaint. */
int gdal_rows_write(gdal_rows *rows, const char *bytes, size_t size, const double *points,
                    size_t stride);

/* Write one row, with a line of `count` points, of form.dimensions numbers each. Returns 0, or an
 * exit code after a complaint. */
int gdal_rows_write_line(gdal_rows *rows, const char *bytes, size_t size, const double *points,
                         size_t count);

/* The same with a polygon: ring k has the points first[k] .. first[k + 1] - 1, the last of which is
 * the first again; the first ring is the outline. */
int gdal_rows_write_polygon(gdal_rows *rows, const char *bytes, size_t size, const double *points,
                            const size_t *first, size_t ring_count);

/* Finish the file, or remove it if not `commit`. Returns 0, or an exit code after a complaint.
 * NULL is allowed. */
int gdal_rows_close(gdal_rows *rows, bool commit);

#endif
