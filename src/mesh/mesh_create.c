/* mesh_create.c - makes a planar mesh from arrays: copies, orientation, neighbours. */
#include "base/threads.h"
#include "base/options.h"
#include "mesh/arrays.h"
#include "mesh/connect.h"
#include "mesh/layout.h"

enum { WORTHWHILE = 1 << 14 }; /* vertices or triangles that make a thread worthwhile */

static void mesh_copy_points(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads)
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

/* Store the triangle counter-clockwise. Returns its signed area as the user gave it: twice the
 * area, rounded, with the exact sign. */
static double triangle_orient(const mw_mesh *mesh, mw_triangle *t)
{
    mw_point a = mesh->point[t->v[0]], b = mesh->point[t->v[1]], c = mesh->point[t->v[2]];
    double area = mw__is_finite(a) && mw__is_finite(b) && mw__is_finite(c) ? mw__orient2d(a, b, c) : 0;
    if (area >= 0) return area;
    uint32_t v = t->v[1];
    t->v[1] = t->v[2];
    t->v[2] = v;
    t->user |= MW_REVERSED;
    return area;
}

/* Copy all triangles, counter-clockwise. Count those that were clockwise, and those without
 * area. */
static mw_status mesh_copy_triangles(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_error *error)
{
    uint32_t flat = 0, reversed = 0, bad = MW_NONE;
    int team = mw__team(threads, mesh->tri_count / WORTHWHILE + 1);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1) reduction(+ : flat, reversed) reduction(min : bad)
#endif
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        if (mw__copy_triangle(arrays, 2, mesh->tolerant, t, &mesh->tri[t], NULL)) {
            bad = t < bad ? t : bad;
            continue;
        }
        double area = triangle_orient(mesh, &mesh->tri[t]);
        flat += area == 0;
        reversed += area < 0;
    }
    mesh->flat_count = flat;
    mesh->reversed_count = reversed;
    return bad == MW_NONE ? MW_OK : mw__copy_triangle(arrays, 2, mesh->tolerant, bad, &mesh->tri[bad], error);
}

static mw_status mesh_refuse_non_manifold_edge(const mw_mesh *mesh, uint32_t extra, mw_error *error)
{
    const uint32_t *v = &mesh->tri[mw__link_triangle(extra)].v[mw__link_edge(extra)];
    return mw__fail_non_manifold_edge(mesh->tri, extra, mw__vertex_number(mesh, v[0]), mw__vertex_number(mesh, v[1]),
                                      error);
}

/* Keep the order of the arrays. */
static mw_status mesh_copy_arrays(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_links *links,
                                  mw_error *error)
{
    mesh->point = mw__alloc_lines(mesh->point_count, sizeof *mesh->point);
    mesh->tri = mw__alloc_lines(mesh->tri_count, sizeof *mesh->tri);
    if (!mesh->point || !mesh->tri) return mw__fail_memory(error);
    mesh_copy_points(mesh, arrays, threads);
    mw_status status = mesh_copy_triangles(mesh, arrays, threads, error);
    if (!status && !mw__connect(mesh->tri, mesh->tri_count, mesh->point_count, threads, links))
        status = mw__fail_memory(error);
    return status;
}

static mw_status mesh_fill(mw_mesh *mesh, const mw_arrays *arrays, const mw_mesh_options *options, mw_error *error)
{
    bool lay_out =
        !mesh->tolerant && (options->layout == 1 || (options->layout == 0 && mw__arrays_are_scattered(arrays)));
    mw_links links = mw__no_links();
    mw_status status = lay_out ? mw__mesh_lay_out(mesh, arrays, options->threads, &links, error)
                               : mesh_copy_arrays(mesh, arrays, options->threads, &links, error);
    if (status) return status;
    mesh->opposite = links.opposite;
    mesh->border_count = (uint32_t)(3 * (uint64_t)mesh->tri_count - links.linked);
    return links.extra == MW_NONE || mesh->tolerant ? MW_OK : mesh_refuse_non_manifold_edge(mesh, links.extra, error);
}

mw_status mw_mesh_create(const mw_arrays *arrays, const mw_mesh_options *options, mw_mesh **out, mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the mesh");
    *out = NULL;
    static const mw_mesh_options defaults;
    if (!options) options = &defaults;
    if (options->layout < 0 || options->layout > 2) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown layout");
    mw_status status = MW_RESERVED_CHECK(mw_mesh_options, options, error);
    if (!status) status = mw__arrays_validate(arrays, 2, error);
    if (status) return status;
    mw_mesh *mesh = mw__calloc(1, sizeof *mesh);
    if (!mesh) return mw__fail_memory(error);
    mesh->tolerant = options->tolerant;
    mesh->point_count = (uint32_t)arrays->point_count;
    mesh->tri_count = (uint32_t)arrays->triangle_count;
    status = mesh_fill(mesh, arrays, options, error);
    if (status)
        mw_mesh_destroy(mesh);
    else
        *out = mesh;
    return status;
}
