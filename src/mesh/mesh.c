/* mesh.c - a planar mesh from arrays: copies, orientation, neighbours, fields. */
#include "mesh/mesh.h"
#include "base/threads.h"
#include "mesh/layout.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

mw_status mw__check_arguments(const mw_arrays *arrays, size_t dimension, mw_error *error)
{
    if (!arrays || (!arrays->points && arrays->point_count) || (!arrays->triangles && arrays->triangle_count))
        return mw__fail(error, MW_ERROR_ARGUMENT, "arrays are missing");
    if (arrays->point_stride > 0 && arrays->point_stride < dimension)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a point stride of %zu holds no %c", arrays->point_stride,
                        arrays->point_stride == 1 ? 'y' : 'z');
    if (arrays->integer_type > MW_INT64) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown type of index");
    if (arrays->point_count > MW_MAX_VERTICES)
        return mw__fail(error, MW_ERROR_LIMIT, "%zu vertices, at most %" PRIu32 " are possible", arrays->point_count,
                        MW_MAX_VERTICES);
    if (arrays->triangle_count > MW_MAX_TRIANGLES)
        return mw__fail(error, MW_ERROR_LIMIT, "%zu triangles, at most %" PRIu32 " are possible",
                        arrays->triangle_count, MW_MAX_TRIANGLES);
    return MW_OK;
}

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

static bool is_finite(const mw_arrays *arrays, size_t dimension, uint32_t vertex)
{
    const double *p = arrays->points + vertex * (arrays->point_stride ? arrays->point_stride : dimension);
    return isfinite(p[0]) && isfinite(p[1]) && (dimension < 3 || isfinite(p[2]));
}

mw_status mw__copy_triangle(const mw_arrays *arrays, size_t dimension, bool tolerant, uint32_t t, mw_triangle *tri,
                            mw_error *error)
{
    for (size_t k = 0; k < 3; k++) {
        uint32_t v = mw__index_at(arrays, 3 * (size_t)t + k);
        if (v >= arrays->point_count)
            return mw__fail_at(error, t, -1, "triangle %" PRIu32 ": corner %zu is no vertex; there are %zu", t, k,
                               arrays->point_count);
        if (!tolerant && !is_finite(arrays, dimension, v))
            return mw__fail_at(error, t, v, "triangle %" PRIu32 ": vertex %" PRIu32 " is not finite", t, v);
        tri->v[k] = v;
        tri->link[k] = MW_NONE;
    }
    tri->v[3] = tri->v[0];
    tri->user = t;
    for (uint32_t k = 0; k < 3 && !tolerant; k++)
        if (tri->v[k] == tri->v[k + 1])
            return mw__fail_at(error, t, tri->v[k], "triangle %" PRIu32 ": vertex %" PRIu32 " stands in it twice", t,
                               tri->v[k]);
    return MW_OK;
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

mw_status mw__fail_shared(const mw_triangle *tri, uint32_t extra, uint32_t from, uint32_t to, mw_error *error)
{
    uint32_t user = tri[mw__link_triangle(extra)].user;
    return mw__fail_at(error, user & MW_USER_MASK, from,
                       "triangle %" PRIu32 ": two others share its edge %" PRIu32 ", from vertex %" PRIu32
                       " to %" PRIu32,
                       user & MW_USER_MASK, mw__user_edge(user, mw__link_edge(extra)), from, to);
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
    bool lay_out = !mesh->tolerant && (options->layout == MW_LAYOUT_HILBERT ||
                                       (options->layout == MW_LAYOUT_AUTO && mw__is_scattered(arrays)));
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
    if ((unsigned)options->layout > MW_LAYOUT_AS_GIVEN) return mw__fail(error, MW_ERROR_ARGUMENT, "unknown layout");
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

void mw_mesh_destroy(mw_mesh *mesh)
{
    if (!mesh) return;
    for (size_t i = 0; i < mesh->field_count; i++) {
        free(mesh->field[i].name);
        free(mesh->field[i].values);
    }
    free(mesh->field);
    free(mesh->tri);
    free(mesh->triangle_place);
    free(mesh->vertex_place);
    free(mesh->users_vertex);
    free(mesh->point);
    free(mesh);
}

uint32_t mw_mesh_vertex_count(const mw_mesh *mesh)
{
    return mesh->point_count;
}

uint32_t mw_mesh_triangle_count(const mw_mesh *mesh)
{
    return mesh->tri_count;
}

void mw_mesh_vertex(const mw_mesh *mesh, uint32_t vertex, double point[2])
{
    mw_point p = mesh->point[mw__vertex_place(mesh, vertex)];
    point[0] = p.x;
    point[1] = p.y;
}

void mw_mesh_triangle(const mw_mesh *mesh, uint32_t triangle, uint32_t vertices[3])
{
    const mw_triangle *t = &mesh->tri[mw__triangle_place(mesh, triangle)];
    for (uint32_t k = 0; k < 3; k++) vertices[mw__user_vertex(t->user, k)] = mw__users_vertex(mesh, t->v[k]);
}

uint32_t mw_mesh_neighbour(const mw_mesh *mesh, uint32_t triangle, unsigned local_edge, unsigned *edge)
{
    const mw_triangle *t = &mesh->tri[mw__triangle_place(mesh, triangle)];
    uint32_t link = t->link[mw__user_edge(t->user, local_edge)]; /* the exchange is its own inverse */
    if (link == MW_NONE) return MW_NONE;
    uint32_t user = mesh->tri[mw__link_triangle(link)].user;
    if (edge) *edge = mw__user_edge(user, mw__link_edge(link));
    return user & MW_USER_MASK;
}

size_t mw_mesh_bytes(const mw_mesh *mesh)
{
    size_t vertex = sizeof *mesh->point + mesh->field_count * sizeof(double), triangle = sizeof *mesh->tri;
    if (mesh->vertex_place) vertex += sizeof *mesh->vertex_place + sizeof *mesh->users_vertex;
    if (mesh->triangle_place) triangle += sizeof *mesh->triangle_place;
    return sizeof *mesh + mesh->point_count * vertex + mesh->tri_count * triangle +
           mesh->field_count * sizeof *mesh->field;
}
