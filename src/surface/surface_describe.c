/* surface_describe.c - the public description of a surface. */
#include "mesh/compensated_sum.h"
#include "surface/surface.h"
#include "topology/topology_counts.h"

#include <stdlib.h>

static bool surface_triangle_is_usable(const mw_surface *surface, uint32_t t)
{
    return mw__corners_finite(surface, t) && mw__has_three_vertices(&surface->tri[t]);
}

/* --- counts --- */

/* Triangles with two coincident vertices have no edges. Returns the number of the others; *edges
 * becomes the number of their edges. */
static uint32_t surface_count_edges(const mw_surface *surface, mw_surface_info *info,
                                    uint64_t *edges)
{
    uint32_t count = 0;
    uint64_t linked = 0;
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (!mw__has_three_representatives(&surface->tri[t], surface->coincident)) continue;
        count++;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = surface->tri[t].link[k];
            info->border_edges += link == MW_NONE;
            if (link == MW_NONE || mw__link_triangle(link) < t) continue;
            linked++;
            info->clashing_edges += !mw__surface_orientations_agree(surface, t, k);
        }
    }
    info->oriented = info->clashing_edges == 0;
    info->closed = count > 0 && info->border_edges == 0;
    *edges = linked + info->border_edges;
    return count;
}

/* Count pinched vertices. *used becomes the number of vertices with a fan. Returns false when out
 * of memory. */
static bool surface_count_pinched(const mw_surface *surface, mw_surface_info *info, uint32_t *used)
{
    uint8_t *fans = mw__calloc(surface->point_count, sizeof *fans);
    bool done = fans && mw__count_fans(surface->tri, surface->tri_count, surface->coincident, fans);
    *used = 0;
    for (uint32_t v = 0; v < surface->point_count && done; v++) {
        *used += fans[v] > 0;
        info->pinched_vertices += fans[v] > 1;
    }
    free(fans);
    return done;
}

/* Returns false when out of memory. */
static bool surface_count(const mw_surface *surface, mw_surface_info *info)
{
    uint64_t edges;
    uint32_t faces = surface_count_edges(surface, info, &edges), corners, used;
    if (!surface_count_pinched(surface, info, &corners) ||
        !mw__count_components(surface->tri, surface->tri_count, surface->point_count,
                              surface->coincident, &used, &info->components) ||
        !mw__count_border_loops(surface->tri, surface->tri_count, surface->coincident,
                                &info->border_loops))
        return false;
    for (uint32_t v = 0; v < surface->point_count; v++)
        info->vertices += mw__representative(surface->coincident, v) == v;
    info->vertices -= surface->freed_points;
    info->unused_vertices = info->vertices - used;
    /* Triangles without edges were counted as a loop each. */
    info->border_loops -= surface->tri_count - faces;
    info->euler = (int64_t)corners - (int64_t)edges + faces;
    return true;
}

/* --- measures --- */

static void surface_extent_widen(mw_surface_info *info, const double p[3])
{
    for (int i = 0; i < 3; i++) {
        /* Fmin and fmax ignore the NaN that is there at first. */
        info->low[i] = fmin(info->low[i], p[i]);
        info->high[i] = fmax(info->high[i], p[i]);
    }
}

/* The normal (b - a) x (c - a), on the front side. Its length is twice the area. */
static void triangle_normal(const double a[3], const double b[3], const double c[3],
                            double normal[3])
{
    for (int i = 0, j = 1, k = 2; i < 3; i++, j = k, k = (j + 1) % 3)
        normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
}

/* Extent, area, flat triangles, volume. The volume is that of the tetrahedra between the triangles
 * and the first vertex used. They are smaller than those up to a far origin, so rounding errors are
 * smaller, too. */
static void surface_measure(const mw_surface *surface, mw_surface_info *info)
{
    mw_sum area = {0}, volume = {0};
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (mw__surface_is_freed(surface, t)) continue;
        const double *corner[3], *apex = mw__surface_corner(surface, 0, 0);
        double normal[3];
        for (uint32_t k = 0; k < 3; k++) {
            corner[k] = mw__surface_corner(surface, t, k);
            if (mw__is_finite3(corner[k])) surface_extent_widen(info, corner[k]);
        }
        triangle_normal(corner[0], corner[1], corner[2], normal);
        for (int i = 0; i < 3; i++) mw__sum_add(&volume, normal[i] * (corner[0][i] - apex[i]) / 6);
        if (!surface_triangle_is_usable(surface, t) ||
            mw__collinear3(corner[0], corner[1], corner[2]))
            info->flat_triangles++;
        else
            mw__sum_add(&area, hypot(hypot(normal[0], normal[1]), normal[2]) / 2);
    }
    info->area = mw__sum_value(&area);
    info->volume = info->closed && info->oriented ? mw__sum_value(&volume) : NAN;
}

mw_status mw_surface_describe(const mw_surface *surface, mw_surface_info *info, mw_error *error)
{
    if (!surface || !info)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the surface or the pointer to its description is NULL");
    *info = (mw_surface_info){.low = {NAN, NAN, NAN}, .high = {NAN, NAN, NAN}};
    mw__surface_read_lock(surface);
    info->triangles = surface->tri_count - surface->freed_triangles;
    bool done = surface_count(surface, info);
    if (done) surface_measure(surface, info);
    mw__surface_read_unlock(surface);
    return done ? MW_OK : mw__fail_memory(error);
}
