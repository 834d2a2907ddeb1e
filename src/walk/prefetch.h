/* prefetch.h - asking memory for what will be met, before it is. Private. */
#ifndef MW_SRC_WALK_PREFETCH_H
#define MW_SRC_WALK_PREFETCH_H

#include "tiling/tiling.h"

/* The tile beyond an edge, if there is one. */
static MW_INLINE void mw__prefetch_tile(const mw_tiling *tiling, uint32_t link)
{
    if (MW_LIKELY(link != MW_NONE)) __builtin_prefetch(&tiling->tri[mw__link_triangle(link)]);
}

/* The tiles across all edges: a walk enters one of them next, and while it waits for the corners of
 * this one they all come. */
static MW_INLINE void mw__prefetch_across(const mw_triangle *tri, const mw_triangle *tile)
{
    for (uint32_t k = 0; k < 3; k++) __builtin_prefetch(&tri[mw__link_triangle(tile->link[k])]);
}

/* As a rule tiles lie in memory along a curve, in the order of their lowest vertices. So most tiles
 * near a tile in the plane, and those that come next along the curve, are near it in memory, mostly
 * after it. In a mesh larger than the caches, prefetching all of them at once is faster than
 * waiting for one after the other. */
static MW_INLINE void mw__prefetch_tiles_round(const mw_tiling *tiling, uint32_t t)
{
    enum { LINE = 64, BEFORE = 16, AFTER = 64 };
    uint32_t from = t < BEFORE ? 0 : t - BEFORE, end = t + AFTER;
    if (end > tiling->tri_count) end = tiling->tri_count;
    for (; from < end; from += LINE / sizeof *tiling->tri) __builtin_prefetch(&tiling->tri[from]);
}

static MW_INLINE void mw__prefetch_points_round(const mw_tiling *tiling, uint32_t v)
{
    enum { LINE = 64, BEFORE = 12, AFTER = 48 };
    uint32_t from = v < BEFORE ? 0 : v - BEFORE, end = v + AFTER;
    if (end > tiling->point_count) end = tiling->point_count;
    for (; from < end; from += LINE / sizeof *tiling->point)
        __builtin_prefetch(&tiling->point[from]);
}

#endif
