/* border_loops.c - look-ups in the border loops, and their end. */
#include "tiling/border_loops.h"

#include <stdlib.h>

void mw__border_loops_release(mw_border_loops *loops)
{
    free(loops->jump);
    free(loops->loop);
    free(loops->component);
    free(loops->component_of);
    mw__box_tree_release(&loops->tree);
    *loops = (mw_border_loops){0};
}

size_t mw__border_loops_bytes(const mw_border_loops *loops, uint32_t vertex_count)
{
    size_t bytes =
        loops->jump_count * sizeof *loops->jump + loops->loop_count * sizeof *loops->loop;
    if (!loops->component_of) return bytes;
    return bytes + loops->component_count * sizeof *loops->component +
           vertex_count * sizeof *loops->component_of + mw__box_tree_bytes(&loops->tree);
}

/* Both tables are pairs of numbers, sorted by the first one. */
static int compare_first_numbers(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

uint32_t mw__border_loops_hole(const mw_border_loops *loops, uint32_t lowest)
{
    const mw_hole_loop *loop =
        bsearch(&lowest, loops->loop, loops->loop_count, sizeof *loop, compare_first_numbers);
    return loop ? loop->hole : MW_NONE;
}

uint32_t mw__border_loops_jump(const mw_border_loops *loops, uint32_t half)
{
    const mw_loop_jump *jump =
        bsearch(&half, loops->jump, loops->jump_count, sizeof *jump, compare_first_numbers);
    return jump ? jump->to : MW_NONE;
}
