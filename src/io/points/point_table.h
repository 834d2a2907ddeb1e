/* point_table.h - points from tables of text. Private. */
#ifndef MW_SRC_IO_POINTS_POINT_TABLE_H
#define MW_SRC_IO_POINTS_POINT_TABLE_H

#include "io/points/point_reader.h"

/* Looks at the beginning, and sets width, names, read and state. */
mw_status mw__point_table_start(mw_point_reader *reader, const mw_point_reader_options *options,
                                mw_error *error);

#endif
