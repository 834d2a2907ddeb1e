#include "cli/series/series_sample.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "cli/gdal/crs_heights.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/output/csv_row.h"
#include "cli/series/series_values.h"
#include "cli/stream/globe_points.h"
#include "cli/stream/located_points.h"

#include <stdlib.h>
#include <string.h>

#define LARGEST_WIDE ((size_t)1 << 28) /* values of a wide table: 2 GiB */

/* One run of the command. */
typedef struct series_run {
    const point_query_settings *query_settings;
    const series_settings *settings;
    const char *output;      /* NULL: standard output */
    const char *points_path; /* for messages */
    point_query query;
    globe_points globe;
    uint32_t *face;
    size_t face_count;
    series_choice choice;
    located_points points;
    series_values values;
    char **names;    /* of the answers' columns; NULL ends them */
    double *results; /* value of column k at point i: results[k * points.count + i] */
    mw_output *out;
    text row;
} series_run;

/* Keep the faces of the mesh's file, which is released before the points are located. */
static int run_load(mw_mesh *mesh, const char *path, const mw_mesh_file *file, const void *self)
{
    series_run *r = *(series_run *const *)self;
    r->face_count = file->faces ? file->face_count : file->triangle_count;
    if (file->faces) {
        r->face = malloc(file->triangle_count * sizeof *r->face + 1);
        if (!r->face) return fail_memory();
        memcpy(r->face, file->faces, file->triangle_count * sizeof *r->face);
    }
    const series_locating *elsewhere = r->settings->elsewhere;
    if (elsewhere) return elsewhere->load(mesh, path, file, elsewhere->self);
    return r->settings->globe ? globe_points_make(&r->globe, path, file, r->settings->open,
                                                  r->query_settings->stream.common.threads)
                              : 0;
}

/* --- columns ---------------------------------------------------------------------------------- */

static size_t run_steps(const series_run *r)
{
    return r->choice.last - r->choice.first + 1;
}

static bool run_is_wide(const series_run *r)
{
    return r->settings->wide && !r->settings->time_column;
}

static bool run_is_long(const series_run *r)
{
    return !r->settings->wide && !r->settings->time_column;
}

/* How many columns of values there are. */
static size_t run_width(const series_run *r)
{
    return r->choice.field_count * (run_is_wide(r) ? run_steps(r) : 1);
}

/* The name of column k of values: of the field, and in a wide table of its time. */
static char *run_column_name(const series_run *r, size_t k)
{
    text name = {0};
    const size_t step = run_is_wide(r) ? k / r->choice.field_count : 0;
    text_string(&name, series_field(&r->choice, k % r->choice.field_count)->name);
    if (run_is_wide(r)) {
        text_string(&name, "@");
        text_double(&name, r->choice.info->times[r->choice.first + step]);
    }
    text_bytes(&name, "", 1);
    if (!name.failed) return name.bytes;
    text_release(&name);
    return NULL;
}

static int run_name_columns(series_run *r)
{
    const size_t width = run_width(r);
    size_t count = 0;
    r->names = calloc(width + 3, sizeof *r->names);
    if (!r->names) return fail_memory();
    if (run_is_long(r)) r->names[count++] = strdup("time");
    for (size_t k = 0; k < width; k++)
        if (!(r->names[count++] = run_column_name(r, k))) return fail_memory();
    if (r->settings->status) r->names[count++] = strdup("status");
    return r->names[0] && r->names[count - 1] ? 0 : fail_memory();
}

static void run_release(series_run *r)
{
    for (size_t k = 0; r->names && r->names[k]; k++) free(r->names[k]);
    free(r->names);
    free(r->results);
    free(r->face);
    text_release(&r->row);
    series_values_release(&r->values);
    located_points_release(&r->points);
    series_close(&r->choice);
    globe_points_release(&r->globe);
    point_query_release(&r->query);
}

/* --- rows ------------------------------------------------------------------------------------- */

/* The row of point i; `time` is NULL where rows have none. */
static void run_write_row(series_run *r, size_t i, const double *time)
{
    const size_t width = run_width(r), n = r->points.count;
    const size_t begin = located_points_begin_row(&r->points, i, &r->row);
    if (time) csv_row_double(&r->row, true, *time);
    for (size_t k = 0; k < width; k++) {
        const double value = r->results[k * n + i];
        csv_row_double(&r->row, value == value, value);
    }
    if (r->settings->status)
        csv_row_word(&r->row, mw_where_name((mw_where)r->points.located[i].where));
    located_points_end_row(&r->points, begin, &r->row);
}

/* The rows of all points. */
static int run_write_rows(series_run *r, const double *time)
{
    enum { FULL = 1 << 20 };
    for (size_t i = 0; i < r->points.count && !mw_output_failed(r->out); i++) {
        run_write_row(r, i, time);
        if (r->row.failed) return fail_memory();
        if (r->row.size < FULL && i + 1 < r->points.count) continue;
        mw_output_write(r->out, r->row.bytes, r->row.size);
        text_clear(&r->row);
    }
    return 0;
}

static int run_write_long(series_run *r)
{
    const size_t fields = r->choice.field_count;
    int end = 0;
    for (size_t s = r->choice.first; s <= r->choice.last && end == 0; s++) {
        for (size_t k = 0; k < fields && end == 0; k++)
            end = series_values_read(&r->values, k, s, r->results + k * r->points.count);
        if (end == 0) end = run_write_rows(r, &r->choice.info->times[s]);
        progress_lines(s - r->choice.first, (double)(s - r->choice.first) / (double)run_steps(r));
    }
    return end;
}

static int run_write_wide(series_run *r)
{
    const size_t fields = r->choice.field_count;
    int end = 0;
    for (size_t s = 0; s < run_steps(r) && end == 0; s++)
        for (size_t k = 0; k < fields && end == 0; k++)
            end = series_values_read(&r->values, k, r->choice.first + s,
                                     r->results + (s * fields + k) * r->points.count);
    return end ? end : run_write_rows(r, NULL);
}

static bool run_is_netcdf(const series_run *r)
{
    const size_t length = r->output ? strlen(r->output) : 0;
    return length > 3 && strcmp(r->output + length - 3, ".nc") == 0;
}

/* Each point at its own time. */
static int run_write_track(series_run *r)
{
    int end = 0;
    for (size_t k = 0; k < r->choice.field_count && end == 0; k++)
        end = series_values_follow(&r->values, k, r->points.points + 2, r->points.width,
                                   r->results + k * r->points.count);
    return end ? end : run_write_rows(r, NULL);
}

/* --- netCDF ----------------------------------------------------------------------------------- */

static int run_write_fields(series_run *r, mw_point_series *out)
{
    const bool track = r->settings->time_column;
    int end = 0;
    for (size_t s = r->choice.first; s <= (track ? r->choice.first : r->choice.last); s++)
        for (size_t k = 0; k < r->choice.field_count; k++) {
            if (end || mw_point_series_failed(out)) return end;
            end = track ? series_values_follow(&r->values, k, r->points.points + 2, r->points.width,
                                               r->results)
                        : series_values_read(&r->values, k, s, r->results);
            if (end == 0) mw_point_series_write(out, k, s - r->choice.first, r->results);
        }
    return end;
}

/* What is said of each field. */
enum { RUN_NAMES, RUN_UNITS, RUN_LONG_NAMES, RUN_STANDARD_NAMES, RUN_LISTS };

static void run_list_texts(const series_run *r, const char **texts)
{
    const size_t n = r->choice.field_count;
    for (size_t k = 0; k < n; k++) {
        const mw_series_field *field = series_field(&r->choice, k);
        texts[RUN_NAMES * n + k] = field->name;
        texts[RUN_UNITS * n + k] = field->unit;
        texts[RUN_LONG_NAMES * n + k] = field->long_name;
        texts[RUN_STANDARD_NAMES * n + k] = field->standard_name;
    }
}

/* The unit of the points, as UDUNITS spells it: "metre", "US_survey_foot". */
static bool run_position_unit(const series_run *r, char unit[CRS_UNIT])
{
    if (!r->points.crs || !crs_unit(r->points.crs, unit)) return false;
    for (char *c = unit; *c; c++)
        if (*c == ' ') *c = '_';
    return true;
}

static int run_write_netcdf_of(series_run *r, const char **texts, const char *history)
{
    mw_error error;
    mw_point_series *out;
    char unit[CRS_UNIT];
    const bool track = r->settings->time_column;
    const mw_series_info *info = r->choice.info;
    const size_t fields = r->choice.field_count;
    run_list_texts(r, texts);
    const mw_point_series_layout layout = {
        .feature = track ? MW_POINT_TRAJECTORY : MW_POINT_TIME_SERIES,
        .positions = r->points.points,
        .position_stride = r->points.width,
        .point_count = r->points.count,
        .degrees = r->points.crs ? crs_is_lonlat(r->points.crs) : r->points.lonlat,
        .crs = r->points.crs,
        .position_unit = run_position_unit(r, unit) ? unit : NULL,
        .history = history,
        .times = track ? r->points.points + 2 : info->times + r->choice.first,
        .time_stride = track ? r->points.width : 1,
        .time_count = run_steps(r),
        .time_unit = info->time_unit,
        .calendar = info->calendar,
        .names = texts + RUN_NAMES * fields,
        .units = texts + RUN_UNITS * fields,
        .long_names = texts + RUN_LONG_NAMES * fields,
        .standard_names = texts + RUN_STANDARD_NAMES * fields,
        .field_count = fields,
        .located = r->points.located};
    if (mw_point_series_open(r->output, &layout, &out, &error) != MW_OK)
        return fail_writing(&error);
    int end = run_write_fields(r, out);
    if (mw_point_series_close(out, end == 0, &error) != MW_OK && end == 0)
        end = fail_writing(&error);
    return end;
}

/* By the conventions of CF: the series of stations, or a track. */
static int run_write_netcdf(series_run *r)
{
    const char **texts = calloc(RUN_LISTS * r->choice.field_count, sizeof *texts);
    text history = {0};
    text_printf(&history, "meshwalk " MW_VERSION_STRING ": values of %s at the points of %s",
                r->choice.path, r->points_path);
    text_bytes(&history, "", 1);
    r->results = malloc(r->points.count * sizeof *r->results + 1);
    int end = texts && r->results && !history.failed ? run_write_netcdf_of(r, texts, history.bytes)
                                                     : fail_memory();
    text_release(&history);
    free(texts);
    return end;
}

/* --- all -------------------------------------------------------------------------------------- */

static int run_write(series_run *r)
{
    mw_error error;
    const char *output = r->output;
    progress_phase("interpolating", r->choice.path);
    if (run_is_netcdf(r)) return run_write_netcdf(r);
    const size_t values = run_width(r) * r->points.count;
    if (values > LARGEST_WIDE && run_is_wide(r)) {
        complain("a wide table of %zu values would not fit into memory; leave out --wide", values);
        return END_RESOURCE;
    }
    r->results = malloc(values * sizeof *r->results + 1);
    if (!r->results) return fail_memory();
    if (mw_output_open(output ? output : "-", &r->out, &error) != MW_OK)
        return fail_writing(&error);
    signals_set_temporary(mw_output_temporary(r->out));
    mw_output_write(r->out, r->points.header.bytes, r->points.header.size);
    int end = r->settings->time_column ? run_write_track(r)
              : run_is_wide(r)         ? run_write_wide(r)
                                       : run_write_long(r);
    if (mw_output_close(r->out, end == 0, &error) != MW_OK && end == 0) end = fail_writing(&error);
    signals_set_temporary(NULL);
    return end;
}

static void run_remark_time(const series_run *r)
{
    const mw_series_info *info = r->choice.info;
    if (r->query_settings->stream.common.quiet) return;
    complain("%s: remark: %zu of %zu steps; times are in %s%s%s", r->choice.path, run_steps(r),
             info->step_count, *info->time_unit ? info->time_unit : "an unknown unit",
             *info->calendar ? ", calendar " : "", info->calendar);
}

static int run_prepare(series_run *r, const char *const *operands)
{
    const series_settings *s = r->settings;
    const series_request request = {.path = s->values,
                                    .mesh = operands[0],
                                    .layout = r->query_settings->stream.common.layout,
                                    .fields = s->fields,
                                    .time = s->time};
    int end =
        series_choose(&r->choice, &request, mw_mesh_vertex_count(r->query.mesh), r->face_count);
    if (end == 0) end = run_name_columns(r);
    if (end == 0) run_remark_time(r);
    r->points = (located_points){.answers = (const char *const *)r->names};
    return end ? end : located_points_read(&r->points, &r->query, operands[1], s->time_column);
}

/* Refuse an output that is one of the files with the values. */
static int run_check_values(const series_run *r)
{
    series_paths files;
    if (!r->settings->values) return 0;
    int end = series_paths_split(&files, r->settings->values)
                  ? files_check_output(r->output, files.paths, (int)files.count)
                  : fail_memory();
    series_paths_release(&files);
    return end;
}

/* Refuse an output that is an input, and tables in netCDF. */
static int run_check_output(const series_run *r, const char *const *operands)
{
    if (run_is_netcdf(r) && (r->settings->wide || r->settings->status)) {
        complain("--%s is for tables; netCDF has %s", r->settings->wide ? "wide" : "status",
                 r->settings->wide ? "all steps of a point anyway" : "the status anyway");
        return END_USAGE;
    }
    int end = files_check_output(r->output, operands, 2);
    return end ? end : run_check_values(r);
}

static void run_locate_elsewhere(series_run *r)
{
    const series_locating *elsewhere = r->settings->elsewhere;
    if (elsewhere) {
        r->query.elsewhere = elsewhere->locate;
        r->query.elsewhere_self = elsewhere->self;
    } else if (r->settings->globe) {
        r->query.elsewhere = globe_points_locate;
        r->query.elsewhere_self = &r->globe;
    }
}

int series_sample(const point_query_settings *query, const series_settings *settings,
                  const char *const *operands)
{
    point_query_settings plain = *query; /* no rows are written to an output that is netCDF */
    series_run r = {.query_settings = &plain, .settings = settings}, *self = &r;
    int end = settings->time ? series_check_time(settings->time) : 0;
    r.output = query->stream.common.output;
    r.points_path = files_is_standard(operands[1]) ? "standard input" : operands[1];
    if (end == 0) end = run_check_output(&r, operands);
    if (end) return end;
    if (run_is_netcdf(&r)) plain.stream.common.output = NULL;
    plain.globe = settings->globe;
    plain.elsewhere = settings->elsewhere != NULL;
    plain.any = plain.any || settings->globe;
    end = point_query_open(&r.query, &plain, operands, false, run_load, &self);
    run_locate_elsewhere(&r);
    if (end == 0) end = run_prepare(&r, operands);
    const series_points at = {.mesh = r.query.mesh,
                              .face = r.face,
                              .face_count = r.face_count,
                              .located = r.points.located,
                              .count = r.points.count,
                              .recover = settings->recover,
                              .threads = query->stream.common.threads};
    if (end == 0) end = series_values_open(&r.values, &r.choice, &at);
    if (end == 0) end = run_write(&r);
    if (end == 0 && query->stream.strict && located_points_lost(&r.points)) end = END_UNANSWERED;
    run_release(&r);
    return end;
}
