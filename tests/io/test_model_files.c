/* test_model_files.c - whole files as models write them: SCHISM's schout with triangles,
 * quadrilaterals and currents of layers and components, MPAS with times as text, dates of ICON,
 * FVCOM's and ANUGA's times. Each is written here, read as a mesh and as values over time.
 * Left out where libnetcdf is not found. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/netcdf/netcdf_output.h"
#include "support/files.h"

#include <math.h>
#include <meshwalk/io.h>
#include <meshwalk/series.h>
#include <stdio.h>
#include <string.h>

static mw_netcdf_output *output;

static void begin(void)
{
    mw_error error;
    if (mw_netcdf_version(NULL, 0) == 0) {
        print_message("left out: libnetcdf is not found\n");
        skip();
    }
    if (mw__netcdf_output_open("a.nc", &output, &error)) fail_msg("%s", error.message);
}

static void end(void)
{
    mw_error error;
    if (mw__netcdf_output_close(output, true, &error)) fail_msg("%s", error.message);
}

static int dimension(const char *name, size_t length)
{
    return mw__netcdf_output_dimension(output, name, length);
}

/* Dimensions end with -1. */
static int variable(const char *name, mw_netcdf_type type, const int *dimensions)
{
    size_t rank = 0;
    while (dimensions[rank] >= 0) rank++;
    return mw__netcdf_output_variable(output, name, type, rank, dimensions);
}

static void attribute(int of, const char *name, const char *text)
{
    mw__netcdf_output_text(output, of, name, text);
}

static void put(int to, const size_t *counts, const double *values)
{
    static const size_t starts[4];
    mw__netcdf_output_doubles(output, to, starts, counts, values);
}

static mw_series *open_series(void)
{
    mw_series *series;
    mw_error error;
    if (mw_series_open("a.nc", NULL, &series, &error)) fail_msg("%s", error.message);
    return series;
}

static void expect_values(mw_series *series, const char *field, size_t step, size_t count,
                          const double *wanted)
{
    double values[8];
    const size_t f = mw_series_find(series, field);
    if (f == SIZE_MAX) fail_msg("there is no field %s", field);
    assert_int_equal(mw_series_describe(series)->fields[f].value_count, count);
    assert_int_equal(mw_series_read(series, f, step, values, NULL), MW_OK);
    for (size_t i = 0; i < count; i++)
        if (!(values[i] == wanted[i] || (isnan(values[i]) && isnan(wanted[i]))))
            fail_msg("%s, step %zu, value %zu: %g, not %g", field, step, i, values[i], wanted[i]);
}

static void expect_times(const mw_series *series, const char *unit, size_t count,
                         const double *times)
{
    const mw_series_info *info = mw_series_describe(series);
    assert_string_equal(info->time_unit, unit);
    assert_int_equal(info->step_count, count);
    for (size_t s = 0; s < count; s++)
        if (info->times[s] != times[s])
            fail_msg("step %zu is at %.17g, not %.17g", s, info->times[s], times[s]);
}

/* --- SCHISM ----------------------------------------------------------------------------------- */

/* A triangle and a quadrilateral; 2 steps of 3 layers and 2 components. With the variable that
 * tells the topology, or without it as older files are. */
static void write_schout(bool topology)
{
    begin();
    const int node = dimension("nSCHISM_hgrid_node", 5), face = dimension("nSCHISM_hgrid_face", 2),
              corner = dimension("nMaxSCHISM_hgrid_face_nodes", 4),
              layer = dimension("nSCHISM_vgrid_layers", 3), two = dimension("two", 2),
              time = dimension("time", MW_NETCDF_UNLIMITED);
    const int t = variable("time", MW_NETCDF_DOUBLE, (int[]){time, -1}),
              x = variable("SCHISM_hgrid_node_x", MW_NETCDF_DOUBLE, (int[]){node, -1}),
              y = variable("SCHISM_hgrid_node_y", MW_NETCDF_DOUBLE, (int[]){node, -1}),
              corners =
                  variable("SCHISM_hgrid_face_nodes", MW_NETCDF_INT, (int[]){face, corner, -1}),
              depth = variable("depth", MW_NETCDF_FLOAT, (int[]){node, -1}),
              elev = variable("elev", MW_NETCDF_FLOAT, (int[]){time, node, -1}),
              hvel = variable("hvel", MW_NETCDF_FLOAT, (int[]){time, node, layer, two, -1}),
              dry = variable("wetdry_elem", MW_NETCDF_FLOAT, (int[]){time, face, -1});
    attribute(t, "units", "seconds since 2011-05-01 00:00:00 +0000");
    attribute(hvel, "long_name", "horizontal current");
    attribute(hvel, "units", "m/s");
    mw__netcdf_output_number(output, corners, "_FillValue", MW_NETCDF_INT, -2147483647.0);
    mw__netcdf_output_number(output, corners, "start_index", MW_NETCDF_INT, 1);
    mw__netcdf_output_number(output, hvel, "missing_value", MW_NETCDF_FLOAT, -9999);
    if (topology) {
        const int mesh = variable("SCHISM_hgrid", MW_NETCDF_INT, (int[]){-1});
        attribute(mesh, "cf_role", "mesh_topology");
        mw__netcdf_output_number(output, mesh, "topology_dimension", MW_NETCDF_INT, 2);
        attribute(mesh, "node_coordinates", "SCHISM_hgrid_node_x SCHISM_hgrid_node_y");
        attribute(mesh, "face_node_connectivity", "SCHISM_hgrid_face_nodes");
    }
    mw__netcdf_output_defined(output);
    put(t, (size_t[]){2}, (double[]){3600, 7200});
    put(x, (size_t[]){5}, (double[]){0, 1, 1, 0, 2});
    put(y, (size_t[]){5}, (double[]){0, 0, 1, 1, 0});
    put(corners, (size_t[]){2, 4}, (double[]){1, 2, 3, 4, 2, 5, 3, -2147483647.0});
    put(depth, (size_t[]){5}, (double[]){-1, 2, 3, 4, 5});
    put(elev, (size_t[]){2, 5}, (double[]){1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    put(dry, (size_t[]){2, 2}, (double[]){0, 1, 1, 0});
    double currents[2 * 5 * 3 * 2];
    for (int k = 0; k < 60; k++) currents[k] = k; /* ((step * 5 + node) * 3 + layer) * 2 + part */
    currents[((1 * 5 + 2) * 3 + 0) * 2 + 1] = -9999;
    put(hvel, (size_t[]){2, 5, 3, 2}, currents);
    end();
}

static void test_schout(void **state)
{
    (void)state;
    for (int topology = 0; topology < 2; topology++) {
        write_schout(topology);
        mw_mesh_file file;
        mw_error error;
        if (mw_read_mesh("a.nc", NULL, &file, &error)) fail_msg("%s", error.message);
        assert_int_equal(file.point_count, 5);
        assert_int_equal(file.face_count, 2);
        assert_int_equal(file.triangle_count, 3);
        assert_int_equal(file.faces[0], 0);
        assert_int_equal(file.faces[1], 0);
        assert_int_equal(file.faces[2], 1);
        assert_int_equal(file.first_number, 1);
        /* both diagonals are as long: that of the lower vertex is cut */
        assert_memory_equal(file.triangles, ((uint32_t[]){0, 1, 2, 0, 2, 3, 1, 4, 2}),
                            9 * sizeof(uint32_t));
        assert_true(file.fields[0][0] == -1 && strcmp(file.field_names[0], "depth") == 0);
        mw_mesh_file_release(&file);
        mw_series *series = open_series();
        expect_times(series, "seconds since 2011-05-01 00:00:00 +0000", 2, (double[]){3600, 7200});
        expect_values(series, "elev", 1, 5, (double[]){6, 7, 8, 9, 10});
        expect_values(series, "wetdry_elem", 0, 2, (double[]){0, 1});
        expect_values(series, "hvel:2:1", 0, 5, (double[]){5, 11, 17, 23, 29});
        expect_values(series, "hvel:0:1", 1, 5, (double[]){31, 37, NAN, 49, 55});
        const mw_series_field *field =
            &mw_series_describe(series)->fields[mw_series_find(series, "hvel:2:1")];
        assert_string_equal(field->long_name, "horizontal current, nSCHISM_vgrid_layers 2, two 1");
        assert_string_equal(field->unit, "m/s");
        mw_series_close(series);
    }
    files_clear();
}

/* --- MPAS ------------------------------------------------------------------------------------- */

/* Four cells of which the triangles of two vertices are whole; a third lacks a cell. */
static void write_mpas(const char *const *times, size_t steps)
{
    enum { LENGTH = 64 };
    static const double turn = 3.14159265358979323846 / 180;
    char rows[3][LENGTH];
    begin();
    const int cell = dimension("nCells", 4), vertex = dimension("nVertices", 3),
              degree = dimension("vertexDegree", 3), level = dimension("nVertLevels", 2),
              length = dimension("StrLen", LENGTH), time = dimension("Time", MW_NETCDF_UNLIMITED);
    const int lon = variable("lonCell", MW_NETCDF_DOUBLE, (int[]){cell, -1}),
              lat = variable("latCell", MW_NETCDF_DOUBLE, (int[]){cell, -1}),
              cells = variable("cellsOnVertex", MW_NETCDF_INT, (int[]){vertex, degree, -1}),
              xtime = variable("xtime", MW_NETCDF_CHAR, (int[]){time, length, -1}),
              ssh = variable("ssh", MW_NETCDF_DOUBLE, (int[]){time, cell, -1}),
              warm = variable("temperature", MW_NETCDF_DOUBLE, (int[]){time, cell, level, -1});
    attribute(MW_NETCDF_OUTPUT_FILE, "config_calendar_type", "gregorian_noleap");
    mw__netcdf_output_defined(output);
    put(lon, (size_t[]){4}, (double[]){10 * turn, 20 * turn, 20 * turn, 10 * turn});
    put(lat, (size_t[]){4}, (double[]){0, 0, 10 * turn, 10 * turn});
    put(cells, (size_t[]){3, 3}, (double[]){1, 2, 3, 1, 3, 4, 4, 0, 1});
    memset(rows, ' ', sizeof rows);
    for (size_t k = 0; k < steps; k++) memcpy(rows[k], times[k], strlen(times[k]));
    mw__netcdf_output_characters(output, xtime, (size_t[]){0, 0}, (size_t[]){steps, LENGTH},
                                 rows[0]);
    put(ssh, (size_t[]){steps, 4}, (double[]){1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    double levels[24];
    for (int k = 0; k < 24; k++) levels[k] = k;
    put(warm, (size_t[]){steps, 4, 2}, levels);
    end();
}

static void test_mpas(void **state)
{
    (void)state;
    static const char *const times[] = {"2000-02-28_00:00:00", "2000-03-01_12:00:00",
                                        "2001-03-01_00:00:00"};
    write_mpas(times, 3);
    mw_mesh_file file;
    mw_error error;
    if (mw_read_mesh("a.nc", NULL, &file, &error)) fail_msg("%s", error.message);
    assert_int_equal(file.point_count, 4);
    assert_int_equal(file.triangle_count, 2);
    assert_string_equal(file.crs, "EPSG:4326");
    assert_true(fabs(file.points[3] - 20) < 1e-12 && fabs(file.points[7] - 10) < 1e-12);
    mw_mesh_file_release(&file);
    mw_series *series = open_series();
    expect_times(series, "seconds since 2000-02-28 00:00:00", 3,
                 (double[]){0, 1.5 * 86400, 366 * 86400.0}); /* no 29th of February */
    assert_string_equal(mw_series_describe(series)->calendar, "noleap");
    expect_values(series, "ssh", 2, 4, (double[]){9, 10, 11, 12});
    expect_values(series, "temperature:1", 1, 4, (double[]){9, 11, 13, 15});
    mw_series_close(series);
    files_clear();
}

/* --- times ------------------------------------------------------------------------------------ */

/* A triangle whose corners are in `table`, with the values 1, 2, 3 at each step. `texts`: FVCOM's
 * Times, or NULL. */
typedef struct timed_file {
    const char *table, *unit, *calendar, *texts[3];
    mw_netcdf_type type;
    double times[3], start; /* ANUGA's start; 0: none */
    bool first_one;
} timed_file;

static void write_timed(const timed_file *f)
{
    enum { LENGTH = 26 };
    char rows[3][LENGTH];
    begin();
    const int node = dimension("node", 3), face = dimension("nele", 1), three = dimension("k", 3),
              length = dimension("DateStrLen", LENGTH), time = dimension("time", 3);
    const int x = variable("x", MW_NETCDF_DOUBLE, (int[]){node, -1}),
              y = variable("y", MW_NETCDF_DOUBLE, (int[]){node, -1}),
              corners = variable(f->table, MW_NETCDF_INT, (int[]){face, three, -1}),
              t = variable("time", f->type, (int[]){time, -1}),
              zeta = variable("zeta", MW_NETCDF_DOUBLE, (int[]){time, node, -1});
    const int texts =
        f->texts[0] ? variable("Times", MW_NETCDF_CHAR, (int[]){time, length, -1}) : -1;
    if (f->unit) attribute(t, "units", f->unit);
    if (f->calendar) attribute(t, "calendar", f->calendar);
    if (f->start > 0)
        mw__netcdf_output_number(output, MW_NETCDF_OUTPUT_FILE, "starttime", MW_NETCDF_DOUBLE,
                                 f->start);
    mw__netcdf_output_defined(output);
    put(x, (size_t[]){3}, (double[]){0, 1, 0});
    put(y, (size_t[]){3}, (double[]){0, 0, 1});
    put(corners, (size_t[]){1, 3}, f->first_one ? (double[]){1, 2, 3} : (double[]){0, 1, 2});
    put(t, (size_t[]){3}, f->times);
    put(zeta, (size_t[]){3, 3}, (double[]){1, 2, 3, 1, 2, 3, 1, 2, 3});
    memset(rows, 0, sizeof rows);
    for (size_t k = 0; k < 3 && texts >= 0; k++) memcpy(rows[k], f->texts[k], strlen(f->texts[k]));
    if (texts >= 0)
        mw__netcdf_output_characters(output, texts, (size_t[]){0, 0}, (size_t[]){3, LENGTH},
                                     rows[0]);
    end();
}

static void expect_timed(const timed_file *f, const char *unit, const double *times)
{
    write_timed(f);
    mw_series *series = open_series();
    expect_times(series, unit, 3, times);
    mw_series_close(series);
    files_clear();
}

static void expect_refused(const timed_file *f, const char *says)
{
    mw_series *series;
    mw_error error;
    write_timed(f);
    assert_int_equal(mw_series_open("a.nc", NULL, &series, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, says);
    files_clear();
}

/* Numbers of dates jump from month to month; days between them do not. */
static void test_dates(void **state)
{
    (void)state;
    timed_file f = {"element",
                    "day as %Y%m%d.%f",
                    "proleptic_gregorian",
                    {0},
                    MW_NETCDF_DOUBLE,
                    {20160228.75, 20160229.5, 20160301},
                    0,
                    true};
    expect_timed(&f, "days since 2016-02-28 00:00:00", (double[]){0.75, 1.5, 2});
    f.calendar = "360_day";
    expect_timed(&f, "days since 2016-02-28 00:00:00", (double[]){0.75, 1.5, 3});
    f.calendar = "julian";
    expect_refused(&f, "a.nc: variable time: dates of the calendar 'julian' are not known");
    f.calendar = NULL;
    f.times[1] = 20161301;
    expect_refused(&f, "a.nc: variable time: step 1: 20161301 is not a date");
    f.times[1] = 20160228.5;
    expect_refused(&f, "a.nc: variable time: times do not increase");
}

/* Floats tell minutes at best. Texts that are other times are not believed. */
static void test_texts(void **state)
{
    (void)state;
    timed_file f = {
        "nv",
        "days since 1858-11-17 00:00:00",
        NULL,
        {"2024-05-23T00:00:00.000000", "2024-05-23T01:00:00.000000", "2024-05-23T02:30:00.000000"},
        MW_NETCDF_FLOAT,
        {60453, 60453 + 1 / 24.0, 60453 + 2.5 / 24},
        0,
        true};
    expect_timed(&f, "days since 1858-11-17 00:00:00", f.times);
    f.unit = "hours since 2024-05-22 12:00:00";
    for (int k = 0; k < 3; k++) f.times[k] = 12 + (double[]){0, 1, 2.5}[k];
    expect_timed(&f, "hours since 2024-05-22 12:00:00", f.times);
    f.texts[1] = "2024-05-23T01:30:00.000000";
    expect_timed(&f, "hours since 2024-05-22 12:00:00", f.times);
}

static void test_start(void **state)
{
    (void)state;
    timed_file f = {"volumes", NULL, NULL, {0}, MW_NETCDF_FLOAT, {0, 10, 20}, 0, false};
    expect_timed(&f, "seconds", f.times);
    f.start = 951782400 + 3661; /* 2000-02-29 */
    expect_timed(&f, "seconds since 2000-02-29 01:01:01", f.times);
    f.start = 951868800.5;
    expect_timed(&f, "seconds since 2000-03-01 00:00:00", (double[]){0.5, 10.5, 20.5});
    f.start = 1704067199; /* the last second of 2023 */
    expect_timed(&f, "seconds since 2023-12-31 23:59:59", f.times);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_schout), cmocka_unit_test(test_mpas),  cmocka_unit_test(test_dates),
        cmocka_unit_test(test_texts),  cmocka_unit_test(test_start),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
