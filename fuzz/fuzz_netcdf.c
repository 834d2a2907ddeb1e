/* Any bytes as a mesh in classic netCDF. netCDF-4 is left out: damaged files bring HDF5 down. */
#include "reader.h"

#include "io/layouts/netcdf_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 4 || memcmp(data, "CDF", 3) != 0 || mw_netcdf_version(NULL, 0) == 0) return 0;
    fuzz_mesh_reader(mw__read_netcdf, "input.nc", data, size);
    return 0;
}
