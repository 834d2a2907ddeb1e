/* query_columns.h - finds the columns of a file of queries that a command reads. */
#ifndef MW_CLI_INPUT_QUERY_COLUMNS_H
#define MW_CLI_INPUT_QUERY_COLUMNS_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

#define MAX_QUERY_COLUMNS 6

/* Which names of coordinates a command knows (mw_axis_names). */
typedef enum query_axes {
    QUERY_PLANE,  /* x and y, or longitude and latitude */
    QUERY_LONLAT, /* longitude and latitude */
    QUERY_SPACE,  /* x, y and z */
} query_axes;

/* Which columns are meant if longitude and latitude fit, and others, too. */
typedef enum query_preference {
    PREFER_NOTHING, /* neither: it is an error */
    PREFER_LONLAT,
    PREFER_OTHERS,
} query_preference;

/* What a command reads from each row. */
typedef struct query_columns {
    query_axes axes;
    query_preference prefer;
    const char *names[MAX_QUERY_COLUMNS]; /* "x", "y": for files without names, and for messages */
    /* behind the coordinates come columns of just these names */
    size_t count;
    /* the end of the complaint if they are not found; NULL: none */
    const char *hint;
} query_columns;

/* Find the columns: column k is at index[k] in the table. *lonlat tells whether their names mean
 * longitude and latitude. These are tried in order:
 *   1. the columns that the user has `chosen` (--columns): the reader reads them already;
 *   2. the columns whose names are known as coordinates, if exactly one set of names fits, or one
 *      of the preferred ones;
 *   3. all columns, if there are no others and none is known as a coordinate of another kind;
 *   4. the first columns of a file without names whose path ends in .xyz.
 * Returns 0 when the reader reads those, or an exit code after a complaint if none of this holds.
 */
int query_columns_find(const query_columns *wanted, const char *path, mw_point_reader *reader,
                       bool chosen, size_t index[MAX_QUERY_COLUMNS], bool *lonlat);

/* Do the names of two columns mean longitude and latitude, in this order? */
bool query_names_are_lonlat(const char *x, const char *y);

/* Refuse a table of points, read from its first column on as mw_point_reader_open does, whose
 * header does not tell which columns are x and y: none is known and there are others, or several
 * are. Returns 0, or an exit code after a complaint. */
int query_columns_check_points(const char *path, const mw_point_reader *reader);

#endif
