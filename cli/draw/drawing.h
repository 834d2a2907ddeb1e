/* drawing.h - a picture of a walk: its triangles, the first and the last of them marked, and the mesh near it. */
#ifndef CLI_DRAWING_H
#define CLI_DRAWING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How a mesh is looked at. */
typedef enum drawing_view {
    VIEW_PLANE,   /* from above; z does not matter                                                            */
    VIEW_SURFACE, /* on the fronts of the triangles visited                                                   */
    VIEW_STAR     /* on the middle of the walk, towards the centre; the fronts are those that face away from it */
} drawing_view;

typedef struct drawing {
    drawing_view view;
    double centre[3]; /* VIEW_STAR */
    const char *caption;
    const double *points;      /* x, y, z of each vertex */
    const uint32_t *triangles; /* three vertices each    */
    size_t point_count, triangle_count;
    const uint32_t *path, *iteration; /* the triangles visited, in order, and the number of the walk that each is of */
    size_t path_count;
    const double *line; /* x, y, z of points of the line that the walk is to follow, the first and the last marked */
    size_t line_count;
} drawing;

/* Returns 0 or an exit code, after a complaint. */
int drawing_write(const drawing *d, const char *path);

#endif
