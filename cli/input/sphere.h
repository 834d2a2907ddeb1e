/* sphere.h - longitudes and latitudes in degrees: meshes and directions on the unit sphere. */
#ifndef CLI_SPHERE_H
#define CLI_SPHERE_H

#include <meshwalk/meshwalk.h>

/* Where a file has no z, take its x and y as longitude and latitude: its vertices then lie on the unit sphere. Complains
 * about a vertex with a latitude beyond a pole. Returns 0 or an exit code. */
int sphere_place(const char *path, mw_mesh_file *file);

/* Points in the directions of `count` longitudes and latitudes, seen from the centre: far enough from it that they are
 * not lost in rounding. */
void sphere_directions(const double *lonlat, size_t stride, size_t count, const double centre[3], int threads,
                       double *points);

#endif
