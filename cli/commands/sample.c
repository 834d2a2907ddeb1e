/* sample - the value the mesh has at each point, in the plane or on a star-shaped polyhedron. */
#include "cli/commands/sample.h"
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_point_layer.h"
#include "cli/input/mesh_field.h"
#include "cli/input/star_input.h"
#include "cli/output/csv_row.h"
#include "cli/stream/sample_on_star.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *outside_name(int i)
{
    return (const char *[]){"empty", "nearest", "linear", NULL}[i];
}
static const char *outside_help(int i)
{
    return (const char *[]){"no value", "the value at the nearest point of the border",
                            "the plane of the nearest border triangle, continued"}[i];
}
static const choices outside_choices = {"way of --outside", outside_name, outside_help};

static const char *missing_name(int i)
{
    return (const char *[]){"empty", "nearest", NULL}[i];
}
static const char *missing_help(int i)
{
    return (const char *[]){"no value", "the value of the nearest of the other corners"}[i];
}
static const choices missing_choices = {"way of --missing", missing_name, missing_help};

static const char *sample_space_name(int i)
{
    return (const char *[]){"plane", "star", NULL}[i];
}
static const char *sample_space_help(int i)
{
    return (const char *[]){"a mesh in the plane of x and y",
                            "a closed polyhedron, star-shaped about a centre, as for star: POINTS "
                            "are rays from the centre"}[i];
}
static const choices sample_space_choices = {"way to take a mesh", sample_space_name,
                                             sample_space_help};

static const option sample_options[] = {
    {"field", 0, OPTION_TEXT, offsetof(sample_settings, field), "NAME",
     "the value to sample: z or a field of MESH, also one of triangles (default: z)", NULL},
    {"outside", 0, OPTION_CHOICE, offsetof(sample_settings, outside), "NAME",
     "what a point outside the mesh gets (default: empty):", &outside_choices},
    {"missing", 0, OPTION_CHOICE, offsetof(sample_settings, missing), "NAME",
     "what a point gets where a corner of its triangle has no value (default: empty):",
     &missing_choices},
    {"nodata", 0, OPTION_TEXT, offsetof(sample_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"status", 0, OPTION_FLAG, offsetof(sample_settings, status), NULL,
     "add the column status: inside, edge, vertex, outside, hole, near or bad; or missing, where a "
     "corner has no value",
     NULL},
    {"time", 0, OPTION_TEXT, offsetof(sample_settings, series.time), "STEPS",
     "values over time: all, FIRST..LAST or N (steps, from 0), or nearest:T. A row for each step "
     "and point, with the column time; --field is a list then (default: all fields over time)",
     NULL},
    {"values", 0, OPTION_TEXT, offsetof(sample_settings, series.values), "FILE",
     "the file with the values over time, or several with commas between them, each with later "
     "times than the one before (default: MESH)",
     NULL},
    {"time-column", 0, OPTION_TEXT, offsetof(sample_settings, series.time_column), "NAME",
     "the column of POINTS with the time of each: its value is interpolated between steps", NULL},
    {"wide", 0, OPTION_FLAG, offsetof(sample_settings, series.wide), NULL,
     "with --time: one row for each point, a column for each field and step", NULL},
    {"recover", 0, OPTION_FLAG, offsetof(sample_settings, series.recover), NULL,
     "make values at triangles or faces continuous; at a vertex the mean of those around it, by "
     "area",
     NULL},
    {"as", 0, OPTION_CHOICE, offsetof(sample_settings, space), "NAME",
     "what to take MESH as (default: plane):", &sample_space_choices},
    {"centre", 0, OPTION_XYZ, offsetof(sample_settings, centre), "X,Y,Z",
     "--as star: the centre, which is to see all facets from inside (default: 0,0,0)", NULL},
    {"lonlat", 0, OPTION_FLAG, offsetof(sample_settings, lonlat), NULL,
     "--as star: POINTS are longitudes and latitudes in degrees; and so are x and y of a MESH "
     "without z, which then lies on the unit sphere",
     NULL},
    {"open", 0, OPTION_FLAG, offsetof(sample_settings, open), NULL,
     "--as star: MESH may leave directions open, as an ocean does; there is no value there", NULL},
    {0},
};

/* What the rows are made from. */
typedef struct sampled_field {
    const double *values;    /* one value for each vertex; NaN: missing */
    const double *triangles; /* one value for each triangle instead; or NULL */
    point_query_values at_points;
    int outside, missing;
    bool status;
} sampled_field;

void sample_corners_read(const mw_mesh *mesh, const double *values, uint32_t triangle,
                         sample_corners *c)
{
    uint32_t v[3];
    mw_mesh_triangle(mesh, triangle, v);
    for (int k = 0; k < 3; k++) {
        mw_mesh_vertex(mesh, v[k], c->at[k]);
        c->value[k] = values[v[k]];
    }
}

double sample_nearest_value(const sample_corners *c, const double p[2])
{
    double value = NAN, least = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double distance = hypot(c->at[k][0] - p[0], c->at[k][1] - p[1]);
        if (isnan(c->value[k]) || !(distance < least)) continue;
        least = distance;
        value = c->value[k];
    }
    return value;
}

double sample_plane_value(const sample_corners *c, const double p[2])
{
    const double *value = c->value, area = mw_orient2d(c->at[0], c->at[1], c->at[2]);
    const double wb = mw_orient2d(c->at[0], p, c->at[2]) / area,
                 wc = mw_orient2d(c->at[0], c->at[1], p) / area;
    return value[0] + wb * (value[1] - value[0]) + wc * (value[2] - value[0]);
}

bool sample_cells_write(text *out, double value, bool status, bool missing, mw_where where)
{
    csv_row_double(out, !isnan(value), value);
    if (status) csv_row_word(out, missing ? "missing" : mw_where_name(where));
    return !isnan(value);
}

/* The value at the nearest point of the border. */
static double sample_border_value(const point_query *q, const double *values,
                                  const mw_nearest_border_point *hit)
{
    mw_location at = {.weight = {hit->weight[0], hit->weight[1], hit->weight[2]},
                      .triangle = hit->triangle};
    double value;
    mw_interpolate(q->mesh, values, &at, 1, &value);
    return value;
}

/* The value that --outside gives. Sets *triangle to the triangle that it comes from. */
static double sample_value_outside(const point_query *q, const sampled_field *s,
                                   const double point[2], uint32_t *triangle)
{
    mw_nearest_border_point hit;
    if (mw_nearest_border(q->locator, point[0], point[1], &hit, NULL) != MW_OK) return NAN;
    *triangle = hit.triangle;
    if (s->triangles) return s->triangles[hit.triangle];
    if (s->outside == OUTSIDE_LINEAR) {
        sample_corners corners;
        sample_corners_read(q->mesh, s->values, hit.triangle, &corners);
        const double value = sample_plane_value(&corners, point);
        if (isfinite(value)) return value;
    }
    return sample_border_value(q, s->values, &hit);
}

static bool sample_row(const point_query *q, const void *self, const double point[2],
                       const mw_location *where, text *out)
{
    const sampled_field *s = self;
    double value = NAN;
    uint32_t triangle = where->triangle;
    if (triangle != MW_NONE)
        value = s->triangles ? s->triangles[triangle] : point_query_value(&s->at_points, where);
    else if (s->outside != OUTSIDE_EMPTY && where->where != MW_BAD)
        value = sample_value_outside(q, s, point, &triangle);
    const bool missing = isnan(value) && triangle != MW_NONE;
    if (missing && s->missing == MISSING_NEAREST && !s->triangles) {
        sample_corners corners;
        sample_corners_read(q->mesh, s->values, triangle, &corners);
        value = sample_nearest_value(&corners, point);
    }
    return sample_cells_write(out, value, s->status, missing, (mw_where)where->where);
}

bool sample_is_series(const sample_settings *s)
{
    return s->series.time || s->series.values || s->series.time_column;
}

static int sample_fail_wide(void)
{
    complain("option '--wide' needs --time: it is for values over time");
    return END_USAGE;
}

int sample_series(const sample_settings *s, const char *const *operands,
                  const series_locating *elsewhere)
{
    series_settings series = s->series;
    const char *wrong = s->outside   ? "outside"
                        : s->missing ? "missing"
                        : s->nodata  ? "nodata"
                                     : NULL;
    if (wrong || s->query.stream.stats) {
        complain("option '--%s' cannot be used with values over time", wrong ? wrong : "stats");
        return END_USAGE;
    }
    if (series.wide && series.time_column) {
        complain("--wide is for --time, not for points with times of their own");
        return END_USAGE;
    }
    series.fields = s->field;
    series.status = s->status;
    series.globe = s->space == SAMPLE_STAR;
    series.open = s->open;
    series.elsewhere = elsewhere;
    return series_sample(&s->query, &series, operands);
}

/* Values that do not depend on time. Returns the exit code. */
static int sample_field(const sample_settings *s, const char *const *operands)
{
    const char *field = s->field ? s->field : "z";
    double *triangles = NULL;
    point_query q;
    const char *const answers[] = {field, s->status ? "status" : NULL, NULL};
    sampled_field rows = {.outside = s->outside, .missing = s->missing, .status = s->status};
    mesh_field_choice choice = {.field = field,
                                .quiet = s->query.stream.common.quiet,
                                .recover = s->series.recover,
                                .triangles = &triangles};
    int end = nodata_parse("nodata", s->nodata, &choice.nodata);
    if (end) return end;
    end = point_query_open(&q, &s->query, operands, s->outside != OUTSIDE_EMPTY, mesh_field_load,
                           &choice);
    rows.triangles = triangles;
    if (end == 0 && !triangles) {
        rows.values = mw_mesh_field(q.mesh, field);
        rows.at_points.field = rows.values;
        rows.at_points.at_points = malloc(QUERY_BLOCK_SIZE * sizeof(double));
        q.values = &rows.at_points;
        if (!rows.at_points.at_points) end = fail_memory();
    }
    if (end == 0)
        end = point_query_run(&q, operands[1], answers, s->status ? "rt" : "r", sample_row, &rows);
    point_query_release(&q);
    free(rows.at_points.at_points);
    free(triangles);
    return end;
}

/* The option that is given although a polyhedron does not know it; NULL: none is. */
static const char *sample_option_of_plane(const sample_settings *s)
{
    return s->outside          ? "outside"
           : s->series.recover ? "recover"
                               : point_query_option_of_plane(&s->query);
}

/* Values over time on the globe. Returns the exit code. */
static int sample_globe_series(const sample_settings *s, const char *const *operands)
{
    if (s->lonlat && !s->centre.count) return sample_series(s, operands, NULL);
    complain("values over time on --as star %s",
             s->lonlat ? "come from the centre 0,0,0: leave out --centre" : "need --lonlat");
    return END_USAGE;
}

static int sample_star(const sample_settings *s, const char *const *operands)
{
    const query_stream_settings *stream = &s->query.stream;
    const char *unfit = sample_option_of_plane(s);
    star_sample_settings sample = {
        .stream = stream,
        .centre = &s->centre,
        .field = {.field = s->field, .quiet = stream->common.quiet},
        .lonlat = s->lonlat,
        .open = s->open,
        .status = s->status,
        .nearest = s->missing == MISSING_NEAREST,
    };
    if (unfit) {
        complain("option '--%s' cannot be used with --as star", unfit);
        return END_USAGE;
    }
    if (sample_is_series(s)) return sample_globe_series(s, operands);
    if (s->series.wide) return sample_fail_wide();
    if (!s->field) {
        complain("sample: which value? --as star needs --field NAME");
        return END_USAGE;
    }
    int end = star_input_check_open(s->open, &s->centre);
    if (end == 0) end = nodata_parse("nodata", s->nodata, &sample.field.nodata);
    if (end == 0) end = files_check_output(stream->common.output, operands, 2);
    if (end == 0) end = point_layers_check(operands, 2);
    if (end == 0) end = query_stream_check_output(stream);
    return end ? end : star_sample_run(&sample, operands);
}

static int sample_run(const void *settings, const char *const *operands)
{
    const sample_settings *s = settings;
    if (s->space == SAMPLE_STAR) return sample_star(s, operands);
    if (s->lonlat || s->centre.count || s->open) {
        complain("option '--%s' needs --as star", s->lonlat         ? "lonlat"
                                                  : s->centre.count ? "centre"
                                                                    : "open");
        return END_USAGE;
    }
    if (sample_is_series(s)) return sample_series(s, operands, NULL);
    if (s->series.wide) return sample_fail_wide();
    return sample_field(s, operands);
}

const option *const sample_option_tables[] = {sample_options, point_query_options,
                                              query_stream_options, common_options, NULL};

const command sample_command = {
    .name = "sample",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .summary = "interpolate heights or other values at points",
    .description = "Writes every row of POINTS unchanged, followed by the value, z. The value is "
                   "interpolated linearly in the triangle that contains the point, and empty if no "
                   "triangle does. With --as star MESH is a globe or another polyhedron, and the "
                   "value is that where the ray through the point meets it. '-' is standard "
                   "input.",
    .options = sample_option_tables,
    .essential = "columns field outside as output",
    .settings_size = sizeof(sample_settings),
    .run = sample_run,
};
