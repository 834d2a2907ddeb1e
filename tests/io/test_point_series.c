/* test_point_series.c - values over time at points: what is written by CF is there to be read.
 * Left out where libnetcdf is not found. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/netcdf/netcdf_file.h"
#include "support/files.h"

#include <math.h>
#include <meshwalk/point_series.h>
#include <meshwalk/version.h>
#include <stdlib.h>
#include <string.h>

static const double places[] = {1, 2, 0.5, 3, 4, 1.5}, times[] = {0, 1, 3};
static const char *const names[] = {"zeta", "temp:0"}, *const units[] = {"m", ""};
static const mw_location located[] = {{.where = MW_INSIDE}, {.where = MW_OUTSIDE}};

static void need_netcdf(void)
{
    if (mw_netcdf_version(NULL, 0) > 0) return;
    print_message("left out: there is no libnetcdf\n");
    skip();
}

static mw_point_series_layout stations(void)
{
    return (mw_point_series_layout){.positions = places,
                                    .position_stride = 3,
                                    .point_count = 2,
                                    .degrees = 1,
                                    .times = times,
                                    .time_count = 3,
                                    .time_unit = "hours since 2020-01-01",
                                    .calendar = "noleap",
                                    .names = names,
                                    .units = units,
                                    .field_count = 2,
                                    .located = located};
}

static void expect_numbers(const mw_netcdf *file, const char *name, size_t rank, size_t rows,
                           const double *want)
{
    double got[6];
    const size_t starts[2] = {0, 0}, counts[2] = {rank == 2 ? 2 : rows, rows};
    const mw_netcdf_variable *v = mw__netcdf_find(file, name);
    if (!v || v->rank != rank) fail_msg("%s", name);
    assert_int_equal(mw__netcdf_doubles(file, v, starts, counts, got, NULL), MW_OK);
    for (size_t i = 0; i < (rank == 2 ? 2 * rows : rows); i++)
        if (!(got[i] == want[i] || (isnan(got[i]) && isnan(want[i]))))
            fail_msg("%s: %g, not %g", name, got[i], want[i]);
}

static void expect_text(const mw_netcdf *file, const char *name, const char *attribute,
                        const char *want)
{
    char *text;
    const mw_netcdf_variable *v = name ? mw__netcdf_find(file, name) : NULL;
    assert_int_equal(mw__netcdf_text(file, v, attribute, &text, NULL), MW_OK);
    assert_non_null(text);
    assert_string_equal(text, want);
    free(text);
}

static mw_netcdf *series_write_and_open(const mw_point_series_layout *layout, size_t steps)
{
    mw_point_series *out;
    mw_netcdf *file;
    mw_error error;
    if (mw_point_series_open("s.nc", layout, &out, &error)) fail_msg("%s", error.message);
    for (size_t step = 0; step < steps; step++)
        for (size_t k = 0; k < 2; k++) {
            const double values[2] = {(double)(10 * step + k), NAN};
            mw_point_series_write(out, k, step, values);
        }
    assert_int_equal(mw_point_series_failed(out), 0);
    if (mw_point_series_close(out, 1, &error)) fail_msg("%s", error.message);
    assert_int_equal(mw__netcdf_open("s.nc", &file, NULL), MW_OK);
    return file;
}

static void test_time_series(void **state)
{
    (void)state;
    need_netcdf();
    const mw_point_series_layout layout = stations();
    mw_netcdf *file = series_write_and_open(&layout, 3);
    expect_numbers(file, "time", 1, 3, times);
    expect_numbers(file, "lon", 1, 2, (double[]){1, 3});
    expect_numbers(file, "lat", 1, 2, (double[]){2, 4});
    expect_numbers(file, "station_id", 1, 2, (double[]){0, 1});
    expect_numbers(file, "status", 1, 2, (double[]){MW_INSIDE, MW_OUTSIDE});
    expect_numbers(file, "zeta", 2, 3, (double[]){0, 10, 20, NAN, NAN, NAN});
    expect_numbers(file, "temp_0", 2, 3, (double[]){1, 11, 21, NAN, NAN, NAN});
    expect_text(file, NULL, "featureType", "timeSeries");
    expect_text(file, "station_id", "cf_role", "timeseries_id");
    expect_text(file, "time", "units", "hours since 2020-01-01");
    expect_text(file, "time", "calendar", "noleap");
    expect_text(file, "zeta", "units", "m");
    expect_text(file, "zeta", "coordinates", "time lat lon");
    expect_text(file, "temp_0", "long_name", "temp:0");
    expect_text(file, "zeta", "long_name", "zeta");
    expect_text(file, "zeta", "grid_mapping", "crs");
    expect_text(file, "crs", "grid_mapping_name", "latitude_longitude");
    expect_text(file, "status", "flag_meanings", "inside edge vertex outside hole near bad");
    expect_text(file, NULL, "title", "Values over time at points");
    expect_text(file, NULL, "history", "meshwalk " MW_VERSION_STRING);
    mw__netcdf_close(file);
    files_clear();
}

static void test_trajectory(void **state)
{
    (void)state;
    need_netcdf();
    mw_point_series_layout layout = stations();
    layout.feature = MW_POINT_TRAJECTORY;
    layout.times = places + 2;
    layout.time_stride = 3;
    layout.degrees = 0;
    layout.located = NULL;
    layout.crs = "PROJCS[\"made up\"]";
    layout.position_unit = "metre";
    layout.long_names = (const char *const[]){"water level", ""};
    layout.standard_names = (const char *const[]){"sea_surface_height_above_geoid", NULL};
    layout.title = "a ship";
    layout.history = "by hand";
    mw_netcdf *file = series_write_and_open(&layout, 1);
    expect_numbers(file, "time", 1, 2, (double[]){0.5, 1.5});
    expect_numbers(file, "x", 1, 2, (double[]){1, 3});
    expect_numbers(file, "zeta", 1, 2, (double[]){0, NAN});
    expect_text(file, NULL, "featureType", "trajectory");
    expect_text(file, "x", "units", "metre");
    expect_text(file, "crs", "crs_wkt", "PROJCS[\"made up\"]");
    expect_text(file, "zeta", "long_name", "water level");
    expect_text(file, "zeta", "standard_name", "sea_surface_height_above_geoid");
    expect_text(file, "temp_0", "long_name", "temp:0");
    expect_text(file, NULL, "title", "a ship");
    expect_text(file, NULL, "history", "by hand");
    expect_text(file, "trajectory", "cf_role", "trajectory_id");
    assert_null(mw__netcdf_find(file, "status"));
    mw__netcdf_close(file);
    files_clear();
}

static void test_refused(void **state)
{
    (void)state;
    need_netcdf();
    mw_point_series_layout layout = stations();
    mw_point_series *out = (mw_point_series *)1;
    mw_error error;
    assert_int_equal(mw_point_series_open("none/s.nc", &layout, &out, &error), MW_ERROR_SYSTEM);
    assert_null(out);
    assert_int_equal(mw_point_series_open(NULL, &layout, &out, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_point_series_open("s.nc", NULL, &out, &error), MW_ERROR_ARGUMENT);
    layout.positions = NULL;
    assert_int_equal(mw_point_series_open("s.nc", &layout, &out, &error), MW_ERROR_ARGUMENT);
    layout = stations();
    assert_int_equal(mw_point_series_open("s.nc", &layout, &out, &error), MW_OK);
    assert_int_equal(mw_point_series_close(out, 0, &error), MW_OK);
    assert_int_equal(files_count(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_time_series),
        cmocka_unit_test(test_trajectory),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
