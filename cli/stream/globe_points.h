/* globe_points.h - points of longitude and latitude, located on the globe for a query that is about
 * a mesh in the plane of these. */
#ifndef MW_CLI_STREAM_GLOBE_POINTS_H
#define MW_CLI_STREAM_GLOBE_POINTS_H

#include "cli/input/star_input.h"
#include "cli/stream/query_stream.h"

typedef struct globe_points {
    star_input polyhedron; /* its triangles have the numbers of the mesh's */
    uint32_t threads;
} globe_points;

/* Make the globe of a mesh's file, which stays as it is. `open` as of star_input. Returns 0, or an
 * exit code after a complaint; release it in both cases. */
int globe_points_make(globe_points *g, const char *path, const mw_mesh_file *file, bool open,
                      uint32_t threads);
void globe_points_release(globe_points *g);

/* A point_query_elsewhere: `self` is a globe_points. */
int globe_points_locate(void *self, const query_block *block, mw_location *answers);

#endif
