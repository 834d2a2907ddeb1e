/* stub.c - weak stand-ins while the real ones are written. */
#include <meshwalk/meshwalk.h>
#pragma GCC diagnostic ignored "-Wunused-parameter"
__attribute__((weak)) const char *mw_star_walk_name(mw_star_walk_kind walk)
{
    return 0;
}

__attribute__((weak)) const char *mw_star_walk_source(mw_star_walk_kind walk)
{
    return 0;
}

__attribute__((weak)) const char *mw_star_walk_help(mw_star_walk_kind walk)
{
    return 0;
}

__attribute__((weak)) const char *mw_star_start_name(mw_star_start_kind start)
{
    return 0;
}

__attribute__((weak)) const char *mw_star_start_help(mw_star_start_kind start)
{
    return 0;
}

__attribute__((weak)) int mw_star_start_has_index(mw_star_start_kind start)
{
    return 0;
}

__attribute__((weak)) mw_star_walk_kind mw_star_walk_by_name(const char *name)
{
    return (mw_star_walk_kind)0;
}

__attribute__((weak)) mw_star_start_kind mw_star_start_by_name(const char *name)
{
    return (mw_star_start_kind)0;
}

__attribute__((weak)) mw_status mw_star_create(const mw_surface *surface, const mw_star_options *options, mw_star **out,
                                               mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) void mw_star_destroy(mw_star *star) {}

__attribute__((weak)) mw_status mw_star_update(mw_star *star, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) void mw_star_describe(const mw_star *star, mw_star_info *info) {}

__attribute__((weak)) mw_status mw_star_check_arrays(const mw_arrays *arrays, int weld, const mw_star_options *options,
                                                     mw_check *check, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) void mw_lonlat_direction(double longitude, double latitude, double direction[3]) {}

__attribute__((weak)) void mw_direction_lonlat(const double direction[3], double *longitude, double *latitude) {}

__attribute__((weak)) mw_status mw_star_index_create(const mw_star *star, mw_star_start_kind start,
                                                     const mw_star_index_options *options, mw_star_index **out,
                                                     mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) void mw_star_index_destroy(mw_star_index *index) {}

__attribute__((weak)) void mw_star_index_describe(const mw_star_index *index, mw_star_index_info *info) {}

__attribute__((weak)) mw_status mw_star_cursor_init(mw_star_cursor *cursor, const mw_star *star,
                                                    const mw_star_query_options *options, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) mw_location mw_star_locate(const mw_star *star, mw_star_cursor *cursor, const double point[3])
{
    return (mw_location){0};
}

__attribute__((weak)) mw_status mw_star_locate_batch(const mw_star *star, const double *points, size_t n, size_t stride,
                                                     const mw_star_query_options *options, mw_location *locations,
                                                     mw_counters *counters, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) size_t mw_star_path(const mw_star *star, mw_star_cursor *cursor, const double point[3],
                                          uint32_t *facets, size_t capacity, mw_location *location)
{
    return 0;
}
#include "star/index.h"
__attribute__((weak)) uint32_t mw__star_start(const mw_star *star, const mw_star_cursor *cursor, uint32_t last, mw_star_walk *walk)
{
    return last == MW_NONE ? star->front : last;
}
__attribute__((weak)) mw_star_start_kind mw__star_index_start(const mw_star_index *index)
{
    return 0;
}
