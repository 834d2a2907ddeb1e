/* netcdf_values.h - the values of a variable by the CF conventions: unpacked, and NaN where
 * missing. Private. */
#ifndef MW_SRC_IO_NETCDF_NETCDF_VALUES_H
#define MW_SRC_IO_NETCDF_NETCDF_VALUES_H

#include "io/netcdf/netcdf_file.h"

/* The conventions of CF for one variable. */
typedef struct mw_netcdf_packing {
    double scale, offset; /* value = stored * scale + offset */
    double missing[3];    /* stored numbers that stand for missing values */
    size_t missing_count;
    bool plain; /* scale 1, offset 0 */
} mw_netcdf_packing;

/* Look at _FillValue, missing_value, scale_factor and add_offset. Without _FillValue the number
 * with which libnetcdf fills what is not written is missing, too. */
mw_netcdf_packing mw__netcdf_packing(const mw_netcdf *file, const mw_netcdf_variable *variable);

/* Stored numbers become values; missing ones become NaN. */
void mw__netcdf_unpack(const mw_netcdf_packing *packing, double *values, size_t count);

/* Returns an error if a file of this size cannot hold the variable's values, even compressed. To be
 * called before memory is allocated. */
mw_status mw__netcdf_check_size(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                mw_error *error);

/* All values of a variable of one dimension. */
mw_status mw__netcdf_column(const mw_netcdf *file, const mw_netcdf_variable *variable,
                            double *values, mw_error *error);

#endif
