/* surface.c - makes a surface in space from arrays: copies points, finds coincident vertices and
 * neighbours; its updates. */
#include "surface/surface.h"
#include "base/options.h"
#include "mesh/arrays.h"
#include "mesh/connect.h"
#include "topology/coincident.h"

#include <stdlib.h>

static mw_status surface_check_arguments(const mw_arrays *arrays, const mw_surface_options *options,
                                         mw_error *error)
{
    mw_status status = MW_RESERVED_CHECK(mw_surface_options, options, error);
    if (!status) status = mw__arrays_validate(arrays, 3, error);
    if (status || !options->borrow || arrays->point_stride == 0 || arrays->point_stride == 3)
        return status;
    return mw__fail(error, MW_ERROR_ARGUMENT,
                    "points with a stride of %zu cannot be borrowed, only with 3",
                    arrays->point_stride);
}

static bool surface_take_points(mw_surface *surface, const mw_arrays *arrays)
{
    size_t stride = arrays->point_stride ? arrays->point_stride : 3;
    surface->point = surface->borrowed ? (double *)arrays->points
                                       : mw__alloc_lines(arrays->point_count, 3 * sizeof(double));
    if (surface->borrowed) return true;
    for (size_t i = 0; i < arrays->point_count && surface->point; i++)
        for (size_t k = 0; k < 3; k++) surface->point[3 * i + k] = arrays->points[i * stride + k];
    return surface->point;
}

/* Find the neighbours. In a welded surface, representatives stand for the vertices meanwhile. */
static mw_status surface_link_triangles(mw_surface *surface, const mw_arrays *arrays, mw_job *job,
                                        mw_error *error)
{
    mw_links links;
    for (uint32_t t = 0; t < surface->tri_count && surface->coincident; t++)
        for (uint32_t k = 0; k < 4; k++)
            surface->tri[t].v[k] = surface->coincident[surface->tri[t].v[k]];
    mw_job_span outer = mw__job_part(job, 0.6);
    bool done = mw__connect(surface->tri, surface->tri_count, surface->point_count, job, &links);
    mw__job_part_end(job, outer);
    if (!done) return mw__fail_memory(error);
    for (uint32_t t = 0; t < surface->tri_count && surface->coincident; t++)
        for (uint32_t k = 0; k < 4; k++)
            surface->tri[t].v[k] = mw__index_at(arrays, 3 * (size_t)t + k % 3);
    if (links.extra == MW_NONE || surface->tolerant) return MW_OK;
    const uint32_t *v = &surface->tri[mw__link_triangle(links.extra)].v[mw__link_edge(links.extra)];
    return mw__fail_non_manifold_edge(surface->tri, links.extra, v[0], v[1], error);
}

static mw_status surface_fill(mw_surface *surface, const mw_arrays *arrays,
                              const mw_surface_options *options, mw_job *job, mw_error *error)
{
    mw__job_stage(job, "copying triangles", 0.2);
    if (!surface_take_points(surface, arrays)) return mw__fail_memory(error);
    surface->tri = mw__alloc_lines(surface->tri_count, sizeof *surface->tri);
    if (!surface->tri) return mw__fail_memory(error);
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (!mw__job_step(job, t, surface->tri_count)) return mw__fail_memory(error);
        mw_status status =
            mw__copy_triangle(arrays, 3, surface->tolerant, t, &surface->tri[t], error);
        if (status) return status;
    }
    mw__job_stage(job, "finding coincident vertices", 0.2);
    if (options->weld &&
        !(surface->coincident = mw__coincident_create(surface->point, surface->point_count)))
        return mw__fail_memory(error);
    if (options->shared && !(surface->rwlock = mw__rwlock_create())) return mw__fail_memory(error);
    return surface_link_triangles(surface, arrays, job, error);
}

mw_status mw__surface_create(const mw_arrays *arrays, const mw_surface_options *options,
                             mw_job *job, mw_surface **out, mw_error *error)
{
    mw_status status = surface_check_arguments(arrays, options, error);
    if (status) return status;
    mw_surface *surface = mw__calloc(1, sizeof *surface);
    if (!surface) return mw__fail_memory(error);
    surface->tolerant = options->tolerant;
    surface->borrowed = options->borrow;
    surface->point_count = (uint32_t)arrays->point_count;
    surface->tri_count = (uint32_t)arrays->triangle_count;
    status = surface_fill(surface, arrays, options, job, error);
    if (status)
        mw_surface_destroy(surface);
    else
        *out = surface;
    return status;
}

mw_status mw_surface_create(const mw_arrays *arrays, const mw_surface_options *options,
                            mw_surface **out, mw_error *error)
{
    static const mw_surface_options defaults = {0};
    if (!options) options = &defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new surface is NULL");
    *out = NULL;
    mw_job job = mw__job(1, options->progress);
    mw_status status =
        mw__job_end(&job, mw__surface_create(arrays, options, &job, out, error), error);
    if (status) {
        mw_surface_destroy(*out);
        *out = NULL;
    }
    return status;
}

void mw_surface_destroy(mw_surface *surface)
{
    if (!surface) return;
    if (!surface->borrowed) free(surface->point);
    mw__rwlock_destroy(surface->rwlock);
    free(surface->coincident);
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

uint32_t mw_surface_neighbour(const mw_surface *surface, uint32_t triangle, unsigned local_edge,
                              unsigned *edge)
{
    uint32_t link = surface->tri[triangle].link[local_edge];
    if (link == MW_NONE) return MW_NONE;
    if (edge) *edge = mw__link_edge(link);
    return mw__link_triangle(link);
}

size_t mw_surface_bytes(const mw_surface *surface)
{
    size_t points = surface->borrowed ? 0 : 3 * sizeof(double),
           coincident = surface->coincident ? sizeof *surface->coincident : 0;
    return sizeof *surface + surface->point_count * (points + coincident) +
           surface->tri_count * sizeof *surface->tri + mw__rwlock_bytes(surface->rwlock);
}

/* --- change --- */

void mw_surface_begin_update(mw_surface *surface)
{
    if (surface->rwlock) mw__rwlock_write_lock(surface->rwlock);
    surface->updating = true;
    surface->version++;
}

void mw_surface_end_update(mw_surface *surface)
{
    surface->updating = false;
    if (surface->rwlock) mw__rwlock_write_unlock(surface->rwlock);
}

double *mw_surface_points(mw_surface *surface)
{
    return surface->point;
}

/* --- geometry --- */

bool mw__collinear3(const double a[3], const double b[3], const double c[3])
{
    for (int i = 0, j = 1; i < 3; i++, j = (i + 1) % 3) /* projected along each axis */
        if (mw__orient2d((mw_point){a[i], a[j]}, (mw_point){b[i], b[j]}, (mw_point){c[i], c[j]}) !=
            0)
            return false;
    return true;
}

bool mw__surface_orientations_agree(const mw_surface *surface, uint32_t t, uint32_t edge)
{
    const mw_triangle *a = &surface->tri[t], *b = &surface->tri[mw__link_triangle(a->link[edge])];
    uint32_t from = a->v[edge], to = b->v[mw__link_edge(a->link[edge]) + 1];
    return mw__representative(surface->coincident, from) ==
           mw__representative(surface->coincident, to);
}
