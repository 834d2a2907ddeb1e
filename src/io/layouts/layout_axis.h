/* layout_axis.h - what a coordinate is, by its attributes. Private; for this room only. */
#ifndef MW_SRC_IO_LAYOUTS_LAYOUT_AXIS_H
#define MW_SRC_IO_LAYOUTS_LAYOUT_AXIS_H

#include "io/netcdf/netcdf_file.h"

/* The kind of a coordinate, told by its units and standard name. */
typedef enum mw_axis_kind {
    MW_AXIS_UNKNOWN = 0,
    MW_AXIS_LONGITUDE,
    MW_AXIS_LATITUDE,
    MW_AXIS_EASTING,
    MW_AXIS_NORTHING
} mw_axis_kind;
mw_status mw__layout_axis(const mw_netcdf *file, const mw_netcdf_variable *variable,
                          mw_axis_kind *kind, bool *radians, mw_error *error);

/* Does an attribute hold this text? */
mw_status mw__layout_attribute_is(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                  const char *attribute, const char *text, bool *is,
                                  mw_error *error);

#endif
