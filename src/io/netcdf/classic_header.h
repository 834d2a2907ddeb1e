/* classic_header.h - the header of a classic netCDF file, looked through before libnetcdf reads
 * it: libnetcdf allocates what counts in a damaged header announce. Private. */
#ifndef MW_SRC_IO_NETCDF_CLASSIC_HEADER_H
#define MW_SRC_IO_NETCDF_CLASSIC_HEADER_H

#include "io/text/byte_source.h"

/* Does the file hold all that its header announces of itself? `source` is at its beginning, and is
 * read from. MW_OK also for netCDF-4. MW_ERROR_INPUT names the byte. */
mw_status mw__classic_header_check(mw_source *source, mw_error *error);

#endif
