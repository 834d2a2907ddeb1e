/* mesh_readers.h - the readers of meshes, each in the file of its format. Private. */
#ifndef MW_SRC_IO_MESH_MESH_READERS_H
#define MW_SRC_IO_MESH_MESH_READERS_H

#include "io/mesh/mesh_builder.h"
#include "io/text/byte_source.h"

/* They begin at the start of the source. */
mw_status mw__read_off(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_obj(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_ply(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_stl(mw_source *source, mw_mesh_builder *builder, mw_error *error);
mw_status mw__read_node_ele(const char *path, mw_mesh_builder *builder, mw_error *error);

#endif
