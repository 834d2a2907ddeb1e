/* axis_names.h - the coordinates of points among the names of columns. Private. */
#ifndef MW_SRC_IO_POINTS_AXIS_NAMES_H
#define MW_SRC_IO_POINTS_AXIS_NAMES_H

#include "base/base.h"

#include <meshwalk/io.h>

/* Whether a column of this name holds a coordinate, by any set of names. */
bool mw__axis_name_known(const char *column);

#endif
