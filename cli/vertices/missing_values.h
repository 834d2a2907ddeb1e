/* missing_values.h - heights and fields of vertices whose file has none: those of constraints, and
 * those added where constraints cross. */
#ifndef MW_CLI_VERTICES_MISSING_VALUES_H
#define MW_CLI_VERTICES_MISSING_VALUES_H

#include "cli/vertices/vertex_table.h"

/* Fill in the missing values (NaN) of the vertices that are not from POINTS:
 *   1. vertices with equal coordinates take each other's values;
 *   2. a vertex that was added on a constraint is interpolated along it, if both ends have a value;
 *   3. the others are interpolated linearly in the Delaunay triangulation of POINTS, outside it at
 *      the nearest point of its border.
 * A value stays NaN if POINTS have no such field, or no triangle. If no vertex has a height, all
 * are 0.
 *   added      the vertices from this number on were added
 *   segments   the constraints, two vertices each; `edges` are what they became
 *   on_a_line  set to true if values stay missing because POINTS lie on one line
 * Returns 0, or an exit code after a complaint. */
int missing_values_fill(vertex_table *v, size_t added, const uint32_t *duplicate_of,
                        const uint32_t *segments, const mw_constrained_edges *edges,
                        uint32_t threads, bool *on_a_line);

#endif
