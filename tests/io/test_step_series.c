/* test_step_series.c - values over time in files that are read from their beginning on. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/files.h"
#include "support/grid_bytes.h"

#include <math.h>
#include <meshwalk/series.h>
#include <stdio.h>
#include <string.h>

static mw_series *open_series(const char *path, size_t vertices)
{
    mw_series *series;
    mw_error error;
    const mw_series_options options = {.vertex_count = vertices};
    if (mw_series_open(path, &options, &series, &error)) fail_msg("%s", error.message);
    return series;
}

static void expect_step(mw_series *series, size_t field, size_t step, const double *wanted)
{
    double values[8];
    mw_error error;
    size_t count = mw_series_describe(series)->fields[field].value_count;
    if (mw_series_read(series, field, step, values, &error)) fail_msg("%s", error.message);
    for (size_t v = 0; v < count; v++)
        if (!(values[v] == wanted[v] || (isnan(values[v]) && isnan(wanted[v]))))
            fail_msg("field %zu, step %zu, value %zu: %g, not %g", field, step, v, values[v],
                     wanted[v]);
}

static void test_selafin(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        grid_bytes g = grid_selafin((grid_form){.big = k & 1, .wide = k & 2});
        files_write("r.slf", (bytes){g.bytes, g.size});
        mw_series *series = open_series("r.slf", 5);
        const mw_series_info *info = mw_series_describe(series);
        assert_int_equal(info->step_count, 2);
        assert_true(info->times[0] == 0 && info->times[1] == 60);
        assert_string_equal(info->time_unit, "seconds since 2020-01-02 03:04:05");
        assert_int_equal(info->field_count, 1);
        assert_string_equal(info->fields[0].name, "q");
        assert_string_equal(info->fields[0].unit, "m");
        expect_step(series, 0, 1, (const double[]){1, 11, 21, 31, 41});
        expect_step(series, 0, 0, (const double[]){0, 10, 20, 30, 40});
        expect_step(series, 0, 1, (const double[]){1, 11, 21, 31, 41});
        mw_series_close(series);
        grid_release(&g);
    }
}

static const char fort63[] = "a run\n3 3 3600.0 60 1 FileFmtVersion: 1\n"
                             "3600.0 60\n1 0.5\n2 -99999.0\n3 1.5E+00\n"
                             "7200.0 120 1 -99999.0\n2 2.5\n10800 180 2 0.25\n3 9\n1 8\n";

/* All vertices of a time, or a few and the value of the others. */
static void test_adcirc(void **state)
{
    (void)state;
    files_write_text("fort.63", fort63);
    mw_series *series = open_series("fort.63", 3);
    const mw_series_info *info = mw_series_describe(series);
    assert_int_equal(info->step_count, 3);
    assert_true(info->times[2] == 10800);
    assert_string_equal(info->fields[0].name, "zeta");
    expect_step(series, 0, 0, (const double[]){.5, NAN, 1.5});
    expect_step(series, 0, 2, (const double[]){8, .25, 9});
    expect_step(series, 0, 1, (const double[]){NAN, 2.5, NAN});
    mw_series_close(series);
    files_write_text("fort.64", "a run\n1 2 3600 60 2\n0 0\n1 1 2\n2 3 4\n");
    series = open_series("fort.64", 0);
    info = mw_series_describe(series);
    assert_int_equal(info->field_count, 2);
    assert_string_equal(info->fields[0].name, "u-vel");
    assert_string_equal(info->fields[1].name, "v-vel");
    expect_step(series, 0, 0, (const double[]){1, 3});
    expect_step(series, 1, 0, (const double[]){2, 4});
    mw_series_close(series);
    files_write_text("maxele.63", "a run\n2 2 9 9 1\n900 9\n1 1\n2 2\n900 9\n1 100\n2 200\n");
    series = open_series("maxele.63", 2);
    assert_int_equal(mw_series_describe(series)->step_count, 1);
    expect_step(series, mw_series_find(series, "zeta_max"), 0, (const double[]){1, 2});
    mw_series_close(series);
}

static const char sms_text[] =
    "DATASET\nOBJTYPE \"mesh2d\"\nRT_JULIAN 2433282.500000\nBEGSCL\nND 3\nNC 2\nNAME \"a depth\"\n"
    "TIMEUNITS se\nTS 0 0.5\n1\n2\n3\nTS 1 60\n1\n0\n4\n5 6\nENDDS\n";

static void test_sms(void **state)
{
    (void)state;
    files_write_text("a.dat", sms_text);
    mw_series *series = open_series("a.dat", 3);
    const mw_series_info *info = mw_series_describe(series);
    assert_int_equal(info->step_count, 2);
    assert_string_equal(info->fields[0].name, "a depth");
    assert_string_equal(info->time_unit, "seconds since 1950-01-01 00:00:00");
    expect_step(series, 0, 1, (const double[]){4, 5, 6});
    expect_step(series, 0, 0, (const double[]){1, 2, 3});
    mw_series_close(series);
    files_write_text("v_els_.dat", "DATASET\nBEGVEC\nND 3\nNC 2\nNAME \"v\"\nTS 0 1\n1 2\n3 4\n");
    series = open_series("v_els_.dat", 0);
    info = mw_series_describe(series);
    assert_int_equal(info->field_count, 2);
    assert_int_equal(info->fields[1].location, MW_SERIES_FACE);
    assert_string_equal(info->fields[1].name, "v_y");
    assert_string_equal(info->time_unit, "hours");
    expect_step(series, 1, 0, (const double[]){2, 4});
    mw_series_close(series);
}

/* Older files: without a name, with the time alone behind TS. */
static void test_sms_old(void **state)
{
    (void)state;
    files_write_text("old.dat", "SCALAR\r\nND 3\r\nTS 0.5\r\n1\r\n2\r\n3\r\nTS  1.5 \r\n4 5 6\r\n");
    mw_series *series = open_series("old.dat", 3);
    const mw_series_info *info = mw_series_describe(series);
    assert_int_equal(info->step_count, 2);
    assert_true(info->times[0] == .5 && info->times[1] == 1.5);
    assert_string_equal(info->fields[0].name, "values");
    expect_step(series, 0, 1, (const double[]){4, 5, 6});
    mw_series_close(series);
}

/* Numbers of four bytes in the other order. */
static void test_sms_other_order(void **state)
{
    (void)state;
    static const unsigned char head[] = {0,   0, 11, 184, 0, 0,   0, 110, 0,   0, 0, 8,  0,   0, 0,
                                         120, 0, 0,  0,   1, 0,   0, 0,   130, 0, 0, 0,  170, 0, 0,
                                         0,   1, 0,  0,   0, 200, 0, 63,  224, 0, 0, 0,  0,   0, 0,
                                         64,  4, 0,  0,   0, 0,   0, 0,   0,   0, 0, 210};
    files_write("b.dat", (bytes){(const char *)head, sizeof head});
    mw_series *series = open_series("b.dat", 1);
    assert_true(mw_series_describe(series)->times[0] == .5);
    expect_step(series, 0, 0, (const double[]){2.5});
    mw_series_close(series);
}

static void test_sms_bytes(void **state)
{
    (void)state;
    char file[512];
    size_t size = 0;
    const int32_t head[] = {3000, 100, 3, 110, 4, 120, 1, 130, 170, 3, 180, 2, 250, 1, 190};
    memcpy(file, head, size = sizeof head);
    memset(file + size, ' ', 40);
    memcpy(file + size, "Dep", 3);
    size += 40;
    for (int step = 0; step < 2; step++) {
        const int32_t card = 200;
        const float numbers[] = {(float)step, 1, 2, 3 + (float)step};
        memcpy(file + size, &card, 4);
        file[size + 4] = (char)step; /* activity follows at the second time */
        memcpy(file + size + 5, numbers, 4);
        size += 9;
        for (int k = 0; k < 2 * step; k++) file[size++] = 1;
        memcpy(file + size, numbers + 1, 12);
        size += 12;
    }
    memcpy(file + size, &(int32_t){210}, 4);
    size += 4;
    files_write("b.dat", (bytes){file, size});
    mw_series *series = open_series("b.dat", 3);
    assert_int_equal(mw_series_describe(series)->step_count, 2);
    assert_string_equal(mw_series_describe(series)->fields[0].name, "Dep");
    assert_string_equal(mw_series_describe(series)->time_unit, "minutes");
    expect_step(series, 0, 1, (const double[]){1, 2, 4});
    mw_series_close(series);
    for (size_t cut = 0; cut < size; cut++) {
        mw_error error;
        files_write("b.dat", (bytes){file, cut});
        mw_status status = mw_series_open("b.dat", NULL, &series, &error);
        assert_true(status == MW_ERROR_INPUT || mw_series_describe(series)->step_count > 0);
        mw_series_close(series);
    }
}

static void test_malformed(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *says;
        int64_t line;
    } cases[] = {
        {"fort.63", "", "the file ends in its header", 1},
        {"fort.63", "a\n3 0 1 1 1\n", "1 values at each of 0 vertices", 2},
        {"fort.63", "a\n3 9999999999 1 1 1\n", "9999999999 vertices", 2},
        {"fort.63", "a\n3 4 1 1 1\n", "values at 4 vertices, but the mesh has 3", 2},
        {"fort.63", "a\n3 3 1 1 7\n", "7 values at each of 3 vertices", 2},
        {"fort.63", "a\n3 3 1 1 1\n", "no values in this file", 2},
        {"fort.63", "a\n3 3 1 1 1\n0 0\n1 1\n", "the file ends after 1 of 3 vertices", 4},
        {"fort.63", "a\n3 3 1 1 1\n5 0 0 1\n5 0 0 1\n",
         "time 5 is not later than the time before it", 4},
        {"fort.63", "a\n3 3 1 1 1\nnan 0 0 1\n", "time nan is not later", 3},
        {"fort.63", "a\n3 3 1 1 1\n5 0 4 1\n", "values at 4 vertices; the mesh has 3", 3},
        {"a.dat", "DATASET\nBEGSCL\nND 4\nTS 0 1\n", "values at 4 vertices, but the mesh has 3", 4},
        {"a.dat", "DATASET\nND 3\nTS 0 1\n", "0 values at each of 3 vertices", 3},
        {"a.dat", "DATASET\nBEGSCL\nND 3\nTS 0 1\n1 2\n", "the file ends before the value", 5},
        {"a.dat", "DATASET\nBEGSCL\nND 3\nTS 0 1\n1 2 3\nBEGSCL\n", "a second dataset", 6},
        {"notes.txt", "a\n", "not values over time in a known format", -1},
    };
    const mw_series_options options = {.vertex_count = 3};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mw_series *series;
        mw_error error;
        files_write_text(cases[i].name, cases[i].text);
        if (mw_series_open(cases[i].name, &options, &series, &error) != MW_ERROR_INPUT)
            fail_msg("case %zu was taken", i);
        files_expect_error(&error, MW_ERROR_INPUT, cases[i].line, cases[i].says);
        assert_null(series);
    }
    /* numbers of vertices are looked at when they are read */
    files_write_text("fort.63", "a\n1 3 1 1 1\n0 0\n1 1\n4 1\n3 1\n");
    mw_series *series = open_series("fort.63", 3);
    double values[3];
    mw_error error;
    assert_int_equal(mw_series_read(series, 0, 0, values, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, 5, "vertex 4 does not exist");
    assert_int_equal(mw_series_read(series, 0, 1, values, &error), MW_ERROR_ARGUMENT);
    mw_series_close(series);
}

/* Files that are cut short anywhere are refused, or have fewer steps. */
static void test_cut(void **state)
{
    (void)state;
    grid_bytes g = grid_selafin((grid_form){.big = true});
    for (size_t size = 0; size < g.size; size += 7) {
        mw_series *series;
        mw_error error;
        files_write("r.slf", (bytes){g.bytes, size});
        mw_status status = mw_series_open("r.slf", NULL, &series, &error);
        assert_true(status == MW_ERROR_INPUT || mw_series_describe(series)->step_count == 1);
        mw_series_close(series);
    }
    grid_release(&g);
    for (size_t size = 0; size < sizeof fort63 - 1; size += 3) {
        mw_series *series;
        mw_error error;
        files_write("fort.63", (bytes){fort63, size});
        if (mw_series_open("fort.63", NULL, &series, &error)) continue;
        for (size_t s = 0; s < mw_series_describe(series)->step_count; s++) {
            double values[3];
            mw_status status = mw_series_read(series, 0, s, values, &error);
            assert_true(status == MW_OK || status == MW_ERROR_INPUT);
        }
        mw_series_close(series);
    }
}

static void test_shared(void **state)
{
    (void)state;
    const char *path = files_shared("ocean/tidal_flats.slf.gz");
    if (!path) skip();
    mw_series *series = open_series(path, 648);
    const mw_series_info *info = mw_series_describe(series);
    assert_int_equal(info->step_count, 17);
    assert_true(info->times[16] == 160000);
    assert_int_equal(info->field_count, 5);
    assert_string_equal(info->fields[3].name, "FREE SURFACE");
    mw_series_close(series);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_selafin),   cmocka_unit_test(test_adcirc),
        cmocka_unit_test(test_sms),       cmocka_unit_test(test_sms_bytes),
        cmocka_unit_test(test_sms_old),   cmocka_unit_test(test_sms_other_order),
        cmocka_unit_test(test_malformed), cmocka_unit_test(test_cut),
        cmocka_unit_test(test_shared),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
