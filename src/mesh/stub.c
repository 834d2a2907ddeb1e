/* stub.c - weak stand-ins while the real ones are written. */
#include <meshwalk/meshwalk.h>
#pragma GCC diagnostic ignored "-Wunused-parameter"
__attribute__((weak)) mw_status mw_surface_create(const mw_arrays *arrays, const mw_surface_options *options,
                                                  mw_surface **out, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) void mw_surface_destroy(mw_surface *surface) {}

__attribute__((weak)) uint32_t mw_surface_vertex_count(const mw_surface *surface)
{
    return 0;
}

__attribute__((weak)) uint32_t mw_surface_triangle_count(const mw_surface *surface)
{
    return 0;
}

__attribute__((weak)) void mw_surface_vertex(const mw_surface *surface, uint32_t vertex, double point[3]) {}

__attribute__((weak)) void mw_surface_triangle(const mw_surface *surface, uint32_t triangle, uint32_t vertices[3]) {}

__attribute__((weak)) uint32_t mw_surface_neighbour(const mw_surface *surface, uint32_t triangle, unsigned local_edge,
                                                    unsigned *edge)
{
    return 0;
}

__attribute__((weak)) size_t mw_surface_bytes(const mw_surface *surface)
{
    return 0;
}

__attribute__((weak)) void mw_surface_begin_update(mw_surface *surface) {}

__attribute__((weak)) void mw_surface_end_update(mw_surface *surface) {}

__attribute__((weak)) double *mw_surface_points(mw_surface *surface)
{
    return 0;
}

__attribute__((weak)) mw_status mw_surface_flip(mw_surface *surface, uint32_t triangle, unsigned local_edge,
                                                mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) mw_status mw_surface_describe(const mw_surface *surface, mw_surface_info *info, mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}

__attribute__((weak)) mw_status mw_surface_check_arrays(const mw_arrays *arrays, int weld, mw_check *check,
                                                        mw_error *error)
{
    return MW_ERROR_ARGUMENT;
}
