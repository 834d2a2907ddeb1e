/* point_series.c - values over time at points, as CF has them [CF 1.8, chapter 9 and appendix H]:
 * time series in the orthogonal multidimensional form, or a single trajectory. */
#include "io/netcdf/netcdf_output.h"

#include <math.h>
#include <meshwalk/point_series.h>
#include <stdlib.h>
#include <string.h>

struct mw_point_series {
    mw_netcdf_output *file;
    size_t points, fields;
    bool track;
    int *variable; /* of each field */
};

/* Variables beside the fields. */
typedef struct series_axes {
    int time, x, y, status, id;
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
    if (unit) mw__netcdf_output_text(s->file, variable, "units", unit);
    mw__netcdf_output_text(s->file, variable, "axis", axis);
}

static void series_define_axes(mw_point_series *s, const mw_point_series_layout *layout, int time,
                               int point, series_axes *axes)
{
    const bool degrees = layout->degrees;
    axes->time = mw__netcdf_output_variable(s->file, "time", MW_NETCDF_DOUBLE, 1, &time);
    mw__netcdf_output_text(s->file, axes->time, "standard_name", "time");
    mw__netcdf_output_text(s->file, axes->time, "axis", "T");
    text_if_known(s, axes->time, "units", layout->time_unit);
    text_if_known(s, axes->time, "calendar", layout->calendar);
    axes->x =
        mw__netcdf_output_variable(s->file, degrees ? "lon" : "x", MW_NETCDF_DOUBLE, 1, &point);
    axes->y =
        mw__netcdf_output_variable(s->file, degrees ? "lat" : "y", MW_NETCDF_DOUBLE, 1, &point);
    series_define_place(s, axes->x, degrees ? "longitude" : "projection_x_coordinate",
                        degrees ? "degrees_east" : NULL, "X");
    series_define_place(s, axes->y, degrees ? "latitude" : "projection_y_coordinate",
                        degrees ? "degrees_north" : NULL, "Y");
}

/* The variable that tells stations, or tracks, apart. */
static void series_define_id(mw_point_series *s, int point, series_axes *axes)
{
    axes->id = mw__netcdf_output_variable(s->file, s->track ? "trajectory" : "station_id",
                                          MW_NETCDF_INT, s->track ? 0 : 1, &point);
    mw__netcdf_output_text(s->file, axes->id, "cf_role",
                           s->track ? "trajectory_id" : "timeseries_id");
    if (!s->track)
        mw__netcdf_output_text(s->file, axes->id, "long_name", "row of the table, from 0");
}

static void series_define_status(mw_point_series *s, int point, series_axes *axes)
{
    axes->status = mw__netcdf_output_variable(s->file, "status", MW_NETCDF_BYTE, 1, &point);
    mw__netcdf_output_text(s->file, axes->status, "long_name", "where the point lies");
    mw__netcdf_output_text(s->file, axes->status, "comment",
                           "0 inside, 1 edge, 2 vertex, 3 outside, 4 hole, 5 near, 6 bad");
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

static bool series_define_field(mw_point_series *s, const mw_point_series_layout *layout, size_t k,
                                int time, int point)
{
    const int both[2] = {time, point};
    char *name = series_name(layout->names[k]);
    if (!name) return false;
    const int variable = mw__netcdf_output_variable(s->file, name, MW_NETCDF_DOUBLE,
                                                    s->track ? 1 : 2, s->track ? &point : both);
    s->variable[k] = variable;
    if (strcmp(name, layout->names[k]))
        mw__netcdf_output_text(s->file, variable, "long_name", layout->names[k]);
    if (layout->units) text_if_known(s, variable, "units", layout->units[k]);
    mw__netcdf_output_number(s->file, variable, "_FillValue", MW_NETCDF_DOUBLE, NAN);
    mw__netcdf_output_text(s->file, variable, "coordinates",
                           layout->degrees ? "time lat lon" : "time y x");
    free(name);
    return true;
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
        named = series_define_field(s, layout, k, time, point);
    mw__netcdf_output_text(s->file, MW_NETCDF_OUTPUT_FILE, "Conventions", "CF-1.8");
    mw__netcdf_output_text(s->file, MW_NETCDF_OUTPUT_FILE, "featureType",
                           s->track ? "trajectory" : "timeSeries");
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
    const size_t starts[2] = {s->track ? 0 : step, 0},
                 counts[2] = {s->track ? s->points : 1, s->points};
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
