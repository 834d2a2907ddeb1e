/* test_recover.c - values at triangles become values at vertices: sums by hand, faces of several
 * triangles, missing values, what is refused, failing memory. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/allocations.h"

#include <meshwalk/meshwalk.h>

/* A square of side 2, cut from its lower left corner; beyond it a triangle of four times the area
 * of one of these; a vertex of no triangle. */
static const double points[] = {0, 0, 2, 0, 2, 2, 0, 2, 10, 0, 7, 7};
static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3, 1, 4, 2};

static mw_mesh *make_mesh(void)
{
    const mw_arrays arrays = {
        .points = points, .point_count = 6, .triangles = triangles, .triangle_count = 3};
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&arrays, NULL, &mesh, NULL), MW_OK);
    return mesh;
}

static void means_are_weighed_by_area(void **state)
{
    mw_mesh *mesh = make_mesh();
    const double values[] = {3, 9, 18};
    double at[6];
    (void)state;
    assert_int_equal(mw_recover_vertex_values(mesh, values, NULL, at, NULL), MW_OK);
    assert_true(at[0] == 6 && at[1] == (3 + 4 * 18) / 5.0 && at[2] == (3 + 9 + 4 * 18) / 6.0);
    assert_true(at[3] == 9 && at[4] == 18 && isnan(at[5]));
    mw_mesh_destroy(mesh);
}

static void faces_have_several_triangles(void **state)
{
    mw_mesh *mesh = make_mesh();
    const double values[] = {5, 20};
    const uint32_t faces[] = {1, 1, 0};
    double at[6];
    (void)state;
    assert_int_equal(mw_recover_vertex_values(mesh, values, faces, at, NULL), MW_OK);
    assert_true(at[0] == 20 && at[1] == 8 && at[2] == 10 && at[3] == 20 && at[4] == 5);
    mw_mesh_destroy(mesh);
}

static void missing_values_do_not_count(void **state)
{
    mw_mesh *mesh = make_mesh();
    const double values[] = {NAN, NAN, 7};
    double at[6];
    (void)state;
    assert_int_equal(mw_recover_vertex_values(mesh, values, NULL, at, NULL), MW_OK);
    assert_true(isnan(at[0]) && at[1] == 7 && at[2] == 7 && isnan(at[3]) && at[4] == 7);
    mw_mesh_destroy(mesh);
}

static void what_is_not_there_is_refused(void **state)
{
    mw_mesh *mesh = make_mesh();
    mw_error error;
    double at[6];
    (void)state;
    assert_int_equal(mw_recover_vertex_values(NULL, at, NULL, at, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_recover_vertex_values(mesh, NULL, NULL, at, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_recover_vertex_values(mesh, at, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    mw_mesh_destroy(mesh);
}

static void memory_may_run_out(void **state)
{
    mw_mesh *mesh = make_mesh();
    mw_error error;
    const double values[] = {1, 2, 3};
    double at[6];
    (void)state;
    allocations_left = 0;
    assert_int_equal(mw_recover_vertex_values(mesh, values, NULL, at, &error), MW_ERROR_MEMORY);
    assert_int_equal(allocations_left, -1);
    mw_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means_are_weighed_by_area),
        cmocka_unit_test(faces_have_several_triangles),
        cmocka_unit_test(missing_values_do_not_count),
        cmocka_unit_test(what_is_not_there_is_refused),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
