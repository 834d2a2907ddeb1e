/* test_io_las.c - points from LAS: every version and point format, made by hand; filters, columns,
 * damage. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/text/byte_order.h"
#include "support/files.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { POINTS = 40, COLUMNS = 14, ROOM = 1 << 16 };

static const char all_columns[] =
    "x,y,z,intensity,return,returns,classification,scan_angle,user_data,point_source,time,red,"
    "green,blue";
static const uint8_t sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
static const uint8_t times[] = {0, 20, 0, 20, 20, 20, 22, 22, 22, 22, 22};
static const uint8_t colours[] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};

typedef struct las_sample {
    unsigned char bytes[ROOM];
    size_t size;
} las_sample;

/* What point i holds, in the order of all_columns; time and colours as if the format had them. */
static void expected(int i, unsigned format, double v[COLUMNS])
{
    bool old = format < 6;
    v[0] = (i * 1000 - 7) * 0.01 + 500000;
    v[1] = (-i * 333) * 0.001 + -20;
    v[2] = INT32_MIN / (i + 1) * 0.5 + 0;
    v[3] = 65535 - i;
    v[4] = old ? i % 8 : i % 16;
    v[5] = old ? 7 - i % 8 : 15 - i % 16;
    v[6] = old ? i % 32 : i * 6;
    v[7] = old ? i - 20 : (i * 1000 - 20000) * 0.006;
    v[8] = i;
    v[9] = 60000 + i;
    v[10] = times[format] ? 1.5e8 + i * 0.125 : (double)NAN;
    for (int k = 0; k < 3; k++) v[11 + k] = colours[format] ? 40000.0 + 10 * i + k : (double)NAN;
}

static void put_point(unsigned char *p, int i, unsigned format)
{
    bool old = format < 6;
    mw__put_bytes(p, 4, (uint32_t)(i * 1000 - 7));
    mw__put_bytes(p + 4, 4, (uint32_t)(-i * 333));
    mw__put_bytes(p + 8, 4, (uint32_t)(INT32_MIN / (i + 1)));
    mw__put_bytes(p + 12, 2, (uint16_t)(65535 - i));
    if (old) {
        /* the upper bits mean other things */
        p[14] = (unsigned char)(i % 8 | (7 - i % 8) << 3 | 0xc0);
        /* synthetic, key point, withheld */
        p[15] = (unsigned char)(i % 32 | (i % 2 ? 0xe0 : 0));
        p[16] = (unsigned char)(i - 20);
        p[17] = (unsigned char)i;
        mw__put_bytes(p + 18, 2, (uint16_t)(60000 + i));
    } else {
        p[14] = (unsigned char)(i % 16 | (15 - i % 16) << 4);
        p[15] = 0xff;
        p[16] = (unsigned char)(i * 6);
        p[17] = (unsigned char)i;
        mw__put_bytes(p + 18, 2, (uint16_t)(i * 1000 - 20000));
        mw__put_bytes(p + 20, 2, (uint16_t)(60000 + i));
    }
    if (times[format]) mw__put_f64(p + times[format], 1.5e8 + i * 0.125);
    for (int k = 0; k < 3 && colours[format]; k++)
        mw__put_bytes(p + colours[format] + 2 * k, 2, (uint16_t)(40000 + 10 * i + k));
}

/* A file: header, `between` bytes of other things, points with `extra` bytes each behind their
 * own. */
static void make(las_sample *l, unsigned minor, unsigned format, size_t extra, const void *between,
                 size_t between_size)
{
    size_t header = minor == 4 ? 375 : minor == 3 ? 235 : 227, record = sizes[format] + extra;
    memset(l, 0, sizeof *l);
    unsigned char *h = l->bytes;
    memcpy(h, "LASF", 4);
    h[24] = 1;
    h[25] = (unsigned char)minor;
    mw__put_bytes(h + 94, 2, header);
    mw__put_bytes(h + 96, 4, header + between_size);
    mw__put_bytes(h + 100, 4, 77); /* a number of records that is a lie */
    h[104] = (unsigned char)format;
    mw__put_bytes(h + 105, 2, record);
    mw__put_bytes(h + 107, 4, minor == 4 && format > 5 ? 0 : POINTS);
    mw__put_f64(h + 131, 0.01);
    mw__put_f64(h + 139, 0.001);
    mw__put_f64(h + 147, 0.5);
    mw__put_f64(h + 155, 500000);
    mw__put_f64(h + 163, -20);
    if (minor == 4) mw__put_bytes(h + 247, 8, POINTS);
    if (between_size > 0) memcpy(h + header, between, between_size);
    for (int i = 0; i < POINTS; i++)
        put_point(h + header + between_size + (size_t)i * record, i, format);
    l->size = header + between_size + POINTS * record;
}

static mw_point_reader *open_las(const las_sample *l, const mw_point_reader_options *options)
{
    mw_point_reader *reader;
    mw_error error;
    files_write("p.las", (bytes){(const char *)l->bytes, l->size});
    if (mw_point_reader_open("p.las", options, &reader, &error) != MW_OK)
        fail_msg("%s", error.message);
    return reader;
}

static void test_every_format(void **state)
{
    (void)state;
    static las_sample l;
    for (unsigned minor = 0; minor <= 4; minor++)
        for (unsigned format = 0; format < (minor == 4 ? 11 : 6); format++)
            for (size_t extra = 0; extra < 8; extra += 7) {
                make(&l, minor, format, extra, "some bytes between", extra ? 18 : 0);
                mw_point_reader_options options = {.columns = all_columns};
                mw_point_reader *reader = open_las(&l, &options);
                assert_int_equal(mw_point_reader_width(reader), COLUMNS);
                assert_string_equal(mw_point_reader_column(reader, 13), "blue");
                double values[COLUMNS * POINTS], wanted[COLUMNS];
                size_t count;
                assert_int_equal(mw_point_reader_read(reader, values, POINTS, &count, NULL), MW_OK);
                assert_int_equal(count, POINTS);
                for (int i = 0; i < POINTS; i++) {
                    expected(i, format, wanted);
                    for (int k = 0; k < COLUMNS; k++) {
                        double v = values[COLUMNS * i + k];
                        if (v != wanted[k] && !(isnan(v) && isnan(wanted[k])))
                            fail_msg("1.%u format %u, point %d, column %d: %g, not %g", minor,
                                     format, i, k, v, wanted[k]);
                    }
                }
                assert_int_equal(mw_point_reader_read(reader, values, POINTS, &count, NULL), MW_OK);
                assert_int_equal(count, 0);
                mw_point_reader_close(reader);
            }
    files_clear();
}

static void test_columns(void **state)
{
    (void)state;
    static las_sample l;
    make(&l, 2, 3, 0, "", 0);
    mw_point_reader *reader = open_las(&l, NULL);
    assert_int_equal(mw_point_reader_width(reader), 3);
    assert_string_equal(mw_point_reader_column(reader, 2), "z");
    mw_point_reader_close(reader);
    mw_point_reader_options options = {.columns = "Classification, 2,1"};
    reader = open_las(&l, &options);
    double values[3 * POINTS], wanted[COLUMNS];
    size_t count;
    assert_int_equal(mw_point_reader_read(reader, values, POINTS, &count, NULL), MW_OK);
    expected(9, 3, wanted);
    assert_true(values[27] == wanted[6] && values[28] == wanted[1] && values[29] == wanted[0]);
    mw_point_reader_close(reader);
    static const char *const none[] = {"x,height", "x,15", "x,0", "x,4x"};
    for (int i = 0; i < 4; i++) {
        mw_error error;
        options.columns = none[i];
        assert_int_equal(mw_point_reader_open("p.las", &options, &reader, &error), MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, -1, "LAS has no column");
    }
    options.columns = "x,1";
    assert_int_equal(mw_point_reader_open("p.las", &options, &reader, NULL), MW_ERROR_ARGUMENT);
    files_clear();
}

/* Ground and water; in the old formats the class is five bits of a byte with flags. */
static void test_classes(void **state)
{
    (void)state;
    static las_sample l;
    for (unsigned format = 0; format <= 6; format += 6) {
        make(&l, 4, format, 0, "", 0);
        mw_point_reader_options options = {.columns = "user_data,classification"};
        size_t wanted = 0;
        unsigned other = format < 6 ? 9 : 198;
        options.classes[2] = options.classes[other] = 1;
        for (int i = 0; i < POINTS; i++) {
            unsigned class = format < 6 ? (unsigned)i % 32 : (unsigned)i * 6 % 256;
            wanted += class == 2 || class == other;
        }
        assert_true(wanted > 0);
        mw_point_reader *reader = open_las(&l, &options);
        double values[2 * POINTS];
        size_t count;
        assert_int_equal(mw_point_reader_read(reader, values, POINTS, &count, NULL), MW_OK);
        assert_int_equal(count, wanted);
        for (size_t i = 0; i < count; i++)
            assert_true(values[2 * i + 1] == 2 || values[2 * i + 1] == other);
        mw_point_reader_close(reader);
        /* one by one, points that do not count in between are no end */
        reader = open_las(&l, &options);
        size_t total = 0;
        do {
            assert_int_equal(mw_point_reader_read(reader, values, 1, &count, NULL), MW_OK);
            total += count;
        } while (count > 0);
        assert_int_equal(total, wanted);
        mw_point_reader_close(reader);
    }
    files_clear();
}

/* Open and read all; the first error, or MW_OK. */
static mw_status read_through(const las_sample *l, mw_error *error)
{
    mw_point_reader *reader;
    double values[3 * POINTS];
    size_t count = 1;
    files_write("p.las", (bytes){(const char *)l->bytes, l->size});
    mw_status status = mw_point_reader_open("p.las", NULL, &reader, error);
    if (status) return status;
    while (!status && count > 0)
        status = mw_point_reader_read(reader, values, POINTS, &count, error);
    mw_point_reader_close(reader);
    return status;
}

static void expect_bad(const las_sample *l, const char *says)
{
    mw_error error;
    assert_int_equal(read_through(l, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, -1, says);
}

static void test_laz(void **state)
{
    (void)state;
    static las_sample l;
    make(&l, 2, 3, 0, "", 0);
    l.bytes[104] |= 0x80;
    expect_bad(&l, "p.las: this is LAZ, compressed LAS, which is not read: unpack it first, for "
                   "instance with 'las2las");
    /* without the bit, by the record that LASzip leaves */
    char record[54 + 20 + 54 + 8] = {0};
    memcpy(record + 2, "other", 5);
    mw__put_bytes((unsigned char *)record + 20, 2, 20);
    memcpy(record + 74 + 2, "laszip encoded", 14);
    mw__put_bytes((unsigned char *)record + 74 + 18, 2, 22204);
    mw__put_bytes((unsigned char *)record + 74 + 20, 2, 8);
    make(&l, 2, 3, 0, record, sizeof record);
    expect_bad(&l, "this is LAZ");
    record[74 + 18] ^= 1; /* another record of LASzip is fine */
    make(&l, 2, 3, 0, record, sizeof record);
    mw_error error;
    assert_int_equal(read_through(&l, &error), MW_OK);
    files_clear();
}

static void test_malformed(void **state)
{
    (void)state;
    static las_sample l, good;
    make(&good, 2, 1, 0, "", 0);
    l = good;
    l.size = 4;
    expect_bad(&l, "p.las: at byte 4: the data end within the header");
    l.size = 226;
    expect_bad(&l, "p.las: at byte 226: the data end within the header");
    l = good;
    l.bytes[25] = 5;
    expect_bad(&l, "at byte 24: LAS version 1.5");
    l = good;
    l.bytes[24] = 2;
    expect_bad(&l, "at byte 24: LAS version 2.2");
    l = good;
    l.bytes[104] = 11;
    expect_bad(&l, "at byte 104: point format 11");
    l = good;
    mw__put_bytes(l.bytes + 105, 2, 27);
    expect_bad(&l, "at byte 105: the point records have 27 bytes; format 1 needs at least 28");
    mw__put_bytes(l.bytes + 105, 2, 0);
    expect_bad(&l, "the point records have 0 bytes");
    l = good;
    mw__put_bytes(l.bytes + 94, 2, 100);
    expect_bad(&l, "at byte 94: the header has 100 bytes");
    l = good;
    mw__put_bytes(l.bytes + 96, 4, 226);
    expect_bad(&l, "the points begin at byte 226");
    mw__put_bytes(l.bytes + 96, 4, UINT32_MAX);
    expect_bad(&l, "the data end early");
    l = good;
    mw__put_bytes(l.bytes + 107, 4, UINT32_MAX);
    expect_bad(&l, "at byte 1347: the data end after 40 of 4294967295 points");
    l = good;
    l.size -= 1;
    expect_bad(&l, "at byte 1319: the data end after 39 of 40 points");
    make(&l, 4, 6, 0, "", 0);
    mw__put_bytes(l.bytes + 247, 8, UINT64_MAX);
    expect_bad(&l, "the data end after 40 of 18446744073709551615 points");
    /* what follows the points is no concern of ours */
    l = good;
    l.size += 1000;
    mw_error error;
    assert_int_equal(read_through(&l, &error), MW_OK);
    mw__put_bytes(l.bytes + 107, 4, 0);
    assert_int_equal(read_through(&l, &error), MW_OK);
    /* cut anywhere it is refused */
    l = good;
    for (size_t cut = 5; cut < good.size; cut++) {
        l.size = cut;
        assert_int_equal(read_through(&l, &error), MW_ERROR_INPUT);
    }
    files_clear();
}

static void test_gzip(void **state)
{
    (void)state;
    static las_sample l;
    make(&l, 2, 3, 0, "", 0);
    files_write_gzip("p.las.gz", (bytes){(const char *)l.bytes, l.size});
    mw_point_reader *reader;
    double values[3 * POINTS];
    size_t count;
    assert_int_equal(mw_point_reader_open("p.las.gz", NULL, &reader, NULL), MW_OK);
    assert_int_equal(mw_point_reader_read(reader, values, POINTS, &count, NULL), MW_OK);
    assert_int_equal(count, POINTS);
    mw_point_reader_close(reader);
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_format), cmocka_unit_test(test_columns),
        cmocka_unit_test(test_classes),      cmocka_unit_test(test_laz),
        cmocka_unit_test(test_malformed),    cmocka_unit_test(test_gzip),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
