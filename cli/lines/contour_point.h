/* contour_point.h - where a level crosses an edge of a mesh. */
#ifndef MW_CLI_LINES_CONTOUR_POINT_H
#define MW_CLI_LINES_CONTOUR_POINT_H

#include <meshwalk/meshwalk.h>

/* The point of the edge between two vertices, one with a value below the level, the other at the
 * level or above it. Their order makes no difference: both triangles at the edge get the same
 * doubles, and so do the lines and the polygons of the level. A point that is nearer to a vertex
 * than 2^-44 of its coordinates is that vertex. */
void contour_point(const mw_mesh *mesh, const double *values, double level, uint32_t from,
                   uint32_t to, double p[2]);

#endif
