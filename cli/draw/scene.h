/* scene.h - what a picture of a walk shows: the part of the page, and the triangles to be painted
 * from back to front. */
#ifndef MW_CLI_DRAW_SCENE_H
#define MW_CLI_DRAW_SCENE_H

#include "cli/draw/projection.h"

#define SCENE_CELLS 256 /* a side of the grid that tells what is near the walk */

/* A part of the page, in the units of the projection. */
typedef struct page_box {
    double low[2], high[2];
} page_box;

/* A triangle to be painted, in order of its key. */
typedef struct painted_triangle {
    double key;
    uint32_t triangle;
    bool back;
} painted_triangle;

typedef struct scene {
    const drawing *d;
    projection projection;
    page_point *at;  /* per vertex */
    uint32_t *visit; /* per triangle: when it was visited first; UINT32_MAX: not */
    double *part;    /* per visit: how far its walk is, from 0 to 1 */
    painted_triangle *painted;
    size_t count;
    size_t seen; /* visits that are shown: the first ones; all, unless set to another number */
    const char *caption;
    /* per cell of what is shown, row by row from below: triangles there are left out; NULL:
     * none are */
    bool *veil;
    page_box all, shown;
} scene;

/* False: out of memory. To be released in any case. */
bool scene_make(scene *s, const drawing *d);
void scene_release(scene *s);

bool page_point_is_finite(const page_point *at);
double page_box_side(const page_box *b); /* the longer one */

/* Corners of a triangle: one of three; all of them finite; the box of those that are. */
const page_point *scene_corner(const scene *s, uint32_t triangle, size_t k);
bool scene_is_finite(const scene *s, uint32_t triangle);
page_box scene_box(const scene *s, uint32_t triangle);

#endif
