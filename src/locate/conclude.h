/* conclude.h - how a walk that has ended becomes an answer. Private. */
#ifndef MW_SRC_LOCATE_CONCLUDE_H
#define MW_SRC_LOCATE_CONCLUDE_H

#include "locate/locator.h"

/* Turn the end of a walk into the answer: decide by exact tests where its point is, and apply the
 * rule of ties (conclude.c). A walk that got long goes on, or is ended by chains (long_walks.c).
 * Leaves in walk->t the tile where the point is, or the last one before the hull. Counts if the
 * walk does. */
mw_location mw__query_conclude(const mw_locator *locator, const mw_cursor *cursor, mw_walk *walk,
                               mw_verdict verdict, mw_counters *counters);

/* The answer if tile t contains q, without a walk; else false. For cursors of the fast path. */
bool mw__query_answer_here(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                           mw_point q, mw_location *location);

#endif
