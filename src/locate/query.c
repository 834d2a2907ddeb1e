/* query.c - one query: first tile, walk, exact conclusion. */
#include "base/random.h"
#include "locate/locator.h"
#include "start/start.h"

/* --- the conclusion ---------------------------------------------------------------------------------------------- */

/* The tile t contains q. Which side of its edges q is on is known from the walk, but not kept: three tests, which the
 * filter decides and whose points are in cache, say whether it is on one. Returns the user's triangle, or MW_NONE with
 * *ghost set to the ghost's mark where only ghosts contain q. */
static uint32_t owner(const mw_tiling *tiling, uint32_t t, mw_point q, uint32_t *ghost)
{
    const mw_triangle *tile = &tiling->tri[t];
    const mw_point *point = tiling->point;
    uint32_t zeros = 0, on = 0, off = 0;
    for (uint32_t k = 0; k < 3; k++)
        if (mw__orient2d(point[tile->v[k]], point[tile->v[k + 1]], q) == 0) {
            zeros++;
            on = k;
        } else {
            off = k;
        }
    if (MW_UNLIKELY(zeros == 2)) return tiling->owner[tile->v[mw__prev(off)]]; /* off both edges at the apex */
    *ghost = tile->user;
    uint32_t best = tile->user & MW_GHOST ? MW_NONE : tile->user & MW_USER_MASK;
    if (MW_UNLIKELY(zeros == 1) && tile->link[on] != MW_NONE) {
        uint32_t other = tiling->tri[mw__link_triangle(tile->link[on])].user;
        if (!(other & MW_GHOST) && (other & MW_USER_MASK) < best) best = other & MW_USER_MASK;
    }
    return zeros == 3 ? MW_NONE : best; /* 3: a flat triangle of a mesh that is no embedding */
}

/* q lies in no triangle: in a hole or outside; near, if a tolerance says so. */
static mw_location outside(const mw_locator *locator, uint32_t ghost, mw_point q, double tolerance)
{
    mw_location location = mw__nowhere(MW_OUTSIDE);
    if ((ghost & MW_GHOST) && (ghost & MW_USER_MASK) != MW_POCKET) {
        location.where = MW_IN_HOLE;
        location.hole = ghost & MW_USER_MASK;
    }
    if (tolerance > 0) mw__border_near(&locator->border, locator->mesh, q, tolerance, &location);
    return location;
}

mw_location mw__conclude(const mw_locator *locator, const mw_cursor *cursor, mw_walk *walk, mw_verdict verdict,
                         mw_counters *counters)
{
    const mw_tiling *tiling = &locator->tiling;
    mw_walk end = *walk;
    bool handover = verdict == MW_DRY;
    if (cursor->arithmetic != MW_EXACT || verdict == MW_DRY) {
        end = mw__walk_begin(tiling, walk->q, walk->t, mw__walk_fuel(MW_WALK_CELESTIAL, MW_EXACT, tiling), 0);
        verdict = mw__celestial.run[true][cursor->count](&end);
        if (end.t != walk->t) { /* a walk in doubles that was right costs no step more */
            handover = true;
            walk->visited += end.visited - 1;
            walk->tests += end.tests;
        }
        walk->t = end.t;
    }
    if (cursor->count) {
        counters->queries++;
        counters->triangles_init += walk->visited_init;
        counters->triangles += walk->visited - walk->visited_init;
        if (walk->visited > counters->triangles_max) counters->triangles_max = walk->visited;
        counters->tests_init += walk->tests_init;
        counters->tests += walk->tests - walk->tests_init;
        counters->handovers += handover;
    }
    uint32_t ghost = 0;
    uint32_t triangle = verdict == MW_FOUND ? owner(tiling, walk->t, walk->q, &ghost) : MW_NONE;
    if (triangle == MW_NONE) return outside(locator, ghost, walk->q, cursor->tolerance);
    return mw__place(locator->mesh, triangle, walk->q);
}

/* --- the departure ----------------------------------------------------------------------------------------------- */

static uint32_t first_tile(const mw_locator *locator, const mw_cursor *cursor, mw_point q, uint64_t *random)
{
    const mw_tiling *tiling = &locator->tiling;
    switch ((mw_start_kind)cursor->start) {
    case MW_START_RANDOM: return mw__start_random(tiling, random);
    case MW_START_SAMPLE: return mw__start_sample(tiling, q, cursor->sample, MW_NONE, random);
    case MW_START_CENTRE: return locator->centre;
    case MW_START_AUTO:
        if (mw__distance2(tiling->point[tiling->tri[cursor->last].v[0]], q) > locator->near2)
            return mw__start_sample(tiling, q, cursor->sample, cursor->last, random);
        return cursor->last;
    default: return cursor->last; /* MW_START_LAST, MW_START_SORTED */
    }
}

mw_walk mw__depart(const mw_locator *locator, const mw_cursor *cursor, mw_point q, uint64_t *random)
{
    uint32_t t = first_tile(locator, cursor, q, random);
    return mw__walk_begin(&locator->tiling, q, t, cursor->fuel, mw__random(random));
}

/* --- the public query -------------------------------------------------------------------------------------------- */

mw_status mw_cursor_init(mw_cursor *cursor, const mw_locator *locator, const mw_query_options *options, mw_error *error)
{
    static const mw_query_options defaults;
    if (!cursor || !locator) return mw__fail(error, MW_ERROR_ARGUMENT, "a cursor needs a locator");
    if (!options) options = &defaults;
    if ((unsigned)options->walk >= MW_WALK_COUNT) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown walk");
    if ((unsigned)options->start >= MW_START_COUNT) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown start");
    if ((unsigned)options->arithmetic > MW_DOUBLE) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown arithmetic");
    if (!(options->tolerance >= 0) || isinf(options->tolerance))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the tolerance is not a length");
    if (options->tolerance > 0 && !locator->has_border)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a tolerance needs a locator with options.border");
    mw_walk_kind walk = options->walk ? options->walk : MW_WALK_REMEMBERING;
    *cursor = (mw_cursor){
        .random = mw__random_seed(options->seed, 0),
        .tolerance = options->tolerance,
        .last = locator->centre,
        .sample = options->sample ? options->sample : mw__sample_count(&locator->tiling),
        .fuel = mw__walk_fuel(walk, options->arithmetic, &locator->tiling),
        .walk = (uint8_t)walk,
        .start = (uint8_t)options->start,
        .arithmetic = (uint8_t)options->arithmetic,
        .count = options->count != 0,
    };
    return MW_OK;
}

mw_location mw_locate(const mw_locator *locator, mw_cursor *cursor, double x, double y)
{
    if (MW_UNLIKELY(!isfinite(x) || !isfinite(y))) return mw__nowhere(MW_BAD);
    mw_walk walk = mw__depart(locator, cursor, (mw_point){x, y}, &cursor->random);
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)cursor->walk);
    mw_verdict verdict = kernels->run[cursor->arithmetic == MW_EXACT][cursor->count](&walk);
    mw_location location = mw__conclude(locator, cursor, &walk, verdict, &cursor->counters);
    cursor->last = walk.t;
    return location;
}
