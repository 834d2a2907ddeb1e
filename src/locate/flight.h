/* flight.h - plain queries: many in flight. Private. */
#ifndef MW_SRC_FLIGHT_H
#define MW_SRC_FLIGHT_H

#include "base/batch.h"
#include "locate/locator.h"

/* The queries of a batch, exact and not counted, on a tiling that is neither open nor cut. */
typedef struct mw_flight {
    const mw_batch *queries;
    const mw_locator *locator;
    const mw_cursor *cursor;
    bool chained;  /* each query begins where the one before it in its lane ended, whatever the cursor's start */
    bool portable; /* only with instructions that every processor of the kind has */
} mw_flight;

/* Is that a tiling and a way to ask for such? Then the walk may be the remembering walk, whatever the cursor's. */
static MW_INLINE bool mw__flies(const mw_tiling *tiling, const mw_query_options *options)
{
    return (options->walk == MW_WALK_AUTO || options->walk == MW_WALK_REMEMBERING) && !options->counters &&
           options->arithmetic == MW_EXACT && !tiling->open && !tiling->cut;
}

/* Walks that step together. Fewer lanes do not pay. */
#define MW_FLIGHT_WIDTH 4

/* Answers the queries first .. first + count - 1 of the order, with so many walks in flight (a multiple of
 * MW_FLIGHT_WIDTH, at most MW_MAX_LANES). Chained lanes answer stretches of the order, other ones take what comes next. */
void mw__fly(const mw_flight *flight, uint32_t first, uint32_t count, uint32_t lanes);

#endif
