#include "io/layouts/layout_axis.h"

#include <stdlib.h>
#include <string.h>

mw_status mw__layout_attribute_is(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                  const char *attribute, const char *text, bool *is,
                                  mw_error *error)
{
    char *found;
    mw_status status = mw__netcdf_text(file, variable, attribute, &found, error);
    *is = !status && found && strcmp(found, text) == 0;
    free(found);
    return status;
}

/* Does a text begin with "degree" or "degrees", and with `side` behind, "_east" for instance? */
static bool layout_unit_is(const char *unit, const char *side)
{
    if (strncmp(unit, "degree", 6) != 0) return false;
    unit += 6;
    unit += *unit == 's';
    unit += *unit == '_';
    return strcmp(unit, side) == 0 || (unit[0] == side[0] - 'a' + 'A' && unit[1] == 0);
}

static mw_axis_kind layout_axis_of(const char *unit, const char *name)
{
    static const char *const names[] = {"", "longitude", "latitude", "projection_x_coordinate",
                                        "projection_y_coordinate"};
    if (unit && layout_unit_is(unit, "east")) return MW_AXIS_LONGITUDE;
    if (unit && layout_unit_is(unit, "north")) return MW_AXIS_LATITUDE;
    for (int k = 1; name && k <= MW_AXIS_NORTHING; k++)
        if (strcmp(name, names[k]) == 0) return (mw_axis_kind)k;
    return MW_AXIS_UNKNOWN;
}

mw_status mw__layout_axis(const mw_netcdf *file, const mw_netcdf_variable *variable,
                          mw_axis_kind *kind, bool *radians, mw_error *error)
{
    char *unit, *name = NULL;
    *kind = MW_AXIS_UNKNOWN;
    *radians = false;
    mw_status status = mw__netcdf_text(file, variable, "units", &unit, error);
    if (!status) status = mw__netcdf_text(file, variable, "standard_name", &name, error);
    if (!status) {
        *kind = layout_axis_of(unit, name);
        *radians = unit && strncmp(unit, "rad", 3) == 0;
    }
    free(unit);
    free(name);
    return status;
}
