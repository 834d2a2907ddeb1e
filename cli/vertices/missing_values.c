#include "cli/vertices/missing_values.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>

/* A duplicate of an earlier vertex, which stands for both in the mesh, and that vertex: each takes
 * the value of the other if it has none. */
static void coincident_share_values(const vertex_table *v, size_t added,
                                    const uint32_t *duplicate_of, vertex_field field)
{
    for (size_t i = v->points; i < added; i++) {
        if (duplicate_of[i] == MW_NONE) continue;
        double *own = &field.values[i * field.stride],
               *other = &field.values[duplicate_of[i] * field.stride];
        if (isnan(*other)) *other = *own;
    }
    for (size_t i = v->points; i < added; i++)
        if (duplicate_of[i] != MW_NONE && isnan(field.values[i * field.stride]))
            field.values[i * field.stride] = field.values[duplicate_of[i] * field.stride];
}

/* The lowest segment that each added vertex lies on. */
static uint32_t *segments_of_added(size_t added, size_t count, const mw_constrained_edges *edges)
{
    uint32_t *segment = malloc((count + 1) * sizeof *segment);
    if (!segment) return NULL;
    for (size_t i = 0; i < count; i++) segment[i] = MW_NONE;
    for (size_t p = 0; p < 2 * edges->count; p++) {
        size_t i = edges->edge[p];
        if (i >= added && edges->segment[p / 2] < segment[i - added])
            segment[i - added] = edges->segment[p / 2];
    }
    return segment;
}

/* How far p is on the way from a to b, from 0 to 1. */
static double fraction_along(const double *a, const double *b, const double *p)
{
    int k = fabs(b[0] - a[0]) < fabs(b[1] - a[1]);
    double part = (p[k] - a[k]) / (b[k] - a[k]);
    return part >= 0 && part <= 1 ? part : 0.5;
}

/* Interpolate added vertices along their segments. A vertex stays NaN if an end of its segment
 * is. */
static void segments_interpolate(const vertex_table *v, size_t added, const uint32_t *segment_of,
                                 const uint32_t *segments, vertex_field field)
{
    const double *points = v->file.points;
    for (size_t i = added; i < v->file.point_count; i++) {
        if (segment_of[i - added] == MW_NONE) continue;
        const uint32_t *end = segments + 2 * (size_t)segment_of[i - added];
        double a = field.values[end[0] * field.stride], b = field.values[end[1] * field.stride];
        double t = fraction_along(points + 3 * (size_t)end[0], points + 3 * (size_t)end[1],
                                  points + 3 * i);
        field.values[i * field.stride] = (1 - t) * a + t * b;
    }
}

/* The Delaunay triangulation of POINTS, and where the other vertices lie in it. */
typedef struct triangulated_points {
    uint32_t threads;
    mw_mesh *mesh;
    mw_locator *locator;
    /* of each vertex not from POINTS; outside, of the nearest border point */
    mw_location *location;
} triangulated_points;

static void triangulated_points_release(triangulated_points *s)
{
    free(s->location);
    mw_locator_destroy(s->locator);
    mw_mesh_destroy(s->mesh);
}

static mw_status triangulated_points_locate(triangulated_points *s, const vertex_table *v,
                                            mw_error *error)
{
    size_t count = v->file.point_count - v->points;
    const double *points = v->file.points + 3 * v->points;
    mw_query_options options = {.threads = s->threads, .progress = progress_of_call()};
    mw_status status =
        mw_locate_batch(s->locator, points, count, 3, &options, s->location, NULL, error);
    for (size_t i = 0; status == MW_OK && i < count; i++) {
        mw_nearest_border_point hit;
        if (s->location[i].triangle != MW_NONE) continue;
        status = mw_nearest_border(s->locator, points[3 * i], points[3 * i + 1], &hit, error);
        if (status == MW_OK)
            s->location[i] = (mw_location){.triangle = hit.triangle,
                                           .weight = {hit.weight[0], hit.weight[1], hit.weight[2]}};
    }
    return status;
}

/* Sets *on_a_line if POINTS have no triangle to interpolate in. Returns 0 or an exit code. */
static int triangulated_points_make(triangulated_points *s, const vertex_table *v, bool *on_a_line)
{
    mw_error error;
    mw_delaunay_options delaunay = {.threads = s->threads, .progress = progress_of_call()};
    mw_locator_options options = {
        .border = 1, .threads = s->threads, .progress = progress_of_call()};
    size_t count = v->file.point_count - v->points;
    progress_phase("interpolating", NULL);
    mw_status status =
        mw_delaunay(v->file.points, v->points, 3, &delaunay, NULL, NULL, &s->mesh, &error);
    *on_a_line = status == MW_ERROR_INPUT;
    if (*on_a_line) return 0;
    if (status == MW_OK) status = mw_locator_create(s->mesh, &options, &s->locator, &error);
    if (status == MW_OK && !(s->location = malloc((count + 1) * sizeof *s->location)))
        return fail_memory();
    if (status == MW_OK) status = triangulated_points_locate(s, v, &error);
    return status == MW_OK ? 0 : fail_reading(&error);
}

static void triangulated_points_interpolate(const triangulated_points *s, const vertex_table *v,
                                            vertex_field field)
{
    for (size_t i = v->points; i < v->file.point_count; i++) {
        const mw_location *location = &s->location[i - v->points];
        uint32_t corner[3];
        double sum = 0;
        if (!isnan(field.values[i * field.stride])) continue;
        mw_mesh_triangle(s->mesh, location->triangle, corner);
        for (int k = 0; k < 3; k++)
            if (location->weight[k] != 0)
                sum += location->weight[k] * field.values[corner[k] * field.stride];
        field.values[i * field.stride] = sum;
    }
}

static bool field_has_missing(const vertex_table *v, vertex_field field)
{
    if (!field.in_points) return false;
    for (size_t i = v->points; i < v->file.point_count; i++)
        if (isnan(field.values[i * field.stride])) return true;
    return false;
}

static int missing_values_interpolate(const vertex_table *v, uint32_t threads, bool *on_a_line)
{
    triangulated_points s = {.threads = threads};
    bool made = false;
    int end = 0;
    for (size_t k = 0; k < vertex_table_field_count(v) && end == 0 && !*on_a_line; k++) {
        vertex_field field = vertex_table_field(v, k);
        if (!field_has_missing(v, field)) continue;
        if (!made) end = triangulated_points_make(&s, v, on_a_line);
        made = true;
        if (end == 0 && !*on_a_line) triangulated_points_interpolate(&s, v, field);
    }
    triangulated_points_release(&s);
    return end;
}

int missing_values_fill(vertex_table *v, size_t added, const uint32_t *duplicate_of,
                        const uint32_t *segments, const mw_constrained_edges *edges,
                        uint32_t threads, bool *on_a_line)
{
    *on_a_line = false;
    mw_mesh_file *file = &v->file;
    uint32_t *segment_of = segments_of_added(added, file->point_count - added, edges);
    if (!segment_of) return fail_memory();
    for (size_t k = 0; k < vertex_table_field_count(v); k++) {
        vertex_field field = vertex_table_field(v, k);
        coincident_share_values(v, added, duplicate_of, field);
        segments_interpolate(v, added, segment_of, segments, field);
    }
    free(segment_of);
    for (size_t i = 0; !file->has_z && i < file->point_count; i++) file->points[3 * i + 2] = 0;
    return missing_values_interpolate(v, threads, on_a_line);
}
