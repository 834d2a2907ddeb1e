/* columns.h - what the beginning of a table tells of its columns. Private. */
#ifndef MW_SRC_IO_COLUMNS_H
#define MW_SRC_IO_COLUMNS_H

#include "io/source.h"

typedef struct mw_columns {
    size_t count;
    char **names;      /* of the header; NULL without one */
    bool *numbers;     /* the first row has a number there (or nothing, in a named column) */
    uint64_t expected; /* rows, if they are announced; else UINT64_MAX */
} mw_columns;

/* Look at the header, if there is one, and at the first row of data, which stays unread. `columns` is all zero but for
 * `expected`; a table without rows leaves it so. Release it in any case. */
mw_status mw__columns_detect(mw_source *source, mw_columns *columns, char *separator, mw_error *error);
/* The same for the vertices of Triangle's .node, a table separated by blanks, whose first row "rows dimension
 * attributes markers" tells what its columns are: number, x, y, (z,) attribute1, ..., (marker). Numbers and markers
 * do not count as columns of numbers. */
mw_status mw__columns_of_node(mw_source *source, mw_columns *columns, mw_error *error);
void mw__columns_release(mw_columns *columns);

/* The next row: neither empty nor a comment; NULL at the end. */
mw_status mw__columns_row(mw_source *source, char **row, mw_error *error);

/* The column of that name, letters in any case, or columns->count. Without a header the first three are x, y and z. */
size_t mw__columns_find(const mw_columns *columns, const char *name, size_t length);
/* The columns of a header that mean x, y and z; false if x or y is not found. The third may be columns->count. */
bool mw__columns_coordinates(const mw_columns *columns, size_t found[3]);

#endif
