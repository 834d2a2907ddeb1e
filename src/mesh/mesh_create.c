/* mesh_create.c - makes a planar mesh from arrays: copies, orientation, neighbours. */
#include "base/options.h"
#include "base/posix.h"
#include "mesh/arrays.h"
#include "mesh/connect.h"
#include "mesh/layout.h"
#include "mesh/mesh_create.h"

typedef struct mesh_filling {
    mw_mesh *mesh;
    const mw_arrays *arrays;
    pthread_mutex_t lock;         /* of what follows */
    uint32_t flat, reversed, bad; /* bad: the first unusable triangle, or MW_NONE */
} mesh_filling;

static void mesh_copy_points(void *work, uint64_t from, uint64_t to)
{
    const mesh_filling *f = work;
    size_t stride = f->arrays->point_stride ? f->arrays->point_stride : 2;
    const double *points = f->arrays->points;
    for (uint64_t i = from; i < to; i++)
        f->mesh->point[i] = (mw_point){points[i * stride], points[i * stride + 1]};
}

/* Store the triangle counter-clockwise. Returns its signed area as the user gave it: twice the
 * area, rounded, with the exact sign. */
static double triangle_orient(const mw_mesh *mesh, mw_triangle *t)
{
    mw_point a = mesh->point[t->v[0]], b = mesh->point[t->v[1]], c = mesh->point[t->v[2]];
    double area =
        mw__is_finite(a) && mw__is_finite(b) && mw__is_finite(c) ? mw__orient2d(a, b, c) : 0;
    if (area >= 0) return area;
    uint32_t v = t->v[1];
    t->v[1] = t->v[2];
    t->v[2] = v;
    t->user |= MW_REVERSED;
    return area;
}

/* Copy triangles, counter-clockwise. Count those that were clockwise, and those without area. */
static void mesh_copy_triangles(void *work, uint64_t from, uint64_t to)
{
    mesh_filling *f = work;
    mw_mesh *mesh = f->mesh;
    uint32_t flat = 0, reversed = 0, bad = MW_NONE;
    for (uint32_t t = (uint32_t)from; t < to; t++) {
        if (mw__copy_triangle(f->arrays, 2, mesh->tolerant, t, &mesh->tri[t], NULL)) {
            bad = t < bad ? t : bad;
            continue;
        }
        double area = triangle_orient(mesh, &mesh->tri[t]);
        flat += area == 0;
        reversed += area < 0;
    }
    pthread_mutex_lock(&f->lock);
    f->flat += flat;
    f->reversed += reversed;
    f->bad = bad < f->bad ? bad : f->bad;
    pthread_mutex_unlock(&f->lock);
}

static mw_status mesh_refuse_non_manifold_edge(const mw_mesh *mesh, uint32_t extra, mw_error *error)
{
    const uint32_t *v = &mesh->tri[mw__link_triangle(extra)].v[mw__link_edge(extra)];
    return mw__fail_non_manifold_edge(mesh->tri, extra, mw__vertex_number(mesh, v[0]),
                                      mw__vertex_number(mesh, v[1]), error);
}

static mw_status mesh_copy_all(mesh_filling *f, mw_job *job, mw_error *error)
{
    mw_mesh *mesh = f->mesh;
    mw__job_stage(job, "copying points", 0.1);
    if (!mw__job_ranges(job, mesh->point_count, mesh_copy_points, f)) return mw__fail_memory(error);
    mw__job_stage(job, "copying triangles", 0.3);
    if (!mw__job_ranges(job, mesh->tri_count, mesh_copy_triangles, f))
        return mw__fail_memory(error);
    mesh->flat_count = f->flat;
    mesh->reversed_count = f->reversed;
    return f->bad == MW_NONE
               ? MW_OK
               : mw__copy_triangle(f->arrays, 2, mesh->tolerant, f->bad, &mesh->tri[f->bad], error);
}

/* Keep the order of the arrays. */
static mw_status mesh_copy_arrays(mw_mesh *mesh, const mw_arrays *arrays, mw_job *job,
                                  mw_links *links, mw_error *error)
{
    mesh->point = mw__alloc_lines(mesh->point_count, sizeof *mesh->point);
    mesh->tri = mw__alloc_lines(mesh->tri_count, sizeof *mesh->tri);
    if (!mesh->point || !mesh->tri) return mw__fail_memory(error);
    mesh_filling filling = {.mesh = mesh, .arrays = arrays, .bad = MW_NONE};
    pthread_mutex_init(&filling.lock, NULL);
    mw_status status = mesh_copy_all(&filling, job, error);
    pthread_mutex_destroy(&filling.lock);
    mw_job_span outer = mw__job_part(job, 0.6);
    if (!status && !mw__connect(mesh->tri, mesh->tri_count, mesh->point_count, job, links))
        status = mw__fail_memory(error);
    mw__job_part_end(job, outer);
    return status;
}

static mw_status mesh_fill(mw_mesh *mesh, const mw_arrays *arrays, const mw_mesh_options *options,
                           mw_job *job, mw_error *error)
{
    bool lay_out = !mesh->tolerant && (options->layout == 1 ||
                                       (options->layout == 0 && mw__arrays_are_scattered(arrays)));
    mw_links links = mw__no_links();
    mw_status status = lay_out ? mw__mesh_lay_out(mesh, arrays, job, &links, error)
                               : mesh_copy_arrays(mesh, arrays, job, &links, error);
    if (status) return status;
    mesh->opposite = links.opposite;
    mesh->border_count = (uint32_t)(3 * (uint64_t)mesh->tri_count - links.linked);
    return links.extra == MW_NONE || mesh->tolerant
               ? MW_OK
               : mesh_refuse_non_manifold_edge(mesh, links.extra, error);
}

mw_status mw__mesh_create(const mw_arrays *arrays, const mw_mesh_options *options, mw_job *job,
                          mw_mesh **out, mw_error *error)
{
    if (options->layout < 0 || options->layout > 2)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown layout");
    mw_status status = MW_RESERVED_CHECK(mw_mesh_options, options, error);
    if (!status) status = mw__arrays_validate(arrays, 2, error);
    if (status) return status;
    mw_mesh *mesh = mw__calloc(1, sizeof *mesh);
    if (!mesh) return mw__fail_memory(error);
    mesh->tolerant = options->tolerant;
    mesh->point_count = (uint32_t)arrays->point_count;
    mesh->tri_count = (uint32_t)arrays->triangle_count;
    status = mesh_fill(mesh, arrays, options, job, error);
    if (status)
        mw_mesh_destroy(mesh);
    else
        *out = mesh;
    return status;
}

mw_status mw_mesh_create(const mw_arrays *arrays, const mw_mesh_options *options, mw_mesh **out,
                         mw_error *error)
{
    static const mw_mesh_options defaults;
    if (!options) options = &defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
    *out = NULL;
    mw_job job = mw__job(options->threads, options->progress);
    mw_status status = mw__job_end(&job, mw__mesh_create(arrays, options, &job, out, error), error);
    if (status) {
        mw_mesh_destroy(*out);
        *out = NULL;
    }
    return status;
}
