/* test_time_texts.c - times that netCDF files hold as text: lengths of years, calendars, what is
 * refused. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <string.h>

#include "io/netcdf/netcdf_output.h"
#include "support/files.h"

#include <meshwalk/io.h>
#include <meshwalk/series.h>

enum { STEPS = 2, LENGTH = 64 };

static void write_times(const char *calendar, const char *const texts[STEPS])
{
    mw_netcdf_output *output;
    char rows[STEPS][LENGTH];
    mw_error error;
    if (mw__netcdf_output_open("a.nc", &output, &error)) fail_msg("%s", error.message);
    const int time = mw__netcdf_output_dimension(output, "Time", STEPS),
              length = mw__netcdf_output_dimension(output, "StrLen", LENGTH),
              cell = mw__netcdf_output_dimension(output, "nCells", 3);
    const int xtime =
        mw__netcdf_output_variable(output, "xtime", MW_NETCDF_CHAR, 2, (int[]){time, length});
    mw__netcdf_output_variable(output, "ssh", MW_NETCDF_DOUBLE, 2, (int[]){time, cell});
    if (calendar)
        mw__netcdf_output_text(output, MW_NETCDF_OUTPUT_FILE, "config_calendar_type", calendar);
    mw__netcdf_output_defined(output);
    memset(rows, ' ', sizeof rows);
    for (int k = 0; k < STEPS; k++) memcpy(rows[k], texts[k], strlen(texts[k]));
    rows[1][strlen(texts[1])] = 0; /* blanks or a NUL end a text */
    mw__netcdf_output_characters(output, xtime, (size_t[]){0, 0}, (size_t[]){STEPS, LENGTH},
                                 rows[0]);
    if (mw__netcdf_output_close(output, true, &error)) fail_msg("%s", error.message);
}

static mw_status open_times(mw_series **series, mw_error *error)
{
    const mw_series_options options = {.vertex_count = 3};
    return mw_series_open("a.nc", &options, series, error);
}

static void expect_times(const char *calendar, const char *name, const char *from, const char *to,
                         double days)
{
    mw_series *series;
    mw_error error;
    char unit[64] = "seconds since ";
    write_times(calendar, (const char *const[]){from, to});
    if (open_times(&series, &error)) fail_msg("%s", error.message);
    const mw_series_info *info = mw_series_describe(series);
    strcat(unit, from);
    unit[strlen("seconds since 2000-01-01")] = ' ';
    assert_string_equal(info->time_unit, unit);
    assert_string_equal(info->calendar, name);
    assert_int_equal(info->step_count, STEPS);
    assert_true(info->times[0] == 0 && info->times[1] == 86400 * days);
    mw_series_close(series);
}

static void test_calendars(void **state)
{
    static const char *const plain = "proleptic_gregorian";
    (void)state;
    if (mw_netcdf_version(NULL, 0) == 0) skip();
    expect_times(NULL, plain, "2000-02-28_00:00:00", "2000-03-01_12:00:00", 2.5);
    expect_times("gregorian", plain, "1900-02-28_06:00:00", "1900-03-01_00:00:00", 0.75);
    expect_times("standard", plain, "0000-01-01T00:00:00", "0001-01-01T00:00:00", 366);
    expect_times("gregorian", plain, "1600-01-01 00:00:00", "2000-01-01 00:00:00", 146097);
    expect_times("noleap", "noleap", "2000-02-28_00:00:00", "2000-03-01_00:00:00", 1);
    expect_times("gregorian_noleap", "noleap", "0001-12-31_23:59:59", "0002-01-01_00:00:01",
                 2 / 86400.0);
    expect_times("360_day", "360_day", "2000-02-28_00:00:00", "2001-03-01_00:00:00", 363);
    expect_times("360_day", "360_day", "2000-02-30_00:00:00", "2000-12-30_00:00:00", 300);
    expect_times(NULL, plain, "2000-02-29_00:00:00", "2000-12-31_00:00:00", 306);
    files_clear();
}

static void expect_refused(const char *calendar, const char *from, const char *to, const char *says)
{
    mw_series *series;
    mw_error error = {0};
    write_times(calendar, (const char *const[]){from, to});
    assert_int_equal(open_times(&series, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, says);
}

static void test_refused(void **state)
{
    static const char *const wrong[] = {"2000-13-01_00:00:00", "2000-00-01_00:00:00",
                                        "2000-01-01_00:61:00", "2000-01-01",
                                        "2000-01-01_00:00:0x", ""};
    (void)state;
    if (mw_netcdf_version(NULL, 0) == 0) skip();
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
        expect_refused(NULL, "2000-01-01_00:00:00", wrong[k], "variable xtime: step 1: '");
    expect_refused("mayan", "2000-01-01_00:00:00", "2000-01-02_00:00:00",
                   "config_calendar_type 'mayan' is not known");
    expect_refused(NULL, "2000-01-02_00:00:00", "2001-02-29_00:00:00",
                   "step 1: there is no day '2001-02-29' in its calendar");
    expect_refused("noleap", "2000-01-02_00:00:00", "2000-02-29_00:00:00", "no day '2000-02-29'");
    expect_refused("360_day", "2000-01-02_00:00:00", "2000-12-31_00:00:00", "no day '2000-12-31'");
    expect_refused(NULL, "2000-01-02_00:00:00", "2000-01-01_00:00:00",
                   "variable xtime: times do not increase");
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_calendars),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
