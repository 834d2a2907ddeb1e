/* netcdf_source.h - opens netCDF files of any kind: plain, compressed by gzip, or a pipe. Headers
 * of classic files are checked before libnetcdf reads them. Private. */
#ifndef MW_SRC_IO_NETCDF_NETCDF_SOURCE_H
#define MW_SRC_IO_NETCDF_NETCDF_SOURCE_H

#include "io/netcdf/netcdf_file.h"
#include "io/text/byte_source.h"

/* Open the file of a source, or its uncompressed contents. In the second case *memory holds them
 * until the file is closed; the caller releases it with free(). */
mw_status mw__netcdf_open_source(mw_source *source, mw_netcdf **out, void **memory,
                                 mw_error *error);

/* The same by a path; "-" is standard input. */
mw_status mw__netcdf_open_path(const char *path, mw_netcdf **out, void **memory, mw_error *error);

#endif
