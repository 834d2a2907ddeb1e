/* query.h - the steps of a query that the single and the batch query share. Private. */
#ifndef MW_SRC_QUERY_H
#define MW_SRC_QUERY_H

#include "locate/locator.h"

/* Where the finished walk found its point: ends it exactly if it was not, and applies the rule of ties. Leaves in walk->t
 * the tile where the point is (or the last one before the hull), and counts. */
mw_location mw__query_conclude(const mw_locator *locator, const mw_cursor *cursor, mw_walk *walk, mw_verdict verdict,
                               mw_counters *counters);

/* The walk of one query: first tile by the cursor's start; `last` is where the query before it ended, MW_NONE if there is
 * none: then the start is MW_START_SAMPLE. If the cursor counts, *work is where; it must last as long as the walk. */
mw_walk mw__query_begin(const mw_locator *locator, const mw_cursor *cursor, uint32_t last, mw_point q, uint64_t *random,
                        mw_work *work);

uint32_t mw__query_first_tile(const mw_locator *locator, const mw_cursor *cursor, uint32_t last, mw_point q,
                              uint64_t *random, mw_work *work);

/* The mesh has changed since the query before: begin at the tile that is now where that ended, or near it. */
void mw__cursor_follow_edits(const mw_locator *locator, mw_cursor *cursor);

/* Have the cursor of a mesh that changes know by its name the tile where the query ended. */
static MW_INLINE void mw__cursor_remember_last(const mw_locator *locator, mw_cursor *cursor)
{
    cursor->last_name = mw__tile_name(&locator->tiling, cursor->last);
}

#endif
