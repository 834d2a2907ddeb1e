/* mesh_create.c - a planar mesh from arrays: copies, orientation, neighbours. */
#include "base/threads.h"
#include "mesh/arrays.h"
#include "mesh/connect.h"
#include "mesh/layout.h"

enum { WORTHWHILE = 1 << 14 }; /* vertices or triangles for a thread to be worth it */

static void copy_points(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads)
{
    size_t stride = arrays->point_stride ? arrays->point_stride : 2;
    int team = mw__team(threads, mesh->point_count / WORTHWHILE + 1);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
#endif
    for (size_t i = 0; i < arrays->point_count; i++)
        mesh->point[i] = (mw_point){arrays->points[i * stride], arrays->points[i * stride + 1]};
}

/* Store the triangle counter-clockwise. Returns its area (twice, rounded, of the right sign) as it was given. */
static double orient(const mw_mesh *mesh, mw_triangle *t)
{
    mw_point a = mesh->point[t->v[0]], b = mesh->point[t->v[1]], c = mesh->point[t->v[2]];
    double area = mw__is_finite(a) && mw__is_finite(b) && mw__is_finite(c) ? mw__orient2d(a, b, c) : 0;
    if (area >= 0) return area;
    uint32_t v = t->v[1];
    t->v[1] = t->v[2];
    t->v[2] = v;
    t->user |= MW_FLIPPED;
    return area;
}

/* All of them, counter-clockwise; count those that were clockwise, and those without area. */
static mw_status copy_triangles(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_error *error)
{
    uint32_t flat = 0, flipped = 0, bad = MW_NONE;
    int team = mw__team(threads, mesh->tri_count / WORTHWHILE + 1);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1) reduction(+ : flat, flipped) reduction(min : bad)
#endif
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        if (mw__copy_triangle(arrays, 2, mesh->tolerant, t, &mesh->tri[t], NULL)) {
            bad = t < bad ? t : bad;
            continue;
        }
        double area = orient(mesh, &mesh->tri[t]);
        flat += area == 0;
        flipped += area < 0;
    }
    mesh->flat_count = flat;
    mesh->flipped_count = flipped;
    return bad == MW_NONE ? MW_OK : mw__copy_triangle(arrays, 2, mesh->tolerant, bad, &mesh->tri[bad], error);
}

static mw_status refuse_shared(const mw_mesh *mesh, uint32_t extra, mw_error *error)
{
    const uint32_t *v = &mesh->tri[mw__link_triangle(extra)].v[mw__link_edge(extra)];
    return mw__fail_shared(mesh->tri, extra, mw__users_vertex(mesh, v[0]), mw__users_vertex(mesh, v[1]), error);
}

/* In the order of the arrays. */
static mw_status copy_arrays(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_links *links, mw_error *error)
{
    mesh->point = mw__alloc_lines(mesh->point_count, sizeof *mesh->point);
    mesh->tri = mw__alloc_lines(mesh->tri_count, sizeof *mesh->tri);
    if (!mesh->point || !mesh->tri) return mw__fail_memory(error);
    copy_points(mesh, arrays, threads);
    mw_status status = copy_triangles(mesh, arrays, threads, error);
    if (!status && !mw__connect(mesh->tri, mesh->tri_count, mesh->point_count, threads, links))
        status = mw__fail_memory(error);
    return status;
}

static mw_status fill(mw_mesh *mesh, const mw_arrays *arrays, const mw_mesh_options *options, mw_error *error)
{
    bool lay_out = !mesh->tolerant && (options->layout == 1 || (options->layout == 0 && mw__is_scattered(arrays)));
    mw_links links = mw__no_links();
    mw_status status = lay_out ? mw__lay_out(mesh, arrays, options->threads, &links, error)
                               : copy_arrays(mesh, arrays, options->threads, &links, error);
    if (status) return status;
    mesh->opposite = links.opposite;
    mesh->border_count = (uint32_t)(3 * (uint64_t)mesh->tri_count - links.linked);
    return links.extra == MW_NONE || mesh->tolerant ? MW_OK : refuse_shared(mesh, links.extra, error);
}

mw_status mw_mesh_create(const mw_arrays *arrays, const mw_mesh_options *options, mw_mesh **out, mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the mesh");
    *out = NULL;
    static const mw_mesh_options defaults;
    if (!options) options = &defaults;
    if (options->layout < 0 || options->layout > 2) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown layout");
    mw_status status = mw__check_arguments(arrays, 2, error);
    if (status) return status;
    mw_mesh *mesh = mw__calloc(1, sizeof *mesh);
    if (!mesh) return mw__fail_memory(error);
    mesh->tolerant = options->tolerant;
    mesh->point_count = (uint32_t)arrays->point_count;
    mesh->tri_count = (uint32_t)arrays->triangle_count;
    status = fill(mesh, arrays, options, error);
    if (status)
        mw_mesh_destroy(mesh);
    else
        *out = mesh;
    return status;
}
