/* test_border.c - the nearest border edge, and points near the mesh, against all edges in rationals. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "meshes.h"
#include "oracle.h"

#include <stdio.h>

/* Squared distance from q to the segment ab, in rationals. */
static void distance2(mpq_t result, const double a[2], const double b[2], const double q[2])
{
    mpq_t u[2], w[2], dot, length, t;
    mpq_inits(u[0], u[1], w[0], w[1], dot, length, t, NULL);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(u[k], b[k]);
        mpq_set_d(t, a[k]);
        mpq_sub(u[k], u[k], t);
        mpq_set_d(w[k], q[k]);
        mpq_sub(w[k], w[k], t);
    }
    for (int k = 0; k < 2; k++) {
        mpq_mul(t, u[k], w[k]);
        mpq_add(dot, dot, t);
        mpq_mul(t, u[k], u[k]);
        mpq_add(length, length, t);
    }
    mpq_div(t, dot, length);
    if (mpq_sgn(t) < 0) mpq_set_ui(t, 0, 1);
    if (mpq_cmp_ui(t, 1, 1) > 0) mpq_set_ui(t, 1, 1);
    mpq_set_ui(result, 0, 1);
    for (int k = 0; k < 2; k++) {
        mpq_mul(dot, t, u[k]);
        mpq_sub(dot, dot, w[k]);
        mpq_mul(dot, dot, dot);
        mpq_add(result, result, dot);
    }
    mpq_clears(u[0], u[1], w[0], w[1], dot, length, t, NULL);
}

/* The first triangle and edge, in order, of those border edges at the least distance. */
static void nearest_by_force(const arrays *a, const mw_mesh *mesh, const double q[2], mpq_t least, uint32_t *triangle,
                             uint32_t *edge)
{
    mpq_t d;
    mpq_init(d);
    *triangle = MW_NONE;
    for (uint32_t t = 0; t < a->triangle_count; t++)
        for (unsigned k = 0; k < 3; k++) {
            if (mw_mesh_neighbour(mesh, t, k, NULL) != MW_NONE) continue;
            const uint32_t *v = a->triangles + 3 * (size_t)t;
            distance2(d, a->points + 2 * (size_t)v[k], a->points + 2 * (size_t)v[(k + 1) % 3], q);
            if (*triangle != MW_NONE && mpq_cmp(d, least) >= 0) continue;
            mpq_set(least, d);
            *triangle = t;
            *edge = k;
        }
    mpq_clear(d);
}

static mw_locator *locator_of(const mw_mesh *mesh)
{
    mw_locator_options options = {.border = 1};
    mw_locator *locator;
    mw_error error;
    if (mw_locator_create(mesh, &options, &locator, &error)) fail_msg("locator: %s", error.message);
    return locator;
}

static void compare(const arrays *a, const mw_mesh *mesh, const mw_locator *locator, const double q[2])
{
    mpq_t least;
    mpq_init(least);
    uint32_t triangle, edge = 3;
    nearest_by_force(a, mesh, q, least, &triangle, &edge);
    mw_border_hit hit;
    assert_int_equal(mw_nearest_border(locator, q[0], q[1], &hit, NULL), MW_OK);
    if (hit.triangle != triangle || hit.edge != edge)
        fail_msg("(%.17g, %.17g): triangle %u edge %u, not %u %u", q[0], q[1], hit.triangle, hit.edge, triangle, edge);
    double want = sqrt(mpq_get_d(least)), off = hypot(hit.point[0] - q[0], hit.point[1] - q[1]);
    if (!(fabs(hit.distance - want) <= 1e-14 * want + 1e-160)) /* squares below that underflow */
        fail_msg("(%.17g, %.17g): distance %.17g, not %.17g", q[0], q[1], hit.distance, want);
    assert_true(fabs(off - want) <= 1e-13 * (want + fabs(q[0]) + fabs(q[1]) + 10));
    mpq_clear(least);
}

static void test_nearest(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 12; round++) {
        arrays a = grid_mesh(2 + (uint32_t)round / 2, round % 2 ? 0.4 : 0, &random);
        punch(&a, 0.08 * (round % 5), &random);
        scramble(&a, round % 3 == 0, &random);
        if (round % 4 == 3) transform(&a, 1, 5e6, 5e6);
        mw_arrays view = arrays_view(&a);
        mw_mesh *mesh;
        assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
        mw_locator *locator = locator_of(mesh);
        size_t n;
        double *q = nasty_queries(&a, 25, &n, &random);
        for (size_t i = 0; i < n; i++) compare(&a, mesh, locator, q + 2 * i);
        free(q);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* Within the tolerance, exactly at it, and beyond it. */
static void test_near(void **state)
{
    (void)state;
    uint64_t random = 2;
    arrays a = grid_mesh(4, 0, &random);
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    mw_locator *locator = locator_of(mesh);
    mw_query_options options = {.tolerance = 0.5};
    const double q[] = {-0.5, 1.25, nextafter(-0.5, -1), 1.25, -0.25, -0.25, 2.5, 4.5, 5, 5, 1, 1};
    const mw_where want[] = {MW_NEAR, MW_OUTSIDE, MW_NEAR, MW_NEAR, MW_OUTSIDE, MW_ON_VERTEX};
    mw_location at[6];
    assert_int_equal(mw_locate_batch(locator, q, 6, 2, &options, at, NULL, NULL), MW_OK);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(at[i].where, want[i]);
        if (want[i] == MW_OUTSIDE) continue;
        double x = 0, y = 0; /* the weights are those of the nearest point of the square */
        for (int k = 0; k < 3; k++) {
            const double *p = a.points + 2 * (size_t)a.triangles[3 * (size_t)at[i].triangle + (size_t)k];
            x += at[i].weight[k] * p[0];
            y += at[i].weight[k] * p[1];
        }
        assert_true(fabs(x - fmin(fmax(q[2 * i], 0), 4)) < 1e-15 && fabs(y - fmin(fmax(q[2 * i + 1], 0), 4)) < 1e-15);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

static void test_arguments(void **state)
{
    (void)state;
    uint64_t random = 3;
    arrays a = grid_mesh(2, 0, &random);
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    mw_locator *locator;
    mw_border_hit hit;
    mw_cursor cursor;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    assert_int_equal(mw_locator_create(mesh, NULL, &locator, NULL), MW_OK);
    assert_int_equal(mw_nearest_border(locator, 0, 0, &hit, NULL), MW_ERROR_ARGUMENT); /* no index */
    const double wrong[] = {1, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        mw_query_options options = {.tolerance = wrong[i]};
        assert_int_equal(mw_cursor_init(&cursor, locator, &options, NULL), MW_ERROR_ARGUMENT);
    }
    mw_locator_destroy(locator);
    locator = locator_of(mesh);
    assert_int_equal(mw_nearest_border(locator, NAN, 0, &hit, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_nearest_border(locator, 1e308, -1e308, &hit, NULL), MW_OK);
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    assert_true(info.border_bytes > 0 && info.border_bytes < info.bytes);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nearest),
        cmocka_unit_test(test_near),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
