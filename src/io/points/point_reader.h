/* point_reader.h - a stream of points: what its readers fill in, and what they share. Private. */
#ifndef MW_SRC_IO_POINTS_POINT_READER_H
#define MW_SRC_IO_POINTS_POINT_READER_H

#include "io/text/byte_source.h"

#include <meshwalk/io.h>

struct mw_point_reader {
    mw_source source;
    size_t width;
    char **names; /* one per value */
    mw_status (*read)(mw_point_reader *reader, double *values, size_t capacity, size_t *count, mw_error *error);
    void *state; /* of that reader; released with free */
};

/* Add a column to the reader. */
mw_status mw__point_reader_add(mw_point_reader *reader, const char *name, mw_error *error);

/* The next item of a selection "x,y,3", without blanks around it, its length in *length; NULL
 * after the last. *rest begins as the selection. */
const char *mw__selection_item(const char **rest, size_t *length);

#endif
