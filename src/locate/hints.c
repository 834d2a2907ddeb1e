/* hints.c - queries of a batch that begin at triangles of their own.
 *
 * A particle that moves a little is in the triangle where it was, or beside it. Its walk then
 * mostly waits for memory: for the slot of the triangle, the tile, its corners. So each of these is
 * prefetched for many queries at once, and while they walk, the tiles of the next queries are
 * prefetched. */
#include "locate/hints.h"

enum { AHEAD = 8 }; /* so many hints ahead, slots are prefetched */

/* Prefetch the place where the slot of a triangle is stored, if it is stored. */
static MW_INLINE void hint_prefetch_slot(const mw_locator *locator, uint32_t hint)
{
    const uint32_t *slot =
        locator->tiling.tile_of ? locator->tiling.tile_of : locator->mesh->triangle_slot;
    const uint32_t count =
        locator->tiling.tile_of ? locator->tiling.number_count : locator->mesh->tri_count;
    if (slot && hint < count) __builtin_prefetch(&slot[hint]);
}

/* Prefetch the tiles of the hints that come next. */
static void hints_ask(const mw_hinted *h)
{
    for (uint32_t i = 0; i < h->later_count; i++) {
        uint32_t t = mw__hint_tile(h->locator, h->later[i]);
        if (t != MW_NONE) __builtin_prefetch(&h->locator->tiling.tri[t]);
        if (i + AHEAD < h->later_count) hint_prefetch_slot(h->locator, h->later[i + AHEAD]);
    }
}

void mw__hints_first_many(const mw_hinted *h, uint32_t *t)
{
    const mw_tiling *tiling = &h->locator->tiling;
    const bool guided = h->cursor->index == &h->locator->guide;
    for (uint32_t i = 0; i < h->n; i++) t[i] = mw__hint_tile(h->locator, h->hints[h->query[i]]);
    for (uint32_t i = 0; i < h->n && guided; i++)
        if (t[i] != MW_NONE) __builtin_prefetch(&tiling->point[tiling->tri[t[i]].v[0]]);
    hints_ask(h); /* takes about as long as the points above take to arrive */
    for (uint32_t i = 0; i < h->n && guided; i++)
        if (t[i] != MW_NONE && !mw__hint_is_near(h->locator, t[i], h->q[i])) t[i] = MW_NONE;
}

void mw__hints_update(const mw_location *locations, uint32_t n, uint32_t *hints)
{
    for (uint32_t i = 0; i < n; i++)
        if (locations[i].triangle != MW_NONE) hints[i] = locations[i].triangle;
}
