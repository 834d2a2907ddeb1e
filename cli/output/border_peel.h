/* border_peel.h - --max-edge: takes long triangles off a triangulation, from its border inwards. */
#ifndef MW_CLI_OUTPUT_BORDER_PEEL_H
#define MW_CLI_OUTPUT_BORDER_PEEL_H

#include <meshwalk/meshwalk.h>

/* What was taken off. */
typedef struct border_peel {
    size_t triangles;
    size_t points; /* that belonged to a triangle before, and belong to none now */
} border_peel;

/* A triangle goes if it has a border edge longer than `longest`, rounded; what it bares is border
 * then, and so on. A constrained edge keeps its triangles, however long it is. So no hole is
 * opened inside, and the result depends on no order. `file` has the triangles of the mesh, and
 * loses those. Returns 0, or an exit code after a complaint. */
int border_peel_off(const mw_mesh *mesh, double longest, const mw_constrained_edges *edges,
                    mw_mesh_file *file, border_peel *peel);

#endif
