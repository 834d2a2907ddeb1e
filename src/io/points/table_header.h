/* table_header.h - the columns of a table, as its header and its first row tell. Private. */
#ifndef MW_SRC_IO_POINTS_TABLE_HEADER_H
#define MW_SRC_IO_POINTS_TABLE_HEADER_H

#include "io/text/byte_source.h"

typedef struct mw_table_header {
    size_t count;
    char **names;      /* of the header; NULL without one */
    char *text;        /* the header as it stands in the file; NULL without one */
    bool *numbers;     /* the first row has a number there (or nothing, in a named column) */
    uint64_t expected; /* rows, if they are announced; else UINT64_MAX */
    bool marks;        /* set before: # may begin the first cell of a row */
    bool texts;        /* set before: texts may stand among the numbers of a column */
} mw_table_header;

/* Look at the header, if there is one, and at the first row of data, which stays unread. A header
 * is a row without numbers, or one with names of coordinates. At first `header` is all zero, except
 * for `expected`; a table without rows leaves it so. Release it in any case. */
mw_status mw__table_header_detect(mw_source *source, mw_table_header *header, char *separator,
                                  mw_error *error);
/* The same for the vertices of Triangle's .node, a table separated by blanks, whose first row
 * "rows dimension attributes markers" tells what its columns are: number, x, y, (z,) attribute1,
 * ..., (marker). Numbers and markers do not count as columns of numbers. */
mw_status mw__table_header_of_node(mw_source *source, mw_table_header *header, mw_error *error);
/* Write the header as the text of rows separated by commas, if white space separates the rows of
 * the file, or if `text` has not been set yet. */
mw_status mw__table_header_commas(mw_table_header *header, char separator, mw_error *error);
void mw__table_header_release(mw_table_header *header);

/* The next row: neither empty nor a comment; NULL at the end. A row may have several lines, if a
 * quoted cell has. Separator 0: not known yet. A line that begins with # is a row only if it has
 * `columns` cells that are not separated by blanks; with `columns` 0 it is always a comment. */
mw_status mw__table_row(mw_source *source, char separator, size_t columns, char **row,
                        mw_error *error);

/* The column of that name, letters in any case, or header->count. Without a header the first
 * three are x, y and z. */
size_t mw__table_header_find(const mw_table_header *header, const char *name, size_t length);
/* The columns of a header that mean x, y and z, by the first set of names that fits; false if x or
 * y is not found. The third may be header->count. */
bool mw__table_header_coordinates(const mw_table_header *header, size_t found[3]);

#endif
