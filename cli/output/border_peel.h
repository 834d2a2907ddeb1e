/* border_peel.h - --max-edge: takes long triangles off a triangulation, from its border inwards. */
#ifndef MW_CLI_OUTPUT_BORDER_PEEL_H
#define MW_CLI_OUTPUT_BORDER_PEEL_H

#include <meshwalk/meshwalk.h>

/* What was taken off. */
typedef struct border_peel {
    size_t triangles;
    size_t points; /* that belonged to a triangle before, and belong to none now */
} border_peel;

/* Removes triangles with a border edge longer than `longest` (rounded), repeatedly: the other edges
 * of a removed triangle become border. A triangle is not removed over a constrained edge. So no
 * hole is opened inside, and the result does not depend on the order. `file` has the triangles of
 * the mesh, and loses those. Returns 0, or an exit code after a complaint. */
int border_peel_off(const mw_mesh *mesh, double longest, const mw_constrained_edges *edges,
                    mw_mesh_file *file, border_peel *peel);

#endif
