/* taken_as.h - what `check` and `info` take a mesh as: one in the plane, a surface in space, or a polyhedron that is
 * star-shaped about a centre. */
#ifndef CLI_TAKEN_AS_H
#define CLI_TAKEN_AS_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

enum { AS_PLANE, AS_SURFACE, AS_STAR };

typedef struct taken_as {
    common_settings common;
    coordinates centre; /* not given: the origin */
    int as;
    bool lonlat, weld, json;
} taken_as;

extern const option taken_as_options[]; /* all but --json */

/* Read the mesh for it: options that do not go together are refused, longitudes and latitudes put on the sphere. Returns
 * 0 or an exit code after a complaint; release the file in either case. */
int taken_as_read(const taken_as *s, const char *const *operands, mw_mesh_file *file);

/* Do vertices with equal coordinates count as one? */
bool taken_as_welded(const taken_as *s);

#endif
