/* time_texts.h - times that a netCDF file holds as text, as MPAS and WRF write them:
 * "2014-01-01_06:00:00". Private; for this room only. */
#ifndef MW_SRC_IO_SERIES_TIME_TEXTS_H
#define MW_SRC_IO_SERIES_TIME_TEXTS_H

#include "io/netcdf/netcdf_file.h"
#include "io/series/series_kind.h"

/* The variable with such texts over a dimension; NULL: there is none. */
const mw_netcdf_variable *mw__time_texts_find(const mw_netcdf *file, int dimension);

/* Read them into part->times, which has room for them, as seconds since the first; unit and
 * calendar go to the part. The calendar is what the file's config_calendar_type tells. Errors name
 * the variable and the step. */
mw_status mw__time_texts_read(const mw_netcdf *file, const mw_netcdf_variable *texts,
                              mw_series_part *part, mw_error *error);

/* Replace part->times, which were read as floats, by what the texts tell, in the same unit. Does
 * nothing unless each text is the time that was rounded. */
mw_status mw__time_texts_refine(const mw_netcdf *file, const mw_netcdf_variable *texts,
                                mw_series_part *part, mw_error *error);

#endif
