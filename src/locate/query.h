/* query.h - the steps of a query that the single and the batch query share. Private. */
#ifndef MW_SRC_LOCATE_QUERY_H
#define MW_SRC_LOCATE_QUERY_H

#include "locate/locator.h"

/* The walk of one query: first tile by the cursor's start; `last` is the tile where the query
 * before it ended; if it is MW_NONE, the start is MW_START_SAMPLE. If the cursor counts, it counts
 * in *work, which must last as long as the walk. */
mw_walk mw__query_begin(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                        mw_point q, uint64_t *random, mw_work *work);

/* The same, from tile t on. */
mw_walk mw__query_begin_at(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                           mw_point q, uint64_t *random, mw_work *work);

uint32_t mw__query_first_tile(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                              mw_point q, uint64_t *random, mw_work *work);

/* The tile that has q, or one with a hull edge that q lies beyond: by a walk from tile t, as a
 * query by default would go on from there. Not for tilings that were left open. */
uint32_t mw__query_tile(const mw_locator *locator, uint32_t t, mw_point q);

/* Give a cursor that is all zero, which was never initialised, the default options. */
void mw__cursor_default(const mw_locator *locator, mw_cursor *cursor);

/* If the mesh was edited since the cursor's last query: let it begin at the tile that is now where
 * that query ended, or near it. */
void mw__cursor_follow_edits(const mw_locator *locator, mw_cursor *cursor);

/* Before the mesh may be edited: remember by its name, which outlasts edits, the tile where the
 * query ended. */
static MW_INLINE void mw__cursor_remember_last(const mw_locator *locator, mw_cursor *cursor)
{
    cursor->last_name = mw__tile_name(&locator->tiling, cursor->last);
}

#endif
