/* interleaved.h - a batch on the fast path: many walks, four to a vector, in turn. Private. */
#ifndef MW_SRC_LOCATE_INTERLEAVED_H
#define MW_SRC_LOCATE_INTERLEAVED_H

#include "batch/batch.h"
#include "locate/locator.h"

/* The queries of a batch that may take the fast path (mw__has_fast_path). */
typedef struct mw_interleaved {
    const mw_batch *queries;
    const mw_locator *locator;
    const mw_cursor *cursor;
    /* each query begins where the one before it in its lane ended, whatever the cursor's start */
    bool chained;
    bool portable; /* use only instructions that every x86-64 processor has */
} mw_interleaved;

/* Lanes of a group, which step together. Fewer do not pay. */
#define MW_GROUP_LANES 4

/* Answers the queries first .. first + count - 1 of the order in so many lanes (a multiple of
 * MW_GROUP_LANES, at most MW_MAX_LANES). Each chained lane answers a range of the order of its own;
 * other lanes take the query that comes next. */
void mw__locate_interleaved(const mw_interleaved *of, uint32_t first, uint32_t count,
                            uint32_t lanes);

#endif
