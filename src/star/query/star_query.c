/* star_query.c - cursors and single queries. */
#include "base/random.h"
#include "base/options.h"
#include "star/star_index.h"
#include "star/query/star_locate.h"

/* What a borrowed star can do. */
static mw_status star_check_borrowed(const mw_star *star, const mw_star_query_options *options,
                                     mw_error *error)
{
    if (!star->borrowed) return MW_OK;
    if (options->walk != MW_STAR_WALK_AUTO && options->walk != MW_STAR_WALK_STOCHASTIC)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the walk on a borrowed star is stochastic, not %s",
                        mw_star_walk_name(options->walk));
    if (options->index || mw_star_start_has_index(options->start) ||
        options->start == MW_STAR_START_FRONT)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the starts on a borrowed star are sample, last, sorted and random");
    return MW_OK;
}

mw_status mw_star_cursor_init(const mw_star *star, const mw_star_query_options *options,
                              mw_star_cursor *cursor, mw_error *error)
{
    static const mw_star_query_options defaults;
    if (!cursor || !star)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the cursor or the star is NULL");
    if (!options) options = &defaults;
    mw_star_start_kind start = options->start;
    if ((unsigned)options->walk >= MW_STAR_WALK_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown walk");
    if ((unsigned)start >= MW_STAR_START_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown start");
    mw_status status = star_check_borrowed(star, options, error);
    if (status) return status;
    if (options->finish && options->finish != MW_STAR_WALK_STOCHASTIC &&
        options->finish != MW_STAR_WALK_FORGETFUL)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the walk 'finish' must be stochastic or forgetful");
    if (options->walk == MW_STAR_WALK_ORTHOGONAL && !star->angles)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the orthogonal walk needs a star with angles");
    if (start == MW_STAR_START_AUTO && options->index) start = mw__star_index_start(options->index);
    if (mw_star_start_has_index(start) && !options->index)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the start %s needs its index",
                        mw_star_start_name(start));
    if (options->index && mw__star_index_start(options->index) != start)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the index is of another start");
    status = MW_RESERVED_CHECK(mw_star_query_options, options, error);
    if (status) return status;
    *cursor = (mw_star_cursor){
        .index = options->index,
        .random = mw__random_seed(options->seed, 0),
        .last = MW_NONE,
        .sample = options->samples,
        .walk = (uint8_t)options->walk,
        .start = (uint8_t)start,
        .finish = (uint8_t)options->finish,
        .count = options->counters != 0,
    };
    return MW_OK;
}

int mw_star_ready(const mw_star *star)
{
    mw__surface_read_lock(star->surface);
    bool ready = mw__star_is_current(star);
    mw__surface_read_unlock(star->surface);
    return ready;
}

/* `trace` and `meeting` may be NULL. */
static mw_location star_query(const mw_star *star, mw_star_cursor *cursor, const double point[3],
                              mw_star_trace *trace, double meeting[3])
{
    mw__surface_read_lock(star->surface);
    mw_location location = mw__star_query_answer(star, cursor, point, &cursor->last,
                                                 &cursor->random, &cursor->counters, trace);
    if (meeting) mw__star_meeting(star, &location, point, meeting);
    mw__surface_read_unlock(star->surface);
    return location;
}

mw_location mw_star_locate(const mw_star *star, mw_star_cursor *cursor, const double point[3])
{
    return star_query(star, cursor, point, NULL, NULL);
}

mw_location mw_star_project(const mw_star *star, mw_star_cursor *cursor, const double point[3],
                            double meeting[3])
{
    return star_query(star, cursor, point, NULL, meeting);
}

size_t mw_star_path(const mw_star *star, mw_star_cursor *cursor, const double point[3],
                    uint32_t *facets, size_t capacity, mw_location *location)
{
    mw_star_trace trace = {.facet = facets, .capacity = facets ? capacity : 0};
    mw_location found = star_query(star, cursor, point, &trace, NULL);
    if (location) *location = found;
    return trace.count;
}
