/* query_source.h - where queries come from: a table of text, LAS, or what GDAL reads. */
#ifndef MW_CLI_INPUT_QUERY_SOURCE_H
#define MW_CLI_INPUT_QUERY_SOURCE_H

#include "cli/input/query_columns.h"

typedef struct query_source_settings {
    const char *columns;       /* --columns; NULL: not given */
    const char *layer, *where; /* of a file that GDAL reads; NULL: not given */
    const char *crs;           /* --points-crs; NULL: not given */
} query_source_settings;

typedef struct query_source query_source;

/* Open the file and find the columns that are `wanted`: column k is at index[k] in the table.
 * Returns 0, or an exit code after a complaint. Close it in both cases. */
int query_source_open(query_source **source, const char *path,
                      const query_source_settings *settings, const query_columns *wanted,
                      size_t index[MAX_QUERY_COLUMNS]);
void query_source_close(query_source *source); /* NULL is allowed */

/* The table, as mw_point_reader_table tells it. */
void query_source_table(const query_source *source, mw_point_table *table);

/* How many first columns of the table are the coordinates of points of a vector file: 0 for a
 * table. */
size_t query_source_coordinates(const query_source *source);

/* The coordinate system that the file tells, as WKT or "EPSG:n"; NULL: none. */
const char *query_source_crs(const query_source *source);

/* Do the names of the columns mean longitude and latitude? */
bool query_source_is_lonlat(const query_source *source);

/* Read up to `capacity` queries, the wanted columns of each. *count is 0 at the end. Returns 0, or
 * an exit code after a complaint. */
int query_source_read(query_source *source, double *values, size_t capacity, size_t *count);

/* The text of a row of the block read last. Several threads may ask at a time. */
const char *query_source_row(const query_source *source, size_t row, size_t *length);

/* How much of the file has been read, from 0 to 1; -1: not known. */
double query_source_fraction(const query_source *source);

#endif
