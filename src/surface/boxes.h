/* boxes.h - a packed tree of boxes over the triangles of a surface. Private. */
#ifndef MW_SRC_SURFACE_BOXES_H
#define MW_SRC_SURFACE_BOXES_H

#include "mesh/surface.h"

/* Members are boxes.c's. */
typedef struct mw_surface_boxes {
    void *box;
} mw_surface_boxes;

#endif
