/* surface.c - a surface in space from arrays: copies, places, neighbours; its update. */
#include "mesh/surface.h"
#include "mesh/arrays.h"
#include "mesh/connect.h"
#include "mesh/place.h"

#include <stdlib.h>

static mw_status check_arguments(const mw_arrays *arrays, const mw_surface_options *options, mw_error *error)
{
    mw_status status = mw__check_arguments(arrays, 3, error);
    if (status || !options->borrow || arrays->point_stride == 0 || arrays->point_stride == 3) return status;
    return mw__fail(error, MW_ERROR_ARGUMENT, "points with a stride of %zu cannot be borrowed", arrays->point_stride);
}

static bool take_points(mw_surface *surface, const mw_arrays *arrays)
{
    size_t stride = arrays->point_stride ? arrays->point_stride : 3;
    surface->point =
        surface->borrowed ? (double *)arrays->points : mw__alloc_lines(arrays->point_count, 3 * sizeof(double));
    if (surface->borrowed) return true;
    for (size_t i = 0; i < arrays->point_count && surface->point; i++)
        for (size_t k = 0; k < 3; k++) surface->point[3 * i + k] = arrays->points[i * stride + k];
    return surface->point;
}

/* Find the neighbours: of a welded surface as if each triangle named the places of its vertices. */
static mw_status link_triangles(mw_surface *surface, const mw_arrays *arrays, mw_error *error)
{
    mw_links links;
    for (uint32_t t = 0; t < surface->tri_count && surface->place; t++)
        for (uint32_t k = 0; k < 4; k++) surface->tri[t].v[k] = surface->place[surface->tri[t].v[k]];
    if (!mw__connect(surface->tri, surface->tri_count, surface->point_count, 1, &links)) return mw__fail_memory(error);
    for (uint32_t t = 0; t < surface->tri_count && surface->place; t++)
        for (uint32_t k = 0; k < 4; k++) surface->tri[t].v[k] = mw__index_at(arrays, 3 * (size_t)t + k % 3);
    if (links.extra == MW_NONE || surface->tolerant) return MW_OK;
    const uint32_t *v = &surface->tri[mw__link_triangle(links.extra)].v[mw__link_edge(links.extra)];
    return mw__fail_shared(surface->tri, links.extra, v[0], v[1], error);
}

static mw_status fill(mw_surface *surface, const mw_arrays *arrays, const mw_surface_options *options, mw_error *error)
{
    if (!take_points(surface, arrays)) return mw__fail_memory(error);
    surface->tri = mw__alloc_lines(surface->tri_count, sizeof *surface->tri);
    if (!surface->tri) return mw__fail_memory(error);
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        mw_status status = mw__copy_triangle(arrays, 3, surface->tolerant, t, &surface->tri[t], error);
        if (status) return status;
    }
    if (options->weld && !(surface->place = mw__places_create(surface->point, surface->point_count)))
        return mw__fail_memory(error);
    if (options->shared && !(surface->gate = mw__gate_create())) return mw__fail_memory(error);
    return link_triangles(surface, arrays, error);
}

mw_status mw_surface_create(const mw_arrays *arrays, const mw_surface_options *options, mw_surface **out,
                            mw_error *error)
{
    static const mw_surface_options defaults = {0};
    if (!options) options = &defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the surface");
    *out = NULL;
    mw_status status = check_arguments(arrays, options, error);
    if (status) return status;
    mw_surface *surface = mw__calloc(1, sizeof *surface);
    if (!surface) return mw__fail_memory(error);
    surface->tolerant = options->tolerant;
    surface->borrowed = options->borrow;
    surface->point_count = (uint32_t)arrays->point_count;
    surface->tri_count = (uint32_t)arrays->triangle_count;
    status = fill(surface, arrays, options, error);
    if (status)
        mw_surface_destroy(surface);
    else
        *out = surface;
    return status;
}

void mw_surface_destroy(mw_surface *surface)
{
    if (!surface) return;
    if (!surface->borrowed) free(surface->point);
    mw__gate_destroy(surface->gate);
    free(surface->place);
    free(surface->tri);
    free(surface);
}

uint32_t mw_surface_vertex_count(const mw_surface *surface)
{
    return surface->point_count;
}

uint32_t mw_surface_triangle_count(const mw_surface *surface)
{
    return surface->tri_count;
}

void mw_surface_vertex(const mw_surface *surface, uint32_t vertex, double point[3])
{
    for (int k = 0; k < 3; k++) point[k] = mw__surface_point(surface, vertex)[k];
}

void mw_surface_triangle(const mw_surface *surface, uint32_t triangle, uint32_t vertices[3])
{
    for (int k = 0; k < 3; k++) vertices[k] = surface->tri[triangle].v[k];
}

uint32_t mw_surface_neighbour(const mw_surface *surface, uint32_t triangle, unsigned local_edge, unsigned *edge)
{
    uint32_t link = surface->tri[triangle].link[local_edge];
    if (link == MW_NONE) return MW_NONE;
    if (edge) *edge = mw__link_edge(link);
    return mw__link_triangle(link);
}

size_t mw_surface_bytes(const mw_surface *surface)
{
    size_t points = surface->borrowed ? 0 : 3 * sizeof(double), places = surface->place ? sizeof *surface->place : 0;
    return sizeof *surface + surface->point_count * (points + places) + surface->tri_count * sizeof *surface->tri +
           mw__gate_bytes(surface->gate);
}

/* --- change --- */

void mw_surface_begin_update(mw_surface *surface)
{
    if (surface->gate) mw__gate_close(surface->gate);
    surface->version++;
}

void mw_surface_end_update(mw_surface *surface)
{
    if (surface->gate) mw__gate_open(surface->gate);
}

double *mw_surface_points(mw_surface *surface)
{
    return surface->point;
}

/* --- geometry --- */

bool mw__collinear3(const double a[3], const double b[3], const double c[3])
{
    for (int i = 0, j = 1; i < 3; i++, j = (i + 1) % 3) /* seen along each axis */
        if (mw__orient2d((mw_point){a[i], a[j]}, (mw_point){b[i], b[j]}, (mw_point){c[i], c[j]}) != 0) return false;
    return true;
}

bool mw__surface_agrees(const mw_surface *surface, uint32_t t, uint32_t edge)
{
    const mw_triangle *a = &surface->tri[t], *b = &surface->tri[mw__link_triangle(a->link[edge])];
    uint32_t from = a->v[edge], to = b->v[mw__link_edge(a->link[edge]) + 1];
    return mw__place_of(surface->place, from) == mw__place_of(surface->place, to);
}
