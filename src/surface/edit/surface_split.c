/* surface_split.c - splits edges and triangles, and flips edges. */
#include "surface/edit/surface_changes.h"
#include "surface/edit/surface_corners.h"
#include "surface/edit/surface_journal.h"
#include "surface/edit/surface_operations.h"

#include <inttypes.h>

/* The mean of n corners of a triangle, whose sum may overflow. */
static void corners_mean(const mw_surface *surface, uint32_t t, uint32_t first, int n,
                         double mean[3])
{
    for (int i = 0; i < 3; i++) {
        mean[i] = 0;
        for (uint32_t k = first; k < first + (uint32_t)n; k++)
            mean[i] += mw__surface_corner(surface, t, k % 3)[i] / n;
    }
}

static mw_status new_point_check(const double point[3], mw_error *error)
{
    return mw__is_finite3(point)
               ? MW_OK
               : mw__fail(error, MW_ERROR_INPUT, "the new vertex would not be finite");
}

static uint32_t half_edge_apex(const mw_surface_editor *e, uint32_t half)
{
    return e->surface->tri[mw__link_triangle(half)].v[mw__prev(mw__link_edge(half))];
}

/* Link half-edge `half` to what `former` was linked to. */
static void half_edge_take_link(mw_surface_editor *e, uint32_t half, uint32_t former)
{
    uint32_t link = mw__half_link(e->surface->tri, former);
    mw__surface_join(e, half, link);
}

/*         c            The triangle of half-edge se keeps the part at the end `low`; the other one
 *       / | \          becomes a new triangle, with the same local numbers. Returns the half-edges
 *      /  |  \         along the split edge: of the part at `low`, and of the other one. */
static void half_edge_split(mw_surface_editor *e, uint32_t half, uint32_t low, uint32_t middle,
                            uint32_t part[2])
{ /*  s---m---f  */
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half), v[3];
    uint32_t start = k, end = mw__next(k), apex = mw__prev(k);
    bool at_start = e->surface->tri[t].v[start] == low;
    for (uint32_t i = 0; i < 3; i++) v[i] = e->surface->tri[t].v[i];
    v[at_start ? start : end] = middle;
    uint32_t made = mw__surface_make_triangle(e, v[0], v[1], v[2]);
    mw__surface_set_corner(e, t, at_start ? end : start, middle);
    uint32_t outer = at_start ? end : apex, inner = at_start ? apex : end;
    half_edge_take_link(e, mw__link(made, outer), mw__link(t, outer));
    mw__surface_join(e, mw__link(t, outer), mw__link(made, inner));
    part[0] = mw__link(t, k);
    part[1] = mw__link(made, k);
}

mw_status mw__surface_split_edge(mw_surface_editor *e, const mw_surface_edit *edit, mw_error *error)
{
    uint32_t half[2], part[2][2] = {{MW_NONE, MW_NONE}, {MW_NONE, MW_NONE}};
    unsigned n;
    uint32_t a = edit->vertex[0], b = edit->vertex[1], low = a < b ? a : b;
    mw_status status = mw__surface_check_edge(e, a, b, half, &n, error);
    if (status) return status;
    if (n == 2 && half_edge_apex(e, half[0]) == half_edge_apex(e, half[1]))
        return mw__surface_refuse_third(mw__link_triangle(half[0]), half_edge_apex(e, half[0]),
                                        e->surface->point_count, error);
    double point[3] = {edit->point[0], edit->point[1], edit->point[2]};
    if (isnan(point[0]))
        corners_mean(e->surface, mw__link_triangle(half[0]), mw__link_edge(half[0]), 2, point);
    status = new_point_check(point, error);
    if (!status)
        status = mw__surface_edit_begin(
            e,
            &(mw_surface_needs){
                .made = n, .vertices = 1, .triangles = 3 * (size_t)n, .vertex_entries = 1},
            error);
    if (status) return status;
    uint32_t middle = mw__surface_make_vertex(e, point, MW_NONE);
    for (unsigned i = 0; i < n; i++) half_edge_split(e, half[i], low, middle, part[i]);
    for (int i = 0; i < 2; i++) mw__surface_join(e, part[0][i], part[1][i]);
    return MW_OK;
}

/* Triangle a b c becomes a b m; b c m and c a m are new. */
mw_status mw__surface_split_triangle(mw_surface_editor *e, const mw_surface_edit *edit,
                                     mw_error *error)
{
    uint32_t t = edit->triangle;
    mw_status status = mw__surface_check_triangle(e, t, error);
    if (status) return status;
    double point[3] = {edit->point[0], edit->point[1], edit->point[2]};
    if (isnan(point[0])) corners_mean(e->surface, t, 0, 3, point);
    status = new_point_check(point, error);
    if (!status)
        status = mw__surface_edit_begin(
            e, &(mw_surface_needs){.made = 2, .vertices = 1, .triangles = 4, .vertex_entries = 1},
            error);
    if (status) return status;
    const uint32_t *v = e->surface->tri[t].v;
    uint32_t a = v[0], b = v[1], c = v[2], m = mw__surface_make_vertex(e, point, MW_NONE);
    uint32_t bcm = mw__surface_make_triangle(e, b, c, m),
             cam = mw__surface_make_triangle(e, c, a, m);
    mw__surface_set_corner(e, t, 2, m);
    half_edge_take_link(e, mw__link(bcm, 0), mw__link(t, 1));
    half_edge_take_link(e, mw__link(cam, 0), mw__link(t, 2));
    mw__surface_join(e, mw__link(t, 1), mw__link(bcm, 2));
    mw__surface_join(e, mw__link(t, 2), mw__link(cam, 1));
    mw__surface_join(e, mw__link(bcm, 1), mw__link(cam, 2));
    return MW_OK;
}

/* Letters as in mw_surface_flip: a b c and b a d become c d b and d c a. */
mw_status mw__surface_flip_edge(mw_surface_editor *e, const mw_surface_edit *edit, mw_error *error)
{
    const mw_triangle *tri = e->surface->tri;
    uint32_t half[2], other[2];
    unsigned n;
    mw_status status = mw__surface_check_edge(e, edit->vertex[0], edit->vertex[1], half, &n, error);
    if (status) return status;
    uint32_t t = mw__link_triangle(half[0]), ab = mw__link_edge(half[0]);
    if (n == 1)
        return mw__fail_at(error, t, edit->vertex[0],
                           "the edge from %" PRIu32 " to %" PRIu32 " is a border", edit->vertex[0],
                           edit->vertex[1]);
    if (!mw__surface_orientations_agree(e->surface, t, ab))
        return mw__fail_at(error, t, edit->vertex[0],
                           "the triangles at the edge from %" PRIu32 " to %" PRIu32
                           " have opposite orientation",
                           edit->vertex[0], edit->vertex[1]);
    uint32_t neighbour = mw__link_triangle(half[1]), ba = mw__link_edge(half[1]);
    uint32_t ca = mw__prev(ab), db = mw__prev(ba), c = tri[t].v[ca], d = tri[neighbour].v[db];
    if (c == d || mw__surface_edge(e, c, d, other))
        return mw__fail_at(
            error, t, c, "the vertices %" PRIu32 " and %" PRIu32 " are the same, or joined already",
            c, d);
    status = mw__surface_edit_begin(e, &(mw_surface_needs){.triangles = 4}, error);
    if (status) return status;
    uint32_t beyond_ca = e->surface->tri[t].link[ca],
             beyond_db = e->surface->tri[neighbour].link[db];
    mw__surface_set_corner(e, t, ab, d);
    mw__surface_set_corner(e, neighbour, ba, c);
    mw__surface_join(e, mw__link(t, ab), beyond_db);
    mw__surface_join(e, mw__link(neighbour, ba), beyond_ca);
    mw__surface_join(e, mw__link(t, ca), mw__link(neighbour, db));
    return MW_OK;
}
