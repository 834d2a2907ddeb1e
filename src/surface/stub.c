/* stub.c - weak stand-ins while the real ones are written. */
#include <meshwalk/meshwalk.h>
#pragma GCC diagnostic ignored "-Wunused-parameter"
__attribute__((weak)) mw_status mw_prober_create(const mw_surface *surface, const mw_prober_options *options,
                                                 mw_prober **out, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) void mw_prober_destroy(mw_prober *prober) {}

__attribute__((weak)) void mw_prober_update(mw_prober *prober, double moved, uint32_t threads) {}

__attribute__((weak)) void mw_prober_describe(const mw_prober *prober, mw_prober_info *info) {}

__attribute__((weak)) const char *mw_touch_state_name(mw_touch_state state)
{
    return 0;
}

__attribute__((weak)) const char *mw_probe_start_name(mw_probe_start start)
{
    return 0;
}

__attribute__((weak)) void mw_probe_counters_add(mw_probe_counters *sum, const mw_probe_counters *more) {}

__attribute__((weak)) mw_status mw_probe_cursor_init(mw_probe_cursor *cursor, const mw_prober *prober,
                                                     const mw_probe_options *options, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) mw_touch mw_probe(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                                        const double motion[3])
{
    return (mw_touch){0};
}

__attribute__((weak)) mw_status mw_probe_batch(const mw_prober *prober, const double *queries, size_t n, size_t stride,
                                               const mw_probe_options *options, mw_touch *touches,
                                               mw_probe_counters *counters, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) size_t mw_probe_path(const mw_prober *prober, mw_probe_cursor *cursor, const double point[3],
                                           const double motion[3], uint32_t *triangles, uint32_t *iteration,
                                           size_t capacity, mw_touch *touch)
{
    return 0;
}

__attribute__((weak)) mw_status mw_nearest_on_surface(const mw_prober *prober, const double point[3],
                                                      double max_distance, mw_surface_hit *hit, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}
