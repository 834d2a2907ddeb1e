/* hints.h - queries of a batch that begin at triangles of their own. Private. */
#ifndef MW_SRC_LOCATE_HINTS_H
#define MW_SRC_LOCATE_HINTS_H

#include "locate/locator.h"

/* Has an edited tiling, or had it before an undo, a triangle of this number? */
static MW_INLINE bool hint_is_name(const mw_tiling *tiling, uint32_t hint)
{
    return hint < tiling->number_count || hint < tiling->name_count;
}

/* The tile where a walk may begin for a hint: the number of a triangle. MW_NONE if no triangle has
 * this number. If the triangle is not a tile itself, because it is flat or was cut, it is a tile
 * nearby. */
static MW_INLINE uint32_t mw__hint_tile(const mw_locator *locator, uint32_t hint)
{
    const mw_tiling *tiling = &locator->tiling;
    if (MW_UNLIKELY(tiling->tile_of))
        return hint_is_name(tiling, hint) ? mw__tile_of_name(tiling, hint) : MW_NONE;
    if (hint >= locator->mesh->tri_count) return MW_NONE;
    uint32_t slot = mw__triangle_slot(locator->mesh, hint);
    return MW_LIKELY(slot < tiling->tri_count) ? slot : slot % tiling->tri_count;
}

/* Is q so near to the tile of its hint that the guide would hardly lead nearer? Only the
 * position of one corner is looked at: more would have to be waited for. */
static MW_INLINE bool mw__hint_is_near(const mw_locator *locator, uint32_t t, mw_point q)
{
    const mw_tiling *tiling = &locator->tiling;
    return mw__distance2(tiling->point[tiling->tri[t].v[0]], q) <= 2 * locator->cell2;
}

/* The tile where one query begins. MW_NONE if its hint names no tile. Also MW_NONE if the start was
 * left to choose and the query is far from its hint: the locator's guide then leads nearer. */
static MW_INLINE uint32_t mw__hint_first(const mw_locator *locator, const mw_cursor *cursor,
                                         uint32_t hint, mw_point q)
{
    uint32_t t = mw__hint_tile(locator, hint);
    bool stays =
        t == MW_NONE || cursor->index != &locator->guide || mw__hint_is_near(locator, t, q);
    return stays ? t : MW_NONE;
}

/* Queries that begin together, at most MW_INDEX_MANY. */
typedef struct mw_hinted {
    const mw_locator *locator;
    const mw_cursor *cursor;
    const uint32_t *hints; /* of the whole batch                                    */
    const uint32_t *query; /* the numbers of these queries in it                    */
    const mw_point *q;     /* their points                                          */
    uint32_t n;            /* how many there are                                    */
    const uint32_t *later; /* the hints of the queries after them, whose tiles are prefetched */
    uint32_t later_count;
} mw_hinted;

/* Find mw__hint_first for each of them. All wait for memory at the same time. */
void mw__hints_first_many(const mw_hinted *hinted, uint32_t *t);

/* Make the triangle of each location the query's next hint. A query that found no triangle keeps
 * its hint. */
void mw__hints_update(const mw_location *locations, uint32_t n, uint32_t *hints);

#endif
