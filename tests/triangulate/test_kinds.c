/* test_kinds.c - what the kinds of triangulation share: names, arguments, the report. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/meshes.h"

#include <math.h>
#include <string.h>

static void test_names(void **state)
{
    (void)state;
    for (int i = 0; i < MW_KIND_COUNT; i++)
        for (int k = 0; k < i; k++)
            assert_true(strcmp(mw_kind_name((mw_triangulation_kind)i),
                               mw_kind_name((mw_triangulation_kind)k)));
    assert_string_equal(mw_kind_name(MW_KIND_MIN_MAX_ANGLE), "min-max-angle");
    assert_true(mw_kind_source(MW_KIND_GREEDY) && mw_kind_help(MW_KIND_GREEDY));
    assert_null(mw_kind_name(MW_KIND_COUNT));
    assert_null(mw_kind_source(MW_KIND_COUNT));
    assert_null(mw_kind_help((mw_triangulation_kind)-1));
}

/* Every kind refuses what the Delaunay triangulation does, and leaves the report alone. */
static void test_errors(void **state)
{
    (void)state;
    const double line[] = {0, 0, 1, 1, 2, 2, 3, 3}, infinite[] = {0, 0, 1, 0, 0, INFINITY};
    for (int kind = 0; kind < MW_KIND_COUNT; kind++) {
        mw_triangulation_kind k = (mw_triangulation_kind)kind;
        mw_kind_report report = {.edge_length = 17};
        mw_mesh *mesh = (mw_mesh *)&report;
        mw_error error;
        assert_int_equal(mw_triangulate(k, line, 4, 0, NULL, NULL, &report, &mesh, &error),
                         MW_ERROR_INPUT);
        assert_null(mesh);
        assert_int_equal(mw_triangulate(k, infinite, 3, 2, NULL, NULL, &report, &mesh, &error),
                         MW_ERROR_INPUT);
        assert_int_equal(error.vertex, 2);
        assert_int_equal(mw_triangulate(k, line, 4, 1, NULL, NULL, &report, &mesh, &error),
                         MW_ERROR_ARGUMENT);
        assert_int_equal(mw_triangulate(k, line, 4, 0, NULL, NULL, &report, NULL, &error),
                         MW_ERROR_ARGUMENT);
        assert_true(report.edge_length == 17);
    }
    mw_mesh *mesh;
    assert_int_equal(mw_triangulate(MW_KIND_COUNT, line, 4, 0, NULL, NULL, NULL, &mesh, NULL),
                     MW_ERROR_ARGUMENT);
}

/* Lengths and angles of a triangle beside a right angle, at any scale that leaves them among the
 * doubles. */
static void test_report(void **state)
{
    (void)state;
    const double pi = 3.14159265358979323846,
                 scales[] = {1, 1e-200, 1e200, 0x1p-1060, 0x1p1020, 1e-320};
    for (int kind = 0; kind < MW_KIND_COUNT; kind++)
        for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
            double s = scales[i];
            const double points[] = {0, 0, 4 * s, 0, 4 * s, 3 * s, 0, 0};
            uint32_t duplicate_of[4];
            mw_kind_report report;
            mw_mesh *mesh;
            mw_error error;
            expect_ok(mw_triangulate((mw_triangulation_kind)kind, points, 4, 0, NULL, duplicate_of,
                                     &report, &mesh, &error),
                      "triangulate", &error);
            assert_int_equal(mw_mesh_triangle_count(mesh), 1);
            assert_int_equal(report.delaunay.duplicates, 1);
            assert_int_equal(duplicate_of[3], 0);
            assert_int_equal(report.optimal, 1);
            assert_true(fabs(report.largest_angle - pi / 2) < 1e-3);
            assert_true(fabs(report.edge_length / s - 12) < 1e-2);
            mw_mesh_destroy(mesh);
        }
}

/* An edge between two triangles counts once; the kinds are in the order that their names promise.
 */
static void test_sums(void **state)
{
    (void)state;
    const double square[] = {0, 0, 2, 0, 2, 2, 0, 2};
    mw_kind_report report[MW_KIND_COUNT];
    mw_mesh *mesh;
    for (int kind = 0; kind < MW_KIND_COUNT; kind++) {
        assert_int_equal(mw_triangulate((mw_triangulation_kind)kind, square, 4, 0, NULL, NULL,
                                        &report[kind], &mesh, NULL),
                         MW_OK);
        assert_true(fabs(report[kind].edge_length - 8 - sqrt(8)) < 1e-12);
        mw_mesh_destroy(mesh);
    }
    enum { N = 500 };
    double points[2 * N];
    uint64_t random = 41;
    for (int i = 0; i < 2 * N; i++) points[i] = random_unit(&random);
    for (int kind = 0; kind < MW_KIND_COUNT; kind++) {
        assert_int_equal(mw_triangulate((mw_triangulation_kind)kind, points, N, 0, NULL, NULL,
                                        &report[kind], &mesh, NULL),
                         MW_OK);
        mw_mesh_destroy(mesh);
    }
    assert_true(report[MW_KIND_MIN_WEIGHT].edge_length <= report[MW_KIND_GREEDY].edge_length);
    assert_true(report[MW_KIND_GREEDY].edge_length < report[MW_KIND_DELAUNAY].edge_length);
    assert_true(report[MW_KIND_MIN_MAX_ANGLE].largest_angle <=
                report[MW_KIND_DELAUNAY].largest_angle);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_report),
        cmocka_unit_test(test_sums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
