#include "cli/stream/sample_on_star.h"
#include "cli/frame/files.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/output/csv_row.h"
#include "cli/stream/ray_stream.h"

#include <math.h>
#include <stdlib.h>

typedef struct star_sample {
    ray_stream query; /* the first member: see ray_stream.h */
    const star_sample_settings *settings;
    double *values;    /* of the vertices; or NULL */
    double *triangles; /* of the triangles instead */
} star_sample;

/* The value of the nearest corner that has one, from where the ray meets the facet; NaN if none
 * has. */
static double facet_nearest_value(const star_sample *s, const mw_location *where)
{
    const mw_surface *surface = s->query.polyhedron.surface;
    uint32_t v[3];
    double corner[3][3], place[3] = {0}, value = NAN, least = INFINITY;
    mw_surface_triangle(surface, where->triangle, v);
    for (int i = 0; i < 3; i++) {
        mw_surface_vertex(surface, v[i], corner[i]);
        for (int k = 0; k < 3; k++) place[k] += where->weight[i] * corner[i][k];
    }
    for (int i = 0; i < 3; i++) {
        const double x = corner[i][0] - place[0], y = corner[i][1] - place[1],
                     z = corner[i][2] - place[2], distance = hypot(hypot(x, y), z);
        if (isnan(s->values[v[i]]) || !(distance < least)) continue;
        least = distance;
        value = s->values[v[i]];
    }
    return value;
}

static bool star_sample_row(const void *self, const double *ray, const void *answer, text *out)
{
    const star_sample *s = self;
    const mw_location *where = answer;
    const bool there = where->triangle != MW_NONE;
    (void)ray;
    double value = !there         ? NAN
                   : s->triangles ? s->triangles[where->triangle]
                                  : ray_stream_value(&s->query, where);
    const bool missing = there && isnan(value);
    if (missing && s->settings->nearest && s->values) value = facet_nearest_value(s, where);
    csv_row_double(out, !isnan(value), value);
    if (s->settings->status)
        csv_row_word(out, missing ? "missing" : mw_where_name((mw_where)where->where));
    return !isnan(value);
}

static void star_sample_report(const void *self, report *out)
{
    const star_sample *s = self;
    ray_stream_report_status(&s->query, out);
    statistics_report_settings(out, &s->settings->stream->common);
    statistics_report_walks(out, &s->query.statistics.counters);
}

/* The values come first: then x and y may become a place on the sphere. */
static int star_sample_open(star_sample *s, const char *path)
{
    const star_sample_settings *settings = s->settings;
    const star_input_settings how = {
        settings->centre, settings->lonlat, false, settings->stream->common.threads, false,
        settings->open};
    mesh_field_choice choice = settings->field;
    mw_mesh_file file;
    int end = files_read_mesh(path, &file);
    if (end) return end;
    choice.triangles = &s->triangles;
    end = mesh_field_copy_either(path, &file, &choice, &s->values);
    if (end == 0) end = star_input_make(&s->query.polyhedron, path, &file, &how);
    mw_mesh_file_release(&file);
    s->query.field = s->values;
    return end;
}

int star_sample_run(const star_sample_settings *settings, const char *const *operands)
{
    const char *const answers[] = {settings->field.field, settings->status ? "status" : NULL, NULL};
    star_sample s = {.query = {.stream = settings->stream,
                               .centre = settings->centre,
                               .lonlat = settings->lonlat,
                               .begin = monotonic_seconds()},
                     .settings = settings};
    int end = star_sample_open(&s, operands[0]);
    if (end == 0)
        end = ray_stream_run(&s.query, operands[1], answers, settings->status ? "rt" : "r",
                             star_sample_row, star_sample_report);
    ray_stream_release(&s.query);
    free(s.values);
    free(s.triangles);
    return end;
}
