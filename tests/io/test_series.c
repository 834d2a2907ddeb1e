/* test_series.c - values over time beside a mesh, in netCDF. Skipped without libnetcdf. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/netcdf/netcdf_output.h"
#include "support/files.h"

#include <math.h>
#include <meshwalk/series.h>
#include <string.h>

static void need_libnetcdf(void)
{
    if (mw_netcdf_version(NULL, 0)) return;
    print_message("left out: libnetcdf is not found\n");
    skip();
}

/* Four vertices, two faces, as ADCIRC has them; two layers of speeds at the faces. */
typedef struct model {
    const char *calendar;
    double times[3];
    size_t steps;
    bool no_mesh;
    bool exact; /* FVCOM's: times as floats, and beside them days and milliseconds */
} model;

static void put(mw_netcdf_output *output, int variable, size_t rank, const size_t *counts,
                const double *values)
{
    static const size_t starts[3];
    (void)rank;
    mw__netcdf_output_doubles(output, variable, starts, counts, values);
}

static void write_model(const char *path, model m)
{
    mw_netcdf_output *output;
    mw_error error;
    if (mw__netcdf_output_open(path, &output, &error)) fail_msg("%s", error.message);
    int time = mw__netcdf_output_dimension(output, "time", MW_NETCDF_UNLIMITED);
    int node = mw__netcdf_output_dimension(output, "node", 4);
    int face = mw__netcdf_output_dimension(output, "nele", 2);
    int layer = mw__netcdf_output_dimension(output, "layer", 2);
    int corner = mw__netcdf_output_dimension(output, "corner", 3);
    int t = mw__netcdf_output_variable(output, "time", m.exact ? MW_NETCDF_FLOAT : MW_NETCDF_DOUBLE,
                                       1, &time);
    int days = -1, parts = -1;
    if (m.exact) {
        days = mw__netcdf_output_variable(output, "Itime", MW_NETCDF_INT, 1, &time);
        parts = mw__netcdf_output_variable(output, "Itime2", MW_NETCDF_INT, 1, &time);
        mw__netcdf_output_text(output, days, "units", "hours since 2020-01-01");
    }
    int x = -1, y = -1, element = -1;
    if (!m.no_mesh) {
        x = mw__netcdf_output_variable(output, "x", MW_NETCDF_DOUBLE, 1, &node);
        y = mw__netcdf_output_variable(output, "y", MW_NETCDF_DOUBLE, 1, &node);
        element =
            mw__netcdf_output_variable(output, "element", MW_NETCDF_INT, 2, (int[]){face, corner});
    }
    int zeta = mw__netcdf_output_variable(output, "zeta", MW_NETCDF_FLOAT, 2, (int[]){time, node});
    int speed =
        mw__netcdf_output_variable(output, "speed", MW_NETCDF_SHORT, 3, (int[]){time, face, layer});
    int depth = mw__netcdf_output_variable(output, "depth", MW_NETCDF_DOUBLE, 1, &node);
    mw__netcdf_output_text(output, t, "units", "hours since 2020-01-01");
    if (m.calendar) mw__netcdf_output_text(output, t, "calendar", m.calendar);
    mw__netcdf_output_text(output, zeta, "units", "m");
    mw__netcdf_output_text(output, zeta, "long_name", "water level");
    mw__netcdf_output_text(output, zeta, "standard_name", "sea_surface_height_above_geoid");
    mw__netcdf_output_text(output, speed, "long_name", "speed of the water");
    mw__netcdf_output_number(output, zeta, "_FillValue", MW_NETCDF_FLOAT, -99999);
    mw__netcdf_output_number(output, speed, "scale_factor", MW_NETCDF_DOUBLE, 0.25);
    mw__netcdf_output_defined(output);
    put(output, t, 1, &m.steps, m.times);
    if (m.exact) {
        put(output, days, 1, &m.steps, (double[]){58849, 58849, 58850});
        put(output, parts, 1, &m.steps, (double[]){0, 43200000, 21600000});
    }
    if (!m.no_mesh) {
        put(output, x, 1, (size_t[]){4}, (double[]){0, 1, 0, 1});
        put(output, y, 1, (size_t[]){4}, (double[]){0, 0, 1, 1});
        put(output, element, 2, (size_t[]){2, 3}, (double[]){1, 2, 3, 2, 4, 3});
    }
    put(output, zeta, 2, (size_t[]){m.steps, 4},
        (double[]){1, 2, 3, 4, 5, -99999, 7, 8, 9, 10, 11, 12});
    put(output, speed, 3, (size_t[]){m.steps, 2, 2},
        (double[]){1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    put(output, depth, 1, (size_t[]){4}, (double[]){-1, -2, -3, -4});
    if (mw__netcdf_output_close(output, true, &error)) fail_msg("%s", error.message);
}

static mw_series *open_series(const char *path, const mw_series_options *options)
{
    mw_series *series;
    mw_error error;
    if (mw_series_open(path, options, &series, &error)) fail_msg("%s", error.message);
    return series;
}

static void expect_values(mw_series *series, const char *field, size_t step, size_t count,
                          const double *wanted)
{
    double values[4];
    size_t f = mw_series_find(series, field);
    assert_int_equal(mw_series_describe(series)->fields[f].value_count, count);
    assert_int_equal(mw_series_read(series, f, step, values, NULL), MW_OK);
    for (size_t i = 0; i < count; i++)
        assert_true(values[i] == wanted[i] || (isnan(values[i]) && isnan(wanted[i])));
}

static void test_fields(void **state)
{
    (void)state;
    need_libnetcdf();
    write_model("a.nc", (model){"noleap", {3, 4, 6}, 3, false, false});
    mw_series *series = open_series("a.nc", NULL);
    const mw_series_info *info = mw_series_describe(series);
    assert_int_equal(info->step_count, 3);
    assert_true(info->times[0] == 3 && info->times[2] == 6);
    assert_string_equal(info->time_unit, "hours since 2020-01-01");
    assert_string_equal(info->calendar, "noleap");
    assert_int_equal(info->field_count, 4);
    assert_string_equal(info->fields[0].name, "zeta");
    assert_string_equal(info->fields[0].unit, "m");
    assert_string_equal(info->fields[0].long_name, "water level");
    assert_string_equal(info->fields[0].standard_name, "sea_surface_height_above_geoid");
    assert_string_equal(info->fields[2].long_name, "speed of the water, layer 1");
    assert_string_equal(info->fields[2].standard_name, "");
    assert_int_equal(info->fields[0].location, MW_SERIES_VERTEX);
    assert_int_equal(info->fields[1].location, MW_SERIES_FACE);
    assert_int_equal(info->fields[3].constant, 1);
    expect_values(series, "zeta", 1, 4, (double[]){5, NAN, 7, 8});
    expect_values(series, "speed:0", 2, 2, (double[]){9 * 0.25, 11 * 0.25});
    expect_values(series, "speed:1", 0, 2, (double[]){2 * 0.25, 4 * 0.25});
    expect_values(series, "depth", 99, 4, (double[]){-1, -2, -3, -4});
    assert_true(mw_series_find(series, "speed") == SIZE_MAX);
    double values[4];
    assert_int_equal(mw_series_read(series, 0, 3, values, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_series_read(series, 4, 0, values, NULL), MW_ERROR_ARGUMENT);
    mw_series_close(series);
    files_clear();
}

static void expect_refused(const mw_series_options *options, const char *says)
{
    mw_series *series;
    mw_error error;
    assert_int_equal(mw_series_open("a.nc", options, &series, &error), MW_ERROR_INPUT);
    assert_null(series);
    files_expect_error(&error, MW_ERROR_INPUT, -1, says);
}

static void test_axis(void **state)
{
    (void)state;
    need_libnetcdf();
    write_model("a.nc", (model){"mayan", {3, 4, 6}, 3, false, false});
    expect_refused(NULL, "a.nc: variable time: the calendar 'mayan' is not one of CF");
    write_model("a.nc", (model){NULL, {3, 6, 4}, 3, false, false});
    expect_refused(NULL, "a.nc: variable time: times do not increase: step 1 has 6, step 2 4");
    write_model("a.nc", (model){NULL, {3, 3, 4}, 3, false, false});
    expect_refused(NULL, "times do not increase");
    write_model("a.nc", (model){NULL, {3, NAN, 4}, 3, false, false});
    expect_refused(NULL, "a.nc: variable time: step 1 has no time");
    write_model("a.nc", (model){NULL, {58849, 58849.5, 58850.25}, 3, false, true});
    mw_series *series = open_series("a.nc", NULL);
    const double *times = mw_series_describe(series)->times;
    assert_true(times[0] == 58849 && times[1] == 58849.5 && times[2] == 58850.25);
    mw_series_close(series);
    files_clear();
}

/* The mesh is in another file: its numbers of vertices and faces tell the dimensions. */
static void test_counts(void **state)
{
    (void)state;
    need_libnetcdf();
    write_model("a.nc", (model){NULL, {3, 4, 6}, 3, true, false});
    expect_refused(NULL, "no mesh in a known layout");
    mw_series_options options = {.vertex_count = 4, .face_count = 2};
    mw_series *series = open_series("a.nc", &options);
    expect_values(series, "zeta", 0, 4, (double[]){1, 2, 3, 4});
    mw_series_close(series);
    options.vertex_count = 5;
    options.face_count = 0;
    expect_refused(&options, "no values at the vertices");
    write_model("a.nc", (model){NULL, {3, 4, 6}, 3, false, false});
    expect_refused(&options, "a.nc: it has values at 4 vertices, but the mesh has 5");
    files_clear();
}

static void test_several(void **state)
{
    (void)state;
    need_libnetcdf();
    write_model("a.nc", (model){NULL, {3, 4}, 2, false, false});
    write_model("b.nc", (model){NULL, {5, 6, 7}, 3, false, false});
    const char *more[] = {"b.nc"};
    mw_series_options options = {.more_paths = more, .more_count = 1};
    mw_series *series = open_series("a.nc", &options);
    assert_int_equal(mw_series_describe(series)->step_count, 5);
    expect_values(series, "zeta", 2, 4, (double[]){1, 2, 3, 4});
    expect_values(series, "zeta", 4, 4, (double[]){9, 10, 11, 12});
    mw_series_close(series);
    write_model("b.nc", (model){NULL, {4, 6}, 2, false, false});
    expect_refused(&options,
                   "b.nc: its first time, 4, is not later than the last one of the file before, 4");
    write_model("b.nc", (model){"julian", {5, 6}, 2, false, false});
    expect_refused(&options, "b.nc: its times are");
    files_write_text("a.nc", "x y\n");
    expect_refused(NULL, "a.nc: not values over time in a known format");
    files_clear();
}

static void test_models(void **state)
{
    (void)state;
    need_libnetcdf();
    static const struct {
        const char *name;
        size_t steps;
        const char *field;
        size_t values;
        bool numbered; /* HDF5 that libnetcdf misreads on big-endian machines: test_io_layouts.c */
    } models[] = {
        {"ocean/shinnecock_fort.63.nc", 57, "zeta", 3070, false},
        {"ocean/fvcom_example.nc", 10, "u:19", 903, true},
        {"ocean/schism_out2d.nc.gz", 48, "dryFlagElement", 791, true},
        {"ocean/cairns.sww.gz", 51, "stage", 2579, false},
        {"ocean/icon_5120.nc.gz", 2, "t2m:1", 5120, false},
        {"ocean/dflow_simplebox_hex7_map.nc.gz", 13, "mesh2d_s1", 810, false},
        {"ocean/ugrid_adcirc_bg.nc.gz", 2, "ssh", 12769, false},
        {"ocean/tuflowfv_cone.nc.gz", 16, "H", 2866, true},
        {"ocean/ugrid_elevation_nl.nc.gz", 0, "elevation", 5248, true},
    };
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        const char *path = files_shared(models[i].name);
        if (!path || (models[i].numbered && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)) continue;
        mw_series *series = open_series(path, NULL);
        const mw_series_info *info = mw_series_describe(series);
        assert_int_equal(info->step_count, models[i].steps);
        size_t field = mw_series_find(series, models[i].field);
        assert_true(field != SIZE_MAX);
        assert_int_equal(info->fields[field].value_count, models[i].values);
        static double values[12769];
        assert_int_equal(mw_series_read(series, field, info->step_count / 2, values, NULL), MW_OK);
        mw_series_close(series);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fields), cmocka_unit_test(test_axis),
        cmocka_unit_test(test_counts), cmocka_unit_test(test_several),
        cmocka_unit_test(test_models),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
