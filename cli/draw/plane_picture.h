/* plane_picture.h - a walk in space as a picture in a plane: over a star-shaped polyhedron in the
 * plane of longitude and polar angle [thesis App. F, Figs. 3, 4], of a probe in its cutting plane
 * [thesis App. G, Fig. 4]. */
#ifndef MW_CLI_DRAW_PLANE_PICTURE_H
#define MW_CLI_DRAW_PLANE_PICTURE_H

#include "cli/draw/drawing_content.h"

#include <stdbool.h>

/* A cell of a grid: longitudes phi and polar angles theta, in radians. */
typedef struct grid_cell {
    double phi[2], theta[2];
} grid_cell;

/* The cells of a grid of about so many, App. F, sec. 6: of squares, or, not uniform, of about equal
 * areas on the sphere. For free(); NULL without memory. */
grid_cell *grid_cells_make(uint32_t cells, bool uniform, size_t *count);
/* The direction to the middle of a cell, of length 1. */
void grid_cell_direction(const grid_cell *cell, double direction[3]);

/* A drawing in the plane, and the arrays that it is made of. */
typedef struct plane_picture {
    drawing drawing;
    double *points, *line, *segments;
    uint32_t *triangles, *path, *iteration;
    uint8_t *marks;
} plane_picture;

/* A walk over a star. Facets that lie across the seam at 180 degrees or contain a pole are left
 * out, as in the thesis; *left_out tells how many of them the walk visited. `orthogonal`: its way
 * is one leg along a parallel and one along a meridian. `cells`: NULL, or those of a grid, and
 * d->marks are its first facets. False without memory; to be released in any case. */
bool plane_picture_of_star(plane_picture *p, const drawing *d, bool orthogonal,
                           const grid_cell *cells, size_t cell_count, size_t *left_out);

/* The last walk of a probe: only triangles that its plane cuts, projected onto the plane, which
 * contains the line of the drawing and the middle of the walk's first triangle. The motion points
 * down. */
bool plane_picture_of_probe(plane_picture *p, const drawing *d);

void plane_picture_release(plane_picture *p);

#endif
