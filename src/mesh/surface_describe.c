/* surface_describe.c - what kind of surface it is. */
#include "mesh/count.h"
#include "mesh/surface.h"

#include <stdlib.h>

static bool is_usable(const mw_surface *surface, uint32_t t)
{
    return mw__corners_finite(surface, t) && mw__has_three_vertices(&surface->tri[t]);
}

/* --- counts --- */

/* Triangles with two vertices at one place have no edges. Returns the number of the others; the number
 * of their edges goes to *edges. */
static uint32_t count_edges(const mw_surface *surface, mw_surface_info *info, uint64_t *edges)
{
    uint32_t count = 0;
    uint64_t linked = 0;
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (!mw__has_three_places(&surface->tri[t], surface->place)) continue;
        count++;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = surface->tri[t].link[k];
            info->border_edges += link == MW_NONE;
            if (link == MW_NONE || mw__link_triangle(link) < t) continue;
            linked++;
            info->clashing_edges += !mw__surface_agrees(surface, t, k);
        }
    }
    info->oriented = info->clashing_edges == 0;
    info->closed = count > 0 && info->border_edges == 0;
    *edges = linked + info->border_edges;
    return count;
}

/* Count pinched vertices, and those that have a fan at all: *used. False when out of memory. */
static bool count_pinched(const mw_surface *surface, mw_surface_info *info, uint32_t *used)
{
    uint8_t *fans = mw__calloc(surface->point_count, sizeof *fans);
    bool done = fans && mw__count_fans(surface->tri, surface->tri_count, surface->place, fans);
    *used = 0;
    for (uint32_t v = 0; v < surface->point_count && done; v++) {
        *used += fans[v] > 0;
        info->pinched_vertices += fans[v] > 1;
    }
    free(fans);
    return done;
}

/* Returns false when out of memory. */
static bool count(const mw_surface *surface, mw_surface_info *info)
{
    uint64_t edges;
    uint32_t faces = count_edges(surface, info, &edges), corners, used;
    if (!count_pinched(surface, info, &corners) ||
        !mw__count_pieces(surface->tri, surface->tri_count, surface->point_count, surface->place, &used,
                          &info->components) ||
        !mw__count_loops(surface->tri, surface->tri_count, surface->place, &info->border_loops))
        return false;
    for (uint32_t v = 0; v < surface->point_count; v++) info->vertices += mw__place_of(surface->place, v) == v;
    info->unused_vertices = info->vertices - used;
    info->border_loops -= surface->tri_count - faces; /* a loop each, of what are no edges */
    info->euler = (int64_t)corners - (int64_t)edges + faces;
    return true;
}

/* --- measures --- */

static void widen(mw_surface_info *info, const double p[3])
{
    for (int i = 0; i < 3; i++) {
        info->low[i] = fmin(info->low[i], p[i]); /* fmin and fmax pass over the NaN they begin with */
        info->high[i] = fmax(info->high[i], p[i]);
    }
}

/* (b - a) x (c - a): twice the area long, along the normal at the front. */
static void cross(const double a[3], const double b[3], const double c[3], double normal[3])
{
    for (int i = 0, j = 1, k = 2; i < 3; i++, j = k, k = (j + 1) % 3)
        normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
}

/* Extent, area, triangles without area, volume: that of the tetrahedra between the triangles and the first vertex used,
 * as they are smaller, and rounded less, than those up to a far origin. */
static void measure(const mw_surface *surface, mw_surface_info *info)
{
    mw_sum area = {0}, volume = {0};
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        const double *corner[3], *apex = mw__surface_corner(surface, 0, 0);
        double normal[3];
        for (uint32_t k = 0; k < 3; k++) {
            corner[k] = mw__surface_corner(surface, t, k);
            if (mw__is_finite3(corner[k])) widen(info, corner[k]);
        }
        cross(corner[0], corner[1], corner[2], normal);
        for (int i = 0; i < 3; i++) mw__sum_add(&volume, normal[i] * (corner[0][i] - apex[i]) / 6);
        if (!is_usable(surface, t) || mw__collinear3(corner[0], corner[1], corner[2]))
            info->flat_triangles++;
        else
            mw__sum_add(&area, hypot(hypot(normal[0], normal[1]), normal[2]) / 2);
    }
    info->area = mw__sum_value(&area);
    info->volume = info->closed && info->oriented ? mw__sum_value(&volume) : NAN;
}

mw_status mw_surface_describe(const mw_surface *surface, mw_surface_info *info, mw_error *error)
{
    if (!surface || !info) return mw__fail(error, MW_ERROR_ARGUMENT, "no surface, or no place for its description");
    *info = (mw_surface_info){.triangles = surface->tri_count, .low = {NAN, NAN, NAN}, .high = {NAN, NAN, NAN}};
    mw__surface_enter(surface);
    bool done = count(surface, info);
    if (done) measure(surface, info);
    mw__surface_leave(surface);
    return done ? MW_OK : mw__fail_memory(error);
}
