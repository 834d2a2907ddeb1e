/* remeshed_star.h - a star-shaped polyhedron sampled anew, on an icosphere or on another mesh:
 * read, made, measured and written. */
#ifndef MW_CLI_REMESH_REMESHED_STAR_H
#define MW_CLI_REMESH_REMESHED_STAR_H

#include "cli/frame/options.h"

typedef struct remesh_settings {
    const char *level;  /* of the icosphere; NULL: `onto` */
    const char *onto;   /* the mesh that has the rays and the triangles */
    const char *nodata; /* the number that means a missing value; NULL: not given */
    int format;         /* the number of a name of mesh_formats */
    bool deviation;     /* measure how far the two are apart, and tell */
    bool json;          /* as JSON */
} remesh_settings;

/* Make it of the polyhedron in the file `path`, and write it to common->output. Returns the exit
 * code. */
int remeshed_star_run(const remesh_settings *s, const common_settings *common,
                      const coordinates *centre, bool lonlat, const char *path);

#endif
