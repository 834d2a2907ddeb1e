/* test_io_crs.c - coordinate systems as files tell them: a comment in PLY, .prj files, records of
 * LAS, GeoJSON. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/text/byte_order.h"
#include "support/files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WKT "PROJCS[\"a b\",GEOGCS[\"c\"],UNIT[\"foot\",0.3048]]"
#define OFF "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
#define PLY(comments)                                                                              \
    "ply\nformat ascii 1.0\n" comments "element vertex 3\nproperty double x\nproperty double y\n"  \
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0\n1 0\n0 1\n3 0 1 2\n"

static void expect(const char *found, const char *crs)
{
    if (crs) assert_non_null(found);
    if (crs) assert_string_equal(found, crs);
    if (!crs && found) fail_msg("no coordinate system was expected, not %s", found);
}

static void expect_mesh(const char *name, const char *text, const char *crs)
{
    mw_mesh_file file;
    mw_error error;
    if (text) files_write_text(name, text);
    if (mw_read_mesh(name, NULL, &file, &error) != MW_OK) fail_msg("%s", error.message);
    expect(file.crs, crs);
    mw_mesh_file_release(&file);
    assert_null(file.crs);
}

static void expect_points(const char *name, bytes contents, const char *crs)
{
    mw_point_reader *reader;
    mw_error error;
    if (contents.data) files_write(name, contents);
    if (mw_point_reader_open(name, NULL, &reader, &error) != MW_OK) fail_msg("%s", error.message);
    expect(mw_point_reader_crs(reader), crs);
    mw_point_reader_close(reader);
}

static void test_ply(void **state)
{
    (void)state;
    expect_mesh("a.ply", PLY(""), NULL);
    expect_mesh("a.ply",
                PLY("comment crs\ncomment crs \ncomment CRS EPSG:1\ncomment crsx EPSG:1\n"), NULL);
    expect_mesh("a.ply", PLY("comment made by hand\ncomment crs EPSG:2056\ncomment crs EPSG:1\n"),
                "EPSG:2056");
    expect_mesh("a.ply", PLY("comment  crs  " WKT "  \n"), WKT);
    expect_mesh("a.ply", PLY("comment crs a\tb\n"), "a b");
    expect_mesh("a.ply", PLY("comment crs a\001b\n"), NULL);
    files_write_text("a.prj", "EPSG:1\n");
    expect_mesh("a.ply", PLY("comment crs EPSG:2056\n"), "EPSG:2056");
    expect_mesh("a.ply", PLY(""), "EPSG:1");
    files_clear();
}

static void test_ply_round_trip(void **state)
{
    static const char *const formats[] = {"ply", "ply-ascii"};
    mw_mesh_file file;
    (void)state;
    files_write_text("a.off", OFF);
    assert_int_equal(mw_read_mesh("a.off", NULL, &file, NULL), MW_OK);
    for (size_t i = 0; i < 2; i++) {
        file.crs = strdup(WKT "\n\n\tand\x01 more");
        assert_int_equal(mw_write_mesh("b.ply", &file, formats[i], NULL, NULL), MW_OK);
        expect_mesh("b.ply", NULL, WKT " and more");
        free(file.crs);
    }
    file.crs = strdup("");
    assert_int_equal(mw_write_mesh("b.ply", &file, NULL, NULL, NULL), MW_OK);
    expect_mesh("b.ply", NULL, NULL);
    mw_mesh_file_release(&file);
    files_clear();
}

/* A .prj file: only WKT, and EPSG:n, are taken from it. */
static void test_beside(void **state)
{
    char *large = calloc(1, 70000);
    (void)state;
    files_write_text("a.prj", "\xef\xbb\xbf " WKT "\r\n");
    expect_mesh("a.off", OFF, WKT);
    files_write_gzip("a.off.gz", BYTES(OFF));
    expect_mesh("a.off.gz", NULL, WKT);
    expect_points("a.csv", BYTES("x,y\n1,2\n"), WKT);
    files_write_text("q.prj", WKT);
    expect_points("q", BYTES("x,y\n1,2\n"), WKT);
    files_write_text(".prj", WKT);
    expect_points(".csv", BYTES("x,y\n1,2\n"), NULL);
    files_write_text("b.PRJ", "GEOGCRS [\"a\",\n  DATUM[\"b\"]]");
    expect_points("b.tar.csv", BYTES("x,y\n1,2\n"), NULL);
    expect_points("b.csv", BYTES("x,y\n1,2\n"), "GEOGCRS [\"a\", DATUM[\"b\"]]");
    static const char *const others[] = {
        "", "\n", "Projection UTM\nZone 10\n", "Proj Title=River", "PROJCS", "PROJ[1]"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        files_write_text("a.prj", others[i]);
        expect_mesh("a.off", OFF, NULL);
    }
    files_write("a.prj", BYTES("EPSG:4\0"
                               "26"));
    expect_mesh("a.off", OFF, NULL);
    snprintf(large, 70000, "PROJCS[\"%069000d\"]", 1);
    files_write_text("a.prj", large);
    expect_mesh("a.off", OFF, NULL);
    files_write_text("a.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n");
    files_write_text("a.ele", "1 3 0\n0 0 1 2\n");
    files_write_text("a.prj", "epsg:31370");
    expect_mesh("a.node", NULL, "epsg:31370");
    expect_mesh("a.ele", NULL, "epsg:31370");
    expect_mesh("a", NULL, "epsg:31370");
    free(large);
    files_clear();
}

static size_t put_record(unsigned char *at, const char *user, unsigned number, const void *contents,
                         size_t size)
{
    memset(at, 0, 54);
    snprintf((char *)at + 2, 16, "%s", user);
    mw__put_bytes(at + 18, 2, number);
    mw__put_bytes(at + 20, 2, size);
    memcpy(at + 54, contents, size);
    return 54 + size;
}

static size_t put_keys(unsigned char *at, unsigned model, unsigned geographic, unsigned projected)
{
    unsigned char keys[32] = {1, 0, 1, 0, 0, 0, 3, 0};
    const unsigned numbers[] = {1024, 2048, 3072}, values[] = {model, geographic, projected};
    for (size_t k = 0; k < 3; k++) {
        mw__put_bytes(keys + 8 + 8 * k, 2, numbers[k]);
        mw__put_bytes(keys + 12 + 8 * k, 2, 1);
        mw__put_bytes(keys + 14 + 8 * k, 2, values[k]);
    }
    return put_record(at, "LASF_Projection", 34735, keys, sizeof keys);
}

/* LAS of no points, with these records. */
static void expect_las(const unsigned char *records, size_t size, const char *crs)
{
    unsigned char file[2048] = "LASF";
    file[24] = 1;
    file[25] = 2;
    mw__put_bytes(file + 94, 2, 227);
    mw__put_bytes(file + 96, 4, 227 + size);
    mw__put_bytes(file + 105, 2, 20);
    memcpy(file + 227, records, size);
    expect_points("p.las", (bytes){(const char *)file, 227 + size}, crs);
}

static void test_las(void **state)
{
    unsigned char r[1024] = {0};
    size_t size;
    (void)state;
    expect_las(r, 0, NULL);
    expect_las(r, put_keys(r, 1, 4269, 26910), "EPSG:26910");
    expect_las(r, put_keys(r, 2, 4326, 32767), "EPSG:4326");
    expect_las(r, put_keys(r, 2, 4326, 26910), "EPSG:4326");
    expect_las(r, put_keys(r, 0, 4326, 0), "EPSG:4326");
    expect_las(r, put_keys(r, 1, 4326, 32767), NULL); /* defined by further keys */
    expect_las(r, put_record(r, "LASF_Projection", 2112, WKT "\0\0", sizeof WKT + 1), WKT);
    expect_las(r, put_record(r, "liblas", 2112, WKT, sizeof WKT), WKT);
    expect_las(r, put_record(r, "somebody", 2112, WKT, sizeof WKT), NULL);
    expect_las(r, put_record(r, "LASF_Projection", 2112, "\0", 1), NULL);
    expect_las(r, put_record(r, "LASF_Projection", 34735, "\1\0\1", 3), NULL);
    size = put_keys(r, 1, 4269, 26910);
    expect_las(r, size + put_record(r + size, "LASF_Projection", 2112, WKT, sizeof WKT), WKT);
    expect_las(r, size - 5, NULL); /* cut off before its last key */
    files_write_text("p.prj", "EPSG:7");
    expect_las(r, size, "EPSG:26910");
    expect_las(r, 0, "EPSG:7");
    files_clear();
}

/* Put a record of those that stand behind the points of LAS 1.4. */
static size_t put_extended(unsigned char *at, const char *user, unsigned number, uint64_t length,
                           const void *contents, size_t size)
{
    memset(at, 0, 60);
    memset(at, 'r', 2); /* reserved */
    snprintf((char *)at + 2, 16, "%s", user);
    mw__put_bytes(at + 18, 2, number);
    mw__put_bytes(at + 20, 8, length);
    memcpy(at + 60, contents, size);
    return 60 + size;
}

/* LAS 1.4 of no points, with these records behind them, the first at byte `begin`. */
static void expect_las_trailer(const unsigned char *records, size_t size, uint64_t begin,
                               uint32_t count, const char *crs)
{
    unsigned char file[2048] = "LASF";
    file[24] = 1;
    file[25] = 4;
    mw__put_bytes(file + 94, 2, 375);
    mw__put_bytes(file + 96, 4, 375);
    mw__put_bytes(file + 105, 2, 20);
    mw__put_bytes(file + 235, 8, begin);
    mw__put_bytes(file + 243, 4, count);
    memcpy(file + 375, records, size);
    expect_points("p.las", (bytes){(const char *)file, 375 + size}, crs);
    files_write_gzip("p.las.gz", (bytes){(const char *)file, 375 + size});
    expect_points("p.las.gz", (bytes){NULL, 0}, crs);
}

static void test_las_trailer(void **state)
{
    unsigned char r[1024] = {0};
    (void)state;
    size_t first = put_extended(r, "somebody", 2112, 9, "not this", 9);
    size_t size =
        first + put_extended(r + first, "LASF_Projection", 2112, sizeof WKT, WKT, sizeof WKT);
    expect_las_trailer(r, size, 375, 2, WKT);
    expect_las_trailer(r, size, 375 + first, 1, WKT);
    expect_las_trailer(r, size, 375 + first, UINT32_MAX, WKT);
    expect_las_trailer(r, size, 375, 1, NULL);
    expect_las_trailer(r, size, 375, 0, NULL);
    for (size_t cut = 0; cut < size; cut++) /* the file ends before the text does */
        expect_las_trailer(r, cut, 375, 2, NULL);
    expect_las_trailer(r, size, UINT64_MAX, 2, NULL);
    expect_las_trailer(r, size, UINT64_MAX / 2, 2, NULL);
    put_extended(r, "somebody", 2112, UINT64_MAX, "not this", 9);
    expect_las_trailer(r, size, 375, 2, NULL);
    put_extended(r, "LASF_Projection", 2112, 1 << 20, "not this", 9);
    expect_las_trailer(r, size, 375, 2, NULL);
    files_clear();
}

static void expect_constraints(const char *name, const char *text, const char *crs)
{
    mw_constraint_file file;
    mw_error error;
    files_write_text(name, text);
    if (mw_read_constraints(name, NULL, &file, &error) != MW_OK) fail_msg("%s", error.message);
    expect(file.crs, crs);
    mw_constraint_file_release(&file);
}

static void test_constraints(void **state)
{
    (void)state;
    files_write_text("c.geojson", "{\"type\":\"Point\",\"coordinates\":[1,2]}");
    if (mw_constraints_known("c.geojson")) {
        expect_constraints("c.geojson", "{\"type\":\"Point\",\"coordinates\":[1,2]}", "EPSG:4326");
        expect_constraints("c.geojson",
                           "{\"type\":\"MultiPoint\",\"coordinates\":[[1,2],[500000,5]]}", NULL);
        expect_constraints("c.geojson", "{\"type\":\"Point\",\"crs\":null,\"coordinates\":[1,2]}",
                           NULL);
        expect_constraints(
            "c.geojson",
            "{\"type\":\"Point\",\"crs\":{\"type\":\"name\",\"properties\":{\"name\":"
            "\"urn:ogc:def:crs:EPSG::2056\"}},\"coordinates\":[1,2]}",
            "urn:ogc:def:crs:EPSG::2056");
        expect_constraints("c.geojson", "{\"type\":\"Point\",\"crs\":7,\"coordinates\":[1,2]}",
                           NULL);
    }
    expect_constraints("a.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n1 0\n0 0 1\n0\n", NULL);
    files_write_text("a.prj", WKT);
    expect_constraints("a.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n1 0\n0 0 1\n0\n", WKT);
    files_clear();
}

static void test_real(void **state)
{
    (void)state;
    const char *tile = files_shared("gis/autzen_utm.las");
    if (!tile) skip();
    mw_point_reader *reader;
    assert_int_equal(mw_point_reader_open(tile, NULL, &reader, NULL), MW_OK);
    assert_non_null(mw_point_reader_crs(reader));
    assert_non_null(strstr(mw_point_reader_crs(reader), "NAD83 / UTM zone 10N"));
    mw_point_reader_close(reader);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ply),         cmocka_unit_test(test_ply_round_trip),
        cmocka_unit_test(test_beside),      cmocka_unit_test(test_las),
        cmocka_unit_test(test_las_trailer), cmocka_unit_test(test_constraints),
        cmocka_unit_test(test_real),
    };
    return cmocka_run_group_tests_name("crs", tests, files_enter, files_leave);
}
