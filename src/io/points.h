/* points.h - a stream of points from a source. Private. */
#ifndef MW_SRC_IO_POINTS_H
#define MW_SRC_IO_POINTS_H

#include "io/point_reader.h"

/* Make a reader of a source, which it takes over (it is closed also on failure). */
mw_status mw__points_start(mw_source source, const mw_point_reader_options *options, mw_point_reader **out,
                           mw_error *error);

#endif
