/* boxes.h - a packed tree of boxes [Leutenegger, Lopez, Edgington 1997]: over things that are laid out in an order in which
 * those near each other in the plane follow each other. Private. */
#ifndef MW_SRC_BOXES_H
#define MW_SRC_BOXES_H

#include "mesh/mesh.h"

typedef struct mw_box {
    double low[2], high[2];
} mw_box;

/* Box 0 of level 0 holds the first MW_BOXES_FAN things, and so on; box i of level k + 1 holds boxes MW_BOXES_FAN * i ... of
 * level k. The top level has one box. */
#define MW_BOXES_BITS 3u
#define MW_BOXES_FAN (1u << MW_BOXES_BITS)
#define MW_BOXES_LEVELS 11 /* for 2^32 things */
typedef struct mw_boxes {
    mw_box *box;
    uint32_t count, level_count;           /* of things; of levels */
    uint32_t first[MW_BOXES_LEVELS];       /* box of a level       */
    uint32_t level_boxes[MW_BOXES_LEVELS]; /* of a level           */
} mw_boxes;

/* Over `count` things, box_of(things, i) being that of thing i. Returns false when out of memory. Release in either
 * case. */
bool mw__boxes_create(mw_boxes *boxes, uint32_t count, mw_box (*box_of)(const void *things, uint32_t i),
                      const void *things);
void mw__boxes_release(mw_boxes *boxes);
size_t mw__boxes_bytes(const mw_boxes *boxes);

/* The first thing from number i on that may contain q: a box of level 0 does. `count` if there is none. */
uint32_t mw__boxes_next(const mw_boxes *boxes, uint32_t i, mw_point q);

static MW_INLINE mw_box mw__box_of_nothing(void)
{
    return (mw_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
}

static MW_INLINE void mw__box_join(mw_box *box, mw_box other)
{
    for (int k = 0; k < 2; k++) {
        box->low[k] = fmin(box->low[k], other.low[k]);
        box->high[k] = fmax(box->high[k], other.high[k]);
    }
}

static MW_INLINE bool mw__box_contains(const mw_box *box, mw_point q)
{
    return q.x >= box->low[0] && q.x <= box->high[0] && q.y >= box->low[1] && q.y <= box->high[1];
}

#endif
