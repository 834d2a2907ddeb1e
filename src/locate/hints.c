/* hints.c - queries of a batch that begin at triangles of their own.
 *
 * A particle that moves a little is in the triangle where it was, or beside it. What its walk then
 * costs is memory: the slot of the triangle, the tile, its corners. So many queries ask for each of
 * these together. */
#include "locate/hints.h"

/* Where the slot of a triangle stands, if anywhere. */
static MW_INLINE void hint_prefetch_slot(const mw_locator *locator, uint32_t hint)
{
    const uint32_t *slot = locator->tiling.tile_of ? locator->tiling.tile_of : locator->mesh->triangle_slot;
    const uint32_t count = locator->tiling.tile_of ? locator->tiling.number_count : locator->mesh->tri_count;
    if (slot && hint < count) __builtin_prefetch(&slot[hint]);
}

static MW_INLINE void hint_prefetch_corners(const mw_tiling *tiling, uint32_t t)
{
    for (int k = 0; k < 3; k++) __builtin_prefetch(&tiling->point[tiling->tri[t].v[k]]);
}

void mw__hints_first_many(const mw_locator *locator, const mw_cursor *cursor, const uint32_t *hints,
                          const uint32_t *query, const mw_point *q, uint32_t n, uint32_t *t)
{
    const mw_tiling *tiling = &locator->tiling;
    for (uint32_t i = 0; i < n; i++) hint_prefetch_slot(locator, hints[query[i]]);
    for (uint32_t i = 0; i < n; i++) {
        t[i] = mw__hint_tile(locator, hints[query[i]]);
        if (t[i] != MW_NONE) __builtin_prefetch(&tiling->tri[t[i]]);
    }
    for (uint32_t i = 0; i < n; i++)
        if (t[i] != MW_NONE) hint_prefetch_corners(tiling, t[i]);
    if (cursor->index != &locator->guide) return;
    for (uint32_t i = 0; i < n; i++)
        if (t[i] != MW_NONE && !mw__hint_is_near(locator, t[i], q[i])) t[i] = MW_NONE;
}

void mw__hints_update(const mw_location *locations, uint32_t n, uint32_t *hints)
{
    for (uint32_t i = 0; i < n; i++)
        if (locations[i].triangle != MW_NONE) hints[i] = locations[i].triangle;
}
