/* test_memory.c - allocation number k fails, for every k: each call says so, leaks nothing, and leaves nothing behind. */
/* wrap: malloc calloc realloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "memory.h"
#include "meshes.h"

typedef mw_status (*attempt)(const void *subject, mw_error *error);

/* Let allocation 0, 1, 2, ... fail until the attempt succeeds. */
static void exhaust(attempt attempted, const void *subject)
{
    mw_status status = MW_ERROR_MEMORY;
    for (long k = 0; status; k++) {
        mw_error error = {0};
        allocations_left = k;
        status = attempted(subject, &error);
        allocations_left = -1;
        if (!status) {
            assert_true(k > 0); /* it does allocate */
            continue;
        }
        assert_int_equal(status, MW_ERROR_MEMORY);
        assert_int_equal(error.status, MW_ERROR_MEMORY);
        assert_true(k < 10000);
    }
}

static mw_status try_mesh(const void *subject, mw_error *error)
{
    mw_mesh *mesh;
    mw_status status = mw_mesh_create(subject, NULL, &mesh, error);
    if (status) assert_null(mesh);
    mw_mesh_destroy(mesh);
    return status;
}

static mw_status try_check(const void *subject, mw_error *error)
{
    mw_check check;
    mw_status status = mw_check_arrays(subject, &check, error);
    if (!status) mw_check_release(&check);
    return status;
}

static mw_status try_describe(const void *subject, mw_error *error)
{
    mw_mesh_info info;
    return mw_mesh_describe(subject, &info, error);
}

static mw_status try_order(const void *subject, mw_error *error)
{
    static uint32_t vertices[1000];
    return mw_mesh_hilbert_order(subject, NULL, vertices, error);
}

static mw_status try_locator(const void *subject, mw_error *error)
{
    mw_locator *locator;
    mw_locator_options options = {.layout = 1, .border = 1};
    mw_status status = mw_locator_create(subject, &options, &locator, error);
    if (status) assert_null(locator);
    mw_locator_destroy(locator);
    return status;
}

static mw_status try_any_locator(const void *subject, mw_error *error)
{
    mw_locator *locator;
    mw_locator_options options = {.any = 1};
    mw_status status = mw_locator_create(subject, &options, &locator, error);
    mw_locator_destroy(locator);
    return status;
}

static mw_status try_batch(const void *subject, mw_error *error)
{
    static double q[400];
    static mw_location at[200];
    return mw_locate_batch(subject, q, 200, 2, NULL, at, NULL, error);
}

static void try_all(const arrays *a)
{
    mw_arrays view = arrays_view(a);
    mw_mesh *mesh;
    mw_locator *locator;
    exhaust(try_mesh, &view);
    exhaust(try_check, &view);
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    exhaust(try_describe, mesh);
    exhaust(try_order, mesh);
    exhaust(try_locator, mesh);
    assert_int_equal(mw_locator_create(mesh, NULL, &locator, NULL), MW_OK);
    exhaust(try_batch, locator);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

static void test_convex(void **state)
{
    (void)state;
    uint64_t random = 1;
    arrays a = grid_mesh(6, 0.3, &random);
    try_all(&a);
    arrays_free(&a);
}

static void test_holes(void **state)
{
    (void)state;
    uint64_t random = 2;
    arrays a = grid_mesh(9, 0.3, &random);
    punch(&a, 0.2, &random);
    try_all(&a);
    arrays_free(&a);
}

static void test_no_embedding(void **state)
{
    (void)state;
    uint64_t random = 3;
    arrays a = grid_mesh(6, 0, &random);
    a.points[2 * 24] += 2; /* an inner vertex beyond its neighbours: folds */
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    exhaust(try_check, &view);
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    exhaust(try_any_locator, mesh);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* A field that could not be stored is not there, and those before it are. */
static void test_fields(void **state)
{
    (void)state;
    uint64_t random = 4;
    arrays a = grid_mesh(2, 0, &random);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_convex),
        cmocka_unit_test(test_holes),
        cmocka_unit_test(test_no_embedding),
        cmocka_unit_test(test_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
