/* lonlat_input.h - meshes and directions given as longitudes and latitudes in degrees. */
#ifndef MW_CLI_INPUT_LONLAT_INPUT_H
#define MW_CLI_INPUT_LONLAT_INPUT_H

#include <meshwalk/meshwalk.h>

/* Put the vertices of a mesh without z on the unit sphere: x is the longitude, y the latitude. A
 * mesh with z stays as it is. Complains of a latitude beyond a pole. Returns 0 or an exit code. */
int lonlat_input_mesh(const char *path, mw_mesh_file *file);

/* Make a point of each longitude and latitude: it lies in their direction from the centre, far
 * enough away that rounding keeps the direction. */
void lonlat_input_directions(const double *lonlat, size_t stride, size_t count,
                             const double centre[3], uint32_t threads, double *points);

#endif
