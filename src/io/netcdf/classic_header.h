/* classic_header.h - checks the header of a classic netCDF file before libnetcdf reads it, because
 * libnetcdf trusts the counts of a damaged header when it allocates. Private. */
#ifndef MW_SRC_IO_NETCDF_CLASSIC_HEADER_H
#define MW_SRC_IO_NETCDF_CLASSIC_HEADER_H

#include "io/text/byte_source.h"

/* Is the header complete, with counts that the file can hold? `source` is at its beginning, and is
 * read from. MW_OK also for netCDF-4. MW_ERROR_INPUT names the byte. */
mw_status mw__classic_header_check(mw_source *source, mw_error *error);

#endif
