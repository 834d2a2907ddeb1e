/* projection.h - an orthographic projection of a mesh onto the page, seen from where the walk
 * shows best. */
#ifndef MW_CLI_DRAW_PROJECTION_H
#define MW_CLI_DRAW_PROJECTION_H

#include "cli/draw/drawing_content.h"

#include <stdbool.h>

typedef struct projection {
    const drawing *d;
    double middle[3], size; /* of the mesh, which becomes a cube from -1 to 1 */
    double axis[3][3];      /* of the page: right, up, towards the eye */
} projection;

/* A point on the page: to the right, up, and towards the eye. */
typedef struct page_point {
    double x, y, z;
} page_point;

projection projection_make(const drawing *d);

/* Where a point is on the page; perhaps not finite. */
page_point projection_at(const projection *p, const double *point);

/* Does a triangle turn its back to the eye? */
bool projection_turns_back(const projection *p, uint32_t triangle);

/* Is a point of a star's line on the side of the eye? */
bool projection_shows(const projection *p, const double *point);

#endif
