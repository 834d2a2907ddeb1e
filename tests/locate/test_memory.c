/* Every allocation of the library fails once: the call reports it, and nothing is lost or broken
 * (leaks show in a build with the address sanitizer). */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "tiling/tiling_create.h"
#include "support/allocations.h"
#include "support/meshes.h"

typedef mw_status mesh_job(const mw_arrays *view, mw_error *error);

static mw_status check_job(const mw_arrays *view, mw_error *error)
{
    mw_check check;
    mw_status status = mw_check_arrays(view, NULL, &check, error);
    if (!status) mw_check_release(&check);
    return status;
}

/* In the plane, then in space, where a point takes three of the coordinates. */
static mw_status mend_job(const mw_arrays *view, mw_error *error)
{
    mw_mended mended;
    mw_arrays space = *view;
    mw_status status = mw_mend_arrays(view, NULL, &mended, error);
    mw_mended_release(&mended);
    space.point_count = space.point_count * 2 / 3;
    if (!status) status = mw_mend_arrays(&space, &(mw_mend_options){.space = 1}, &mended, error);
    mw_mended_release(&mended);
    return status;
}

static mw_mesh *make(const mw_arrays *view, mw_status *status, mw_error *error)
{
    mw_mesh *mesh;
    *status = mw_mesh_create(view, &(mw_mesh_options){.tolerant = 1}, &mesh, error);
    return mesh;
}

static mw_status describe_job(const mw_arrays *view, mw_error *error)
{
    mw_status status;
    mw_mesh *mesh = make(view, &status, error);
    mw_mesh_info info;
    if (!status) status = mw_mesh_describe(mesh, NULL, &info, error);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status tile_job(const mw_arrays *view, mw_error *error)
{
    mw_status status;
    mw_mesh *mesh = make(view, &status, error);
    mw_tiling tiling = {0};
    if (!status)
        status =
            mw__tiling_create(mesh, (mw_tiling_options){.any = true}, MW_ALONE, &tiling, error);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status locator_job(const mw_arrays *view, mw_error *error)
{
    mw_status status;
    mw_mesh *mesh = make(view, &status, error);
    mw_locator *locator = NULL;
    if (!status)
        status = mw_locator_create(mesh, &(mw_locator_options){.any = 1, .border = 1, .areas = 1},
                                   &locator, error);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status open_job(const mw_arrays *view, mw_error *error)
{
    mw_status status;
    mw_mesh *mesh = make(view, &status, error);
    mw_locator *locator = NULL;
    if (!status)
        status = mw_locator_create(mesh, &(mw_locator_options){.any = 1, .fill = MW_FILL_NO},
                                   &locator, error);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status batch_job(const mw_arrays *view, mw_error *error)
{
    static mw_location at[200];
    mw_status status;
    mw_mesh *mesh = make(view, &status, error);
    mw_locator *locator = NULL;
    if (!status) status = mw_locator_create(mesh, &(mw_locator_options){.any = 1}, &locator, error);
    double q[400] = {0};
    if (!status) status = mw_locate_batch(locator, q, 200, 2, NULL, at, NULL, error);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status order_job(const mw_arrays *view, mw_error *error)
{
    uint32_t vertices[200];
    mw_status status;
    mw_mesh *mesh = make(view, &status, error);
    if (!status) status = mw_mesh_hilbert_order(mesh, NULL, vertices, error);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status delaunay_job(const mw_arrays *view, mw_error *error)
{
    mw_mesh *mesh;
    mw_status status =
        mw_delaunay(view->points, view->point_count, 0, NULL, NULL, NULL, &mesh, error);
    mw_mesh_destroy(mesh);
    return status;
}

/* Laid out along a curve, from points that are not packed. */
static mw_status layout_job(const mw_arrays *view, mw_error *error)
{
    mw_mesh *mesh;
    mw_arrays wide = *view;
    wide.points = __real_calloc(view->point_count, 3 * sizeof(double));
    wide.point_stride = 3;
    for (size_t i = 0; i < view->point_count; i++)
        memcpy((double *)wide.points + 3 * i, view->points + 2 * i, 2 * sizeof(double));
    mw_status status = mw_mesh_create(
        &wide, &(mw_mesh_options){.layout = MW_LAYOUT_HILBERT, .threads = 1}, &mesh, error);
    mw_mesh_destroy(mesh);
    free((double *)wide.points);
    return status;
}

/* Let allocation 0, 1, 2, ... of the job fail until it gets through. */
static void exhaust(mesh_job *run, const arrays *a)
{
    mw_arrays view = arrays_view(a);
    long failures = 0;
    for (;; failures++) {
        mw_error error = {0};
        allocations_left = failures;
        mw_status status = run(&view, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        if (!failed) {
            assert_int_equal(status, MW_OK);
            break;
        }
        assert_int_equal(status, MW_ERROR_MEMORY);
        assert_int_equal(error.status, MW_ERROR_MEMORY);
        assert_string_equal(error.message, "out of memory");
    }
    assert_true(failures > 3);
}

static void exhaust_all(arrays *a)
{
    exhaust(check_job, a);
    exhaust(mend_job, a);
    exhaust(describe_job, a);
    exhaust(tile_job, a);
    exhaust(locator_job, a);
    exhaust(open_job, a);
    exhaust(batch_job, a);
    exhaust(order_job, a);
    exhaust(delaunay_job, a);
    arrays_free(a);
}

static void test_convex(void **state)
{
    (void)state;
    uint64_t random = 1;
    arrays a = arrays_grid(6, 0.4, &random);
    exhaust_all(&a);
}

static void test_punched(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int sparse = 0; sparse < 2; sparse++) { /* sparse: several pieces */
        arrays a = arrays_grid(9, 0.4, &random);
        arrays_punch(&a, sparse ? 0.75 : 0.3, &random);
        exhaust_all(&a);
    }
}

/* A vertex inside an edge, joined by a flat triangle. */
static void test_cut(void **state)
{
    (void)state;
    arrays a = arrays_make(6, 3);
    const double p[6][2] = {{0, 0}, {4, 0}, {2, 0}, {2, 3}, {1, -3}, {3, -3}};
    for (int i = 0; i < 6; i++) arrays_point(&a, p[i][0], p[i][1]);
    arrays_triangle(&a, 0, 1, 3);
    arrays_triangle(&a, 2, 4, 5);
    arrays_triangle(&a, 0, 2, 1);
    exhaust_all(&a);
}

/* Defects of every kind but numbers out of range, which make no mesh. */
static void test_defective(void **state)
{
    (void)state;
    uint64_t random = 3;
    arrays a = arrays_grid(6, 0, &random);
    for (uint32_t i = 0; i < a.point_count; i++) a.points[2 * i] += i % 5 == 0 ? 2.3 : 0;
    arrays b = arrays_make(a.point_count, a.triangle_count + 3);
    for (uint32_t i = 0; i < a.point_count; i++)
        arrays_point(&b, a.points[2 * i], a.points[2 * i + 1]);
    for (uint32_t i = 0; i < a.triangle_count; i++)
        arrays_triangle(&b, a.triangles[3 * i], a.triangles[3 * i + 1], a.triangles[3 * i + 2]);
    for (uint32_t i = 0; i < 3; i++) arrays_triangle(&b, i, i, 20);
    arrays_free(&a);
    exhaust_all(&b);
}

static void test_bad_index(void **state)
{
    (void)state;
    uint64_t random = 4;
    arrays a = arrays_grid(4, 0, &random);
    a.triangles[7] = 1000;
    exhaust(check_job, &a);
    arrays_free(&a);
}

/* In several parts, with a fold in one of them. */
static void test_layout(void **state)
{
    (void)state;
    uint64_t random = 6;
    arrays a = arrays_grid(80, 0, &random);
    a.points[2 * 999] += 5;
    exhaust(layout_job, &a);
    arrays_free(&a);
}

/* A field that could not be stored is not there, and those before it are. */
static void test_fields(void **state)
{
    (void)state;
    uint64_t random = 5;
    arrays a = arrays_grid(2, 0, &random);
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    assert_int_equal(mw_mesh_set_field(mesh, "first", a.points, 1, NULL), MW_OK);
    for (long k = 0; k < 3; k++) {
        allocations_left = k;
        mw_status status = mw_mesh_set_field(mesh, "second", a.points, 1, NULL);
        allocations_left = -1;
        assert_int_equal(status, MW_ERROR_MEMORY);
        assert_int_equal(mw_mesh_field_count(mesh), 1);
        assert_null(mw_mesh_field(mesh, "second"));
        assert_true(mw_mesh_field(mesh, "first")[2] == a.points[2]);
    }
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Walks are long: the locator takes chains for its guide. */
static void test_chains(void **state)
{
    (void)state;
    enum { STEPS = 300 };
    arrays a = arrays_make(2 * STEPS + 2, 2 * STEPS);
    for (int i = 0; i <= STEPS; i++)
        for (int y = 0; y < 2; y++) arrays_point(&a, ldexp(1, 900 - 6 * i), y);
    for (uint32_t i = 0; i < 2 * STEPS; i += 2) {
        arrays_triangle(&a, i, i + 1, i + 2);
        arrays_triangle(&a, i + 2, i + 1, i + 3);
    }
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    assert_int_equal(info.guide, MW_START_CHAINS);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    exhaust(locator_job, &a);
    exhaust(batch_job, &a);
    arrays_free(&a);
}

/* Points that are triangulated as a copy, multiplied by a power of two. */
static void test_tiny(void **state)
{
    (void)state;
    static const double extent[] = {5e-324, 1e-300, 1e300};
    uint64_t random = 3;
    for (size_t i = 0; i < sizeof extent / sizeof *extent; i++) {
        arrays a = arrays_grid(6, 0, &random);
        arrays_transform(&a, extent[i], 0, 0);
        exhaust(delaunay_job, &a);
        exhaust(locator_job, &a);
        arrays_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_convex),    cmocka_unit_test(test_punched),
        cmocka_unit_test(test_cut),       cmocka_unit_test(test_defective),
        cmocka_unit_test(test_bad_index), cmocka_unit_test(test_layout),
        cmocka_unit_test(test_fields),    cmocka_unit_test(test_chains),
        cmocka_unit_test(test_tiny),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
