/* box_tree.h - a packed R-tree [Leutenegger, Lopez, Edgington 1997]: a tree of boxes over things
 * that are sorted so that neighbours in the plane follow each other. Private. */
#ifndef MW_SRC_TILING_BOX_TREE_H
#define MW_SRC_TILING_BOX_TREE_H

#include "mesh/mesh.h"

typedef struct mw_box {
    double low[2], high[2];
} mw_box;

/* Box i of level 0 has the things from MW_BOX_TREE_FANOUT * i on; box i of level k + 1 has the
 * boxes of level k from MW_BOX_TREE_FANOUT * i on. The top level has one box. */
#define MW_BOX_TREE_BITS 3u
#define MW_BOX_TREE_FANOUT (1u << MW_BOX_TREE_BITS)
#define MW_BOX_TREE_LEVELS 11 /* for 2^32 things */
typedef struct mw_box_tree {
    mw_box *box;
    uint32_t count, level_count;              /* number of things, of levels */
    uint32_t first[MW_BOX_TREE_LEVELS];       /* first box of a level */
    uint32_t level_boxes[MW_BOX_TREE_LEVELS]; /* number of boxes of a level */
} mw_box_tree;

/* Make a tree over `count` things; box_of(things, i) is the box of thing i. Returns false when out
 * of memory. Release in either case. */
bool mw__box_tree_create(mw_box_tree *tree, uint32_t count,
                         mw_box (*box_of)(const void *things, uint32_t i), const void *things);
/* Where the boxes of a tree over `count` things stand, without the boxes. Returns their number. */
uint32_t mw__box_tree_lay_out(mw_box_tree *tree, uint32_t count);
void mw__box_tree_release(mw_box_tree *tree);
size_t mw__box_tree_bytes(const mw_box_tree *tree);

/* The first thing from number i on that may contain q, as its box of level 0 does; `count` if there
 * is none. */
uint32_t mw__box_tree_next(const mw_box_tree *tree, uint32_t i, mw_point q);

static MW_INLINE mw_box mw__box_empty(void)
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
