/* layout.c - orders vertices along a Hilbert curve, and triangles by their lowest vertex. O(n).
 *
 * Triangles are distributed to buckets by ranges of their lowest vertices (buckets.c). Then each
 * range is sorted and linked in cache (partitions.c). */
#include "mesh/layout.h"

#include "mesh/arrays.h"
#include "mesh/point_order.h"
#include "mesh/partitions.h"

#include <stdlib.h>

enum {
    AHEAD = 16, /* points: how far ahead memory is asked for */
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

typedef struct point_setting {
    mw_mesh *mesh;
    const mw_point *given;
    const uint32_t *order;
} point_setting;

static void points_set(void *work, uint64_t from, uint64_t to)
{
    const point_setting *s = work;
    const uint32_t *order = s->order;
    uint64_t n = s->mesh->point_count;
    for (uint64_t i = from; i < to; i++) {
        if (order && i + AHEAD < n) __builtin_prefetch(&s->given[order[i + AHEAD]]);
        s->mesh->point[i] = s->given[order ? order[i] : i];
        if (order) s->mesh->vertex_slot[order[i]] = (uint32_t)i;
    }
}

bool mw__mesh_set_points(mw_mesh *mesh, const mw_point *given, uint32_t *order, mw_job *job)
{
    uint32_t n = mesh->point_count;
    mesh->vertex_number = order;
    mesh->point = mw__alloc_lines(n, sizeof *mesh->point);
    mesh->vertex_slot = order ? mw__alloc_lines(n, sizeof *mesh->vertex_slot) : NULL;
    if (!mesh->point || (order && !mesh->vertex_slot)) return false;
    point_setting setting = {mesh, given, order};
    return mw__job_ranges(job, n, points_set, &setting);
}

bool mw__mesh_lay_out_vertices(mw_mesh *mesh, mw_job *job)
{
    if (mesh->vertex_number || !mw__points_are_scattered(mesh->point, mesh->point_count))
        return true;
    uint32_t *order = mw__alloc_lines(mesh->point_count, sizeof *order);
    mw_job_span outer = mw__job_part(job, 0.7);
    bool ordered = order && mw__points_order(mesh->point, mesh->point_count, job, order);
    mw__job_part_end(job, outer);
    if (!ordered) {
        free(order);
        return false;
    }
    mw_point *given = mesh->point;
    mw__job_stage(job, "copying points", 0.3);
    bool done = mw__mesh_set_points(mesh, given, order, job);
    for (uint32_t t = 0; t < mesh->tri_count && done; t++)
        for (int k = 0; k < 4; k++) mesh->tri[t].v[k] = mesh->vertex_slot[mesh->tri[t].v[k]];
    free(given);
    return done;
}

/* --- all --- */

typedef struct layout_work {
    mw_mesh *mesh;
    const mw_arrays *arrays;
    mw_job *job;
    bool all_finite;
    void *scratch; /* for keys, then for buckets */
    mw_buckets buckets;
} layout_work;

typedef struct point_reading {
    const double *from;
    size_t stride;
    mw_point *to;
} point_reading;

static void points_read(void *work, uint64_t from, uint64_t to)
{
    const point_reading *r = work;
    for (uint64_t i = from; i < to; i++)
        r->to[i] = (mw_point){r->from[i * r->stride], r->from[i * r->stride + 1]};
}

const mw_point *mw__points_read(const double *from, size_t stride, uint32_t n, mw_job *job,
                                mw_point **copy)
{
    *copy = NULL;
    if (stride == 0 || stride == 2) return (const mw_point *)from;
    *copy = mw__alloc_lines(n, sizeof **copy);
    point_reading reading = {from, stride, *copy};
    return *copy && mw__job_ranges(job, n, points_read, &reading) ? *copy : NULL;
}

typedef struct point_copying {
    mw_mesh *mesh;
    const mw_point *given;
    const mw_key *order;
} point_copying;

/* Copy the points in their new order; set slots and numbers. */
static void points_copy(void *work, uint64_t from, uint64_t to)
{
    const point_copying *c = work;
    mw_mesh *mesh = c->mesh;
    uint64_t n = mesh->point_count;
    for (uint64_t i = from; i < to; i++) {
        if (i + AHEAD < n) {
            __builtin_prefetch(&c->given[c->order[i + AHEAD].item]);
            __builtin_prefetch(&mesh->vertex_slot[c->order[i + AHEAD].item], 1);
        }
        mesh->point[i] = c->given[c->order[i].item];
        mesh->vertex_number[i] = c->order[i].item;
        mesh->vertex_slot[c->order[i].item] = (uint32_t)i;
    }
}

static bool layout_vertices(layout_work *l)
{
    mw_mesh *mesh = l->mesh;
    uint32_t n = mesh->point_count;
    mesh->point = mw__alloc_lines(n, sizeof *mesh->point);
    mesh->vertex_number = mw__alloc_lines(n, sizeof *mesh->vertex_number);
    mesh->vertex_slot = mw__alloc_lines(n, sizeof *mesh->vertex_slot);
    if (!mesh->point || !mesh->vertex_number || !mesh->vertex_slot) return false;
    mw_point *copy;
    mw_key *keys = l->scratch;
    mw__job_stage(l->job, "reading points", 0.05);
    const mw_point *given =
        mw__points_read(l->arrays->points, l->arrays->point_stride, n, l->job, &copy);
    bool done = given || n == 0;
    if (done) {
        mw__job_stage(l->job, "measuring the extent", 0.05);
        mw_extent extent = mw__points_extent(given, n, l->job, &l->all_finite);
        mw_job_span outer = mw__job_part(l->job, 0.3);
        done = mw__points_sort(given, n, &extent, l->job, keys, keys + n);
        mw__job_part_end(l->job, outer);
    }
    mw__job_stage(l->job, "copying points", 0.1);
    point_copying copying = {mesh, given, keys};
    done = done && mw__job_ranges(l->job, n, points_copy, &copying);
    free(copy);
    return done;
}

static void layout_choose_buckets(layout_work *l)
{
    mw_buckets *p = &l->buckets;
    *p = (mw_buckets){.shift = PARTITION_SHIFT,
                      .writers = mw__job_team(l->job, MOST_THREADS),
                      .triangle_count = l->mesh->tri_count};
    while (l->mesh->point_count >> p->shift >= MOST_PARTITIONS) p->shift++;
    p->ranges = (l->mesh->point_count >> p->shift) + 1;
}

static bool layout_allocate(layout_work *l)
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

mw_status mw__mesh_lay_out(mw_mesh *mesh, const mw_arrays *arrays, mw_job *job, mw_links *links,
                           mw_error *error)
{
    layout_work l = {.mesh = mesh, .arrays = arrays, .job = job};
    layout_choose_buckets(&l);
    uint32_t bad = MW_NONE;
    bool done = layout_allocate(&l) && layout_vertices(&l) &&
                mw__buckets_fill(&l.buckets, mesh, arrays, l.all_finite, job, &bad) &&
                (bad != MW_NONE || mw__partitions_build(mesh, &l.buckets, job, links));
    mw__buckets_release(&l.buckets);
    free(l.scratch);
    if (!done) return mw__fail_memory(error);
    return bad == MW_NONE ? MW_OK : mw__copy_triangle(arrays, 2, false, bad, &mesh->tri[0], error);
}
