/* surface_pieces.c - adds, removes and moves single vertices and triangles. */
#include "surface/edit/surface_changes.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_journal.h"
#include "surface/edit/surface_operations.h"

#include <inttypes.h>

mw_status mw__surface_add_vertex(mw_surface_editor *e, const mw_surface_edit *edit, mw_error *error)
{
    mw_status status =
        mw__surface_edit_begin(e, &(mw_surface_needs){.vertices = 1, .vertex_entries = 1}, error);
    if (!status) mw__surface_make_vertex(e, edit->point, MW_NONE);
    return status;
}

mw_status mw__surface_shift_vertex(mw_surface_editor *e, const mw_surface_edit *edit,
                                   mw_error *error)
{
    mw_status status = mw__surface_check_vertex(e, edit->vertex[0], error);
    if (!status)
        status = mw__surface_edit_begin(e, &(mw_surface_needs){.vertex_entries = 1}, error);
    if (!status) mw__surface_move_vertex(e, edit->vertex[0], edit->point);
    return status;
}

mw_status mw__surface_remove_vertex(mw_surface_editor *e, const mw_surface_edit *edit,
                                    mw_error *error)
{
    uint32_t v = edit->vertex[0];
    mw_status status = mw__surface_check_vertex(e, v, error);
    if (status) return status;
    uint32_t degree = mw__surface_degree(e, v);
    status = degree ? mw__surface_check_left(e, degree, error) : MW_OK;
    if (!status) /* each triangle, and its neighbour at the edge opposite */
        status = mw__surface_edit_begin(
            e, &(mw_surface_needs){.triangles = 2 * (size_t)degree, .vertex_entries = 1}, error);
    if (status) return status;
    while (mw__is_corner(e->at[v].first)) {
        uint32_t t = e->at[v].first / 3, k = e->at[v].first % 3,
                 beyond = e->surface->tri[t].link[mw__next(k)];
        mw__surface_free_triangle(e, t, beyond == MW_NONE ? MW_NONE : mw__link_triangle(beyond));
    }
    mw__surface_free_vertex(e, v, MW_NONE);
    return MW_OK;
}

mw_status mw__surface_remove_triangle(mw_surface_editor *e, const mw_surface_edit *edit,
                                      mw_error *error)
{
    uint32_t t = edit->triangle, heir = MW_NONE;
    mw_status status = mw__surface_check_triangle(e, t, error);
    if (!status) status = mw__surface_check_left(e, 1, error);
    if (!status) status = mw__surface_edit_begin(e, &(mw_surface_needs){.triangles = 4}, error);
    if (status) return status;
    for (uint32_t k = 0; k < 3; k++)
        if (e->surface->tri[t].link[k] != MW_NONE)
            heir = mw__link_triangle(e->surface->tri[t].link[k]);
    mw__surface_free_triangle(e, t, heir);
    return MW_OK;
}

/* Find the border edges that a new triangle would be linked to: beyond[k], or MW_NONE. */
static mw_status added_triangle_check(const mw_surface_editor *e, const uint32_t v[3],
                                      uint32_t beyond[3], mw_error *error)
{
    for (uint32_t k = 0; k < 3; k++) {
        mw_status status = mw__surface_check_vertex(e, v[k], error);
        if (status) return status;
    }
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t a = v[k], b = v[mw__next(k)], half[2];
        if (a == b)
            return mw__fail_at(error, -1, a, "a triangle cannot have vertex %" PRIu32 " twice", a);
        unsigned n = mw__surface_edge(e, a, b, half);
        if (n == 2) return mw__surface_refuse_third(mw__link_triangle(half[0]), a, b, error);
        if (n == 1 && mw__half_start(e->surface->tri, half[0]) == a)
            return mw__surface_refuse_clash(mw__link_triangle(half[0]), a, b, error);
        beyond[k] = half[0];
    }
    return MW_OK;
}

mw_status mw__surface_add_triangle(mw_surface_editor *e, const mw_surface_edit *edit,
                                   mw_error *error)
{
    uint32_t beyond[3];
    const uint32_t *v = edit->vertex;
    mw_status status = added_triangle_check(e, v, beyond, error);
    if (!status)
        status = mw__surface_edit_begin(e, &(mw_surface_needs){.made = 1, .triangles = 3}, error);
    if (status) return status;
    uint32_t t = mw__surface_make_triangle(e, v[0], v[1], v[2]);
    for (uint32_t k = 0; k < 3; k++)
        if (beyond[k] != MW_NONE) mw__surface_join(e, mw__link(t, k), beyond[k]);
    return MW_OK;
}
