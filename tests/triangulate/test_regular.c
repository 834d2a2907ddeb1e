/* test_regular.c - regular triangulations: no point lies below the plane of a triangle, each
 * lifted by its weight, in exact integers or rationals; the triangles fill the convex hull. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "predicates/power.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct weighted {
    double *points, *weights;
    uint32_t n;
} weighted;

static void weighted_free(weighted *w)
{
    free(w->points);
    free(w->weights);
}

/* On a grid of few places; x and y and weights are integers of the same size. */
static weighted weighted_lattice(uint32_t n, uint32_t side, int heaviest, uint64_t *random)
{
    weighted w = {malloc(2 * n * sizeof(double)), malloc(n * sizeof(double)), n};
    for (uint32_t i = 0; i < n; i++) {
        w.points[2 * i] = mw__random_below(random, side);
        w.points[2 * i + 1] = mw__random_below(random, side);
        w.weights[i] = (double)mw__random_below(random, (uint32_t)heaviest + 1) - heaviest / 2;
    }
    return w;
}

/* --- the oracle ------------------------------------------------------------------------------- */

/* The sign of the determinant of lifted points, in integers of 64 bits: coordinates and weights
 * are below 2^12. */
static int lattice_power(const weighted *w, const uint32_t *t, uint32_t d)
{
    int64_t x[3], y[3], z[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = (int64_t)(w->points[2 * t[i]] - w->points[2 * d]);
        y[i] = (int64_t)(w->points[2 * t[i] + 1] - w->points[2 * d + 1]);
        z[i] = x[i] * x[i] + y[i] * y[i] - (int64_t)w->weights[t[i]] + (int64_t)w->weights[d];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += z[i] * (x[j] * y[k] - x[k] * y[j]);
    }
    return (sum > 0) - (sum < 0);
}

static int64_t lattice_turn(const weighted *w, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = w->points;
    return (int64_t)((p[2 * b] - p[2 * a]) * (p[2 * c + 1] - p[2 * a + 1]) -
                     (p[2 * c] - p[2 * a]) * (p[2 * b + 1] - p[2 * a + 1]));
}

static bool lattice_contains(const weighted *w, const uint32_t *t, uint32_t d)
{
    for (int k = 0; k < 3; k++)
        if (lattice_turn(w, t[k], t[(k + 1) % 3], d) < 0) return false;
    return true;
}

/* No point below any triangle; each in one, so that the triangles fill the hull, as the mesh is
 * convex and an embedding. */
static void expect_regular(const weighted *w, const mw_mesh *mesh)
{
    mw_mesh_info info;
    assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
    assert_true(info.embedding && info.convex && info.oriented && info.flat_triangles == 0);
    bool *covered = calloc(w->n, sizeof *covered);
    for (uint32_t i = 0; i < mw_mesh_triangle_count(mesh); i++) {
        uint32_t t[3];
        mw_mesh_triangle(mesh, i, t);
        assert_true(lattice_turn(w, t[0], t[1], t[2]) > 0);
        for (uint32_t d = 0; d < w->n; d++) {
            assert_true(lattice_power(w, t, d) <= 0);
            covered[d] = covered[d] || lattice_contains(w, t, d);
        }
    }
    for (uint32_t d = 0; d < w->n; d++) assert_true(covered[d]);
    free(covered);
}

/* Points that are the heaviest of their place, and the lowest of these: one of each place. */
static uint32_t count_places(const weighted *w, bool *first)
{
    uint32_t places = 0;
    for (uint32_t i = 0; i < w->n; i++) {
        bool known = false;
        first[i] = true;
        for (uint32_t k = 0; k < w->n; k++) {
            if (k == i || memcmp(w->points + 2 * i, w->points + 2 * k, 2 * sizeof(double)) != 0)
                continue;
            known = known || k < i;
            if (w->weights[k] > w->weights[i] || (w->weights[k] == w->weights[i] && k < i))
                first[i] = false;
        }
        places += !known;
    }
    return places;
}

static void expect_told(const weighted *w, const mw_mesh *mesh, const uint8_t *hidden,
                        const mw_kind_report *report)
{
    uint32_t vertices = 0;
    bool *used = calloc(w->n, sizeof *used), *first = calloc(w->n, sizeof *first);
    for (uint32_t i = 0; i < mw_mesh_triangle_count(mesh); i++) {
        uint32_t t[3];
        mw_mesh_triangle(mesh, i, t);
        for (int k = 0; k < 3; k++) used[t[k]] = true;
    }
    uint32_t places = count_places(w, first);
    for (uint32_t i = 0; i < w->n; i++) {
        assert_int_equal(hidden[i], !used[i]);
        assert_true(first[i] || hidden[i]);
        vertices += used[i];
    }
    assert_int_equal(report->delaunay.duplicates, w->n - places);
    assert_int_equal(report->hidden, places - vertices);
    free(used);
    free(first);
}

/* --- tests ------------------------------------------------------------------------------------ */

static void lattices_are_regular(void **state)
{
    static const int heaviest[] = {0, 1, 4, 20, 200, 3000};
    uint64_t random = environment_print_seed("regular", 31);
    size_t hidden_sum = 0;
    (void)state;
    for (int round = 0; round < 240; round++) {
        uint32_t n = 4 + mw__random_below(&random, 60),
                 side = 2 + mw__random_below(&random, round % 2 ? 8 : 40);
        weighted w = weighted_lattice(n, side, heaviest[round % 6], &random);
        if (round % 5 == 4) /* on one plane, or hardly off it */
            for (uint32_t i = 0; i < n; i++)
                w.weights[i] = w.points[2 * i] * w.points[2 * i] +
                               w.points[2 * i + 1] * w.points[2 * i + 1] +
                               (round % 2 ? w.weights[i] / 8 - fmod(w.weights[i] / 8, 1) : 0);
        uint8_t *hidden = malloc(n);
        mw_kind_report report;
        mw_kind_options options = {.weights = w.weights, .hidden = hidden, .threads = 1};
        mw_mesh *mesh;
        mw_status status =
            mw_triangulate(MW_KIND_REGULAR, w.points, n, 2, &options, NULL, &report, &mesh, NULL);
        if (status == MW_OK) { /* else all points lie on a line */
            expect_regular(&w, mesh);
            expect_told(&w, mesh, hidden, &report);
            hidden_sum += report.hidden;
            mw_mesh_destroy(mesh);
        } else {
            assert_int_equal(status, MW_ERROR_INPUT);
        }
        free(hidden);
        weighted_free(&w);
    }
    assert_true(hidden_sum > 500);
}

/* Without weights, or with equal ones, it is a Delaunay triangulation. */
static void equal_weights_are_delaunay(void **state)
{
    enum { N = 400 };
    uint64_t random = environment_print_seed("regular", 32);
    double points[2 * N], weights[N];
    (void)state;
    for (int round = 0; round < 4; round++) {
        for (int i = 0; i < 2 * N; i++)
            points[i] = round % 2 ? floor(16 * random_unit(&random)) : random_unit(&random);
        for (int i = 0; i < N; i++) weights[i] = 7.25;
        mw_mesh *mesh;
        mw_kind_report report;
        mw_kind_options options = {.weights = round < 2 ? weights : NULL};
        assert_int_equal(
            mw_triangulate(MW_KIND_REGULAR, points, N, 0, &options, NULL, &report, &mesh, NULL),
            MW_OK);
        assert_int_equal(report.hidden, 0);
        mw_mesh_info info;
        assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
        assert_true(info.delaunay && info.convex);
        assert_int_equal(info.unused_vertices, report.delaunay.duplicates);
        mw_mesh_destroy(mesh);
    }
}

/* Many points, in doubles: across each edge the vertex is not below, which is enough where all
 * triangles fill the hull; and each hidden point is not below the triangle that contains it. */
static void many_points_are_regular(void **state)
{
    enum { N = 20000 };
    uint64_t random = environment_print_seed("regular", 33);
    double *points = malloc(2 * N * sizeof *points), *weights = malloc(N * sizeof *weights);
    uint8_t *hidden = malloc(N);
    mw_mesh *mesh;
    mw_kind_report report;
    (void)state;
    for (int i = 0; i < 2 * N; i++) points[i] = random_unit(&random);
    for (int i = 0; i < N; i++) weights[i] = 1e-4 * random_unit(&random);
    mw_kind_options options = {.weights = weights, .hidden = hidden};
    assert_int_equal(
        mw_triangulate(MW_KIND_REGULAR, points, N, 0, &options, NULL, &report, &mesh, NULL), MW_OK);
    assert_true(report.hidden > N / 20 && report.hidden < N);
    mw_mesh_info info;
    assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
    assert_true(info.convex && !info.delaunay);
    for (uint32_t i = 0; i < mw_mesh_triangle_count(mesh); i++) {
        uint32_t t[3], far[3];
        mw_weighted_point p[4];
        mw_mesh_triangle(mesh, i, t);
        for (int k = 0; k < 3; k++)
            p[k] = (mw_weighted_point){{points[2 * t[k]], points[2 * t[k] + 1]}, weights[t[k]]};
        for (unsigned k = 0; k < 3; k++) {
            unsigned edge;
            uint32_t across = mw_mesh_neighbour(mesh, i, k, &edge);
            if (across == MW_NONE) continue;
            mw_mesh_triangle(mesh, across, far);
            uint32_t v = far[(edge + 2) % 3];
            p[3] = (mw_weighted_point){{points[2 * v], points[2 * v + 1]}, weights[v]};
            assert_true(mw__power_exact(p) <= 0);
        }
    }
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_cursor cursor = {0};
    for (uint32_t i = 0; i < N; i++) {
        uint32_t t[3];
        mw_weighted_point p[4];
        if (!hidden[i]) continue;
        mw_location at = mw_locate(locator, &cursor, points[2 * i], points[2 * i + 1]);
        assert_true(at.triangle != MW_NONE);
        mw_mesh_triangle(mesh, at.triangle, t);
        for (int k = 0; k < 3; k++)
            p[k] = (mw_weighted_point){{points[2 * t[k]], points[2 * t[k] + 1]}, weights[t[k]]};
        p[3] = (mw_weighted_point){{points[2 * i], points[2 * i + 1]}, weights[i]};
        assert_true(mw__power_exact(p) <= 0);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(hidden);
    free(weights);
    free(points);
}

static void weights_that_are_not_finite_are_refused(void **state)
{
    (void)state;
    const double points[] = {0, 0, 1, 0, 0, 1, 1, 1}, bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        double weights[] = {1, 2, bad[i], 3};
        mw_mesh *mesh;
        mw_error error;
        mw_kind_options options = {.weights = weights};
        assert_int_equal(
            mw_triangulate(MW_KIND_REGULAR, points, 4, 0, &options, NULL, NULL, &mesh, &error),
            MW_ERROR_INPUT);
        assert_null(mesh);
        assert_int_equal(error.vertex, 2);
    }
}

/* Weights whose squares are beyond the doubles. */
static void extreme_weights(void **state)
{
    (void)state;
    const double points[] = {0, 0, 4, 0, 4, 4, 0, 4, 2, 2, 1, 3},
                 weights[] = {0, 0, 0, 0, 1e308, -1e308};
    uint8_t hidden[6];
    mw_mesh *mesh;
    mw_kind_options options = {.weights = weights, .hidden = hidden};
    assert_int_equal(
        mw_triangulate(MW_KIND_REGULAR, points, 6, 0, &options, NULL, NULL, &mesh, NULL), MW_OK);
    const uint8_t want[6] = {0, 0, 0, 0, 0, 1};
    assert_memory_equal(hidden, want, 6);
    assert_int_equal(mw_mesh_triangle_count(mesh), 4);
    mw_mesh_destroy(mesh);
}

static void failing_allocations_are_reported(void **state)
{
    uint64_t random = 3;
    weighted w = weighted_lattice(60, 20, 50, &random);
    mw_kind_options options = {.weights = w.weights, .threads = 1};
    mw_status status = MW_ERROR_MEMORY;
    (void)state;
    for (long k = 0; status == MW_ERROR_MEMORY; k++) {
        mw_mesh *mesh;
        assert_true(k < 1000);
        allocations_left = k;
        status =
            mw_triangulate(MW_KIND_REGULAR, w.points, w.n, 0, &options, NULL, NULL, &mesh, NULL);
        allocations_left = -1;
        assert_true(status == MW_OK || (status == MW_ERROR_MEMORY && !mesh));
        mw_mesh_destroy(mesh);
    }
    assert_int_equal(status, MW_OK);
    weighted_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattices_are_regular),
        cmocka_unit_test(equal_weights_are_delaunay),
        cmocka_unit_test(many_points_are_regular),
        cmocka_unit_test(weights_that_are_not_finite_are_refused),
        cmocka_unit_test(extreme_weights),
        cmocka_unit_test(failing_allocations_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
