/* las.h - points from LAS files. Private. */
#ifndef MW_SRC_IO_POINTS_LAS_H
#define MW_SRC_IO_POINTS_LAS_H

#include "io/points/point_reader.h"

/* Looks at the beginning, and sets width, names, read and state. */
mw_status mw__las_start(mw_point_reader *reader, const mw_point_reader_options *options,
                        mw_error *error);

#endif
