/* test_io_source.c - bytes and lines of an input, across the borders of blocks; limits that only
 * large inputs reach. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "io/text/byte_source.h"
#include "support/write_mesh_file.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static mw_source memory_source(const char *text, size_t size)
{
    mw_source source;
    assert_int_equal(mw__source_memory(&source, "memory", text, size, NULL), MW_OK);
    return source;
}

/* Random lines with random ends come out as they went in, some of them read twice. */
static void test_lines(void **state)
{
    (void)state;
    uint64_t random = (uint64_t)time(NULL);
    print_message("seed %llu\n", (unsigned long long)random);
    enum { LINES = 3000, LONGEST = 400 };
    char *text = malloc(LINES * (LONGEST + 2)), *lines = malloc(LINES * (LONGEST + 1));
    assert_true(text && lines);
    size_t size = 0;
    for (int i = 0; i < LINES; i++) {
        char *line = lines + i * (LONGEST + 1);
        size_t length = mw__random_below(&random, 8) ? mw__random_below(&random, 30)
                                                     : mw__random_below(&random, LONGEST);
        for (size_t k = 0; k < length; k++) line[k] = (char)('a' + mw__random_below(&random, 26));
        line[length] = 0;
        memcpy(text + size, line, length);
        size += length;
        static const char *const ends[] = {"\n", "\r\n", "\r"};
        /* an empty line after a lone CR cannot end in LF: that would be one line end */
        const char *end = ends[mw__random_below(&random, 3)];
        if (length == 0 && size > 0 && text[size - 1] == '\r') end = "\r";
        memcpy(text + size, end, strlen(end));
        size += strlen(end);
    }
    mw_source source = memory_source(text, size);
    for (int i = 0; i < LINES; i++)
        for (uint32_t again = mw__random_below(&random, 4) == 0 ? 2 : 1; again-- > 0;) {
            char *line;
            assert_int_equal(mw__source_line(&source, &line, NULL), MW_OK);
            assert_non_null(line);
            assert_string_equal(line, lines + i * (LONGEST + 1));
            assert_int_equal(source.line, i + 1);
            if (again > 0) mw__source_unread_line(&source);
        }
    char *line;
    assert_int_equal(mw__source_line(&source, &line, NULL), MW_OK);
    assert_null(line);
    assert_int_equal(source.offset, size);
    mw__source_close(&source);
    free(text);
    free(lines);
}

/* Lines of this text, joined to as many as `wanted`, hold the bytes between their beginnings and
 * ends. */
static void expect_joined(mw_source *source, const char *text, size_t wanted)
{
    char *line;
    size_t begin = source->offset;
    int64_t first = source->line;
    assert_int_equal(mw__source_line(source, &line, NULL), MW_OK);
    for (size_t joined = 1; joined < wanted; joined++) {
        assert_int_equal(mw__source_join_line(source, &line, NULL), MW_OK);
        assert_non_null(line);
    }
    assert_int_equal(source->line, first + (int64_t)wanted);
    assert_int_equal(strlen(line), source->line_length);
    assert_memory_equal(line, text + begin, source->line_length);
    assert_true(strchr("\r\n", text[begin + source->line_length]));
}

static void test_joined_lines(void **state)
{
    (void)state;
    enum { LINES = 2000 };
    char *text = malloc(LINES * 16);
    size_t size = 0, wanted = 1;
    assert_non_null(text);
    for (int i = 0; i < LINES; i++)
        size += (size_t)sprintf(text + size, "%0*d%s", 1 + i * 7 % 11, i,
                                i % 3 == 0   ? "\n"
                                : i % 3 == 1 ? "\r\n"
                                             : "\r");
    mw_source source = memory_source(text, size);
    for (int64_t line = 0; line + 5 < LINES; line += (int64_t)wanted, wanted = wanted % 5 + 1) {
        size_t before = source.offset;
        expect_joined(&source, text, wanted);
        mw__source_unread_line(&source);
        assert_int_equal(source.line, line);
        assert_int_equal(source.offset, before);
        expect_joined(&source, text, wanted);
    }
    char *line;
    while (source.line < LINES) mw__source_line(&source, &line, NULL);
    assert_int_equal(mw__source_join_line(&source, &line, NULL), MW_OK);
    assert_null(line);
    mw__source_close(&source);
    free(text);
}

static void test_bytes(void **state)
{
    (void)state;
    enum { SIZE = 200000 };
    char *data = malloc(SIZE);
    assert_non_null(data);
    for (size_t i = 0; i < SIZE; i++) data[i] = (char)(i * i >> 3);
    mw_source source = memory_source(data, SIZE);
    source.binary = true;
    const unsigned char *read;
    const char *peeked;
    size_t count, at = 0;
    for (size_t step = 1; at + step + 1000 < SIZE; at += step, step = step * 3 % 1009) {
        assert_int_equal(mw__source_peek(&source, 1000, &peeked, &count, NULL), MW_OK);
        assert_int_equal(count, 1000);
        assert_memory_equal(peeked, data + at, 1000);
        assert_int_equal(mw__source_bytes(&source, step, &read, NULL), MW_OK);
        assert_memory_equal(read, data + at, step);
        assert_int_equal(source.offset, at + step);
        if (step % 5 == 0 && at + 2 * step + 1000 < SIZE) {
            assert_int_equal(mw__source_skip(&source, step, NULL), MW_OK);
            at += step;
        }
    }
    mw_error error;
    assert_int_equal(mw__source_skip(&source, SIZE - at - 10, NULL), MW_OK);
    assert_int_equal(mw__source_peek(&source, 1000, &peeked, &count, NULL), MW_OK);
    assert_int_equal(count, 10);
    assert_int_equal(mw__source_bytes(&source, 11, &read, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, "memory: at byte 200000: the data end early");
    assert_int_equal(mw__source_skip(&source, UINT64_MAX, &error), MW_ERROR_INPUT);
    mw__source_close(&source);
    free(data);
}

/* "text" as often as it is wanted between two others; the reader says `says`. */
static void expect_limit(const char *name, const char *before, const char *repeated, int times,
                         const char *after, const char *says)
{
    FILE *out = fopen(name, "w");
    assert_non_null(out);
    fputs(before, out);
    for (int i = 0; i < times; i++) fprintf(out, repeated, i);
    fputs(after, out);
    fclose(out);
    mw_error error;
    if (strstr(name, ".csv")) {
        mw_point_reader *reader;
        assert_int_equal(mw_point_reader_open(name, NULL, &reader, &error), MW_ERROR_INPUT);
    } else {
        mw_mesh_file file;
        assert_int_equal(mw_read_mesh(name, NULL, &file, &error), MW_ERROR_INPUT);
    }
    files_expect_error(&error, MW_ERROR_INPUT, error.line, says);
    unlink(name);
}

static void test_limits(void **state)
{
    (void)state;
    static const char head[] = "ply\nformat ascii 1.0\nelement vertex 1\n";
    expect_limit("e.ply", head, "element e%d 0\n", 300, "end_header\n",
                 "e.ply:259: more than 256 elements");
    expect_limit("e.ply", head, "property int p%d\n", 5000, "end_header\n",
                 "e.ply:4100: more than 4096 properties");
    expect_limit("e.csv", "0", ",%d", 5000, "\n", "e.csv:1: more than 4096 columns");
    expect_limit("e.obj", "v 0 0 0\nf", " 1 1 1 1 1 1 1 1 1 %d \\\n", 900000, "1\n",
                 "continued lines have more than 16777216");
}

/* As many columns as are allowed. */
static void test_many_columns(void **state)
{
    (void)state;
    enum { COLUMNS = 4096 };
    FILE *out = fopen("wide.csv", "w");
    assert_non_null(out);
    for (int row = 0; row < 3; row++)
        for (int i = 0; i < COLUMNS; i++)
            fprintf(out, "%d%c", row * i, i + 1 < COLUMNS ? ';' : '\n');
    fclose(out);
    mw_point_reader *reader;
    assert_int_equal(mw_point_reader_open("wide.csv", NULL, &reader, NULL), MW_OK);
    assert_int_equal(mw_point_reader_width(reader), COLUMNS);
    assert_string_equal(mw_point_reader_column(reader, 4095), "c4096");
    double *values = malloc(3 * COLUMNS * sizeof *values);
    assert_non_null(values);
    size_t count;
    assert_int_equal(mw_point_reader_read(reader, values, 4, &count, NULL), MW_OK);
    assert_int_equal(count, 3);
    assert_true(values[3 * COLUMNS - 1] == 2 * 4095);
    free(values);
    mw_point_reader_close(reader);
    files_clear();
}

static void test_arrays(void **state)
{
    (void)state;
    mw_mesh_file file = mesh_file_read_text("a.off", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n");
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    assert_ptr_equal(arrays.points, file.points);
    assert_ptr_equal(arrays.triangles, file.triangles);
    assert_true(arrays.point_count == 4 && arrays.point_stride == 3 && arrays.triangle_count == 2);
    assert_int_equal(arrays.integer_type, MW_UINT32);
    mw_mesh_file_release(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),        cmocka_unit_test(test_joined_lines),
        cmocka_unit_test(test_bytes),        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_many_columns), cmocka_unit_test(test_arrays)};
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
