/* point_series.c - values over time at points, as CF has them [CF 1.8, chapter 9 and appendix H]:
 * time series in the orthogonal multidimensional form, or a single trajectory.
 *
 * The dimensions of a time series are (station, time), as CF recommends, but values come step by
 * step. So a field is stored in chunks of many stations and few steps. */
#include "io/layouts/crs_define.h"
#include "io/netcdf/netcdf_output.h"

#include <math.h>
#include <meshwalk/point_series.h>
#include <meshwalk/version.h>
#include <stdlib.h>
#include <string.h>

struct mw_point_series {
    mw_netcdf_output *file;
    size_t points, fields;
    bool track;
    int *variable; /* of each field */
};

/* Variables beside the fields; crs: -1 if there is none. */
typedef struct series_axes {
    int time, x, y, status, id, crs;
} series_axes;

static void text_if_known(mw_point_series *s, int variable, const char *attribute, const char *text)
{
    if (text && *text) mw__netcdf_output_text(s->file, variable, attribute, text);
}

/* --- definitions ------------------------------------------------------------------------------ */

static void series_define_place(mw_point_series *s, int variable, const char *name,
                                const char *unit, const char *axis)
{
    mw__netcdf_output_text(s->file, variable, "standard_name", name);
    text_if_known(s, variable, "units", unit);
    mw__netcdf_output_text(s->file, variable, "axis", axis);
}

/* x, or y. */
static int series_define_side(mw_point_series *s, const mw_point_series_layout *layout, int point,
                              bool y)
{
    const bool degrees = layout->degrees;
    static const char *const names[] = {"x", "y", "lon", "lat"},
                             *const standard[] = {"projection_x_coordinate",
                                                  "projection_y_coordinate", "longitude",
                                                  "latitude"},
                             *const units[] = {"degrees_east", "degrees_north"};
    const int k = (degrees ? 2 : 0) + (y ? 1 : 0);
    const int variable = mw__netcdf_output_variable(s->file, names[k], MW_NETCDF_DOUBLE, 1, &point);
    series_define_place(s, variable, standard[k], degrees ? units[y] : layout->position_unit,
                        y ? "Y" : "X");
    return variable;
}

static void series_define_axes(mw_point_series *s, const mw_point_series_layout *layout, int time,
                               int point, series_axes *axes)
{
    axes->time = mw__netcdf_output_variable(s->file, "time", MW_NETCDF_DOUBLE, 1, &time);
    mw__netcdf_output_text(s->file, axes->time, "standard_name", "time");
    mw__netcdf_output_text(s->file, axes->time, "axis", "T");
    text_if_known(s, axes->time, "units", layout->time_unit);
    text_if_known(s, axes->time, "calendar", layout->calendar);
    axes->x = series_define_side(s, layout, point, false);
    axes->y = series_define_side(s, layout, point, true);
    axes->crs = mw__crs_define(s->file, layout->crs       ? layout->crs
                                        : layout->degrees ? "EPSG:4326"
                                                          : NULL);
}

/* The variable that tells stations, or tracks, apart. */
static void series_define_id(mw_point_series *s, int point, series_axes *axes)
{
    axes->id = mw__netcdf_output_variable(s->file, s->track ? "trajectory" : "station_id",
                                          MW_NETCDF_INT, s->track ? 0 : 1, &point);
    mw__netcdf_output_text(s->file, axes->id, "cf_role",
                           s->track ? "trajectory_id" : "timeseries_id");
    mw__netcdf_output_text(s->file, axes->id, "long_name",
                           s->track ? "number of the track" : "row of the table, from 0");
}

static void series_define_status(mw_point_series *s, int point, series_axes *axes)
{
    double values[MW_WHERE_COUNT];
    char meanings[32 * MW_WHERE_COUNT] = "";
    for (int k = 0; k < MW_WHERE_COUNT; k++) {
        values[k] = k;
        if (k) strcat(meanings, " ");
        strcat(meanings, mw_where_name((mw_where)k));
    }
    axes->status = mw__netcdf_output_variable(s->file, "status", MW_NETCDF_BYTE, 1, &point);
    mw__netcdf_output_text(s->file, axes->status, "long_name", "where the point lies");
    mw__netcdf_output_list(s->file, axes->status, "flag_values", MW_NETCDF_BYTE, MW_WHERE_COUNT,
                           values);
    mw__netcdf_output_text(s->file, axes->status, "flag_meanings", meanings);
}

/* A name that CF allows: letters, digits and underscores, a letter first. */
static char *series_name(const char *name)
{
    char *plain = mw__alloc(strlen(name) + 2, 1), *to = plain;
    if (!plain) return NULL;
    for (const char *c = name; *c; c++) {
        const bool letter = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z'),
                   digit = *c >= '0' && *c <= '9';
        if (c == name && !letter) *to++ = 'v';
        *to++ = letter || digit ? *c : '_';
    }
    *to = 0;
    return plain;
}

/* Text k of a list that may be NULL; "": unknown. */
static const char *series_text(const char *const *texts, size_t k)
{
    return texts && texts[k] ? texts[k] : "";
}

static void series_define_chunks(mw_point_series *s, const mw_point_series_layout *layout,
                                 int variable)
{
    enum { CHUNK = 4096 };
    const size_t points = s->points < CHUNK ? s->points : CHUNK, steps = layout->time_count;
    if (points == 0 || steps == 0) return;
    const size_t most = CHUNK / points;
    mw__netcdf_output_chunks(s->file, variable, (size_t[]){points, steps < most ? steps : most});
}

static bool series_define_field(mw_point_series *s, const mw_point_series_layout *layout, size_t k,
                                int time, int point, const series_axes *axes)
{
    const int both[2] = {point, time};
    char *name = series_name(layout->names[k]);
    if (!name) return false;
    const int variable = mw__netcdf_output_variable(s->file, name, MW_NETCDF_DOUBLE,
                                                    s->track ? 1 : 2, s->track ? &point : both);
    s->variable[k] = variable;
    if (!s->track) series_define_chunks(s, layout, variable);
    const char *long_name = series_text(layout->long_names, k);
    mw__netcdf_output_text(s->file, variable, "long_name",
                           *long_name ? long_name : layout->names[k]);
    text_if_known(s, variable, "standard_name", series_text(layout->standard_names, k));
    text_if_known(s, variable, "units", series_text(layout->units, k));
    mw__netcdf_output_number(s->file, variable, "_FillValue", MW_NETCDF_DOUBLE, NAN);
    mw__netcdf_output_text(s->file, variable, "coordinates",
                           layout->degrees ? "time lat lon" : "time y x");
    if (axes->crs >= 0) mw__netcdf_output_text(s->file, variable, "grid_mapping", "crs");
    free(name);
    return true;
}

static void series_define_file(mw_point_series *s, const mw_point_series_layout *layout)
{
    static const char *const titles[] = {"Values over time at points", "Values along a track"};
    const char *history = layout->history ? layout->history : "meshwalk " MW_VERSION_STRING;
    mw__netcdf_output_text(s->file, MW_NETCDF_OUTPUT_FILE, "Conventions", "CF-1.8");
    mw__netcdf_output_text(s->file, MW_NETCDF_OUTPUT_FILE, "featureType",
                           s->track ? "trajectory" : "timeSeries");
    mw__netcdf_output_text(s->file, MW_NETCDF_OUTPUT_FILE, "title",
                           layout->title ? layout->title : titles[s->track]);
    mw__netcdf_output_text(s->file, MW_NETCDF_OUTPUT_FILE, "history", history);
}

static bool series_define(mw_point_series *s, const mw_point_series_layout *layout,
                          series_axes *axes)
{
    const int point = mw__netcdf_output_dimension(s->file, s->track ? "obs" : "station", s->points);
    const int time =
        s->track ? point : mw__netcdf_output_dimension(s->file, "time", layout->time_count);
    bool named = true;
    series_define_axes(s, layout, time, point, axes);
    series_define_id(s, point, axes);
    if (layout->located) series_define_status(s, point, axes);
    for (size_t k = 0; k < s->fields && named; k++)
        named = series_define_field(s, layout, k, time, point, axes);
    series_define_file(s, layout);
    mw__netcdf_output_defined(s->file);
    return named;
}

/* --- values ----------------------------------------------------------------------------------- */

/* A number of each of n records that are `stride` doubles apart. */
static bool series_write_axis(mw_point_series *s, int variable, const double *values, size_t stride,
                              size_t n)
{
    const size_t start = 0;
    double *packed = mw__alloc(n, sizeof *packed);
    if (!packed) return false;
    for (size_t i = 0; i < n; i++) packed[i] = values[i * stride];
    if (n) mw__netcdf_output_doubles(s->file, variable, &start, &n, packed);
    free(packed);
    return true;
}

static bool series_write_statuses(mw_point_series *s, int variable, const mw_location *located)
{
    const size_t start = 0, n = s->points;
    uint32_t *where = mw__alloc(n, sizeof *where);
    if (!where) return false;
    for (size_t i = 0; i < n; i++) where[i] = located[i].where;
    if (n) mw__netcdf_output_numbers(s->file, variable, &start, &n, where);
    free(where);
    return true;
}

static bool series_write_ids(mw_point_series *s, int variable)
{
    const size_t start = 0, n = s->track ? 1 : s->points;
    uint32_t *id = mw__alloc(n, sizeof *id);
    if (!id) return false;
    for (size_t i = 0; i < n; i++) id[i] = (uint32_t)i;
    if (n) mw__netcdf_output_numbers(s->file, variable, &start, &n, id);
    free(id);
    return true;
}

static bool series_write_axes(mw_point_series *s, const mw_point_series_layout *layout,
                              const series_axes *axes)
{
    const size_t stride = layout->position_stride ? layout->position_stride : 2,
                 time = layout->time_stride ? layout->time_stride : 1;
    return series_write_axis(s, axes->time, layout->times, time,
                             s->track ? s->points : layout->time_count) &&
           series_write_axis(s, axes->x, layout->positions, stride, s->points) &&
           series_write_axis(s, axes->y, layout->positions + 1, stride, s->points) &&
           series_write_ids(s, axes->id) &&
           (!layout->located || series_write_statuses(s, axes->status, layout->located));
}

/* --- all -------------------------------------------------------------------------------------- */

static mw_status series_check(const char *path, const mw_point_series_layout *layout,
                              mw_error *error)
{
    if (!path || !layout || (layout->point_count && !layout->positions) || !layout->times ||
        (layout->field_count && !layout->names))
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the path, the positions, the times or the names are NULL");
    return MW_OK;
}

mw_status mw_point_series_open(const char *path, const mw_point_series_layout *layout,
                               mw_point_series **out, mw_error *error)
{
    series_axes axes = {0};
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new series is NULL");
    *out = NULL;
    mw_status status = series_check(path, layout, error);
    if (status) return status;
    mw_point_series *s = mw__calloc(1, sizeof *s);
    if (!s) return mw__fail_memory(error);
    *s = (mw_point_series){.points = layout->point_count,
                           .fields = layout->field_count,
                           .track = layout->feature == MW_POINT_TRAJECTORY,
                           .variable = mw__calloc(layout->field_count, sizeof(int))};
    if (!s->variable)
        status = mw__fail_memory(error);
    else
        status = mw__netcdf_output_open(path, &s->file, error);
    if (!status && !(series_define(s, layout, &axes) && series_write_axes(s, layout, &axes)))
        status = mw__fail_memory(error);
    if (status)
        mw_point_series_close(s, 0, NULL);
    else
        *out = s;
    return status;
}

void mw_point_series_write(mw_point_series *s, size_t field, size_t step, const double *values)
{
    const size_t starts[2] = {0, step}, counts[2] = {s->points, 1};
    if (field < s->fields && s->points)
        mw__netcdf_output_doubles(s->file, s->variable[field], starts, counts, values);
}

int mw_point_series_failed(const mw_point_series *s)
{
    return mw__netcdf_output_failed(s->file);
}

mw_status mw_point_series_close(mw_point_series *s, int commit, mw_error *error)
{
    if (!s) return MW_OK;
    mw_status status = mw__netcdf_output_close(s->file, commit, error);
    free(s->variable);
    free(s);
    return status;
}
