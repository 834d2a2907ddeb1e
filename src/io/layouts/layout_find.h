/* layout_find.h - where a netCDF file keeps its mesh: by UGRID's attributes, or by the names that a
 * model gives its variables. Private. */
#ifndef MW_SRC_IO_LAYOUTS_LAYOUT_FIND_H
#define MW_SRC_IO_LAYOUTS_LAYOUT_FIND_H

#include "io/layouts/mesh_layout.h"

/* Find the mesh. `wanted`: the name of a layout, perhaps followed by ":0" or ":1", the number of
 * the first vertex; NULL: any layout that the file has. MW_ERROR_INPUT: the file has no such mesh,
 * or an incomplete one; MW_ERROR_ARGUMENT: `wanted` is not the name of a layout. */
mw_status mw__layout_find(const mw_netcdf *file, const char *wanted, mw_layout *layout,
                          mw_error *error);

/* MW_ERROR_ARGUMENT unless `wanted` can be asked for; NULL can. */
mw_status mw__layout_check(const char *wanted, mw_error *error);

/* The coordinate system of x and y: WKT or "EPSG:n", released by the caller; NULL: not known. */
mw_status mw__layout_crs(const mw_netcdf *file, const mw_layout *layout, char **crs,
                         mw_error *error);

#endif
