/* points_text.h - points from text. Private. */
#ifndef MW_SRC_IO_POINTS_TEXT_H
#define MW_SRC_IO_POINTS_TEXT_H

#include "io/point_reader.h"

/* Looks at the beginning, and sets width, names, read and state. */
mw_status mw__points_text(mw_point_reader *reader, const mw_point_reader_options *options, mw_error *error);

#endif
