/* constraints.h - constraints as the program reads them, and what it says when they cross. */
#ifndef CLI_CONSTRAINTS_H
#define CLI_CONSTRAINTS_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

/* Read constraints, by GDAL what the library does not know. Returns 0 or an exit code. */
int constraints_read(const char *path, mw_constraint_file *file);

/* Does a .poly lie behind them, whose segments bound without polygons? */
bool constraints_are_poly(const mw_constraint_file *file);

/* The file may take its points from a .node file beside it: refuse an output that would write that. Returns 0 or an exit
 * code after a complaint. */
int constraints_check_node(const char *path, const char *output);

/* Complain of two segments that cross; `points` are the vertices that they name, 3 doubles each. `split`: even though
 * they were split. Returns the exit code. */
int constraints_cross(const char *path, const mw_constraint_file *file, const double *points, const uint32_t cross[2],
                      bool split);

#endif
