/* layout_find.h - finds the mesh in a netCDF file: by UGRID's attributes, or by the names of a
 * model's variables. Private. */
#ifndef MW_SRC_IO_LAYOUTS_LAYOUT_FIND_H
#define MW_SRC_IO_LAYOUTS_LAYOUT_FIND_H

#include "io/layouts/mesh_layout.h"

/* Find the mesh. `wanted`: the name of a layout, optionally followed by the number of the first
 * vertex, ":0" or ":1"; NULL: any layout. MW_ERROR_INPUT: the file has no such mesh, or an
 * incomplete one; MW_ERROR_ARGUMENT: `wanted` is not the name of a layout. */
mw_status mw__layout_find(const mw_netcdf *file, const char *wanted, mw_layout *layout,
                          mw_error *error);

/* MW_OK if `wanted` is NULL or names a layout, else MW_ERROR_ARGUMENT. */
mw_status mw__layout_check(const char *wanted, mw_error *error);

/* The coordinate system of x and y: WKT or "EPSG:n", released by the caller; NULL: not known. */
mw_status mw__layout_crs(const mw_netcdf *file, const mw_layout *layout, char **crs,
                         mw_error *error);

#endif
