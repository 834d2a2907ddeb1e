/* mesh_readers.h - the readers of meshes, each in the file of its format. Private. */
#ifndef MW_SRC_IO_MESH_READERS_H
#define MW_SRC_IO_MESH_READERS_H

#include "io/builder.h"
#include "io/source.h"

/* They begin at the start of the source. */
mw_status mw__read_off(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_obj(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_ply(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_stl(mw_source *source, mw_builder *builder, mw_error *error);
mw_status mw__read_node(mw_source *node, mw_builder *builder, mw_error *error); /* the vertices */
/* The same where more may follow them; tells how many coordinates they have: 2 or 3. */
mw_status mw__read_node_rows(mw_source *node, mw_builder *builder, int64_t *dimension, mw_error *error);
mw_status mw__read_node_file(const char *path, mw_builder *builder, mw_error *error); /* the .node of that name */
mw_status mw__read_ele(mw_source *ele, mw_builder *builder, mw_error *error);         /* the triangles, after them */
mw_status mw__read_node_ele(const char *path, mw_builder *builder, mw_error *error);
/* Is there PATH.node or PATH.node.gz? */
mw_status mw__node_ele_exists(const char *path, bool *exists, mw_error *error);

#endif
