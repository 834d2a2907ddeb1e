/* box_tree.c - a packed tree of boxes (an R-tree). */
#include "tiling/box_tree.h"

#include <stdlib.h>

static void box_tree_build_level(mw_box_tree *b, uint32_t level,
                                 mw_box (*box_of)(const void *things, uint32_t i),
                                 const void *things)
{
    uint32_t below = level ? b->level_boxes[level - 1] : b->count;
    for (uint32_t i = 0; i < b->level_boxes[level]; i++) {
        mw_box box = mw__box_empty();
        for (uint32_t j = i * MW_BOX_TREE_FANOUT; j < below && j < (i + 1) * MW_BOX_TREE_FANOUT;
             j++)
            mw__box_join(&box, level ? b->box[b->first[level - 1] + j] : box_of(things, j));
        b->box[b->first[level] + i] = box;
    }
}

uint32_t mw__box_tree_lay_out(mw_box_tree *tree, uint32_t count)
{
    *tree = (mw_box_tree){.count = count};
    uint32_t sum = 0, below = count;
    do {
        uint32_t here = (below + MW_BOX_TREE_FANOUT - 1) / MW_BOX_TREE_FANOUT;
        tree->first[tree->level_count] = sum;
        tree->level_boxes[tree->level_count++] = here;
        sum += here;
        below = here;
    } while (below > 1);
    return sum;
}

bool mw__box_tree_create(mw_box_tree *tree, uint32_t count,
                         mw_box (*box_of)(const void *things, uint32_t i), const void *things)
{
    const uint32_t boxes = mw__box_tree_lay_out(tree, count);
    tree->box = mw__alloc(boxes, sizeof *tree->box);
    if (!tree->box) return false;
    for (uint32_t level = 0; level < tree->level_count; level++)
        box_tree_build_level(tree, level, box_of, things);
    return true;
}

void mw__box_tree_release(mw_box_tree *tree)
{
    free(tree->box);
    *tree = (mw_box_tree){0};
}

size_t mw__box_tree_bytes(const mw_box_tree *tree)
{
    size_t sum = 0;
    for (uint32_t level = 0; level < tree->level_count; level++) sum += tree->level_boxes[level];
    return sum * sizeof *tree->box;
}

/* The number of levels, from level 0 on, in which thing i is the first of a box. */
static uint32_t box_tree_levels_begun(const mw_box_tree *b, uint32_t i)
{
    uint32_t level = 0;
    while (level < b->level_count && i % MW_BOX_TREE_FANOUT == 0) {
        i /= MW_BOX_TREE_FANOUT;
        level++;
    }
    return level;
}

uint32_t mw__box_tree_next(const mw_box_tree *tree, uint32_t i, mw_point q)
{
    for (uint64_t at = i; at < tree->count;) {
        uint64_t passed = 0;
        for (uint32_t level = box_tree_levels_begun(tree, (uint32_t)at); level-- > 0 && !passed;) {
            uint32_t shift = MW_BOX_TREE_BITS * (level + 1);
            if (!mw__box_contains(&tree->box[tree->first[level] + (at >> shift)], q))
                passed = UINT64_C(1) << shift;
        }
        if (!passed) return (uint32_t)at;
        at += passed;
    }
    return tree->count;
}
