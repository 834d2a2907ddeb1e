/* msh_data.h - the sections $NodeData and $ElementData of MSH: values of vertices and of faces.
 * Private. */
#ifndef MW_SRC_IO_GRID_MSH_DATA_H
#define MW_SRC_IO_GRID_MSH_DATA_H

#include "io/grid/msh_source.h"
#include "io/grid/number_list.h"
#include "io/mesh/mesh_builder.h"

/* Values of vertices become a field at once, those of faces a triangle field; a vector becomes
 * NAME_0, NAME_1, ... Without a value they are NaN. `ranks` are the numbers of the vertices or
 * faces, sorted; values of other elements are skipped. If there are values of that name, they are
 * of an earlier time, and these are skipped. */
mw_status mw__msh_read_data(mw_msh_source *m, mw_mesh_builder *builder, const mw_rank_list *ranks,
                            bool of_faces, mw_error *error);

#endif
