/* row_output.h - rows that a command makes, each with a point or a line: a table (CSV), or the
 * features of a vector file, by the ending of its name. */
#ifndef MW_CLI_LINES_ROW_OUTPUT_H
#define MW_CLI_LINES_ROW_OUTPUT_H

#include "cli/constraints/feature_values.h"
#include "cli/frame/text.h"
#include "cli/gdal/gdal_rows.h"

#include <meshwalk/meshwalk.h>

typedef struct row_output {
    const char *path; /* "-": standard output */
    const char *crs;
    bool quiet;
    mw_output *out;  /* NULL if features are written */
    gdal_rows *rows; /* NULL if a table is written */
    text text;       /* rows not written yet */
    double *points;  /* x, y of each of them */
    size_t count, room;
} row_output;

/* The functions return 0, or an exit code after a complaint. */

/* Refuse an output that cannot be written, before anything is read. NULL: standard output. */
int row_output_check(const char *path);

/* Begin a header, and the kinds of its columns: the feature, its part, and its attributes. One that
 * has a name of the command's own columns gets a prefix. A failure is in the texts. */
typedef bool row_output_own(const void *rows, const char *name);
void row_output_begin_header(text *header, text *kinds, const feature_values *values,
                             row_output_own *is_own, const void *rows);

/* Begin a row: feature, part, and the values of the feature. */
void row_output_begin_row(text *out, const feature_values *values, uint32_t feature, uint32_t part);

/* Begin with the header, whose texts are not in quotes.
 *   kinds  of its columns: 't' text, 'i' integer, 'r' real
 *   crs    of the points; NULL: not known
 * Close it in both cases. */
int row_output_open(row_output *o, const char *path, const text *header, const char *kinds,
                    const char *crs, bool quiet);
/* The same for rows with a line or a polygon each, of a vector file only. */
int row_output_open_lines(row_output *o, const char *path, const text *header, const char *kinds,
                          const char *crs, bool quiet);

int row_output_open_polygons(row_output *o, const char *path, const text *header, const char *kinds,
                             const char *crs, bool quiet);

/* The same for rows with a line each, or a polygon, whose points have x, y and z. */
int row_output_open_draped(row_output *o, const char *path, const text *header, const char *kinds,
                           const char *crs, bool quiet, bool polygons);

/* Append a row, which the caller has written to o->text with its end. */
int row_output_row(row_output *o, const double point[2]);

/* Write the row that stands in o->text, with a line of `count` points, x and y each, or x, y
 * and z. */
int row_output_line(row_output *o, const double *points, size_t count);

/* The same with a polygon, as gdal_rows_write_polygon takes it. */
int row_output_polygon(row_output *o, const double *points, const size_t *first, size_t ring_count);

/* Finish the output, or remove it if not `commit`. */
int row_output_close(row_output *o, bool commit);

#endif
