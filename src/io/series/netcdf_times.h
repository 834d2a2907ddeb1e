/* netcdf_times.h - the time axis of a netCDF file. Private; for this room only. */
#ifndef MW_SRC_IO_SERIES_NETCDF_TIMES_H
#define MW_SRC_IO_SERIES_NETCDF_TIMES_H

#include "io/netcdf/netcdf_file.h"
#include "io/series/series_kind.h"

/* The dimension of the times; -1: there is none. */
int mw__netcdf_time_dimension(const mw_netcdf *file);

/* Read the times of that dimension into the part: they increase, and their calendar is one of CF.
 * A dimension without times has the numbers of its steps. */
mw_status mw__netcdf_times(const mw_netcdf *file, int dimension, mw_series_part *part,
                           mw_error *error);

#endif
