/* view_content.h - what a page shows, as JSON: a mesh and points, with numbers packed by zlib and
 * written in base64. */
#ifndef MW_CLI_VIEW_VIEW_CONTENT_H
#define MW_CLI_VIEW_VIEW_CONTENT_H

#include "cli/frame/text.h"

#include <meshwalk/meshwalk.h>

typedef struct view_content {
    const char *path;     /* of the mesh */
    const char *as;       /* how it is taken: "plane", "surface" or "star" */
    const double *centre; /* x, y, z: where rays come from */
    const mw_mesh_file *mesh;
    const char *points_path; /* NULL: no points */
    const double *points;    /* x, y of each */
    size_t point_count;
} view_content;

/* Add it to a text; text.failed tells whether memory ran out. */
void view_content_write(text *t, const view_content *content);

#endif
