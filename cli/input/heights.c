#include "cli/input/heights.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>

/* A vertex at the place of an earlier one, which stands for both in the mesh: each takes what only the other knows. */
static void share(const vertices *v, size_t added, const uint32_t *duplicate_of, vertex_value value)
{
    for (size_t i = v->points; i < added; i++) {
        if (duplicate_of[i] == MW_NONE) continue;
        double *own = &value.values[i * value.stride], *other = &value.values[duplicate_of[i] * value.stride];
        if (isnan(*other)) *other = *own;
    }
    for (size_t i = v->points; i < added; i++)
        if (duplicate_of[i] != MW_NONE && isnan(value.values[i * value.stride]))
            value.values[i * value.stride] = value.values[duplicate_of[i] * value.stride];
}

/* Which segment each added vertex lies on: the lowest one. */
static uint32_t *find_segments(size_t added, size_t count, const mw_constrained_edges *edges)
{
    uint32_t *segment = malloc((count + 1) * sizeof *segment);
    if (!segment) return NULL;
    for (size_t i = 0; i < count; i++) segment[i] = MW_NONE;
    for (size_t p = 0; p < 2 * edges->count; p++) {
        size_t i = edges->edge[p];
        if (i >= added && edges->segment[p / 2] < segment[i - added]) segment[i - added] = edges->segment[p / 2];
    }
    return segment;
}

/* How far from a to b the point p is, 0 to 1. */
static double part_of(const double *a, const double *b, const double *p)
{
    int k = fabs(b[0] - a[0]) < fabs(b[1] - a[1]);
    double part = (p[k] - a[k]) / (b[k] - a[k]);
    return part >= 0 && part <= 1 ? part : 0.5;
}

/* Added vertices on segments that have a value at both ends. */
static void along_segments(const vertices *v, size_t added, const uint32_t *segment_of, const uint32_t *segments,
                           vertex_value value)
{
    const double *points = v->file.points;
    for (size_t i = added; i < v->file.point_count; i++) {
        if (segment_of[i - added] == MW_NONE) continue;
        const uint32_t *end = segments + 2 * (size_t)segment_of[i - added];
        double a = value.values[end[0] * value.stride], b = value.values[end[1] * value.stride];
        double t = part_of(points + 3 * (size_t)end[0], points + 3 * (size_t)end[1], points + 3 * i);
        value.values[i * value.stride] = (1 - t) * a + t * b;
    }
}

/* POINTS, triangulated, and where the other vertices lie there. */
typedef struct surface {
    mw_mesh *mesh;
    mw_locator *locator;
    mw_location *place; /* of each vertex beyond POINTS; outside, the nearest place of the border */
} surface;

static void release(surface *s)
{
    free(s->place);
    mw_locator_destroy(s->locator);
    mw_mesh_destroy(s->mesh);
}

static mw_status locate(surface *s, const vertices *v, mw_error *error)
{
    size_t count = v->file.point_count - v->points;
    const double *points = v->file.points + 3 * v->points;
    mw_status status = mw_locate_batch(s->locator, points, count, 3, NULL, s->place, NULL, error);
    for (size_t i = 0; status == MW_OK && i < count; i++) {
        mw_nearest_border_point hit;
        if (s->place[i].triangle != MW_NONE) continue;
        status = mw_nearest_border(s->locator, points[3 * i], points[3 * i + 1], &hit, error);
        if (status == MW_OK)
            s->place[i] =
                (mw_location){.triangle = hit.triangle, .weight = {hit.weight[0], hit.weight[1], hit.weight[2]}};
    }
    return status;
}

/* *flat: POINTS have no triangle to interpolate in. Returns 0 or an exit code. */
static int make_surface(surface *s, const vertices *v, bool *flat)
{
    mw_error error;
    mw_locator_options options = {.border = 1};
    size_t count = v->file.point_count - v->points;
    progress_phase("interpolating", NULL);
    mw_status status = mw_delaunay(v->file.points, v->points, 3, NULL, NULL, NULL, &s->mesh, &error);
    *flat = status == MW_ERROR_INPUT;
    if (*flat) return 0;
    if (status == MW_OK) status = mw_locator_create(s->mesh, &options, &s->locator, &error);
    if (status == MW_OK && !(s->place = malloc((count + 1) * sizeof *s->place))) return fail_memory();
    if (status == MW_OK) status = locate(s, v, &error);
    return status == MW_OK ? 0 : fail_reading(&error);
}

static void interpolate(const surface *s, const vertices *v, vertex_value value)
{
    for (size_t i = v->points; i < v->file.point_count; i++) {
        const mw_location *place = &s->place[i - v->points];
        uint32_t corner[3];
        double sum = 0;
        if (!isnan(value.values[i * value.stride])) continue;
        mw_mesh_triangle(s->mesh, place->triangle, corner);
        for (int k = 0; k < 3; k++)
            if (place->weight[k] != 0) sum += place->weight[k] * value.values[corner[k] * value.stride];
        value.values[i * value.stride] = sum;
    }
}

static bool lacks(const vertices *v, vertex_value value)
{
    if (!value.in_points) return false;
    for (size_t i = v->points; i < v->file.point_count; i++)
        if (isnan(value.values[i * value.stride])) return true;
    return false;
}

static int interpolate_all(const vertices *v, bool *flat)
{
    surface s = {0};
    bool made = false;
    int end = 0;
    for (size_t k = 0; k < vertices_value_count(v) && end == 0 && !*flat; k++) {
        vertex_value value = vertices_value(v, k);
        if (!lacks(v, value)) continue;
        if (!made) end = make_surface(&s, v, flat);
        made = true;
        if (end == 0 && !*flat) interpolate(&s, v, value);
    }
    release(&s);
    return end;
}

int heights_fill(vertices *v, size_t added, const uint32_t *duplicate_of, const uint32_t *segments,
                 const mw_constrained_edges *edges, bool *flat)
{
    *flat = false;
    mw_mesh_file *file = &v->file;
    uint32_t *segment_of = find_segments(added, file->point_count - added, edges);
    if (!segment_of) return fail_memory();
    for (size_t k = 0; k < vertices_value_count(v); k++) {
        vertex_value value = vertices_value(v, k);
        share(v, added, duplicate_of, value);
        along_segments(v, added, segment_of, segments, value);
    }
    free(segment_of);
    for (size_t i = 0; !file->has_z && i < file->point_count; i++) file->points[3 * i + 2] = 0;
    return interpolate_all(v, flat);
}
