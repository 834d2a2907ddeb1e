/* netcdf_output.h - a netCDF-4 file that is written, and appears under its name only when it is
 * complete. Private.
 *
 * Dimensions, variables and attributes are defined first, then values are written. The first
 * failure is kept: calls after it do nothing, and mw__netcdf_output_close reports it. Any thread
 * may write, one at a time to one file. */
#ifndef MW_SRC_IO_NETCDF_NETCDF_OUTPUT_H
#define MW_SRC_IO_NETCDF_NETCDF_OUTPUT_H

#include "io/netcdf/netcdf_file.h"

/* Where attributes of the file go: no variable. */
#define MW_NETCDF_OUTPUT_FILE (-1)
/* The length of a dimension that grows as values are written. */
#define MW_NETCDF_UNLIMITED 0

/* Opaque. */
typedef struct mw_netcdf_output mw_netcdf_output;

/* MW_ERROR_SYSTEM: there is no libnetcdf, or the file cannot be written; MW_ERROR_ARGUMENT for
 * standard output and what is no regular file: netCDF is not written in one go. */
mw_status mw__netcdf_output_open(const char *path, mw_netcdf_output **out, mw_error *error);

/* The numbers of what is defined; -1 after a failure, which the calls below accept. */
int mw__netcdf_output_dimension(mw_netcdf_output *output, const char *name, size_t length);
int mw__netcdf_output_variable(mw_netcdf_output *output, const char *name, mw_netcdf_type type,
                               size_t rank, const int *dimensions);
void mw__netcdf_output_text(mw_netcdf_output *output, int variable, const char *attribute,
                            const char *text);
void mw__netcdf_output_number(mw_netcdf_output *output, int variable, const char *attribute,
                              mw_netcdf_type type, double value);
void mw__netcdf_output_list(mw_netcdf_output *output, int variable, const char *attribute,
                            mw_netcdf_type type, size_t count, const double *values);
/* Pack the values of a variable by zlib: 1 (quick) to 9. */
void mw__netcdf_output_pack(mw_netcdf_output *output, int variable, int level);
/* Store a variable in chunks of so many values along each dimension. */
void mw__netcdf_output_chunks(mw_netcdf_output *output, int variable, const size_t *lengths);
/* After the last definition, before the first value. */
void mw__netcdf_output_defined(mw_netcdf_output *output);

/* Write a block of values, the last dimension fastest. Values that the variable's type cannot hold
 * are a failure. */
void mw__netcdf_output_doubles(mw_netcdf_output *output, int variable, const size_t *starts,
                               const size_t *counts, const double *values);
void mw__netcdf_output_integers(mw_netcdf_output *output, int variable, const size_t *starts,
                                const size_t *counts, const int64_t *values);
void mw__netcdf_output_numbers(mw_netcdf_output *output, int variable, const size_t *starts,
                               const size_t *counts, const uint32_t *values);
void mw__netcdf_output_characters(mw_netcdf_output *output, int variable, const size_t *starts,
                                  const size_t *counts, const char *text);
bool mw__netcdf_output_failed(const mw_netcdf_output *output);

/* Finish the file, and release the output in any case. `commit`: true gives it its name, false
 * removes it. MW_ERROR_SYSTEM with the first failure, and no file is left. NULL is allowed. */
mw_status mw__netcdf_output_close(mw_netcdf_output *output, bool commit, mw_error *error);

#endif
