/* test_io_weights.c - files of weights: what is written is read back, applied to the fields of
 * netCDF files, and refused where it does not fit. Left out where libnetcdf is not found. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/netcdf/netcdf_output.h"
#include "support/files.h"

#include <math.h>
#include <meshwalk/weights.h>
#include <stdlib.h>
#include <string.h>

static void need_netcdf(void)
{
    if (mw_netcdf_version(NULL, 0) > 0) return;
    print_message("left out: there is no libnetcdf\n");
    skip();
}

/* Three points of four vertices; the last point has no weights. */
static mw_operator *example(void)
{
    static const uint32_t row[] = {0, 0, 0, 1}, column[] = {0, 1, 3, 2};
    static const double weight[] = {0.5, 0.25, 0.25, 1};
    const mw_operator_entries entries = {row, column, weight, 4, 3, 4, 0};
    mw_operator *weights;
    assert_int_equal(mw_operator_create_from_entries(&entries, NULL, &weights, NULL), MW_OK);
    return weights;
}

static void expect_example(const mw_operator *weights)
{
    static const uint32_t want[] = {0, 1, 3, 2};
    mw_operator_info info;
    uint64_t first[4];
    uint32_t column[4];
    double weight[4];
    mw_operator_describe(weights, &info);
    assert_int_equal(info.rows, 3);
    assert_int_equal(info.columns, 4);
    assert_int_equal(info.entries, 4);
    mw_operator_copy(weights, first, column, weight);
    assert_true(first[0] == 0 && first[1] == 3 && first[2] == 4 && first[3] == 4);
    assert_memory_equal(column, want, sizeof want);
    assert_true(weight[0] == 0.5 && weight[1] == 0.25 && weight[3] == 1);
}

static void write_example(const char *path, bool degrees)
{
    static const double vertices[] = {0, 0, 1, 0, 1, 1, 0, 1}, points[] = {0, 10, 1, 11, 2, 12};
    static const mw_location at[] = {
        {.where = MW_INSIDE}, {.where = MW_ON_VERTEX}, {.where = MW_OUTSIDE}};
    const mw_weight_positions positions = {
        .columns = vertices, .rows = points, .located = at, .degrees = degrees};
    mw_operator *weights = example();
    mw_error error;
    if (mw_write_weights(path, weights, &positions, NULL, &error)) fail_msg("%s", error.message);
    mw_operator_destroy(weights);
}

static void numbers_read(const char *path, const char *name, size_t count, double *values)
{
    mw_netcdf *file;
    const size_t start = 0;
    assert_int_equal(mw__netcdf_open(path, &file, NULL), MW_OK);
    assert_int_equal(
        mw__netcdf_doubles(file, mw__netcdf_find(file, name), &start, &count, values, NULL), MW_OK);
    mw__netcdf_close(file);
}

static void test_esmf(void **state)
{
    (void)state;
    need_netcdf();
    double v[4];
    mw_operator *weights;
    mw_error error;
    write_example("w.nc", true);
    if (mw_read_weights("w.nc", NULL, &weights, &error)) fail_msg("%s", error.message);
    expect_example(weights);
    mw_operator_destroy(weights);
    numbers_read("w.nc", "row", 4, v);
    assert_true(v[0] == 1 && v[2] == 1 && v[3] == 2);
    numbers_read("w.nc", "col", 4, v);
    assert_true(v[0] == 1 && v[2] == 4 && v[3] == 3);
    numbers_read("w.nc", "mask_b", 3, v);
    assert_true(v[0] == 1 && v[1] == 1 && v[2] == 0);
    numbers_read("w.nc", "frac_b", 3, v);
    assert_true(v[0] == 1 && v[1] == 1 && v[2] == 0);
    numbers_read("w.nc", "status_b", 3, v);
    assert_true(v[0] == MW_INSIDE && v[1] == MW_ON_VERTEX && v[2] == MW_OUTSIDE);
    numbers_read("w.nc", "yc_b", 3, v);
    assert_true(v[0] == 10 && v[2] == 12);
    numbers_read("w.nc", "xc_a", 4, v);
    assert_true(v[1] == 1 && v[3] == 0);
    assert_int_equal(files_count(), 1);
    files_clear();
}

/* The bytes that NumPy wrote for these weights are not kept here; these are facts of the format. */
static void test_npz(void **state)
{
    (void)state;
    size_t size;
    write_example("w.npz", false);
    char *text = files_read("w.npz", &size);
    assert_memory_equal(text, "PK\3\4", 4);
    assert_memory_equal(text + size - 22, "PK\5\6\0\0\0\0\6\0\6\0", 12);
    assert_memory_equal(text + 30, "indices.npy", 11);
    assert_memory_equal(text + 41, "\x93NUMPY\1\0\x76\0{'descr': '<i4', ", 27);
    assert_memory_equal(text + 41 + 128, "\0\0\0\0\1\0\0\0\3\0\0\0\2\0\0\0PK", 18);
    free(text);
    files_clear();
}

/* --- application ------------------------------------------------------------------------------ */

/* zeta(time, node) as floats with a missing value, temp(time, layer, node) packed, node's own h;
 * time, the depths of layers, and days that no field has. */
static void write_fields(const char *path, size_t steps)
{
    mw_netcdf_output *out;
    mw_error error;
    if (mw__netcdf_output_open(path, &out, &error)) fail_msg("%s", error.message);
    const int time = mw__netcdf_output_dimension(out, "time", MW_NETCDF_UNLIMITED),
              layer = mw__netcdf_output_dimension(out, "layer", 2),
              node = mw__netcdf_output_dimension(out, "node", 4),
              hours = mw__netcdf_output_variable(out, "time", MW_NETCDF_DOUBLE, 1, &time),
              zeta =
                  mw__netcdf_output_variable(out, "zeta", MW_NETCDF_FLOAT, 2, (int[]){time, node}),
              temp = mw__netcdf_output_variable(out, "temp", MW_NETCDF_SHORT, 3,
                                                (int[]){time, layer, node}),
              h = mw__netcdf_output_variable(out, "h", MW_NETCDF_DOUBLE, 1, &node),
              day = mw__netcdf_output_dimension(out, "day", 3);
    mw__netcdf_output_variable(out, "depths", MW_NETCDF_DOUBLE, 1, &layer);
    mw__netcdf_output_variable(out, "day", MW_NETCDF_DOUBLE, 1, &day);
    mw__netcdf_output_text(out, hours, "units", "hours since 2000-01-01");
    mw__netcdf_output_text(out, zeta, "units", "m");
    mw__netcdf_output_number(out, zeta, "_FillValue", MW_NETCDF_FLOAT, -999);
    mw__netcdf_output_number(out, temp, "scale_factor", MW_NETCDF_DOUBLE, 0.5);
    mw__netcdf_output_number(out, temp, "add_offset", MW_NETCDF_DOUBLE, 10);
    mw__netcdf_output_defined(out);
    for (size_t t = 0; t < steps; t++) {
        const double at = (double)t, z[4] = {at, at + 4, t == 9 ? -999 : 2 * at, t == 8 ? -999 : 0},
                     p[8] = {4 * at, 0, 6, 0, 0, 0, -2, 8};
        mw__netcdf_output_doubles(out, hours, &t, (size_t[]){1}, &at);
        mw__netcdf_output_doubles(out, zeta, (size_t[]){t, 0}, (size_t[]){1, 4}, z);
        mw__netcdf_output_doubles(out, temp, (size_t[]){t, 0, 0}, (size_t[]){1, 2, 4}, p);
    }
    mw__netcdf_output_doubles(out, h, (size_t[]){0}, (size_t[]){4}, (double[]){8, 4, 7, 0});
    if (mw__netcdf_output_close(out, true, &error)) fail_msg("%s", error.message);
}

static void fields_expect(const char *path, bool left_out)
{
    double time[10], zeta[30], temp[60], h[3];
    mw_netcdf *file;
    assert_int_equal(mw__netcdf_open(path, &file, NULL), MW_OK);
    const mw_netcdf_variable *z = mw__netcdf_find(file, "zeta"), *p = mw__netcdf_find(file, "temp");
    assert_int_equal(z->type, MW_NETCDF_FLOAT);
    assert_int_equal(mw__netcdf_doubles(file, z, (size_t[]){0, 0}, (size_t[]){10, 3}, zeta, NULL),
                     MW_OK);
    assert_int_equal(
        mw__netcdf_doubles(file, p, (size_t[]){0, 0, 0}, (size_t[]){10, 2, 3}, temp, NULL), MW_OK);
    mw__netcdf_close(file);
    numbers_read(path, "time", 10, time);
    numbers_read(path, "h", 3, h);
    for (size_t t = 0; t < 10; t++) {
        const double at = (double)t, first = 0.75 * at + 1;
        assert_true(time[t] == at);
        if (t != 8)
            assert_true(zeta[3 * t] == first);
        else if (left_out)
            assert_true(zeta[3 * t] == (double)(float)(first / 0.75));
        else
            assert_true(isnan(zeta[3 * t]));
        assert_true(t == 9 ? isnan(zeta[3 * t + 1]) : zeta[3 * t + 1] == 2 * at);
        assert_true(isnan(zeta[3 * t + 2]));
        assert_true(temp[6 * t] == 10 + at && temp[6 * t + 1] == 13 && isnan(temp[6 * t + 2]));
        assert_true(temp[6 * t + 3] == 11 && temp[6 * t + 4] == 9 && isnan(temp[6 * t + 5]));
    }
    assert_true(h[0] == 5 && h[1] == 7 && isnan(h[2]));
}

/* Of the variables of one dimension the file holds these alone. */
static void expect_axes(const char *path, bool time, bool depths)
{
    mw_netcdf *file;
    assert_int_equal(mw__netcdf_open(path, &file, NULL), MW_OK);
    assert_true((mw__netcdf_find(file, "time") != NULL) == time);
    assert_true((mw__netcdf_find(file, "depths") != NULL) == depths);
    assert_null(mw__netcdf_find(file, "day"));
    mw__netcdf_close(file);
}

static void test_apply(void **state)
{
    (void)state;
    need_netcdf();
    mw_error error;
    mw_apply_weights_info info;
    write_example("w.nc", true);
    write_fields("f.nc", 10);
    if (mw_apply_weights("w.nc", "f.nc", "o.nc", NULL, &info, &error))
        fail_msg("%s", error.message);
    assert_int_equal(info.fields, 3);
    assert_int_equal(info.slabs, 31);
    assert_int_equal(info.points, 3);
    assert_int_equal(info.unmapped, 1);
    fields_expect("o.nc", false);
    expect_axes("o.nc", true, true);
    const mw_apply_weights_options leave = {.missing = MW_MISSING_LEFT_OUT, .threads = 2};
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "o.nc", &leave, NULL, &error), MW_OK);
    fields_expect("o.nc", true);
    const char *const names[] = {"h", "zeta"};
    const mw_apply_weights_options one = {.fields = names + 1, .field_count = 1},
                                   still = {.fields = names, .field_count = 1};
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "o.nc", &still, NULL, &error), MW_OK);
    expect_axes("o.nc", false, false);
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "o.nc", &one, &info, &error), MW_OK);
    assert_int_equal(info.fields, 1);
    expect_axes("o.nc", true, false);
    write_fields("empty.nc", 0); /* no time yet */
    if (mw_apply_weights("w.nc", "empty.nc", "p.nc", NULL, &info, &error))
        fail_msg("%s", error.message);
    assert_int_equal(info.fields, 3);
    assert_int_equal(info.slabs, 1);
    double positions[3];
    numbers_read("o.nc", "point_y", 3, positions);
    assert_true(positions[0] == 10 && positions[2] == 12);
    files_clear();
}

/* --- what is refused -------------------------------------------------------------------------- */

/* A file of weights of which one thing is wrong. */
typedef struct wrong_weights {
    const char *left_out; /* a variable that is not there */
    double row, column, weight, base;
    size_t short_by; /* S has fewer values */
    const char *says;
} wrong_weights;

static void wrong_write(const char *path, const wrong_weights *w)
{
    mw_netcdf_output *out;
    assert_int_equal(mw__netcdf_output_open(path, &out, NULL), MW_OK);
    const int s = mw__netcdf_output_dimension(out, "n_s", 3),
              less = mw__netcdf_output_dimension(out, "less", 2),
              a = mw__netcdf_output_dimension(out, "n_a", 4);
    if (strcmp(w->left_out, "n_b")) mw__netcdf_output_dimension(out, "n_b", 3);
    static const char *const names[] = {"row", "col", "S"};
    int variable[3];
    (void)a;
    for (int i = 0; i < 3; i++) {
        if (strcmp(w->left_out, names[i]) == 0) continue;
        variable[i] = mw__netcdf_output_variable(out, names[i], MW_NETCDF_DOUBLE, 1,
                                                 i == 2 && w->short_by ? &less : &s);
        if (i < 2 && w->base > 0)
            mw__netcdf_output_number(out, variable[i], "start_index", MW_NETCDF_DOUBLE, w->base);
    }
    mw__netcdf_output_defined(out);
    const double values[3][3] = {{1, 2, w->row}, {1, 2, w->column}, {1, 1, w->weight}};
    for (int i = 0; i < 3; i++) {
        const size_t start = 0, count = i == 2 && w->short_by ? 2 : 3;
        if (strcmp(w->left_out, names[i]))
            mw__netcdf_output_doubles(out, variable[i], &start, &count, values[i]);
    }
    assert_int_equal(mw__netcdf_output_close(out, true, NULL), MW_OK);
}

static void test_wrong_weights(void **state)
{
    (void)state;
    need_netcdf();
    static const wrong_weights wrong[] = {
        {"n_b", 1, 1, 1, 0, 0, "w.nc: has no dimension n_b"},
        {"row", 1, 1, 1, 0, 0, "row"},
        {"S", 1, 1, 1, 0, 0, "S"},
        {"", 4, 1, 1, 0, 0, "w.nc: entry 2: there is no row 4"},
        {"", 0, 1, 1, 0, 0, "w.nc: entry 2: there is no row 0"},
        {"", -1, 1, 1, 0, 0, "variable row: entry 2 is -1"},
        {"", 1, 5, 1, 0, 0, "w.nc: entry 2: there is no column 5"},
        {"", 1, 1, NAN, 0, 0, "w.nc: entry 2: the weight nan is not finite"},
        {"", 1, 1, 1, 7, 0, "its start_index is 7"},
        {"", 1, 1, 1, 0, 1, "variable S: has no value for each of the 3 entries"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        mw_operator *weights = (mw_operator *)1;
        mw_error error;
        wrong_write("w.nc", &wrong[i]);
        assert_true(mw_read_weights("w.nc", NULL, &weights, &error) == MW_ERROR_INPUT);
        assert_null(weights);
        if (!strstr(error.message, wrong[i].says)) fail_msg("%zu: %s", i, error.message);
    }
    files_clear();
}

static void test_wrong_fields(void **state)
{
    (void)state;
    need_netcdf();
    mw_error error;
    const char *const unknown[] = {"zeta", "salt"}, *const other[] = {"time"};
    const mw_apply_weights_options two = {.fields = unknown, .field_count = 2},
                                   axis = {.fields = other, .field_count = 1},
                                   rule = {.missing = (mw_missing_rule)7},
                                   reserved = {.reserved = {1}};
    write_example("w.nc", false);
    write_fields("f.nc", 10);
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "o.nc", &two, NULL, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "salt"));
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "o.nc", &axis, NULL, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "f.nc: variable time: has no last dimension"));
    assert_int_equal(mw_apply_weights("f.nc", "f.nc", "o.nc", NULL, NULL, &error), MW_ERROR_INPUT);
    assert_int_equal(mw_apply_weights("w.nc", "none.nc", "o.nc", NULL, NULL, &error),
                     MW_ERROR_SYSTEM);
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "none/o.nc", NULL, NULL, &error),
                     MW_ERROR_SYSTEM);
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "o.nc", &rule, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_apply_weights("w.nc", "f.nc", "o.nc", &reserved, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_apply_weights(NULL, "f.nc", "o.nc", NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(files_count(), 2); /* nothing half-written */
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_esmf),         cmocka_unit_test(test_npz),
        cmocka_unit_test(test_apply),        cmocka_unit_test(test_wrong_weights),
        cmocka_unit_test(test_wrong_fields),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
