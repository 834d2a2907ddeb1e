/* The Delaunay triangulation: every one made here is checked exactly, triangle by triangle. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <zlib.h>

#include "base/random.h"
#include "oracle/delaunay_oracle.h"
#include "support/allocations.h"
#include "support/point_sets.h"

#include <meshwalk/triangulate.h>

/* Triangulate and check; returns the report. */
static mw_delaunay_report triangulate(const mw_point *points, uint32_t n)
{
    mw_mesh *mesh;
    mw_error error;
    mw_delaunay_report report;
    uint32_t *duplicate_of = malloc((n + 1) * sizeof *duplicate_of);
    if (mw_delaunay(&points->x, n, 0, NULL, duplicate_of, &report, &mesh, &error) != MW_OK)
        fail_msg("%s", error.message);
    assert_int_equal(mesh->point_count, n);
    for (uint32_t i = 0; i < n; i++) {
        double p[2];
        mw_mesh_vertex(mesh, i, p);
        assert_memory_equal(p, &points[i], sizeof p);
    }
    delaunay_oracle_check(mesh, duplicate_of);
    size_t duplicates = 0;
    for (uint32_t i = 0; i < n; i++) duplicates += duplicate_of[i] != MW_NONE;
    assert_int_equal(report.points, n);
    assert_int_equal(report.duplicates, duplicates);
    mw_mesh_destroy(mesh);
    free(duplicate_of);
    return report;
}

/* No set of points, and no order that they are given in, costs more than a few visits for each. */
static void test_sets(void **state)
{
    (void)state;
    for (size_t i = 0; i < POINT_SETS; i++) {
        uint32_t sizes[] = {20, 300, point_sets[i].largest};
        mw_point *points = malloc(point_sets[i].largest * sizeof *points + 300 * sizeof *points);
        for (int k = 0; k < 3; k++) {
            if (k < 2 && sizes[k] >= point_sets[i].largest) continue;
            point_set_fill(&point_sets[i], 17, points, sizes[k]);
            mw_delaunay_report report = triangulate(points, sizes[k]);
            double visits = (double)report.triangles_visited / sizes[k];
            if (visits > point_sets[i].visits)
                fail_msg("%s: %u points, %g visits each", point_sets[i].name, sizes[k], visits);
        }
        free(points);
    }
}

/* --- all small sets on a grid --- */

static int on_one_line(const mw_point *points, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++)
            for (uint32_t k = 0; k < j; k++)
                if (mw__orient2d(points[i], points[j], points[k]) != 0) return 0;
    return 1;
}

static void triangulate_or_refuse(const mw_point *points, uint32_t n)
{
    if (on_one_line(points, n)) {
        mw_mesh *mesh;
        assert_int_equal(mw_delaunay(&points->x, n, 2, NULL, NULL, NULL, &mesh, NULL),
                         MW_ERROR_INPUT);
        assert_null(mesh);
    } else {
        triangulate(points, n);
    }
}

/* Every sequence of four points of a 3 x 3 grid. */
static void test_all_fours(void **state)
{
    (void)state;
    for (uint32_t code = 0; code < 9 * 9 * 9 * 9; code++) {
        mw_point points[4];
        for (uint32_t i = 0, c = code; i < 4; i++, c /= 9)
            points[i] = (mw_point){c % 9 % 3, c % 9 / 3};
        triangulate_or_refuse(points, 4);
    }
}

/* Random sequences of up to 14 points of a 4 x 4 grid. */
static void test_small_sets(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 5000; seed++) {
        mw_point points[14];
        uint64_t random = seed;
        uint32_t n = 3 + mw__random_below(&random, 12);
        for (uint32_t i = 0; i < n; i++)
            points[i] = (mw_point){mw__random_below(&random, 4), mw__random_below(&random, 4)};
        triangulate_or_refuse(points, n);
    }
}

/* --- real points --- */

static mw_point *read_points(const char *path, uint32_t *n)
{
    gzFile file = gzopen(path, "rb");
    if (!file) return NULL;
    uint32_t room = 1 << 20;
    mw_point *points = malloc(room * sizeof *points);
    char line[256];
    for (*n = 0; *n < room && gzgets(file, line, sizeof line);) {
        char *end;
        points[*n].x = strtod(line, &end);
        points[*n].y = strtod(end, NULL);
        *n += 1;
    }
    gzclose(file);
    return points;
}

static void test_lidar(void **state)
{
    (void)state;
    static const char *const names[] = {"autzen", "crop_4_6", "topography", "delft"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[512];
        uint32_t n = 0;
        snprintf(path, sizeof path, "%s/terrain/%s_ground.xyz.gz", MW_TEST_SHARED, names[i]);
        mw_point *points = read_points(path, &n);
        if (!points) {
            print_message("left out: there is no %s\n", path);
            skip();
        }
        mw_delaunay_report report = triangulate(points, n);
        assert_true(report.triangles_visited < 10 * (uint64_t)n);
        free(points);
    }
}

/* --- the interface --- */

static void refuses(const mw_point *points, size_t n, int64_t vertex, const char *message)
{
    mw_mesh *mesh = (mw_mesh *)1;
    mw_error error;
    assert_int_equal(mw_delaunay(points ? &points->x : NULL, n, 2, NULL, NULL, NULL, &mesh, &error),
                     MW_ERROR_INPUT);
    assert_null(mesh);
    assert_int_equal(error.status, MW_ERROR_INPUT);
    assert_int_equal(error.vertex, vertex);
    assert_string_equal(error.message, message);
}

static void test_refused_points(void **state)
{
    (void)state;
    mw_point points[6] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 3}, {4, 5}};
    refuses(NULL, 0, -1, "fewer than three points: 0");
    refuses(points, 2, -1, "fewer than three points: 2");
    points[3].y = NAN;
    refuses(points, 6, 3, "point 3 is not finite");
    points[3].y = 1;
    points[5].x = -INFINITY;
    refuses(points, 6, 5, "point 5 is not finite");
    const mw_point same[4] = {{1, -0.0}, {1, 0}, {1, 0}, {1, -0.0}};
    refuses(same, 4, -1, "fewer than three different points: all 4 are equal");
    const mw_point two[5] = {{1, 2}, {3, 4}, {1, 2}, {3, 4}, {1, 2}};
    refuses(two, 5, -1, "fewer than three different points: only two among 5");
    const mw_point line[5] = {{1, 2}, {3, 4}, {5, 6}, {3, 4}, {-1e9, -999999999}};
    refuses(line, 5, -1, "all 5 points lie on one line");
    const mw_point vertical[3] = {{1e308, -1e308}, {1e308, 1e308}, {1e308, 1e-300}};
    refuses(vertical, 3, -1, "all 3 points lie on one line");
}

static void test_refused_calls(void **state)
{
    (void)state;
    const double points[6] = {0, 0, 1, 0, 0, 1};
    mw_mesh *mesh = (mw_mesh *)1;
    mw_error error;
    assert_int_equal(mw_delaunay(points, 3, 1, NULL, NULL, NULL, &mesh, &error), MW_ERROR_ARGUMENT);
    assert_null(mesh);
    assert_int_equal(mw_delaunay(NULL, 3, 2, NULL, NULL, NULL, &mesh, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_delaunay(points, 3, 2, NULL, NULL, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_delaunay(points, (size_t)1 << 40, 2, NULL, NULL, NULL, &mesh, &error),
                     MW_ERROR_LIMIT);
    assert_null(mesh);
}

/* Heights between the points, and no space after the last. */
static void test_stride(void **state)
{
    (void)state;
    const double points[] = {0, 0, NAN, 1, 0, 7, 0, 1};
    mw_mesh *mesh;
    assert_int_equal(mw_delaunay(points, 3, 3, NULL, NULL, NULL, &mesh, NULL), MW_OK);
    assert_int_equal(mw_mesh_triangle_count(mesh), 1);
    double corner[2];
    mw_mesh_vertex(mesh, 2, corner);
    assert_true(corner[0] == 0 && corner[1] == 1);
    mw_mesh_destroy(mesh);
}

/* Points of a fine lattice, far from the origin: many lie nearly, but not exactly, on one circle.
 */
static void test_lattices(void **state)
{
    (void)state;
    enum { N = 500 };
    static const double steps[] = {0.125, 1, 0x1p-20, 0x1p-30};
    uint64_t random = 43;
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++)
        for (int shift = -1; shift <= 1; shift += 2) {
            mw_point points[N];
            for (uint32_t i = 0; i < N; i++)
                points[i] = (mw_point){shift * (1024 + mw__random_below(&random, 64) * steps[s]),
                                       2048 + mw__random_below(&random, 64) * steps[s]};
            triangulate(points, N);
        }
}

/* Multiplied by a power of two, the points have the same triangles in the same order, in the same
 * number of steps, even if every product overflows or underflows. If the factor costs bits of small
 * coordinates, the triangulation is still correct. */
static void test_scales(void **state)
{
    (void)state;
    enum { N = 3000 };
    static const int exponents[] = {-1070, -1000, -500, -160, 100, 260, 900, 980};
    uint64_t random = 41;
    mw_point point[N], scaled[N];
    mw_mesh *mesh, *same;
    mw_delaunay_report report, again;
    for (uint32_t i = 0; i < N; i++) { /* integers, so that the least exponent costs no bit */
        point[i].x = mw__random_below(&random, 1 << 20);
        point[i].y = mw__random_below(&random, 1 << 20);
    }
    assert_int_equal(mw_delaunay(&point->x, N, 0, NULL, NULL, &report, &mesh, NULL), MW_OK);
    for (size_t e = 0; e < sizeof exponents / sizeof *exponents; e++) {
        for (uint32_t i = 0; i < N; i++)
            scaled[i] =
                (mw_point){ldexp(point[i].x, exponents[e]), ldexp(point[i].y, exponents[e])};
        assert_int_equal(mw_delaunay(&scaled->x, N, 0, NULL, NULL, &again, &same, NULL), MW_OK);
        assert_int_equal(again.triangles_visited, report.triangles_visited);
        assert_int_equal(mw_mesh_triangle_count(same), mw_mesh_triangle_count(mesh));
        for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
            uint32_t v[3], w[3];
            mw_mesh_triangle(mesh, t, v);
            mw_mesh_triangle(same, t, w);
            assert_memory_equal(v, w, sizeof v);
        }
        mw_mesh_destroy(same);
    }
    mw_mesh_destroy(mesh);
    for (uint32_t i = 0; i < 40; i++) /* from 2^-500 to 2^990 */
        scaled[i] = (mw_point){ldexp(point[i].x, (int)(i % 40) * 37 - 500),
                               ldexp(point[i].y, (int)(i % 7) * 200 - 500)};
    triangulate(scaled, 40);
}

/* Consecutive triangles lie near each other, whatever the order of the points. */
static void test_order_of_triangles(void **state)
{
    (void)state;
    enum { N = 20000 };
    mw_point *points = malloc(N * sizeof *points);
    point_set_fill(&point_sets[0], 3, points, N);
    mw_mesh *mesh;
    assert_int_equal(mw_delaunay(&points->x, N, 2, NULL, NULL, NULL, &mesh, NULL), MW_OK);
    double jumps = 0;
    for (uint32_t t = 1; t < mesh->tri_count; t++) {
        mw_point a = mesh->point[mesh->tri[t - 1].v[0]], b = mesh->point[mesh->tri[t].v[0]];
        jumps += hypot(a.x - b.x, a.y - b.y);
    }
    assert_true(jumps / mesh->tri_count < 3 / sqrt(N));
    mw_mesh_destroy(mesh);
    free(points);
}

/* Whichever allocation fails, the call says so and leaves nothing behind (the leak checker looks
 * on). */
static void test_memory_failures(void **state)
{
    (void)state;
    mw_point points[100];
    uint32_t duplicate_of[100];
    point_set_fill(&point_sets[0], 5, points, 100);
    for (long allowed = 0;; allowed++) {
        mw_mesh *mesh = (mw_mesh *)1;
        mw_error error;
        allocations_left = allowed;
        mw_status status = mw_delaunay(&points->x, 100, 2, NULL, duplicate_of, NULL, &mesh, &error);
        allocations_left = -1;
        if (status == MW_OK) {
            assert_true(allowed > 5);
            mw_mesh_destroy(mesh);
            return;
        }
        assert_int_equal(status, MW_ERROR_MEMORY);
        assert_int_equal(error.status, MW_ERROR_MEMORY);
        assert_null(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_all_fours),
        cmocka_unit_test(test_small_sets),
        cmocka_unit_test(test_lidar),
        cmocka_unit_test(test_refused_points),
        cmocka_unit_test(test_refused_calls),
        cmocka_unit_test(test_stride),
        cmocka_unit_test(test_lattices),
        cmocka_unit_test(test_scales),
        cmocka_unit_test(test_order_of_triangles),
        cmocka_unit_test(test_memory_failures),
    };
    return cmocka_run_group_tests_name("delaunay", tests, NULL, NULL);
}
