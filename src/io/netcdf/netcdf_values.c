#include "io/netcdf/netcdf_values.h"

#include <math.h>

/* What libnetcdf fills variables with, by their types (NC_FILL_INT, NC_FILL_FLOAT ...). */
static bool netcdf_values_fill(mw_netcdf_type type, double *fill)
{
    switch (type) {
    case MW_NETCDF_SHORT: *fill = -32767; return true;
    case MW_NETCDF_INT: *fill = -2147483647; return true;
    case MW_NETCDF_UINT: *fill = 4294967295.0; return true;
    case MW_NETCDF_INT64: *fill = -9223372036854775806.0; return true;
    case MW_NETCDF_UINT64: *fill = 18446744073709551614.0; return true;
    case MW_NETCDF_FLOAT:
    case MW_NETCDF_DOUBLE: *fill = 9.9692099683868690e+36; return true;
    case MW_NETCDF_BYTE: /* too few numbers to spare one */
    case MW_NETCDF_UBYTE:
    case MW_NETCDF_USHORT:
    case MW_NETCDF_CHAR:
    case MW_NETCDF_STRING: break;
    }
    return false;
}

mw_netcdf_packing mw__netcdf_packing(const mw_netcdf *file, const mw_netcdf_variable *variable)
{
    mw_netcdf_packing packing = {.scale = 1, .offset = 0};
    double *missing = packing.missing;
    bool filled = mw__netcdf_number(file, variable, "_FillValue", &missing[0]);
    packing.missing_count = filled || netcdf_values_fill(variable->type, &missing[0]);
    if (mw__netcdf_number(file, variable, "missing_value", &missing[packing.missing_count]))
        packing.missing_count++;
    if (!mw__netcdf_number(file, variable, "scale_factor", &packing.scale)) packing.scale = 1;
    if (!mw__netcdf_number(file, variable, "add_offset", &packing.offset)) packing.offset = 0;
    packing.plain = packing.scale == 1 && packing.offset == 0;
    return packing;
}

void mw__netcdf_unpack(const mw_netcdf_packing *packing, double *values, size_t count)
{
    for (size_t m = 0; m < packing->missing_count; m++) {
        double missing = packing->missing[m];
        for (size_t i = 0; i < count; i++)
            if (values[i] == missing) values[i] = NAN;
    }
    if (packing->plain) return;
    for (size_t i = 0; i < count; i++) values[i] = values[i] * packing->scale + packing->offset;
}

mw_status mw__netcdf_check_size(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                mw_error *error)
{
    /* deflate packs at most 1032 bytes into one; classic files are not packed */
    double packing = mw__netcdf_is_classic(file) ? 1 : 1032, bytes = 1;
    if (variable->rank > MW_NETCDF_RANK)
        return mw__netcdf_fail(file, variable, error, "it has %zu dimensions", variable->rank);
    for (size_t k = 0; k < variable->rank; k++) bytes *= (double)variable->lengths[k];
    if (bytes <= packing * (double)mw__netcdf_file_size(file)) return MW_OK;
    return mw__netcdf_fail(file, variable, error,
                           "%.0f values are announced, which a file of this size cannot hold",
                           bytes);
}

mw_status mw__netcdf_column(const mw_netcdf *file, const mw_netcdf_variable *variable,
                            double *values, mw_error *error)
{
    size_t start = 0, count = variable->lengths[0];
    mw_netcdf_packing packing = mw__netcdf_packing(file, variable);
    mw_status status = mw__netcdf_doubles(file, variable, &start, &count, values, error);
    if (!status) mw__netcdf_unpack(&packing, values, count);
    return status;
}
