/* test_io_rings.c - rings of fewer than three different points are skipped, and listed by feature,
 * polygon and ring. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/files.h"

#include <meshwalk/meshwalk.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define POLYGON(rings) "{\"type\":\"Polygon\",\"coordinates\":[" rings "]}"
#define MANY(polygons) "{\"type\":\"MultiPolygon\",\"coordinates\":[" polygons "]}"
#define FEATURE(geometry) "{\"type\":\"Feature\",\"properties\":null,\"geometry\":" geometry "}"
#define FEATURES(features) "{\"type\":\"FeatureCollection\",\"features\":[" features "]}"
#define SQUARE "[[0,0],[9,0],[9,9],[0,9],[0,0]]"
#define INNER "[[1,1],[2,1],[2,2],[1,1]]"
#define PLACE "[[5,5],[5,5]]"
#define NEEDLE "[[5,5],[6,6],[5,5],[6,6],[5,5]]"

/* False where the library was built without Jansson: then all GeoJSON is refused. */
static bool read_rings(const char *text, mw_constraint_file *file)
{
    mw_error error;
    files_write_text("rings.geojson", text);
    mw_status status = mw_read_constraints("rings.geojson", NULL, file, &error);
    if (status && strstr(error.message, "built without Jansson")) return false;
    if (status) fail_msg("%s", error.message);
    return true;
}

static void expect_skipped(const mw_constraint_file *file, size_t i, uint32_t record,
                           uint32_t polygon, uint32_t ring)
{
    assert_true(i < file->skipped_count);
    assert_int_equal(file->skipped[i].record, record);
    assert_int_equal(file->skipped[i].polygon, polygon);
    assert_int_equal(file->skipped[i].ring, ring);
}

static void test_inner_ring(void **state)
{
    (void)state;
    static const char *const wrong[] = {PLACE, NEEDLE, "[]", "[[5,5]]", "[[5,5],[6,6]]"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[512];
        mw_constraint_file file;
        snprintf(text, sizeof text,
                 FEATURES(FEATURE("null") "," FEATURE(POLYGON(SQUARE ",%s," INNER))), wrong[i]);
        if (!read_rings(text, &file)) return;
        assert_int_equal(file.point_count, 7);
        assert_int_equal(file.segment_count, 7);
        assert_int_equal(file.polygon_count, 1);
        assert_int_equal(file.skipped_count, 1);
        expect_skipped(&file, 0, 1, 0, 1);
        mw_constraint_file_release(&file);
        assert_null(file.skipped);
    }
    files_clear();
}

/* Without its outer ring a polygon would be turned inside out. Numbers of polygons have no gap. */
static void test_outer_ring(void **state)
{
    (void)state;
    mw_constraint_file file;
    if (!read_rings(FEATURES(FEATURE(MANY("[" SQUARE "],[" PLACE "," INNER "],[" INNER "," NEEDLE
                                          "]")) "," FEATURE(POLYGON(NEEDLE "," PLACE))),
                    &file))
        return;
    assert_int_equal(file.segment_count, 7);
    assert_int_equal(file.polygon_count, 2);
    assert_int_equal(file.polygon[0], 0);
    assert_int_equal(file.polygon[6], 1);
    assert_int_equal(file.skipped_count, 4);
    expect_skipped(&file, 0, 0, 1, 0);
    expect_skipped(&file, 1, 0, 2, 1);
    expect_skipped(&file, 2, 1, 0, 0);
    expect_skipped(&file, 3, 1, 0, 1);
    mw_constraint_file_release(&file);
    files_clear();
}

/* What is skipped grows with the file; sound files list nothing. */
static void test_many(void **state)
{
    (void)state;
    enum { RINGS = 300 };
    char *text = malloc(RINGS * sizeof PLACE + 512), *end = text;
    assert_non_null(text);
    end += sprintf(end, "%s", "{\"type\":\"Polygon\",\"coordinates\":[" SQUARE);
    for (int i = 0; i < RINGS; i++) end += sprintf(end, "," PLACE);
    sprintf(end, "]}");
    mw_constraint_file file;
    bool read = read_rings(text, &file);
    free(text);
    if (!read) return;
    assert_int_equal(file.skipped_count, RINGS);
    for (uint32_t i = 0; i < RINGS; i++) expect_skipped(&file, i, 0, 0, i + 1);
    mw_constraint_file_release(&file);
    assert_true(read_rings(POLYGON(SQUARE "," INNER), &file));
    assert_int_equal(file.skipped_count, 0);
    assert_null(file.skipped);
    assert_int_equal(file.record_count, 1);
    mw_constraint_file_release(&file);
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_inner_ring),
        cmocka_unit_test(test_outer_ring),
        cmocka_unit_test(test_many),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
