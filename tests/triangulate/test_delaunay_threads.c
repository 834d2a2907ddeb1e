/* The Delaunay triangulation cut into patches, down to single points: each result is checked
 * exactly, and is the same on any number of threads. */
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

#include "base/random.h"
#include "oracle/delaunay_oracle.h"
#include "support/allocations.h"
#include "support/meshes.h"
#include "support/point_sets.h"
#include "triangulate/delaunay/delaunay.h"

typedef struct made {
    mw_status status;
    mw_error error;
    mw_delaunay_report report;
    mw_mesh mesh;
    uint32_t *duplicate_of;
} made;

static made make(const mw_point *points, uint32_t n, uint32_t patch, uint32_t threads)
{
    made m = {
        .error.message = "", .mesh.point_count = n, .mesh.point = malloc((n + 1) * sizeof *points)};
    const mw_delaunay_setup setup = {.patch = patch};
    mw_job job = {.threads = threads};
    memcpy(m.mesh.point, points, n * sizeof *points);
    m.duplicate_of = malloc((n + 1) * sizeof *m.duplicate_of);
    m.status = mw__delaunay_set_up(points, n, &setup, &job, m.duplicate_of, &m.report, &m.mesh.tri,
                                   &m.mesh.tri_count, &m.error);
    return m;
}

static void release(made *m)
{
    free(m->mesh.tri);
    free(m->mesh.point);
    free(m->duplicate_of);
}

static void expect_same(const made *a, const made *b, uint32_t n)
{
    assert_int_equal(a->status, b->status);
    assert_string_equal(a->error.message, b->error.message);
    assert_int_equal(a->mesh.tri_count, b->mesh.tri_count);
    if (a->status) return;
    assert_memory_equal(a->mesh.tri, b->mesh.tri, a->mesh.tri_count * sizeof *a->mesh.tri);
    assert_memory_equal(a->duplicate_of, b->duplicate_of, n * sizeof *a->duplicate_of);
    assert_int_equal(a->report.duplicates, b->report.duplicates);
    assert_int_equal(a->report.triangles_visited, b->report.triangles_visited);
}

/* On one thread, and the same on others: some fewer than patches, some more. */
static mw_delaunay_report triangulate(const mw_point *points, uint32_t n, uint32_t patch)
{
    made one = make(points, n, patch, 1);
    if (one.status != MW_OK) fail_msg("%s", one.error.message);
    delaunay_oracle_check(&one.mesh, one.duplicate_of);
    for (uint32_t threads = 2; threads <= 3; threads++) {
        made more = make(points, n, patch, threads);
        expect_same(&one, &more, n);
        release(&more);
    }
    mw_delaunay_report report = one.report;
    release(&one);
    return report;
}

static void test_sets(void **state)
{
    (void)state;
    static const uint32_t patches[] = {1, 3, 60, 1000};
    for (size_t i = 0; i < POINT_SETS; i++)
        for (size_t k = 0; k < sizeof patches / sizeof *patches; k++) {
            uint32_t n = point_sets[i].largest < 1500 ? point_sets[i].largest : 1500;
            mw_point *points = malloc(n * sizeof *points);
            point_set_fill(&point_sets[i], 23, points, n);
            mw_delaunay_report report = triangulate(points, n, patches[k]);
            assert_int_equal(report.points, n);
            free(points);
        }
}

/* Random sequences of up to 14 points of a 4 x 4 grid; most are flat somewhere. What cannot be
 * triangulated is refused in the words that it is without a cut. */
static void test_small_sets(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 20000; seed++) {
        mw_point points[14];
        uint64_t random = seed;
        uint32_t n = 3 + mw__random_below(&random, 12), patch = 1 + mw__random_below(&random, 4);
        for (uint32_t i = 0; i < n; i++)
            points[i] = (mw_point){mw__random_below(&random, 4), mw__random_below(&random, 4)};
        made whole = make(points, n, 14, 1), cut = make(points, n, patch, 1);
        assert_int_equal(cut.status, whole.status);
        assert_string_equal(cut.error.message, whole.error.message);
        assert_int_equal(cut.mesh.tri_count, whole.mesh.tri_count);
        if (cut.status == MW_OK) delaunay_oracle_check(&cut.mesh, cut.duplicate_of);
        release(&whole);
        release(&cut);
    }
}

/* Points on the lines that part patches, each twice or so: the borders of the cells of a curve
 * through 0..64 are integers. */
static void test_cuts(void **state)
{
    (void)state;
    enum { WIDTH = 65, N = 2 * WIDTH * WIDTH };
    mw_point *points = malloc(N * sizeof *points);
    uint64_t random = 11;
    for (uint32_t i = 0; i < N; i++)
        points[i] = (mw_point){mw__random_below(&random, WIDTH), mw__random_below(&random, WIDTH)};
    points[0] = (mw_point){0, 0};
    points[1] = (mw_point){WIDTH - 1, WIDTH - 1};
    for (uint32_t patch = 1; patch < N; patch *= 5) triangulate(points, N, patch);
    for (uint32_t i = 0; i < N; i++)
        points[i].y = 32 + (i % 2 ? 0 : points[i].y / 1024); /* near the line between halves */
    triangulate(points, N, 100);
    free(points);
}

/* A crowd in one cell of the curve, far from the rest. */
static void test_crowd(void **state)
{
    (void)state;
    enum { N = 5000 };
    mw_point *points = malloc(N * sizeof *points);
    uint64_t random = 7;
    for (uint32_t i = 0; i < N; i++) {
        double scale = i % 10 ? 0x1p-40 : 1;
        points[i] = (mw_point){scale * random_unit(&random), scale * random_unit(&random)};
    }
    triangulate(points, N, 200);
    /* twins */
    for (uint32_t i = 0; i < N; i++)
        points[i] = i < 3 ? (mw_point){i, i * i} : (mw_point){1.5, 0.25};
    mw_delaunay_report report = triangulate(points, N, 200);
    assert_int_equal(report.duplicates, N - 4);
    free(points);
}

/* Patches as large as they are by default. */
static void test_many(void **state)
{
    (void)state;
    enum { N = 60000 };
    mw_point *points = malloc(N * sizeof *points);
    point_set_fill(&point_sets[0], 29, points, N);
    triangulate(points, N, 0);
    points[N - 1].x = points[40000].y = NAN;
    for (uint32_t threads = 1; threads < 4; threads++) {
        made bad = make(points, N, 0, threads);
        assert_int_equal(bad.status, MW_ERROR_INPUT);
        assert_int_equal(bad.error.vertex, 40000);
        release(&bad);
    }
    free(points);
}

/* The calls with options: as the call without. */
static void test_options(void **state)
{
    (void)state;
    enum { N = 40000 };
    mw_point *points = malloc(N * sizeof *points);
    mw_mesh *mesh[3];
    point_set_fill(&point_sets[0], 31, points, N);
    const mw_delaunay_options two = {.threads = 2};
    const mw_kind_options three = {.threads = 3};
    assert_int_equal(mw_delaunay(&points->x, N, 2, NULL, NULL, NULL, &mesh[0], NULL), MW_OK);
    assert_int_equal(mw_delaunay(&points->x, N, 2, &two, NULL, NULL, &mesh[1], NULL), MW_OK);
    assert_int_equal(
        mw_triangulate(MW_KIND_DELAUNAY, &points->x, N, 2, &three, NULL, NULL, &mesh[2], NULL),
        MW_OK);
    for (int i = 1; i < 3; i++)
        assert_int_equal(mw_mesh_triangle_count(mesh[i]), mw_mesh_triangle_count(mesh[0]));
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh[0]); t++) {
        uint32_t v[3][3];
        for (int i = 0; i < 3; i++) mw_mesh_triangle(mesh[i], t, v[i]);
        assert_memory_equal(v[0], v[1], sizeof v[0]);
        assert_memory_equal(v[0], v[2], sizeof v[0]);
    }
    for (int i = 0; i < 3; i++) mw_mesh_destroy(mesh[i]);
    free(points);
}

/* Whichever allocation fails, the call says so and leaves nothing behind (the leak checker looks
 * on). */
static void test_memory_failures(void **state)
{
    (void)state;
    enum { N = 20000 };
    mw_point *points = malloc(N * sizeof *points);
    point_set_fill(&point_sets[0], 5, points, N);
    for (long allowed = 0;; allowed++) {
        mw_triangle *tri = (mw_triangle *)1;
        uint32_t tri_count;
        mw_error error;
        const mw_delaunay_setup setup = {.patch = 1000};
        mw_job job = {.threads = 2};
        allocations_left = allowed;
        mw_status status =
            mw__delaunay_set_up(points, N, &setup, &job, NULL, NULL, &tri, &tri_count, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        if (status == MW_OK) {
            assert_false(failed);
            assert_true(allowed > 7);
            free(tri);
            break;
        }
        assert_int_equal(status, MW_ERROR_MEMORY);
        assert_null(tri);
    }
    free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_small_sets),
        cmocka_unit_test(test_cuts),
        cmocka_unit_test(test_crowd),
        cmocka_unit_test(test_many),
        cmocka_unit_test(test_options),
        cmocka_unit_test(test_memory_failures),
    };
    return cmocka_run_group_tests_name("delaunay in threads", tests, NULL, NULL);
}
