/* points.h - a stream of points and the readers behind it. Private. */
#ifndef MW_SRC_IO_POINTS_H
#define MW_SRC_IO_POINTS_H

#include "io/builder.h"
#include "io/source.h"

#include <meshwalk/io.h>

struct mw_point_reader {
    mw_source source;
    size_t width;
    char **names; /* one per value */
    mw_status (*read)(mw_point_reader *reader, double *values, size_t capacity, size_t *count, mw_error *error);
    void *state; /* of that reader; released with free */
};

/* Make a reader of a source, which it takes over (it is closed also on failure). */
mw_status mw__points_start(mw_source source, const mw_point_reader_options *options, mw_point_reader **out,
                           mw_error *error);

/* The two readers: look at the beginning, set width, names, read and state. */
mw_status mw__points_text(mw_point_reader *reader, const mw_point_reader_options *options, mw_error *error);
mw_status mw__points_las(mw_point_reader *reader, const mw_point_reader_options *options, mw_error *error);

/* Add a column to the reader. */
mw_status mw__points_add(mw_point_reader *reader, const char *name, mw_error *error);

/* The next item of a selection "x,y,3", without blanks around it, its length in *length; NULL after the last. *rest
 * begins as the selection. */
const char *mw__points_item(const char **rest, size_t *length);

#endif
