/* test_border.c - the nearest border edge, and points near the mesh, against all edges in
 * rationals. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "support/meshes.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

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
static void nearest_by_force(const arrays *a, const mw_mesh *mesh, const double q[2], mpq_t least,
                             uint32_t *triangle, uint32_t *edge)
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

/* |v - want| <= tolerance, and a rounding of the smallest doubles. An infinite v is for what is
 * above the doubles. */
static bool close_to(double v, const mpf_t want, const mpf_t tolerance)
{
    mpf_t off, most;
    mpf_init_set_d(off, isinf(v) ? DBL_MAX : v);
    mpf_init_set_d(most, DBL_TRUE_MIN);
    bool infinite = isinf(v) && mpf_cmp(want, off) > 0;
    mpf_sub(off, off, want);
    mpf_abs(off, off);
    mpf_add(most, most, tolerance);
    bool is = !isnan(v) && (infinite || (!isinf(v) && mpf_cmp(off, most) <= 0));
    mpf_clears(off, most, NULL);
    return is;
}

/* Is the hit's point as far from q as the edge is, up to a rounding of the coordinates? */
static bool foot_is_right(const mw_nearest_border_point *hit, const double q[2], const double a[2],
                          const double b[2], const mpf_t want)
{
    for (int k = 0; k < 2; k++)
        if (!(hit->point[k] >= fmin(a[k], b[k]) && hit->point[k] <= fmax(a[k], b[k]))) return false;
    mpf_t d, off, tolerance;
    mpf_inits(d, off, tolerance, NULL);
    for (int k = 0; k < 2; k++) {
        mpf_set_d(off, hit->point[k]);
        mpf_set_d(tolerance, q[k]);
        mpf_sub(off, off, tolerance);
        mpf_mul(off, off, off);
        mpf_add(d, d, off);
    }
    mpf_sqrt(d, d);
    mpf_set(tolerance, want);
    for (int k = 0; k < 2; k++) {
        mpf_set_d(off, fmax(fabs(q[k]), fmax(fabs(a[k]), fabs(b[k]))));
        mpf_add(tolerance, tolerance, off);
    }
    mpf_div_2exp(tolerance, tolerance, 49);
    mpf_set_d(off, 4 * DBL_TRUE_MIN);
    mpf_add(tolerance, tolerance, off);
    mpf_sub(d, d, want);
    mpf_abs(d, d);
    bool is = mpf_cmp(d, tolerance) <= 0;
    mpf_clears(d, off, tolerance, NULL);
    return is;
}

/* r = (b - a) . (d - c), in rationals. */
static void scalar_product(mpq_t r, const double a[2], const double b[2], const double c[2],
                           const double d[2])
{
    mpq_t x, y, z;
    mpq_inits(x, y, z, NULL);
    mpq_set_ui(r, 0, 1);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(x, b[k]);
        mpq_set_d(z, a[k]);
        mpq_sub(x, x, z);
        mpq_set_d(y, d[k]);
        mpq_set_d(z, c[k]);
        mpq_sub(y, y, z);
        mpq_mul(x, x, y);
        mpq_add(r, r, x);
    }
    mpq_clears(x, y, z, NULL);
}

/* The weights divide edge uv as the projection of q does, up to rounding in proportion to how far
 * off q is. */
static bool weights_are_right(const mw_nearest_border_point *hit, const double q[2],
                              const double u[2], const double v[2])
{
    mpq_t along, length;
    mpq_inits(along, length, NULL);
    scalar_product(along, u, v, u, q);
    scalar_product(length, u, v, u, v);
    mpq_div(along, along, length);
    double share = fmin(fmax(mpq_get_d(along), 0), 1);
    scalar_product(along, u, q, u, q);
    mpq_div(along, along, length);
    double off = 0x1p-48 * (1 + sqrt(mpq_get_d(along)));
    mpq_clears(along, length, NULL);
    const double *w = hit->weight;
    uint32_t next = (hit->edge + 1) % 3;
    return fabs(w[next] - share) <= off && fabs(w[hit->edge] + w[next] - 1) <= 0x1p-50 &&
           w[(hit->edge + 2) % 3] == 0;
}

static void compare(const arrays *a, const mw_mesh *mesh, const mw_locator *locator,
                    const double q[2])
{
    mpq_t least;
    mpf_t want, tolerance;
    mpq_init(least);
    mpf_init2(want, 256);
    mpf_init2(tolerance, 256);
    uint32_t triangle, edge = 3;
    nearest_by_force(a, mesh, q, least, &triangle, &edge);
    mpf_set_q(want, least);
    mpf_sqrt(want, want);
    mpf_div_2exp(tolerance, want, 49);
    mw_nearest_border_point hit;
    assert_int_equal(mw_nearest_border(locator, q[0], q[1], &hit, NULL), MW_OK);
    if (hit.triangle != triangle || hit.edge != edge)
        fail_msg("(%.17g, %.17g): triangle %u edge %u, not %u %u", q[0], q[1], hit.triangle,
                 hit.edge, triangle, edge);
    if (!close_to(hit.distance, want, tolerance))
        fail_msg("(%.17g, %.17g): distance %.17g, not %.17g", q[0], q[1], hit.distance,
                 mpf_get_d(want));
    const uint32_t *v = a->triangles + 3 * (size_t)triangle;
    if (!foot_is_right(&hit, q, a->points + 2 * (size_t)v[edge],
                       a->points + 2 * (size_t)v[(edge + 1) % 3], want))
        fail_msg("(%.17g, %.17g): nearest is (%.17g, %.17g)?", q[0], q[1], hit.point[0],
                 hit.point[1]);
    if (!weights_are_right(&hit, q, a->points + 2 * (size_t)v[edge],
                           a->points + 2 * (size_t)v[(edge + 1) % 3]))
        fail_msg("(%.17g, %.17g): weights %.17g %.17g %.17g?", q[0], q[1], hit.weight[0],
                 hit.weight[1], hit.weight[2]);
    mpf_clears(want, tolerance, NULL);
    mpq_clear(least);
}

static void test_nearest(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 12; round++) {
        arrays a = arrays_grid(2 + (uint32_t)round / 2, round % 2 ? 0.4 : 0, &random);
        arrays_punch(&a, 0.08 * (round % 5), &random);
        arrays_scramble(&a, round % 3 == 0, &random);
        if (round % 4 == 3) arrays_transform(&a, 1, 5e6, 5e6);
        mw_arrays view = arrays_view(&a);
        mw_mesh *mesh;
        assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
        mw_locator *locator = locator_of(mesh);
        size_t n;
        double *q = arrays_queries(&a, 25, &n, &random);
        for (size_t i = 0; i < n; i++) compare(&a, mesh, locator, q + 2 * i);
        free(q);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* A mesh about the origin, at most as large as the doubles go at scale 1.5e308. */
static arrays scaled_mesh(double sx, double sy, uint64_t *random)
{
    arrays a = arrays_grid(4, mw__random(random) >> 63 ? 0.4 : 0, random);
    arrays_punch(&a, 0.2, random);
    arrays_scramble(&a, 1, random);
    for (uint32_t i = 0; i < a.point_count; i++) {
        a.points[2 * i] = (a.points[2 * i] / 2 - 1) * sx;
        a.points[2 * i + 1] = (a.points[2 * i + 1] / 2 - 1) * sy;
    }
    return a;
}

static void compare_scaled(double sx, double sy, uint64_t *random)
{
    arrays a = scaled_mesh(sx, sy, random);
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    mw_locator *locator = locator_of(mesh);
    size_t n;
    double *q = arrays_queries(&a, 12, &n, random);
    for (size_t i = 0; i < 2 * n; i++) /* some are beyond the doubles */
        if (!isfinite(q[i])) q[i] = (2 * random_unit(random) - 1) * DBL_MAX;
    for (size_t i = 0; i < n; i++) compare(&a, mesh, locator, q + 2 * i);
    const double corners[] = {DBL_MAX, DBL_MAX, -DBL_MAX, DBL_MAX, 0, 0, DBL_TRUE_MIN, 0, 1, 1};
    for (size_t i = 0; i < 5; i++) compare(&a, mesh, locator, corners + 2 * i);
    free(q);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Where squares, areas or even differences leave the range of doubles; the same in x and y, or
 * not. */
static void test_scales(void **state)
{
    (void)state;
    static const double scale[] = {1e100, 1e-100, 1e120,     1e-120,  1e155, 1e-155,
                                   1e160, 1e-160, 1e200,     1e-200,  1e290, 1e-290,
                                   1e300, 1e-300, 0x1p-1060, 1.5e308, 1};
    enum { SCALES = sizeof scale / sizeof *scale };
    uint64_t random = 4;
    for (int i = 0; i < SCALES; i++) {
        for (int round = 0; round < 4; round++) compare_scaled(scale[i], scale[i], &random);
        compare_scaled(scale[i], scale[mw__random_below(&random, SCALES)], &random);
    }
}

/* One triangle, as wide as the doubles allow. */
static void test_widest(void **state)
{
    (void)state;
    arrays a = arrays_make(3, 1);
    arrays_point(&a, -1.5e308, 0);
    arrays_point(&a, 1.5e308, 0);
    arrays_point(&a, 0, 1e308);
    arrays_triangle(&a, 0, 1, 2);
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    mw_locator *locator = locator_of(mesh);
    const double q[] = {0,     -1e307,  0,        1e307, 1e308, -1e-300, -1e308,
                        1e308, 1.5e308, -1.5e308, 0.5,   1,     0,       DBL_TRUE_MIN};
    for (size_t i = 0; i < sizeof q / sizeof *q; i += 2) compare(&a, mesh, locator, q + i);
    mw_nearest_border_point hit;
    assert_int_equal(mw_nearest_border(locator, 3e307, -1e307, &hit, NULL), MW_OK);
    assert_true(hit.edge == 0 && hit.distance == 1e307 && hit.point[1] == 0);
    assert_true(fabs(hit.point[0] - 3e307) < 1e293);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* The tolerance of tiny meshes: half a unit from the border of a hole, then just beyond. */
static void test_near_tiny(void **state)
{
    (void)state;
    static const double units[] = {1e-155, 1e-203, 1e-290, 0x1p-1060};
    for (int i = 0; i < 4; i++) {
        double unit = units[i];
        arrays a = arrays_make(8, 8);
        for (int ring = 0; ring < 2; ring++)
            for (int k = 0; k < 4; k++) {
                double r = (ring ? 4 : 12) * unit;
                arrays_point(&a, k == 1 || k == 2 ? r : -r, k >= 2 ? r : -r);
            }
        for (uint32_t k = 0; k < 4; k++) {
            arrays_triangle(&a, k, (k + 1) % 4, 4 + k);
            arrays_triangle(&a, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k);
        }
        mw_arrays view = arrays_view(&a);
        mw_mesh *mesh;
        assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
        mw_locator *locator = locator_of(mesh);
        const double q[] = {3.5 * unit, unit, unit, -2 * unit, 12.5 * unit, 0, 14 * unit, 0};
        const mw_where want[] = {MW_NEAR, MW_IN_HOLE, MW_NEAR, MW_OUTSIDE};
        const mw_query_options options = {.tolerance = 0.6 * unit};
        mw_location at[4];
        assert_int_equal(mw_locate_batch(locator, q, 4, 2, &options, at, NULL, NULL), MW_OK);
        for (int k = 0; k < 4; k++) {
            assert_int_equal(at[k].where, want[k]);
            compare(&a, mesh, locator, q + (size_t)2 * (size_t)k);
        }
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
    arrays a = arrays_grid(4, 0, &random);
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
            const double *p =
                a.points + 2 * (size_t)a.triangles[3 * (size_t)at[i].triangle + (size_t)k];
            x += at[i].weight[k] * p[0];
            y += at[i].weight[k] * p[1];
        }
        assert_true(fabs(x - fmin(fmax(q[2 * i], 0), 4)) < 1e-15 &&
                    fabs(y - fmin(fmax(q[2 * i + 1], 0), 4)) < 1e-15);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

static void test_arguments(void **state)
{
    (void)state;
    uint64_t random = 3;
    arrays a = arrays_grid(2, 0, &random);
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    mw_locator *locator;
    mw_nearest_border_point hit;
    mw_cursor cursor;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    assert_int_equal(mw_locator_create(mesh, NULL, &locator, NULL), MW_OK);
    /* no index */
    assert_int_equal(mw_nearest_border(locator, 0, 0, &hit, NULL), MW_ERROR_ARGUMENT);
    const double wrong[] = {1, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        mw_query_options options = {.tolerance = wrong[i]};
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_ERROR_ARGUMENT);
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

/* Every border edge of a punched lattice has, next to its middle, a point of the hole or pocket
 * beyond it. So the lowest edge of each hole is found by force. */
static void test_holes(void **state)
{
    (void)state;
    uint64_t random = 20261128;
    for (int round = 0; round < 20; round++) {
        arrays a = arrays_grid(12, 0, &random);
        arrays_punch(&a, round * 0.04, &random);
        arrays_scramble(&a, round % 2, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){.threads = 1});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.fill = MW_FILL_YES});
        mw_locator_info info;
        mw_cursor cursor = {0};
        mw_hole_edge *edges = calloc(a.triangle_count, sizeof *edges);
        mw_hole_edge *force = malloc(a.triangle_count * sizeof *force);
        memset(force, 255, a.triangle_count * sizeof *force);
        mw_locator_describe(locator, &info);
        assert_int_equal(mw_locator_holes(locator, edges, NULL), MW_OK);
        uint32_t seen = 0;
        for (uint32_t t = 0; t < a.triangle_count; t++)
            for (unsigned k = 0; k < 3; k++) {
                if (mw_mesh_neighbour(mesh, t, k, NULL) != MW_NONE) continue;
                const uint32_t *v = a.triangles + 3 * (size_t)t;
                const double *p = a.points + 2 * (size_t)v[k],
                             *q = a.points + 2 * (size_t)v[(k + 1) % 3],
                             *r = a.points + 2 * (size_t)v[(k + 2) % 3];
                const double x = (p[0] + q[0]) / 2, y = (p[1] + q[1]) / 2;
                const mw_location beyond =
                    mw_locate(locator, &cursor, x + (x - r[0]) / 64, y + (y - r[1]) / 64);
                if (beyond.hole == MW_NONE || force[beyond.hole].triangle != MW_NONE) continue;
                force[beyond.hole] = (mw_hole_edge){t, k};
                seen++;
            }
        assert_int_equal(seen, info.holes);
        assert_memory_equal(edges, force, info.holes * sizeof *edges);
        free(force);
        free(edges);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

static void test_holes_arguments(void **state)
{
    (void)state;
    uint64_t random = 7;
    mw_mesh *mesh = mesh_with_hole(9, &random);
    mw_locator *open = mesh_locator(mesh, (mw_locator_options){.fill = MW_FILL_NO});
    mw_locator *filled = mesh_locator(mesh, (mw_locator_options){.fill = MW_FILL_YES});
    mw_hole_edge edge;
    mw_error error;
    assert_int_equal(mw_locator_holes(NULL, &edge, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_locator_holes(filled, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_locator_holes(open, &edge, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_locator_holes(filled, &edge, &error), MW_OK);
    mw_locator_destroy(open);
    mw_locator_destroy(filled);
    mw_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nearest),   cmocka_unit_test(test_scales),
        cmocka_unit_test(test_widest),    cmocka_unit_test(test_near),
        cmocka_unit_test(test_near_tiny), cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_holes),     cmocka_unit_test(test_holes_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
