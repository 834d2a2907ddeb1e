#include "io/layouts/crs_define.h"

#include <stdlib.h>
#include <string.h>

bool mw__crs_is_lonlat(const char *crs)
{
    static const char *const begins[] = {"EPSG:4326", "GEOGCS", "GEOGCRS", "GEODCRS"};
    for (size_t k = 0; crs && k < sizeof begins / sizeof *begins; k++)
        if (strncmp(crs, begins[k], strlen(begins[k])) == 0) return true;
    return false;
}

int mw__crs_define(mw_netcdf_output *output, const char *crs)
{
    if (!crs) return -1;
    const int variable = mw__netcdf_output_variable(output, "crs", MW_NETCDF_INT, 0, NULL);
    if (strncmp(crs, "EPSG:", 5) == 0) {
        mw__netcdf_output_text(output, variable, "epsg_code", crs);
        mw__netcdf_output_number(output, variable, "epsg", MW_NETCDF_INT, (double)atoi(crs + 5));
    } else {
        mw__netcdf_output_text(output, variable, "crs_wkt", crs);
        mw__netcdf_output_text(output, variable, "spatial_ref", crs);
    }
    if (mw__crs_is_lonlat(crs))
        mw__netcdf_output_text(output, variable, "grid_mapping_name", "latitude_longitude");
    return variable;
}
