/* drawing_content.h - what a picture of a walk shows: its triangles, its line, the mesh, and how to
 * look at it. */
#ifndef MW_CLI_DRAW_DRAWING_CONTENT_H
#define MW_CLI_DRAW_DRAWING_CONTENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How a mesh is looked at. */
typedef enum drawing_view {
    /* from above; z does not matter */
    VIEW_PLANE,
    /* on the fronts of the triangles visited */
    VIEW_SURFACE,
    /* on the middle of the walk, towards the centre; fronts face away from it */
    VIEW_STAR
} drawing_view;

typedef struct drawing {
    drawing_view view;
    double centre[3]; /* VIEW_STAR */
    const char *caption;
    const char *name;          /* of the walk */
    const double *points;      /* x, y, z of each vertex */
    const uint32_t *triangles; /* three vertices each    */
    size_t point_count, triangle_count;
    /* the triangles visited, in order, and the number of the walk that each is of */
    const uint32_t *path, *iteration;
    size_t path_count;
    /* NULL, or the stage of each visit: of these names, a colour each */
    const uint8_t *stage;
    const char *const *stage_names; /* NULL ends them; at most four */
    size_t most_triangles;          /* that are painted, without the walk's; 0: a good number */
    /* x, y, z of points of the line that the walk follows, the first and the last marked; a NaN
     * between two parts them */
    const double *line;
    size_t line_count;
    const char *line_name; /* for the legend */
    /* VIEW_PLANE: thin straight lines, two points x, y, z each, and what they are; dashed or not */
    const double *segments;
    size_t segment_count;
    const char *segment_name;
    bool dashed;
    /* NULL, or per triangle: 1 if it is painted yellow; and what that means */
    const uint8_t *marks;
    const char *mark_name;
} drawing;

#endif
