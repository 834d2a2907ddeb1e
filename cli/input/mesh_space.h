/* mesh_space.h - --as: how a command takes a mesh. As a mesh in the plane, as a surface in space,
 * or as a polyhedron that is star-shaped about a centre. */
#ifndef MW_CLI_INPUT_MESH_SPACE_H
#define MW_CLI_INPUT_MESH_SPACE_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

typedef enum mesh_space { SPACE_PLANE, SPACE_SURFACE, SPACE_STAR } mesh_space;

/* The settings of the commands with --as, and the options for them. `json` is for `check` and
 * `info`, which have the option in tables of their own. */
typedef struct mesh_space_settings {
    common_settings common;
    coordinates centre; /* not given: the origin */
    int space;          /* mesh_space */
    bool lonlat, weld, json;
} mesh_space_settings;

extern const option mesh_space_options[];

/* Refuse options that contradict each other, read the mesh operands[0], and, with --lonlat, put it
 * on the sphere. Returns 0, or an exit code after a complaint. Release the file in both cases. */
int mesh_space_read(const mesh_space_settings *s, const char *const *operands, mw_mesh_file *file);

/* Do vertices with equal coordinates count as one? */
bool mesh_space_is_welded(const mesh_space_settings *s);

#endif
