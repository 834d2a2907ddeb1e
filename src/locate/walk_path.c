/* walk_path.c - one query whose way is written down, triangle by triangle. */
#include "locate/location.h"
#include "locate/query.h"

/* From the start to the answer. Only the tiles of this tiling are written down, not those of an
 * index. */
static mw_location path_locate(const mw_locator *locator, mw_cursor *cursor, mw_point q, mw_walk_trace *trace)
{
    mw_work work;
    mw_walk walk = mw__query_begin(locator, cursor, cursor->last, q, &cursor->random, &work);
    work.trace = trace;
    mw__walk_record(trace, &walk);
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)cursor->walk, &locator->tiling);
    mw_verdict verdict = mw__walk_run(&walk, kernels, true, true);
    mw_location location = mw__query_conclude(locator, cursor, &walk, verdict, &cursor->counters);
    cursor->last = walk.t;
    return location;
}

size_t mw_walk_path(const mw_locator *locator, mw_cursor *cursor, double x, double y, uint32_t *triangles,
                    size_t capacity, mw_location *location)
{
    mw_location nowhere = mw__location_nowhere(MW_BAD);
    mw_location *at = location ? location : &nowhere;
    mw_walk_trace trace = {.triangle = triangles, .capacity = triangles ? capacity : 0};
    *at = nowhere;
    if (!isfinite(x) || !isfinite(y)) return 0;
    mw__cursor_default(locator, cursor);
    if (cursor->live) mw__cursor_follow_edits(locator, cursor);
    mw_cursor exact = *cursor; /* a walk that is written down counts */
    exact.count = 1;
    exact.arithmetic = MW_EXACT;
    *at = path_locate(locator, &exact, (mw_point){x, y}, &trace);
    cursor->last = exact.last;
    if (cursor->live) mw__cursor_remember_last(locator, cursor);
    cursor->random = exact.random;
    if (cursor->count) cursor->counters = exact.counters;
    return trace.count;
}
