/* row.h - lines of integers and numbers after each other, as Triangle's files have them. Private. */
#ifndef MW_SRC_IO_ROW_H
#define MW_SRC_IO_ROW_H

#include "io/source.h"

/* A line, and how far it has been read. `what` names the next number for messages. */
typedef struct mw_row {
    const mw_source *source;
    const char *p;
} mw_row;

bool mw__row_ends(mw_row *row);
mw_status mw__row_integer(mw_row *row, const char *what, int64_t *value, mw_error *error);
mw_status mw__row_double(mw_row *row, const char *what, double *value, mw_error *error);

/* A header: a count, and up to `count - 1` further integers that keep their values where the line ends; none is
 * negative. A line that is NULL is an empty file. */
mw_status mw__row_header(mw_source *source, char *line, int64_t *values, size_t count, mw_error *error);

/* The errors of a file that holds fewer or more rows than it announced; the second reads on to see. */
mw_status mw__rows_ended(const mw_source *source, const char *what, int64_t have, int64_t announced, mw_error *error);
mw_status mw__rows_end(mw_source *source, const char *what, int64_t announced, mw_error *error);

#endif
