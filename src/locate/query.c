/* query.c - one query: first tile, walk, conclusion (conclude.c). */
#include "locate/query.h"
#include "base/options.h"

#include "base/random.h"
#include "locate/components.h"
#include "locate/conclude.h"
#include "locate/fast_path.h"
#include "locate/index.h"
#include "locate/location.h"
#include "locate/long_walks.h"
#include "start/start.h"

/* --- the walk of a query --- */

/* Tile t if it is nearer than a sample is likely to be, or else the nearest of the sample. */
static uint32_t tile_near_or_sampled(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                                     mw_point q, uint64_t *random)
{
    const mw_tiling *tiling = &locator->tiling;
    if (mw__distance2(tiling->point[tiling->tri[t].v[0]], q) <= locator->near2) return t;
    return mw__start_sample(tiling, q, cursor->sample, t, random);
}

static uint32_t start_tile(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                           mw_point q, uint64_t *random)
{
    const mw_tiling *tiling = &locator->tiling;
    if (MW_UNLIKELY(last == MW_NONE))
        return mw__start_sample(tiling, q, cursor->sample, MW_NONE, random);
    switch ((mw_start_kind)cursor->start) {
    case MW_START_RANDOM: return mw__start_random(tiling, random);
    case MW_START_SAMPLE: return mw__start_sample(tiling, q, cursor->sample, MW_NONE, random);
    case MW_START_CENTRE: return mw__tile_of_name(tiling, locator->centre);
    case MW_START_AUTO:
        if (locator->guide.start == MW_START_AUTO)
            return tile_near_or_sampled(locator, cursor, last, q, random);
        return mw__locator_guided_tile(locator, last, q);
    case MW_START_GRID: /* for these, mw__index_first */
    case MW_START_TWO_LEVEL_GRID:
    case MW_START_LAYERS:
    case MW_START_CURVE:
    case MW_START_BUCKETS:
    case MW_START_TRIANGLE_BUCKETS:
    case MW_START_KD_TREE:
    case MW_START_CHAINS:
    case MW_START_LAST:
    case MW_START_SORTED:
    case MW_START_COUNT: break;
    }
    return last;
}

uint32_t mw__query_first_tile(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                              mw_point q, uint64_t *random, mw_work *work)
{
    return cursor->index ? mw__index_first(&locator->tiling, cursor, q, random, work)
                         : start_tile(locator, cursor, last, q, random);
}

static mw_walk query_walk(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                          mw_point q, uint64_t *random, mw_work *work)
{
    const mw_tiling *tiling = &locator->tiling;
    mw_walk walk =
        mw__walk_begin(tiling, q, t, cursor->fuel, mw__random(random), cursor->count ? work : NULL);
    if (MW_UNLIKELY(tiling->border_loops)) mw__components_begin(locator, &walk);
    return walk;
}

/* The number of steps of the fast stochastic walk that make one test: as given, or the expected
 * number of tiles that the line to q crosses, at most the fuel. These steps do not use up fuel. On
 * Delaunay meshes of 10^3 to 10^6 random points, from random tiles, the tests are within 1.1 % of
 * the fewest that any multiple of the estimate makes, and hardly a tile is visited in vain. For
 * 10^5 points, where the stochastic walk visits 383.0 tiles with 494.5 tests, multiples give
 *   times    0.5    0.8    0.9    0.95   1      1.03   1.05   1.1
 *   tiles    383.4  383.4  383.4  383.5  383.7  384.7  386.4  397.8
 *   tests    444.4  413.8  403.4  398.3  393.3  391.3  391.4  400.7 */
static void walk_allow_steps(mw_walk *walk, const mw_locator *locator, uint32_t given)
{
    mw_point p = walk->point[walk->tri[walk->t].v[0]];
    double steps =
        given ? given : locator->crossings_per_length * hypot(walk->q.x - p.x, walk->q.y - p.y);
    walk->steps =
        (uint32_t)fmin(steps, mw__walk_fuel(MW_WALK_FAST_STOCHASTIC, MW_EXACT, &locator->tiling));
    walk->fuel += walk->steps; /* at most 4096 + 45 sqrt(2^30), twice */
}

/* Begin the query in tile t. *work holds zeros, or what the search for t counted. */
static mw_walk query_begin_at(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                              mw_point q, uint64_t *random, mw_work *work)
{
    mw_walk walk = query_walk(locator, cursor, t, q, random, work);
    if (MW_UNLIKELY(cursor->walk == MW_WALK_FAST_STOCHASTIC))
        walk_allow_steps(&walk, locator, cursor->steps);
    return walk;
}

mw_walk mw__query_begin(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                        mw_point q, uint64_t *random, mw_work *work)
{
    if (cursor->count) *work = (mw_work){0};
    uint32_t t = mw__query_first_tile(locator, cursor, last, q, random, work);
    if (MW_UNLIKELY(cursor->count) && t != last) {
        /* the search in chains did not count: search once more, and count */
        const mw_index *index = cursor->index                          ? cursor->index
                                : mw__query_is_guided(locator, cursor) ? &locator->guide
                                                                       : NULL;
        if (index && index->start == MW_START_CHAINS) mw__chains_count(&index->chains, q, work);
    }
    return query_begin_at(locator, cursor, t, q, random, work);
}

mw_walk mw__query_begin_at(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                           mw_point q, uint64_t *random, mw_work *work)
{
    if (cursor->count) *work = (mw_work){0};
    return query_begin_at(locator, cursor, t, q, random, work);
}

/* --- the public query --- */

/* Which start do the options mean? With an index, its own; MW_START_AUTO is decided by the
 * query. */
static mw_status query_resolve_start(const mw_query_options *options, mw_start_kind *start,
                                     mw_error *error)
{
    *start = options->start;
    if ((unsigned)*start >= MW_START_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown start");
    if (!options->index) {
        if (mw_start_has_index(*start))
            return mw__fail(error, MW_ERROR_ARGUMENT, "the start %s needs its index",
                            mw_start_name(*start));
        return MW_OK;
    }
    if (*start == MW_START_AUTO) *start = options->index->start;
    if (*start != options->index->start)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the index is of the start %s, not %s",
                        mw_start_name(options->index->start), mw_start_name(*start));
    return MW_OK;
}

/* mw_cursor.fast: which form of the fast path is tried first */
enum { FAST_NONE, FAST_PLAIN, FAST_SCALED };

/* Does the start lead near q, so that the walk is short? */
static bool start_is_near(mw_start_kind start)
{
    return start != MW_START_RANDOM && start != MW_START_SAMPLE && start != MW_START_CENTRE;
}

mw_status mw_cursor_init(const mw_locator *locator, const mw_query_options *options,
                         mw_cursor *cursor, mw_error *error)
{
    static const mw_query_options defaults;
    if (!cursor || !locator)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the cursor or the locator is NULL");
    if (!options) options = &defaults;
    if ((unsigned)options->walk >= MW_WALK_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown walk");
    mw_start_kind start;
    mw_status status = MW_RESERVED_CHECK(mw_query_options, options, error);
    if (!status) status = query_resolve_start(options, &start, error);
    if (status) return status;
    if (options->finish && options->finish != MW_WALK_REMEMBERING &&
        options->finish != MW_WALK_STOCHASTIC)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the walk 'finish' must be remembering or stochastic");
    if ((unsigned)options->arithmetic > MW_DOUBLE)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown arithmetic");
    if (!(options->tolerance >= 0) || isinf(options->tolerance))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the tolerance must be finite and at least 0");
    if (options->tolerance > 0 && !locator->has_border)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "a tolerance needs a locator with options.border");
    mw_walk_kind walk = options->walk ? options->walk : locator->auto_walk;
    if (locator->tiling.border_loops && walk != MW_WALK_BORDER)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "pockets and holes are not filled, so only the border walk works, not %s",
                        mw_walk_name(walk));
    *cursor = (mw_cursor){
        .index = options->index,
        .random = mw__random_seed(options->seed, 0),
        .tolerance = options->tolerance,
        .last = mw__tile_of_name(&locator->tiling, locator->centre),
        .sample = mw__sample_count(&locator->tiling, options->samples),
        .steps = options->steps,
        .walk = (uint8_t)walk,
        .start = (uint8_t)start,
        .finish = (uint8_t)(options->finish ? options->finish : locator->finish),
        .arithmetic = (uint8_t)options->arithmetic,
        .count = options->counters != 0,
        .fast = start_is_near(start) && mw__has_fast_path(&locator->tiling, options)
                    ? locator->scale == 1 ? FAST_PLAIN : FAST_SCALED
                    : FAST_NONE,
        .live = locator->tiling.tile_of != NULL,
        .asked = options->samples,
        .last_name = locator->centre,
        .epoch = locator->epoch,
    };
    cursor->fuel = mw__query_fuel(locator, cursor);
    return MW_OK;
}

void mw__cursor_follow_edits(const mw_locator *locator, mw_cursor *cursor)
{
    const mw_tiling *tiling = &locator->tiling;
    if (cursor->epoch == locator->epoch) return;
    bool renamed = cursor->epoch >> 32 != locator->epoch >> 32;
    cursor->last =
        renamed ? cursor->last % tiling->tri_count : mw__tile_of_name(tiling, cursor->last_name);
    cursor->fuel =
        mw__walk_fuel((mw_walk_kind)cursor->walk, (mw_arithmetic)cursor->arithmetic, tiling);
    cursor->sample = mw__sample_count(tiling, cursor->asked);
    cursor->epoch = locator->epoch;
}

void mw__cursor_default(const mw_locator *locator, mw_cursor *cursor)
{
    /* a cursor that was initialised has a walk; this one was zeroed */
    if (MW_UNLIKELY(cursor->walk == MW_WALK_AUTO)) mw_cursor_init(locator, NULL, cursor, NULL);
}

/* As mw__query_first_tile, for streams of queries: a query near the one before it needs no call. */
static MW_INLINE uint32_t fast_first_tile(const mw_locator *locator, mw_cursor *cursor, mw_point q)
{
    uint32_t last = cursor->last;
    if (!cursor->index && cursor->start == MW_START_LAST) return last;
    if (!cursor->index && cursor->start == MW_START_AUTO && locator->guide.start != MW_START_AUTO)
        return mw__locator_guided_tile(locator, last, q);
    return mw__query_first_tile(locator, cursor, last, q, &cursor->random, NULL);
}

/* Locate by the fast path. Returns false if it led to tile cursor->last, but to no answer. */
static MW_INLINE bool locate_fast_by(const mw_locator *locator, mw_cursor *cursor, mw_point q,
                                     double scale, mw_location *location)
{
    const mw_tiling *tiling = &locator->tiling;
    uint32_t t = fast_first_tile(locator, cursor, q);
    double weight[3];
    const mw_verdict verdict = mw__remembering_fast(tiling, q, scale, &t, weight);
    cursor->last = t;
    const mw_triangle *tile = &tiling->tri[t];
    if (MW_LIKELY(verdict == MW_VERDICT_FOUND && !(tile->user & MW_GHOST))) {
        mw__location_write_inside(location, tile->user, weight[0], weight[1], weight[2]);
        return true;
    }
    return mw__fast_path_outside(tiling, cursor, tile, verdict == MW_VERDICT_FOUND,
                                 verdict == MW_VERDICT_LEFT, location);
}

/* By the walk of the cursor: from tile cursor->last, where the fast path has led, else from where
 * the start says. The fast path that scales is tried here, and that of a cursor that was zero. */
static __attribute__((noinline)) mw_location locate_by_walk(const mw_locator *locator,
                                                            mw_cursor *cursor, mw_point q)
{
    mw_work work;
    mw_location location;
    const bool fresh = cursor->walk == MW_WALK_AUTO;
    mw__cursor_default(locator, cursor);
    if ((cursor->fast == FAST_SCALED || (cursor->fast && fresh)) &&
        locate_fast_by(locator, cursor, q, locator->scale, &location))
        return location;
    if (cursor->fast && mw__query_answer_here(locator, cursor, cursor->last, q, &location))
        return location;
    mw_walk walk = cursor->fast
                       ? mw__walk_begin(&locator->tiling, q, cursor->last, cursor->fuel,
                                        mw__random(&cursor->random), NULL)
                       : mw__query_begin(locator, cursor, cursor->last, q, &cursor->random, &work);
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)cursor->walk, &locator->tiling);
    mw_verdict verdict = kernels->run[cursor->arithmetic == MW_EXACT][cursor->count](&walk);
    location = mw__query_conclude(locator, cursor, &walk, verdict, &cursor->counters);
    cursor->last = walk.t;
    return location;
}

static MW_INLINE bool locate_fast(const mw_locator *locator, mw_cursor *cursor, mw_point q,
                                  mw_location *location)
{
    return MW_LIKELY(cursor->fast == FAST_PLAIN) && locate_fast_by(locator, cursor, q, 1, location);
}

static __attribute__((noinline)) mw_location locate_live(const mw_locator *locator,
                                                         mw_cursor *cursor, mw_point q)
{
    mw_location location;
    mw__cursor_follow_edits(locator, cursor);
    if (!locate_fast(locator, cursor, q, &location)) location = locate_by_walk(locator, cursor, q);
    mw__cursor_remember_last(locator, cursor);
    return location;
}

mw_location mw_locate(const mw_locator *locator, mw_cursor *cursor, double x, double y)
{
    mw_location location;
    mw_point q = {x, y};
    if (MW_UNLIKELY(!isfinite(x) || !isfinite(y)))
        mw__location_write_nowhere(&location, MW_BAD, MW_NONE);
    else if (MW_UNLIKELY(cursor->live))
        location = locate_live(locator, cursor, q);
    else if (MW_UNLIKELY(!locate_fast(locator, cursor, q, &location)))
        location = locate_by_walk(locator, cursor, q);
    return location;
}

uint32_t mw__query_tile(const mw_locator *locator, uint32_t t, mw_point q)
{
    mw_cursor cursor = {0};
    mw__cursor_default(locator, &cursor);
    mw_walk walk = mw__walk_begin(&locator->tiling, q, t, cursor.fuel, 0, NULL);
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)cursor.walk, &locator->tiling);
    mw__query_conclude(locator, &cursor, &walk, kernels->run[true][false](&walk), NULL);
    return walk.t;
}

mw_status mw_nearest_border(const mw_locator *locator, double x, double y,
                            mw_nearest_border_point *hit, mw_error *error)
{
    if (!locator || !hit || !isfinite(x) || !isfinite(y))
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the locator or the result is NULL, or the point is not finite");
    if (!locator->has_border)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the locator was made without options.border");
    if (mw__border_tree_nearest(&locator->border_tree, locator->mesh, (mw_point){x, y}, hit))
        return MW_OK;
    /* only a mesh that is not an embedding */
    return mw__fail(error, MW_ERROR_INPUT, "the mesh has no border");
}
