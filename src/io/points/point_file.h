/* point_file.h - a stream of points from a source: its contents tell the format. Private. */
#ifndef MW_SRC_IO_POINTS_POINT_FILE_H
#define MW_SRC_IO_POINTS_POINT_FILE_H

#include "io/points/point_reader.h"

/* Make a reader of a source, which it takes over (it is closed also on failure). */
mw_status mw__point_reader_start(mw_source source, const mw_point_reader_options *options,
                                 mw_point_reader **out, mw_error *error);

#endif
