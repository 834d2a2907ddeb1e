#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_operations.h"

#include <inttypes.h>

mw_status mw__surface_check_vertex(const mw_surface_editor *e, uint32_t vertex, mw_error *error)
{
    if (mw__surface_has_vertex(e, vertex)) return MW_OK;
    return mw__fail_at(error, -1, vertex, "there is no vertex %" PRIu32, vertex);
}

mw_status mw__surface_check_triangle(const mw_surface_editor *e, uint32_t triangle, mw_error *error)
{
    if (mw__surface_has_triangle(e, triangle)) return MW_OK;
    return mw__fail_at(error, triangle, -1, "there is no triangle %" PRIu32, triangle);
}

mw_status mw__surface_check_edge(const mw_surface_editor *e, uint32_t a, uint32_t b,
                                 uint32_t half[2], unsigned *count, mw_error *error)
{
    mw_status status = mw__surface_check_vertex(e, a, error);
    if (!status) status = mw__surface_check_vertex(e, b, error);
    if (status) return status;
    *count = a == b ? 0 : mw__surface_edge(e, a, b, half);
    if (*count) return MW_OK;
    return mw__fail_at(error, -1, a, "no edge joins the vertices %" PRIu32 " and %" PRIu32, a, b);
}

mw_status mw__surface_check_left(const mw_surface_editor *e, uint32_t gone, mw_error *error)
{
    if (gone < mw__surface_living(e)) return MW_OK;
    return mw__fail(error, MW_ERROR_INPUT, "no triangle would be left");
}

mw_status mw__surface_refuse_third(uint32_t triangle, uint32_t a, uint32_t b, mw_error *error)
{
    return mw__fail_at(error, triangle, a,
                       "the edge from %" PRIu32 " to %" PRIu32
                       " would have a third triangle; one of the others is %" PRIu32,
                       a, b, triangle);
}

mw_status mw__surface_refuse_clash(uint32_t triangle, uint32_t a, uint32_t b, mw_error *error)
{
    return mw__fail_at(error, triangle, a,
                       "the triangles at the edge from %" PRIu32 " to %" PRIu32
                       " would have opposite orientation; one of them is %" PRIu32,
                       a, b, triangle);
}
