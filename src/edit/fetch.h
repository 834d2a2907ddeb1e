/* fetch.h - asking memory for what will be met, before it is. Private. */
#ifndef MW_SRC_FETCH_H
#define MW_SRC_FETCH_H

#include "domain/tiling.h"

/* The tile beyond an edge, if there is one. */
static MW_INLINE void mw__fetch_tile(const mw_tiling *tiling, uint32_t link)
{
    if (MW_LIKELY(link != MW_NONE)) __builtin_prefetch(&tiling->tri[mw__link_triangle(link)]);
}

/* Tiles lie along a curve as a rule, numbered by their lowest vertices, so that most of what lies round about a tile, or comes next along the curve, lies
 * near it in memory, rather behind it than before. To ask for all of that at once beats waiting for one after the other, in a mesh that caches do not
 * hold. */
enum { MW_LINE = 64, MW_TILES_BEFORE = 16, MW_TILES_AFTER = 64, MW_POINTS_BEFORE = 12, MW_POINTS_AFTER = 48 };

static MW_INLINE void mw__fetch_tiles_round(const mw_tiling *tiling, uint32_t t)
{
    uint32_t from = t < MW_TILES_BEFORE ? 0 : t - MW_TILES_BEFORE, end = t + MW_TILES_AFTER;
    if (end > tiling->tri_count) end = tiling->tri_count;
    for (; from < end; from += MW_LINE / sizeof *tiling->tri) __builtin_prefetch(&tiling->tri[from]);
}

static MW_INLINE void mw__fetch_points_round(const mw_tiling *tiling, uint32_t v)
{
    uint32_t from = v < MW_POINTS_BEFORE ? 0 : v - MW_POINTS_BEFORE, end = v + MW_POINTS_AFTER;
    if (end > tiling->point_count) end = tiling->point_count;
    for (; from < end; from += MW_LINE / sizeof *tiling->point) __builtin_prefetch(&tiling->point[from]);
}

#endif
