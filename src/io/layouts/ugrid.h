/* ugrid.h - meshes by the attributes of UGRID 1.0. Private; for this room only. */
#ifndef MW_SRC_IO_LAYOUTS_UGRID_H
#define MW_SRC_IO_LAYOUTS_UGRID_H

#include "io/layouts/mesh_layout.h"

/* Look for a topology of faces; layout->x stays NULL if there is none. */
mw_status mw__layout_ugrid(const mw_netcdf *file, mw_layout *layout, mw_error *error);

#endif
