/* test_operator_memory.c - every allocation of an operator's calls fails once: the call says so,
 * and leaves nothing (leaks show in a build with the address sanitizer). */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/allocations.h"
#include "support/meshes.h"

#include <meshwalk/operator.h>

enum { POINTS = 64 };

typedef mw_status operator_job(const mw_mesh *mesh, const mw_location *at, mw_operator **out,
                               mw_error *error);

static mw_status job_locations(const mw_mesh *mesh, const mw_location *at, mw_operator **out,
                               mw_error *error)
{
    return mw_operator_create(mesh, at, POINTS, NULL, out, error);
}

/* Five entries in each row, in an order that has to be mended. */
static mw_status job_entries(const mw_mesh *mesh, const mw_location *at, mw_operator **out,
                             mw_error *error)
{
    uint32_t row[5 * POINTS], column[5 * POINTS];
    double weight[5 * POINTS];
    (void)at;
    for (uint32_t i = 0; i < 5 * POINTS; i++) {
        row[i] = i / 5;
        column[i] = i * 7919 % 60000;
        weight[i] = 1;
    }
    mw_operator_entries entries = {row, column, weight, 5 * POINTS, POINTS, 60000, 0};
    (void)mesh;
    return mw_operator_create_from_entries(&entries, NULL, out, error);
}

static mw_status job_transpose(const mw_mesh *mesh, const mw_location *at, mw_operator **out,
                               mw_error *error)
{
    mw_operator *weights;
    *out = NULL;
    mw_status status = mw_operator_create(mesh, at, POINTS, NULL, &weights, error);
    if (!status) status = mw_operator_transpose(weights, NULL, out, error);
    mw_operator_destroy(weights);
    return status;
}

static mw_status job_surface(const mw_mesh *mesh, const mw_location *at, mw_operator **out,
                             mw_error *error)
{
    static const double points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint32_t corners[3] = {0, 1, 2};
    const mw_arrays view = {
        .points = points, .point_count = 3, .triangles = corners, .triangle_count = 1};
    const mw_touch touch = {.weight = {1, 0, 0}};
    const mw_hits hits = mw_hits_of_touches(&touch, 1);
    mw_surface *surface;
    (void)mesh;
    (void)at;
    *out = NULL;
    mw_status status = mw_surface_create(&view, NULL, &surface, error);
    if (!status) status = mw_operator_create_on_surface(surface, &hits, NULL, out, error);
    mw_surface_destroy(surface);
    return status;
}

static void test_every_allocation(void **state)
{
    static operator_job *const jobs[] = {job_locations, job_entries, job_transpose, job_surface};
    uint64_t random = 7;
    arrays a = arrays_grid(60, 0.3, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_location at[POINTS];
    (void)state;
    for (uint32_t i = 0; i < POINTS; i++)
        at[i] = (mw_location){.weight = {0.5, 0.25, 0.25},
                              .triangle = i * 911 % mw_mesh_triangle_count(mesh)};
    for (size_t j = 0; j < sizeof jobs / sizeof *jobs; j++) {
        long k = 0;
        for (mw_status status = MW_ERROR_MEMORY; status; k++) {
            mw_operator *out = NULL;
            mw_error error;
            allocations_left = k;
            status = jobs[j](mesh, at, &out, &error);
            allocations_left = -1;
            assert_true(status == MW_OK || status == MW_ERROR_MEMORY);
            assert_true(!status == (out != NULL));
            mw_operator_destroy(out);
        }
        assert_true(k > 3);
    }
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_allocation)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
