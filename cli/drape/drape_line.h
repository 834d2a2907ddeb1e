/* drape_line.h - a line laid on a mesh: its points and its crossings with edges, with heights. */
#ifndef MW_CLI_DRAPE_DRAPE_LINE_H
#define MW_CLI_DRAPE_DRAPE_LINE_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct drape_line {
    double *points; /* x, y, z; z is NaN where there is no height */
    bool *on;       /* per point: does the line continue on the mesh? */
    size_t count, room;
    double length, surface; /* over the mesh: in the plane, and on the surface */
    double outside;         /* length where there is no height */
} drape_line;

/* Lay the line of `count` points, x and y each, on the mesh of a locator, with a value for each
 * vertex, NaN where it is missing. Replaces what the line held before. Returns 0, or an exit code
 * after a complaint. */
int drape_line_lay(drape_line *line, const mw_locator *locator, const mw_mesh *mesh,
                   const double *values, mw_cursor *cursor, const double *points, size_t count);
void drape_line_release(drape_line *line);

#endif
