/* counted_rows.h - a header with a count, and so many lines of integers and numbers, as in
 * Triangle's files. Private. */
#ifndef MW_SRC_IO_TEXT_COUNTED_ROWS_H
#define MW_SRC_IO_TEXT_COUNTED_ROWS_H

#include "io/text/byte_source.h"

/* A line, and how far it has been read. `what` names the next number for messages. */
typedef struct mw_number_row {
    const mw_source *source;
    const char *p;
} mw_number_row;

bool mw__row_ends(mw_number_row *row);
mw_status mw__row_integer(mw_number_row *row, const char *what, int64_t *value, mw_error *error);
mw_status mw__row_double(mw_number_row *row, const char *what, double *value, mw_error *error);

/* A header: a count, and up to `count - 1` further integers that keep their values where the
 * line ends; none is negative. A line that is NULL is an empty file. */
mw_status mw__rows_header(mw_source *source, char *line, int64_t *values, size_t count,
                          mw_error *error);

/* The error of a file that ends after `have` rows. */
mw_status mw__rows_end_early(const mw_source *source, const char *what, int64_t have,
                             int64_t announced, mw_error *error);
/* After the last row: an error if another one follows. */
mw_status mw__rows_check_end(mw_source *source, const char *what, int64_t announced,
                             mw_error *error);

#endif
