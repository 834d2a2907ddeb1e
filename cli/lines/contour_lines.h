/* contour_lines.h - the lines of equal value of a mesh.
 *
 * A vertex whose value is the level counts as above it. So each triangle has both or neither of its
 * sides, the line of a level enters it over one edge and leaves it over another, and each line is
 * closed or goes from border to border, whatever the values are. Triangles that are flat at the
 * level lie above it: the line runs along them. Nothing is decided by rounded coordinates. */
#ifndef MW_CLI_LINES_CONTOUR_LINES_H
#define MW_CLI_LINES_CONTOUR_LINES_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

/* A line; higher values lie to its left. A closed one ends with its first point. */
typedef struct contour_line {
    double level;
    bool closed;
    const double *points; /* x, y; at least two, and none follows its equal */
    size_t count;
} contour_line;

/* Take a line, whose points are valid during the call. Returns 0, or an exit code after a
 * complaint, which ends the tracing. */
typedef int contour_sink(void *self, const contour_line *line);

/* Trace the lines of all levels, which ascend, one level after the other. Lines that shrink to a
 * point are left out. Triangles with a vertex whose value is NaN count as no part of the mesh.
 *   values  one for each vertex
 * Returns 0, or an exit code after a complaint. */
int contour_lines_trace(const mw_mesh *mesh, const double *values, const double *levels,
                        size_t level_count, contour_sink *sink, void *self);

#endif
