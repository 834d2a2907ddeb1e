/* netcdf_mesh.h - meshes in netCDF files, read and written. Private. */
#ifndef MW_SRC_IO_LAYOUTS_NETCDF_MESH_H
#define MW_SRC_IO_LAYOUTS_NETCDF_MESH_H

#include "io/mesh/mesh_builder.h"
#include "io/netcdf/netcdf_source.h"

/* Read a mesh; `builder->layout` as for mw__layout_find. */
mw_status mw__read_netcdf(mw_source *source, mw_mesh_builder *builder, mw_error *error);

/* As UGRID 1.0 in netCDF-4. */
mw_status mw__write_netcdf(const char *path, const mw_mesh_file *file, mw_job *job,
                           mw_error *error);

#endif
