/* traced_constraints.h - the edges of a mesh along the constraints that it was made with. */
#ifndef MW_CLI_VERTICES_TRACED_CONSTRAINTS_H
#define MW_CLI_VERTICES_TRACED_CONSTRAINTS_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct traced_constraints {
    uint32_t *vertex; /* two for each edge */
    size_t count, room;
} traced_constraints;

/* Read a file of constraints and find their edges in a mesh. A segment is one edge, or a chain of
 * edges if vertices lie on it. Returns 0, or an exit code after a complaint, for instance if a
 * segment is no edge; `mesh_path` is for the message; constraints in another system than
 * `mesh_crs`, which may be NULL, are transformed; `common` says with how many threads, and
 * whether to warn. Release in both cases. */
int traced_constraints_read(traced_constraints *traced, const char *path,
                            const common_settings *common, const mw_mesh *mesh,
                            const char *mesh_path, const char *mesh_crs);
void traced_constraints_release(traced_constraints *traced);

#endif
