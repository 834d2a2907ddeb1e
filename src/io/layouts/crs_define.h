/* crs_define.h - a coordinate system as the grid mapping of a netCDF file that is written
 * [CF 1.8, section 5.6]. Private. */
#ifndef MW_SRC_IO_LAYOUTS_CRS_DEFINE_H
#define MW_SRC_IO_LAYOUTS_CRS_DEFINE_H

#include "io/netcdf/netcdf_output.h"

/* Define the variable "crs" for "EPSG:..." or WKT. Returns its number; -1 for NULL, or after a
 * failure of the output. */
int mw__crs_define(mw_netcdf_output *output, const char *crs);

/* Is it one of longitudes and latitudes? As far as the beginning of its text tells; NULL is none.
 */
bool mw__crs_is_lonlat(const char *crs);

#endif
