/* test_io_netcdf.c - netCDF files by libnetcdf: what is written is read back; what is wrong is
 * told. Skipped where libnetcdf is not found. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/netcdf/netcdf_file.h"
#include "io/netcdf/netcdf_output.h"
#include "support/files.h"

#include <stdlib.h>
#include <string.h>
#include <threads.h>

static void need_netcdf(void)
{
    if (mw_netcdf_version(NULL, 0) == 0) skip();
}

static mw_netcdf_output *open_output(const char *path)
{
    mw_netcdf_output *output;
    mw_error error;
    if (mw__netcdf_output_open(path, &output, &error)) fail_msg("%s", error.message);
    return output;
}

/* "name" of two dimensions with attributes, and a text. */
static void write_example(const char *path)
{
    mw_netcdf_output *output = open_output(path);
    int time = mw__netcdf_output_dimension(output, "time", MW_NETCDF_UNLIMITED);
    int node = mw__netcdf_output_dimension(output, "node", 3);
    int depth =
        mw__netcdf_output_variable(output, "depth", MW_NETCDF_DOUBLE, 2, (int[]){time, node});
    int corner = mw__netcdf_output_variable(output, "corner", MW_NETCDF_INT, 1, &node);
    int word = mw__netcdf_output_variable(output, "word", MW_NETCDF_CHAR, 1, &node);
    mw__netcdf_output_text(output, depth, "units", "m");
    mw__netcdf_output_number(output, corner, "start_index", MW_NETCDF_INT, 1);
    mw__netcdf_output_text(output, MW_NETCDF_OUTPUT_FILE, "title", "an example");
    mw__netcdf_output_pack(output, depth, 2);
    mw__netcdf_output_defined(output);
    mw__netcdf_output_doubles(output, depth, (size_t[]){1, 0}, (size_t[]){1, 3},
                              (double[]){0.1, -2, 1e300});
    mw__netcdf_output_doubles(output, depth, (size_t[]){0, 0}, (size_t[]){1, 3},
                              (double[]){1, 2, 3});
    mw__netcdf_output_numbers(output, corner, (size_t[]){0}, (size_t[]){3},
                              (uint32_t[]){7, 8, 2147483647});
    mw__netcdf_output_characters(output, word, (size_t[]){0}, (size_t[]){3}, "abc");
    mw_error error;
    if (mw__netcdf_output_close(output, true, &error)) fail_msg("%s", error.message);
}

static mw_netcdf *open_file(const char *path)
{
    mw_netcdf *file;
    mw_error error;
    if (mw__netcdf_open(path, &file, &error)) fail_msg("%s", error.message);
    return file;
}

static void expect_example(const mw_netcdf *file)
{
    assert_int_equal(mw__netcdf_variable_count(file), 3);
    const mw_netcdf_variable *depth = mw__netcdf_find(file, "depth");
    assert_non_null(depth);
    assert_int_equal(depth->type, MW_NETCDF_DOUBLE);
    assert_int_equal(depth->rank, 2);
    assert_int_equal(depth->lengths[0], 2);
    assert_int_equal(depth->lengths[1], 3);
    double values[3];
    assert_int_equal(
        mw__netcdf_doubles(file, depth, (size_t[]){1, 0}, (size_t[]){1, 3}, values, NULL), MW_OK);
    assert_true(values[0] == 0.1 && values[1] == -2 && values[2] == 1e300);
    const mw_netcdf_variable *corner = mw__netcdf_find(file, "corner");
    int64_t corners[3];
    assert_int_equal(mw__netcdf_integers(file, corner, (size_t[]){0}, (size_t[]){3}, corners, NULL),
                     MW_OK);
    assert_int_equal(corners[2], 2147483647);
    double start;
    assert_true(mw__netcdf_number(file, corner, "start_index", &start));
    assert_true(start == 1);
    assert_false(mw__netcdf_number(file, depth, "units", &start));
    char *text;
    assert_int_equal(mw__netcdf_text(file, depth, "units", &text, NULL), MW_OK);
    assert_string_equal(text, "m");
    free(text);
    assert_int_equal(mw__netcdf_text(file, MW_NETCDF_FILE, "title", &text, NULL), MW_OK);
    assert_string_equal(text, "an example");
    free(text);
    assert_int_equal(mw__netcdf_text(file, depth, "nothing", &text, NULL), MW_OK);
    assert_null(text);
    char word[4] = "";
    assert_int_equal(mw__netcdf_characters(file, mw__netcdf_find(file, "word"), (size_t[]){0},
                                           (size_t[]){3}, word, NULL),
                     MW_OK);
    assert_string_equal(word, "abc");
}

static void test_round_trip(void **state)
{
    (void)state;
    need_netcdf();
    write_example("a.nc");
    assert_int_equal(files_count(), 1);
    mw_netcdf *file = open_file("a.nc");
    expect_example(file);
    mw__netcdf_close(file);
    write_example("a.nc"); /* replaces it */
    size_t size;
    char *contents = files_read("a.nc", &size);
    assert_true(mw__netcdf_begins(contents, size));
    assert_int_equal(mw__netcdf_open_memory("a.nc", contents, size, &file, NULL), MW_OK);
    expect_example(file);
    mw__netcdf_close(file);
    free(contents);
    files_clear();
}

static void test_errors(void **state)
{
    (void)state;
    need_netcdf();
    write_example("a.nc");
    mw_netcdf *file = open_file("a.nc");
    mw_error error;
    double values[9];
    const mw_netcdf_variable *word = mw__netcdf_find(file, "word");
    assert_int_equal(mw__netcdf_doubles(file, word, (size_t[]){0}, (size_t[]){3}, values, &error),
                     MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, "a.nc: variable word: it holds no numbers");
    const mw_netcdf_variable *corner = mw__netcdf_find(file, "corner");
    assert_int_equal(mw__netcdf_doubles(file, corner, (size_t[]){0}, (size_t[]){9}, values, &error),
                     MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, "a.nc: variable corner: NetCDF: Start+count");
    assert_int_equal(mw__netcdf_need(file, "none", &corner, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, "a.nc: there is no variable 'none'");
    mw__netcdf_close(file);
    assert_int_equal(mw__netcdf_open("b.nc", &file, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "b.nc: No such file");
    files_write_text("b.nc", "CDF\001 and no more");
    assert_int_equal(mw__netcdf_open("b.nc", &file, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, "b.nc: the file is damaged or incomplete");
    files_clear();
}

static void test_failed_output(void **state)
{
    (void)state;
    need_netcdf();
    mw_error error;
    mw_netcdf_output *output = open_output("a.nc");
    int node = mw__netcdf_output_dimension(output, "node", 3);
    int small = mw__netcdf_output_variable(output, "small", MW_NETCDF_BYTE, 1, &node);
    mw__netcdf_output_defined(output);
    mw__netcdf_output_integers(output, small, (size_t[]){0}, (size_t[]){3},
                               (int64_t[]){1, 2, 1000});
    assert_true(mw__netcdf_output_failed(output));
    assert_int_equal(mw__netcdf_output_variable(output, "more", MW_NETCDF_BYTE, 1, &node), -1);
    assert_int_equal(mw__netcdf_output_close(output, true, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "a.nc: variable small: NetCDF: ");
    assert_int_equal(mw__netcdf_output_close(open_output("a.nc"), false, &error), MW_OK);
    assert_int_equal(files_count(), 0);
    assert_int_equal(mw__netcdf_output_open("/dev/null", &output, &error), MW_ERROR_ARGUMENT);
    files_expect_error(&error, MW_ERROR_ARGUMENT, -1, "a file only");
    assert_int_equal(mw__netcdf_output_open("none/a.nc", &output, &error), MW_ERROR_SYSTEM);
}

static int read_often(void *path)
{
    for (int i = 0; i < 20; i++) {
        mw_netcdf *file;
        if (mw__netcdf_open(path, &file, NULL)) return 1;
        double values[6];
        mw_status status = mw__netcdf_doubles(file, mw__netcdf_find(file, "depth"),
                                              (size_t[]){0, 0}, (size_t[]){2, 3}, values, NULL);
        mw__netcdf_close(file);
        if (status || values[0] != 1) return 1;
    }
    return 0;
}

/* HDF5 would not bear it without the lock. */
static void test_threads(void **state)
{
    (void)state;
    need_netcdf();
    static char name[] = "a.nc";
    write_example(name);
    thrd_t threads[4];
    for (int i = 0; i < 4; i++)
        assert_int_equal(thrd_create(&threads[i], read_often, name), thrd_success);
    for (int i = 0; i < 4; i++) {
        int result;
        thrd_join(threads[i], &result);
        assert_int_equal(result, 0);
    }
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_failed_output),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
