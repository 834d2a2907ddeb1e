/* test_io_constraints.c - constraints from .poly and GeoJSON: what is read, what is refused and
 * with which message, what happens without memory, and real files. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

/* wrap: malloc calloc realloc aligned_alloc */
#include "io/constraints/geojson.h"
#include "support/allocations.h"
#include "support/files.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static mw_constraint_file read_text(const char *name, const char *text)
{
    mw_constraint_file file;
    mw_error error;
    files_write_text(name, text);
    if (mw_read_constraints(name, NULL, &file, &error) != MW_OK)
        fail_msg("%s: refused: %s", text, error.message);
    return file;
}

static void expect_point(const mw_constraint_file *file, size_t i, double x, double y, double z)
{
    const double *p = file->points + 3 * i;
    assert_true(i < file->point_count);
    if (p[0] != x || p[1] != y || !(p[2] == z || (isnan(z) && isnan(p[2]))))
        fail_msg("point %zu is %g %g %g, not %g %g %g", i, p[0], p[1], p[2], x, y, z);
}

static void expect_segment(const mw_constraint_file *file, size_t i, uint32_t a, uint32_t b,
                           uint32_t polygon, uint32_t place)
{
    assert_true(i < file->segment_count);
    assert_int_equal(file->segments[2 * i], a);
    assert_int_equal(file->segments[2 * i + 1], b);
    assert_int_equal(file->polygon[i], polygon);
    assert_int_equal(file->record[i], place);
}

static void expect_counts(const mw_constraint_file *file, size_t points, size_t segments,
                          size_t polygons, size_t holes)
{
    assert_int_equal(file->point_count, points);
    assert_int_equal(file->segment_count, segments);
    assert_int_equal(file->polygon_count, polygons);
    assert_int_equal(file->hole_seed_count, holes);
    for (size_t i = 0; i < 2 * segments; i++) assert_true(file->segments[i] < points);
}

#define POLY_SEGMENTS "# segments\n2 1\n1 1 2 7\n2 2 3 7\n"

static void test_poly(void **state)
{
    (void)state;
    mw_constraint_file file = read_text(
        "a.poly", "# a comment\n3 2 2 1\n1 0 0 5 6 1\n2 4 0 7 8 1 # corner\n"
                  "3 0 4.5 9 10 0\n\n" POLY_SEGMENTS "1\n1 0.5 -1e1\n1 # regions\n1 0 0 7 0.1\n");
    expect_counts(&file, 3, 2, 0, 1);
    expect_point(&file, 1, 4, 0, NAN);
    expect_point(&file, 2, 0, 4.5, NAN);
    expect_segment(&file, 0, 0, 1, MW_NONE, 9);
    expect_segment(&file, 1, 1, 2, MW_NONE, 10);
    assert_string_equal(file.record_name, "line");
    assert_int_equal(file.has_z, 0);
    assert_int_equal(file.field_count, 2);
    assert_string_equal(file.field_names[1], "attribute2");
    assert_true(file.fields[0][0] == 5 && file.fields[1][2] == 10);
    assert_true(file.hole_seeds[0] == 0.5 && file.hole_seeds[1] == -10);
    mw_constraint_file_release(&file);
    mw_constraint_file_release(&file); /* empty */
    mw_constraint_file_release(NULL);

    /* from 0; a height by name; neither holes nor a final newline; recognised without its ending */
    file = read_text("plain", "# attributes: z, depth\n2 2 2 0\n0 1 2 3 4\n1 5 6 7 8\n1 0\n0 1 0");
    expect_counts(&file, 2, 1, 0, 0);
    expect_point(&file, 0, 1, 2, 3);
    expect_segment(&file, 0, 1, 0, MW_NONE, 6);
    assert_int_equal(file.has_z, 1);
    assert_int_equal(file.field_count, 1);
    assert_string_equal(file.field_names[0], "depth");
    mw_constraint_file_release(&file);
    assert_int_equal(mw_constraints_known("plain"), 1);
    files_clear();
}

/* The vertices of a .poly stand in the .node beside it, zipped or not. */
static void test_poly_and_node(void **state)
{
    (void)state;
    static const char poly[] = "0 2 0 0\n1 0\n1 1 3\n0\n",
                      node[] = "3 2 1 0\n1 0 0 .5\n2 1 0 .5\n3 0 1 .5\n";
    mw_constraint_file file;
    mw_error error;
    files_write_text("b.poly", poly);
    assert_int_equal(mw_read_constraints("b.poly", NULL, &file, &error), MW_ERROR_SYSTEM);
    assert_non_null(strstr(error.message, "b.node"));
    files_write_text("b.node", node);
    for (int zipped = 0; zipped < 2; zipped++) {
        if (zipped) {
            files_clear();
            files_write_gzip("b.poly.gz", BYTES(poly));
            files_write_gzip("b.node.gz", BYTES(node));
        }
        assert_int_equal(mw_read_constraints(zipped ? "b.poly.gz" : "b.poly", NULL, &file, &error),
                         MW_OK);
        expect_counts(&file, 3, 1, 0, 0);
        expect_segment(&file, 0, 0, 2, MW_NONE, 3);
        assert_int_equal(file.field_count, 1);
        mw_constraint_file_release(&file);
    }
    files_clear();
}

static void refused(const char *name, const char *text, int64_t line, const char *says)
{
    mw_constraint_file file;
    mw_error error;
    files_write_text(name, text);
    memset(&file, 0xee, sizeof file);
    if (mw_read_constraints(name, NULL, &file, &error) == MW_OK) fail_msg("taken: %s", text);
    files_expect_error(&error, MW_ERROR_INPUT, line, says);
    if (strncmp(error.message, name, strlen(name)) != 0)
        fail_msg("does not begin with the file: %s", error.message);
    static const mw_constraint_file empty;
    assert_memory_equal(&file, &empty, sizeof file);
}

static void test_poly_refused(void **state)
{
    (void)state;
#define THREE "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n"
    refused("r.poly", "", 1, "the file is empty");
    refused("r.poly", "x\n", 1, "number of rows");
    refused("r.poly", "3 2 0 0\n1 0 0\n", 2, "ends after 1 of 3 vertices");
    refused("r.poly", "1 3 0 0\n1 0 0 0\n1 0\n", 2, "TetGen");
    refused("r.poly", THREE, 4, "ends before the segments");
    refused("r.poly", THREE "two 0\n", 5, "number of rows");
    refused("r.poly", THREE "-1 0\n", 5, "negative");
    refused("r.poly", THREE "2 0\n1 1 2\n", 6, "ends after 1 of 2 segments");
    refused("r.poly", THREE "1 0\n1 1 4\n", 6, "vertex 4 does not exist");
    refused("r.poly", THREE "1 0\n1 0 1\n", 6, "vertex 0 does not exist");
    refused("r.poly", THREE "1 0\n1 1\n", 6, "the line ends before the end of the segment");
    refused("r.poly", THREE "1 0\n1 1 2.5\n", 6, "expected the end of the segment");
    refused("r.poly", THREE "1 0\n1 1 2\n2\n1 0 0\n", 8, "ends after 1 of 2 holes");
    refused("r.poly", THREE "1 0\n1 1 2\n1\n1 0 nan\n", 8, "not finite");
    refused("r.poly", THREE "1 0\n1 1 2\n1\n1 0 y\n", 8, "point of the hole: 'y' is not a number");
    refused("r.poly", THREE "1 0\n1 1 2\n9999999999999\n1 0 0\n", 8,
            "ends after 1 of 9999999999999 holes");
    refused("r.poly", "9999999999999 2 0 0\n1 0 0\n", 2, "ends after 1");
    files_clear();
}

static void test_other_files(void **state)
{
    (void)state;
    mw_constraint_file file;
    mw_error error;
    refused("x.off", "OFF\n1 0 0\n0 0 0\n", -1, "constraints are read from GeoJSON and .poly");
    refused("x.csv", "x,y\n1,2\n", -1, "constraints are read from");
    refused("x.xyz", "1 2.5\n3 4\n", -1, "constraints are read from");
    refused("rings.json", "[[[0,0],[1,0],[1,1]]]", -1, "constraints are read from");
    refused("empty", "", -1, "constraints are read from");
    assert_int_equal(mw_constraints_known("x.off"), 0);
    assert_int_equal(mw_constraints_known("absent.poly"), 0);
    assert_int_equal(mw_constraints_known(NULL), 0);
    assert_int_equal(mw_read_constraints("absent.poly", NULL, &file, &error), MW_ERROR_SYSTEM);
    assert_int_equal(mw_read_constraints(NULL, NULL, &file, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_read_constraints("x.off", NULL, NULL, &error), MW_ERROR_ARGUMENT);
    files_clear();
}

static bool no_geojson(void)
{
    return !mw__geojson_known();
}

/* Without Jansson a GeoJSON file is known for what it is, and refused. */
static void test_geojson_not_built(void **state)
{
    (void)state;
    if (!no_geojson()) return;
    refused("g.geojson", "{}", -1, "built without Jansson");
    assert_int_equal(mw_constraints_known("g.geojson"), 0);
    files_clear();
}

#define FEATURE(geometry)                                                                          \
    "{\"type\":\"Feature\",\"properties\":{\"a\":[1,{}]},\"geometry\":" geometry "}"
#define FEATURES(list)                                                                             \
    "{\"type\":\"FeatureCollection\",\"crs\":null,\"bbox\":[0],\"features\":[" list "]}"
#define SHAPE(type, coordinates) "{\"type\":\"" type "\",\"coordinates\":" coordinates "}"

static void test_geojson(void **state)
{
    (void)state;
    if (no_geojson()) return;
    mw_constraint_file file = read_text(
        "a.geojson",
        "\xef\xbb\xbf\n" FEATURES(FEATURE("null") "," FEATURE(SHAPE("Point", "[1,2]")) "," FEATURE(
            SHAPE("LineString",
                  "[[0,0],[1,0,5],[1,0],[2,1]]")) ",\n" FEATURE(SHAPE("Polygon",
                                                                      "[[[0,0],[4,0],[4,4],[0,0]],["
                                                                      "[1,0.5],["
                                                                      "2,1],[2,1.5e0],[1,0.5],[1,0."
                                                                      "5]]]"))));
    expect_counts(&file, 11, 9, 1, 0);
    expect_point(&file, 0, 1, 2, NAN);
    expect_point(&file, 2, 1, 0, 5);
    assert_int_equal(file.has_z, 1);
    assert_string_equal(file.record_name, "feature");
    assert_int_equal(file.field_count, 0);
    expect_segment(&file, 0, 1, 2, MW_NONE, 2);
    expect_segment(&file, 2, 3, 4, MW_NONE, 2);
    expect_segment(&file, 3, 5, 6, 0, 3);
    expect_segment(&file, 5, 7, 5, 0, 3);
    expect_segment(&file, 8, 10, 8, 0, 3);
    expect_point(&file, 10, 2, 1.5, NAN);
    mw_constraint_file_release(&file);
    files_clear();
}

static void test_geojson_shapes(void **state)
{
    (void)state;
    if (no_geojson()) return;
    /* every kind, nested; each polygon of a MultiPolygon is one; a ring may be left open */
    static const char shapes[] = "{\"geometries\":[" SHAPE("MultiPoint", "[[1,1],[2,2]]") "," SHAPE(
        "MultiLineString",
        "[[[0,0],[1,1]],[[5,5],[6,6],[7,5]]]") ",{\"type\":\"GeometryCollection\",\"geometries\":"
                                               "[" SHAPE(
                                                   "MultiPolygon",
                                                   "[[[[0,0],[9,0],[9,9],[0,0]]],[[[20,0],[29,"
                                                   "0],[29,9]]]]") "]},null],"
                                                                   "\"type\":"
                                                                   "\"GeometryCollection\"}";
    static const char *const wrapped[] = {shapes, FEATURE("%s"), FEATURES(FEATURE("%s"))};
    for (size_t i = 0; i < 3; i++) {
        char text[2048];
        const char *place = strstr(wrapped[i], "%s");
        if (place)
            snprintf(text, sizeof text, "%.*s%s%s", (int)(place - wrapped[i]), wrapped[i], shapes,
                     place + 2);
        else
            snprintf(text, sizeof text, "%s", wrapped[i]);
        mw_constraint_file file = read_text("b", text);
        expect_counts(&file, 13, 9, 2, 0);
        expect_segment(&file, 0, 2, 3, MW_NONE, 0);
        expect_segment(&file, 3, 7, 8, 0, 0);
        expect_segment(&file, 8, 12, 10, 1, 0);
        assert_int_equal(file.has_z, 0);
        mw_constraint_file_release(&file);
    }
    static const char *const empty[] = {SHAPE("Point", "[]"), SHAPE("Polygon", "[]"),
                                        SHAPE("MultiPolygon", "[]"), FEATURES(""),
                                        "{\"type\":\"Feature\"}"};
    for (size_t i = 0; i < sizeof empty / sizeof *empty; i++) {
        mw_constraint_file file = read_text("c.geojson", empty[i]);
        expect_counts(&file, 0, 0, 0, 0);
        mw_constraint_file_release(&file);
    }
    files_clear();
}

static void test_geojson_refused(void **state)
{
    (void)state;
    if (no_geojson()) return;
    static const struct {
        const char *text, *says;
    } wrong[] = {
        {"{}", "not GeoJSON: it has no type"},
        {"{\"type\":7}", "not GeoJSON: it has no type"},
        {"{\"type\":\"Topology\"}", "feature 0: 'Topology' is not a geometry type"},
        {"{\"type\":\"a\\u0001b\"}", "feature 0: 'a?b' is not a geometry type"},
        {"{\"type\":\"FeatureCollection\"}", "no array of features"},
        {FEATURES("{}"), "feature 0: its type is not 'Feature'"},
        {FEATURES("7"), "feature 0: its type is not 'Feature'"},
        {FEATURES(FEATURE("{}")), "feature 0: a geometry has no type"},
        {FEATURES(FEATURE("null") "," FEATURE("7")), "feature 1: a geometry has no type"},
        {SHAPE("Point", "{}"), "feature 0: a Point has no array of coordinates"},
        {"{\"type\":\"GeometryCollection\"}", "no array of geometries"},
        {SHAPE("Point", "[1]"), "a position is not two or three numbers"},
        {SHAPE("Point", "[1,\"2\"]"), "a coordinate is not a number"},
        {SHAPE("Point", "[1,2,null]"), "a coordinate is not a number"},
        {SHAPE("MultiPoint", "[1,2]"), "a part of a MultiPoint is not an array"},
        {SHAPE("LineString", "[[0,0]]"), "a line has fewer than two positions"},
        {SHAPE("MultiLineString", "[[[0,0],[1,1]],[]]"), "a line has fewer than two positions"},
        {SHAPE("LineString", "[[0,0],7]"), "a position is not"},
        {FEATURES(FEATURE("null") "," FEATURE(SHAPE("Polygon", "[[[0,0],[1,0],[0,1]],7]"))),
         "feature 1: a ring is not an array"},
        {SHAPE("Polygon", "[[],[[0,0],[0,\"1\"]]]"), "a coordinate is not a number"},
        {SHAPE("Polygon", "[[[0,0],[1,0],[0,\"1\"],[0,0]]]"), "a coordinate is not a number"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        refused("r.geojson", wrong[i].text, -1, wrong[i].says);
    refused("r.geojson", "{\n\"type\":\n\"Point\", oops}", 3, "oops");
    refused("r.geojson", "{\"type\":\"Point\",\n\"coordinates\":[1,1e999]}", 2,
            "real number overflow");
    refused("r.geojson", "{\"type\":\"Point\",\n\"coordinates\":[1,2]}\n{}", 3,
            "end of file expected");
    refused("r.geojson", "{\"type\":\"Point\",\n\"coordinates\":[1,NaN]}", 2, "");
    refused("r.geojson", "{\"type\":\n\n\"Poi", 3, "premature end");
    char deep[6000] = "{\"type\":\"Point\",\"coordinates\":";
    memset(deep + strlen(deep), '[', 4000);
    refused("r.geojson", deep, 1, "maximum parsing depth");
    files_clear();
}

/* A zipped file cut short anywhere is refused. */
static void test_geojson_zipped(void **state)
{
    (void)state;
    if (no_geojson()) return;
    mw_constraint_file file;
    mw_error error;
    char text[9000] = "{\"type\":\"MultiPoint\",\n\"coordinates\":[[0,0]";
    for (int i = 1; i < 900; i++) sprintf(text + strlen(text), ",[%d,%d]", i * i % 97, i);
    strcat(text, "]}");
    files_write_gzip("z.geojson.gz", (bytes){text, strlen(text)});
    assert_int_equal(mw_read_constraints("z.geojson.gz", NULL, &file, &error), MW_OK);
    expect_counts(&file, 900, 0, 0, 0);
    mw_constraint_file_release(&file);
    size_t size;
    char *zipped = files_read("z.geojson.gz", &size);
    assert_non_null(zipped);
    for (size_t cut = 11; cut < size; cut += cut + 20 < size ? 17 : 1) {
        files_write("cut.geojson.gz", (bytes){zipped, cut});
        if (mw_read_constraints("cut.geojson.gz", NULL, &file, &error) == MW_OK)
            fail_msg("cut at %zu: taken", cut);
        assert_int_equal(error.status, MW_ERROR_INPUT);
        assert_non_null(strstr(error.message, "cut.geojson.gz"));
    }
    free(zipped);
    files_clear();
}

static void fail_each(const char *path)
{
    for (long k = 0;; k++) {
        mw_constraint_file file;
        mw_error error = {0};
        allocations_left = k;
        mw_status status = mw_read_constraints(path, NULL, &file, &error);
        bool reached = allocations_left < 0;
        allocations_left = -1;
        if (!reached) {
            assert_int_equal(status, MW_OK);
            assert_true(k > 2);
            mw_constraint_file_release(&file);
            return;
        }
        if (status != MW_ERROR_MEMORY)
            fail_msg("%s: status %d when allocation %ld fails: %s", path, status, k, error.message);
        assert_string_equal(error.message, "out of memory");
        assert_null(file.points);
    }
}

static void test_memory(void **state)
{
    (void)state;
    char text[16384] = "40 2 2 0\n";
    for (int i = 0; i < 40; i++) sprintf(text + strlen(text), "%d %d %d 5 6\n", i, i, i * i);
    strcat(text, "39 0\n");
    for (int i = 0; i < 39; i++) sprintf(text + strlen(text), "%d %d %d\n", i, i, i + 1);
    strcat(text, "20\n");
    for (int i = 0; i < 20; i++) sprintf(text + strlen(text), "%d 0 0\n", i);
    files_write_text("m.poly", text);
    fail_each("m.poly");
    files_write_text("n.poly", "0 2 1 0\n1 0\n0 0 1\n0\n");
    files_write_text("n.node", "2 2 1 0\n0 0 0 1\n1 1 1 1\n");
    fail_each("n.poly");
    if (!no_geojson()) {
        strcpy(text, "{\"type\":\"Polygon\",\"coordinates\":[[[0,0]");
        for (int i = 1; i < 100; i++) sprintf(text + strlen(text), ",[%d,%d]", i, i * i);
        strcat(text, "]]}");
        files_write_text("m.geojson", text);
        fail_each("m.geojson");
    }
    files_clear();
}

static const struct {
    const char *name;
    size_t points, segments, polygons, holes;
} real[] = {
    {"domain/A.poly", 29, 29, 0, 1},
    {"domain/la.poly", 141, 148, 0, 0},
    {"domain/face.poly", 26, 22, 0, 3},
    {"domain/double_hex3.poly", 16, 16, 0, 2},
    {"domain/square_circle_hole.poly", 826, 135, 0, 1},
    {"domain/box.poly", 8, 5, 0, 1},
    {"domain/chicago_buildings.geojson", 181, 181, 10, 0},
    {"domain/chicago_neighborhoods.geojson.gz", 55432, 55432, 101, 0},
    {"domain/land_50m.geojson.gz", 59208, 59208, 1419, 0},
    {"domain/olinda_tracts.geojson.gz", 12235, 12235, 470, 0},
    {"domain/parcels_moravia.geojson.gz", 7102, 7102, 573, 0},
    {"domain/provinces_nl.geojson.gz", 3539, 3539, 12, 0},
    {"domain/soil_blocks.geojson", 2609, 2609, 47, 0},
};

/* The counts that others counted. */
static void test_real_files(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof real / sizeof *real; i++) {
        const char *path = files_shared(real[i].name);
        if (!path || (strstr(path, "geojson") && no_geojson())) continue;
        mw_constraint_file file;
        mw_error error;
        if (mw_read_constraints(path, NULL, &file, &error) != MW_OK) fail_msg("%s", error.message);
        expect_counts(&file, real[i].points, real[i].segments, real[i].polygons, real[i].holes);
        mw_constraint_file_release(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_poly),           cmocka_unit_test(test_poly_and_node),
        cmocka_unit_test(test_poly_refused),   cmocka_unit_test(test_other_files),
        cmocka_unit_test(test_geojson),        cmocka_unit_test(test_geojson_not_built),
        cmocka_unit_test(test_geojson_shapes), cmocka_unit_test(test_geojson_refused),
        cmocka_unit_test(test_geojson_zipped), cmocka_unit_test(test_memory),
        cmocka_unit_test(test_real_files),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
