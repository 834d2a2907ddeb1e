/* layout.c - orders vertices along a Hilbert curve, and triangles by their lowest vertex. O(n).
 *
 * Triangles are distributed to buckets by ranges of their lowest vertices (buckets.c). Then each
 * range is sorted and linked in cache (partitions.c). */
#include "mesh/layout.h"

#include "base/threads.h"
#include "mesh/arrays.h"
#include "mesh/point_order.h"
#include "mesh/partitions.h"

#include <stdlib.h>

enum {
    MOST_THREADS = 64,
    PARTITION_SHIFT = 12,     /* a range has at least 2^12 vertices */
    MOST_PARTITIONS = 1 << 12 /* so that the caches can hold the ends of all */
};

/* --- is it worth it? --- */

static bool are_far(uint32_t a, uint32_t b)
{
    enum { FAR = 4096 };
    return (a > b ? a - b : b - a) > FAR;
}

/* A walk goes from triangle to triangle, and the arrays do not tell neighbours. But neighbours
 * share vertices, and in a good order consecutive triangles have vertices with close numbers. */
bool mw__arrays_are_scattered(const mw_arrays *arrays)
{
    enum { SMALL = 1 << 14, PROBES = 4096 };
    size_t n = arrays->triangle_count, stride = n / PROBES + 1, edges = 0, far = 0;
    if (n < SMALL) return false; /* fits into the cache in any order */
    for (size_t t = 0; t + 1 < n; t += stride) {
        uint32_t v[4];
        for (size_t k = 0; k < 4; k++) v[k] = mw__index_at(arrays, 3 * t + k);
        edges += 3;
        far += (size_t)are_far(v[0], v[1]) + are_far(v[1], v[2]) + are_far(v[0], v[3]);
    }
    return far > edges / 4;
}

bool mw__points_are_scattered(const mw_point *points, uint32_t n)
{
    enum { SMALL = 1 << 14, PROBES = 4096 };
    if (n < SMALL) return false;
    uint32_t stride = n / PROBES + 1, jumps = 0, probes = 0;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < n; i += stride) {
        const double p[2] = {points[i].x, points[i].y};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
    double far = 16 * sqrt((high[0] - low[0]) / n * (high[1] - low[1]));
    for (uint32_t i = 0; i + 1 < n; i += stride, probes++)
        jumps += !(fabs(points[i].x - points[i + 1].x) + fabs(points[i].y - points[i + 1].y) < far);
    return jumps > probes / 4;
}

/* --- vertices --- */

bool mw__mesh_set_points(mw_mesh *mesh, const mw_point *given, uint32_t *order, uint32_t threads)
{
    enum { AHEAD = 16, WORTHWHILE = 1 << 14 };
    uint32_t n = mesh->point_count;
    mesh->vertex_number = order;
    mesh->point = mw__alloc_lines(n, sizeof *mesh->point);
    mesh->vertex_slot = order ? mw__alloc_lines(n, sizeof *mesh->vertex_slot) : NULL;
    if (!mesh->point || (order && !mesh->vertex_slot)) return false;
    int team = mw__team(threads, n / WORTHWHILE + 1);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
#endif
    for (uint32_t i = 0; i < n; i++) {
        if (order && i + AHEAD < n) __builtin_prefetch(&given[order[i + AHEAD]]);
        mesh->point[i] = given[order ? order[i] : i];
        if (order) mesh->vertex_slot[order[i]] = i;
    }
    return true;
}

bool mw__mesh_lay_out_vertices(mw_mesh *mesh, uint32_t threads)
{
    if (mesh->vertex_number || !mw__points_are_scattered(mesh->point, mesh->point_count)) return true;
    uint32_t *order = mw__alloc_lines(mesh->point_count, sizeof *order);
    if (!order || !mw__points_order(mesh->point, mesh->point_count, threads, order)) {
        free(order);
        return false;
    }
    mw_point *given = mesh->point;
    bool done = mw__mesh_set_points(mesh, given, order, threads);
    for (uint32_t t = 0; t < mesh->tri_count && done; t++)
        for (int k = 0; k < 4; k++) mesh->tri[t].v[k] = mesh->vertex_slot[mesh->tri[t].v[k]];
    free(given);
    return done;
}

/* --- all --- */

typedef struct mesh_layout {
    mw_mesh *mesh;
    const mw_arrays *arrays;
    uint32_t threads;
    int team;
    bool all_finite;
    void *scratch; /* for keys, then for buckets */
    mw_buckets buckets;
} mesh_layout;

/* The points of the arrays: the caller's own array if it is packed. *copy is to be released. */
static const mw_point *layout_read_points(const mesh_layout *l, mw_point **copy)
{
    uint32_t n = l->mesh->point_count;
    size_t stride = l->arrays->point_stride;
    const double *from = l->arrays->points;
    *copy = NULL;
    if (stride == 0 || stride == 2) return (const mw_point *)from;
    *copy = mw__alloc_lines(n, sizeof **copy);
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(l->team) if (l->team > 1)
#endif
    for (uint32_t i = 0; i < n; i++)
        if (*copy) (*copy)[i] = (mw_point){from[i * stride], from[i * stride + 1]};
    return *copy;
}

/* Copy the points in their new order; set slots and numbers. */
static void layout_copy_points(const mesh_layout *l, const mw_point *given, const mw_key *order)
{
    enum { AHEAD = 16 };
    mw_mesh *mesh = l->mesh;
    uint32_t n = mesh->point_count;
#ifdef _OPENMP
#pragma omp parallel for schedule(static) num_threads(l->team) if (l->team > 1)
#endif
    for (uint32_t i = 0; i < n; i++) {
        if (i + AHEAD < n) {
            __builtin_prefetch(&given[order[i + AHEAD].item]);
            __builtin_prefetch(&mesh->vertex_slot[order[i + AHEAD].item], 1);
        }
        mesh->point[i] = given[order[i].item];
        mesh->vertex_number[i] = order[i].item;
        mesh->vertex_slot[order[i].item] = i;
    }
}

static bool layout_vertices(mesh_layout *l)
{
    mw_mesh *mesh = l->mesh;
    uint32_t n = mesh->point_count;
    mesh->point = mw__alloc_lines(n, sizeof *mesh->point);
    mesh->vertex_number = mw__alloc_lines(n, sizeof *mesh->vertex_number);
    mesh->vertex_slot = mw__alloc_lines(n, sizeof *mesh->vertex_slot);
    if (!mesh->point || !mesh->vertex_number || !mesh->vertex_slot) return false;
    mw_point *copy;
    mw_key *keys = l->scratch;
    const mw_point *given = layout_read_points(l, &copy);
    bool done = given || n == 0;
    if (done) {
        mw_extent extent = mw__points_extent(given, n, l->threads, &l->all_finite);
        done = mw__points_sort(given, n, &extent, l->threads, keys, keys + n);
    }
    if (done) layout_copy_points(l, given, keys);
    free(copy);
    return done;
}

static void layout_choose_buckets(mesh_layout *l)
{
    mw_buckets *p = &l->buckets;
    *p = (mw_buckets){.shift = PARTITION_SHIFT, .writers = (uint32_t)l->team, .triangle_count = l->mesh->tri_count};
    while (l->mesh->point_count >> p->shift >= MOST_PARTITIONS) p->shift++;
    p->ranges = (l->mesh->point_count >> p->shift) + 1;
}

static bool layout_allocate(mesh_layout *l)
{
    mw_mesh *mesh = l->mesh;
    size_t keys = 2 * (size_t)mesh->point_count * sizeof(mw_key),
           buckets = mw__buckets_capacity(&l->buckets) * sizeof(mw_raw_triangle);
    l->scratch = mw__alloc_lines(keys > buckets ? keys : buckets, 1);
    mesh->tri = mw__alloc_lines(mesh->tri_count, sizeof *mesh->tri);
    mesh->triangle_slot = mw__alloc_lines(mesh->tri_count, sizeof *mesh->triangle_slot);
    l->buckets.raw = l->scratch;
    return l->scratch && mesh->tri && mesh->triangle_slot;
}

mw_status mw__mesh_lay_out(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_links *links, mw_error *error)
{
    mesh_layout l = {.mesh = mesh, .arrays = arrays, .threads = threads, .team = mw__team(threads, MOST_THREADS)};
    layout_choose_buckets(&l);
    uint32_t bad = MW_NONE;
    bool done = layout_allocate(&l) && layout_vertices(&l) &&
                mw__buckets_fill(&l.buckets, mesh, arrays, l.all_finite, &bad) &&
                (bad != MW_NONE || mw__partitions_build(mesh, &l.buckets, links));
    mw__buckets_release(&l.buckets);
    free(l.scratch);
    if (!done) return mw__fail_memory(error);
    return bad == MW_NONE ? MW_OK : mw__copy_triangle(arrays, 2, false, bad, &mesh->tri[0], error);
}
