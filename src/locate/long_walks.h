/* long_walks.h - walks that get long. Private. */
#ifndef MW_SRC_LOCATE_LONG_WALKS_H
#define MW_SRC_LOCATE_LONG_WALKS_H

#include "locate/locator.h"

#define MW_SHORT_WALK 64u /* steps after which a walk from a guide is long */

/* Was the start left to choose? A batch that was left to choose may have chosen to go from query to
 * query: that counts, too. */
bool mw__query_is_guided(const mw_locator *locator, const mw_cursor *cursor);

/* The steps that the walks of a cursor may take, at first. */
uint32_t mw__query_fuel(const mw_locator *locator, const mw_cursor *cursor);

/* Go on with a walk of this kind that has used up the cursor's fuel: by chains that know the tile
 * of its point, if the locator has such; else as if it had not been stopped, and the locator adds
 * up what it visits. A walk that is traced always goes from triangle to triangle. */
mw_verdict mw__long_walk_end(const mw_locator *locator, const mw_cursor *cursor, mw_walk_kind kind,
                             mw_walk *walk);

#endif
