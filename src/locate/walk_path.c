/* walk_path.c - one query whose way is written down, triangle by triangle. */
#include "locate/conclude.h"
#include "locate/location.h"
#include "locate/query.h"

_Static_assert((int)MW_WALK_STAGE_INIT == MW_STAGE_INIT &&
                   (int)MW_WALK_STAGE_WALK == MW_STAGE_WALK &&
                   (int)MW_WALK_STAGE_FINAL == MW_STAGE_FINAL &&
                   (int)MW_WALK_STAGE_BORDER == MW_STAGE_BORDER,
               "stages have the same numbers inside");

/* --- the line --- */

static void way_add_point(mw_walk_way *way, double x, double y)
{
    way->line[way->line_points][0] = x;
    way->line[way->line_points++][1] = y;
}

/* Along the x axis from there, then along the y axis. */
static void way_add_legs(mw_walk_way *way, mw_point from, mw_point q)
{
    way_add_point(way, from.x, from.y);
    way_add_point(way, q.x, from.y);
}

/* The middle of a tile, as the improved orthogonal walks take it. */
static mw_point way_middle(const mw_tiling *tiling, const uint32_t *v)
{
    const mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    return (mw_point){a.x / 3 + b.x / 3 + c.x / 3, a.y / 3 + b.y / 3 + c.y / 3};
}

/* Where the line of a walk begins that began in tile `first` and has ended. */
static void way_set_line(mw_walk_way *way, mw_walk_kind kind, const mw_walk *walk, uint32_t first,
                         size_t count)
{
    const uint32_t *v = walk->tri[first].v;
    const mw_point corner = walk->point[v[0]], q = walk->q;
    switch (kind) {
    case MW_WALK_STRAIGHT:
    case MW_WALK_HYBRID:
    case MW_WALK_NORMAL_STRAIGHT_TURN: way_add_point(way, corner.x, corner.y); break;
    case MW_WALK_NORMAL_STRAIGHT: way_add_point(way, q.x - walk->d.x, q.y - walk->d.y); break;
    case MW_WALK_ORTHOGONAL: way_add_legs(way, corner, q); break;
    case MW_WALK_IMPROVED_ORTHOGONAL:
    case MW_WALK_IMPROVED_ORTHOGONAL_VERTEX:
        way_add_legs(way, way_middle(walk->tiling, v), q);
        break;
    case MW_WALK_BORDER:
        if (count > 1) way_add_point(way, walk->p.x, walk->p.y);
        break;
    default: break;
    }
    if (way->line_points > 0) way_add_point(way, q.x, q.y);
}

/* --- the way --- */

/* From the start to the answer. Only the tiles of this tiling are written down, not those of an
 * index. */
static mw_location path_locate(const mw_locator *locator, mw_cursor *cursor, mw_point q,
                               mw_walk_trace *trace, mw_walk_way *way)
{
    mw_work work;
    mw_walk walk = mw__query_begin(locator, cursor, cursor->last, q, &cursor->random, &work);
    work.trace = trace;
    mw__walk_record(trace, &walk);
    uint32_t first = walk.t;
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)cursor->walk, &locator->tiling);
    mw_verdict verdict = mw__walk_run(&walk, kernels, true, true);
    mw_location location = mw__query_conclude(locator, cursor, &walk, verdict, &cursor->counters);
    cursor->last = walk.t;
    if (trace->stage && trace->capacity > 0 && work.triangles[MW_STAGE_INIT] > 0)
        trace->stage[0] = MW_STAGE_INIT;
    way_set_line(way, (mw_walk_kind)cursor->walk, &walk, first, trace->count);
    return location;
}

size_t mw_walk_follow(const mw_locator *locator, mw_cursor *cursor, double x, double y,
                      mw_walk_way *way, mw_location *location)
{
    mw_location nowhere = mw__location_nowhere(MW_BAD);
    mw_location *at = location ? location : &nowhere;
    mw_walk_trace trace = {.triangle = way->triangles,
                           .stage = way->stages,
                           .capacity = way->triangles ? way->capacity : 0};
    *at = nowhere;
    way->line_points = 0;
    if (!isfinite(x) || !isfinite(y)) return 0;
    mw__cursor_default(locator, cursor);
    if (cursor->live) mw__cursor_follow_edits(locator, cursor);
    mw_cursor exact = *cursor; /* a walk that is written down counts */
    exact.count = 1;
    exact.arithmetic = MW_EXACT;
    *at = path_locate(locator, &exact, (mw_point){x, y}, &trace, way);
    cursor->last = exact.last;
    if (cursor->live) mw__cursor_remember_last(locator, cursor);
    cursor->random = exact.random;
    if (cursor->count) cursor->counters = exact.counters;
    return trace.count;
}

size_t mw_walk_path(const mw_locator *locator, mw_cursor *cursor, double x, double y,
                    uint32_t *triangles, size_t capacity, mw_location *location)
{
    mw_walk_way way = {.triangles = triangles, .capacity = capacity};
    return mw_walk_follow(locator, cursor, x, y, &way, location);
}
