/* node_ele.h - the two files of Triangle's meshes, one by one. Private. */
#ifndef MW_SRC_IO_MESH_NODE_ELE_H
#define MW_SRC_IO_MESH_NODE_ELE_H

#include "io/mesh/mesh_builder.h"
#include "io/text/byte_source.h"

/* The vertices. */
mw_status mw__read_node(mw_source *node, mw_mesh_builder *builder, mw_error *error);
/* The same where more may follow them; tells how many coordinates they have: 2 or 3. */
mw_status mw__read_node_rows(mw_source *node, mw_mesh_builder *builder, int64_t *dimension,
                             mw_error *error);
/* The .node of that name. */
mw_status mw__read_node_file(const char *path, mw_mesh_builder *builder, mw_error *error);
/* The triangles, after the vertices. */
mw_status mw__read_ele(mw_source *ele, mw_mesh_builder *builder, mw_error *error);

/* Is there PATH.node or PATH.node.gz? */
mw_status mw__node_ele_exists(const char *path, bool *exists, mw_error *error);

#endif
