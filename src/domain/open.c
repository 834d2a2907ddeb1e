/* open.c - what an open tiling is asked for. */
#include "domain/open.h"

#include <stdlib.h>

void mw__open_release(mw_open *open)
{
    free(open->turn);
    free(open->loop);
    free(open->piece);
    free(open->piece_of);
    mw__boxes_release(&open->boxes);
    *open = (mw_open){0};
}

size_t mw__open_bytes(const mw_open *open, uint32_t vertex_count)
{
    size_t bytes = open->turn_count * sizeof *open->turn + open->loop_count * sizeof *open->loop;
    if (!open->piece_of) return bytes;
    return bytes + open->piece_count * sizeof *open->piece + vertex_count * sizeof *open->piece_of +
           mw__boxes_bytes(&open->boxes);
}

/* Both tables have pairs of numbers, in order of the first ones. */
static int compare_firsts(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

uint32_t mw__open_hole(const mw_open *open, uint32_t lowest)
{
    const mw_hole_loop *loop = bsearch(&lowest, open->loop, open->loop_count, sizeof *loop, compare_firsts);
    return loop ? loop->hole : MW_NONE;
}

uint32_t mw__open_turn(const mw_open *open, uint32_t half)
{
    const mw_turn *turn = bsearch(&half, open->turn, open->turn_count, sizeof *turn, compare_firsts);
    return turn ? turn->to : MW_NONE;
}
