/* fixed_edges.h - the edges of a mesh along constraints that it was made with. */
#ifndef CLI_FIXED_EDGES_H
#define CLI_FIXED_EDGES_H

#include <meshwalk/meshwalk.h>

typedef struct fixed_edges {
    uint32_t *vertex; /* two for each edge */
    size_t count, room;
} fixed_edges;

/* Read the constraints in a file and find their edges in the mesh; a segment is one edge, or several with vertices between them.
 * `mesh_path` is for messages. Returns 0, or an exit code after a complaint, as of a segment that is no edge. Release in either case. */
int fixed_edges_read(fixed_edges *e, const char *path, const mw_mesh *mesh, const char *mesh_path);
void fixed_edges_release(fixed_edges *e);

#endif
