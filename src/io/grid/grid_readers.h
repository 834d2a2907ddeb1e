/* grid_readers.h - the readers of the meshes of simulations, each in the file of its format.
 * Private. */
#ifndef MW_SRC_IO_GRID_GRID_READERS_H
#define MW_SRC_IO_GRID_GRID_READERS_H

#include "io/mesh/mesh_builder.h"

/* They begin at the start of the source. */
mw_status mw__read_fort14(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_hgrid_ll(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_2dm(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_selafin(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_su2(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_msh(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_vtk(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_vtu(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_npz(mw_source *source, mw_mesh_builder *builder, mw_error *error);

#endif
