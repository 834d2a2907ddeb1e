/* The Delaunay triangulation cut into patches, down to single points: each result is checked exactly, and is the same on any
 * number of threads. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "delaunay.h"
#include "memory.h"
#include "triangulate/delaunay.h"

typedef struct made {
    mw_status status;
    mw_error error;
    mw_triangulation_report report;
    mw_mesh mesh;
    uint32_t *duplicate_of;
} made;

static made make(const mw_point *points, uint32_t n, uint32_t patch, uint32_t threads)
{
    made m = {.error.message = "", .mesh.point_count = n, .mesh.point = malloc((n + 1) * sizeof *points)};
    const mw_delaunay_setup setup = {.threads = threads, .patch = patch};
    memcpy(m.mesh.point, points, n * sizeof *points);
    m.duplicate_of = malloc((n + 1) * sizeof *m.duplicate_of);
    m.status =
        mw__delaunay_set_up(points, n, &setup, m.duplicate_of, &m.report, &m.mesh.tri, &m.mesh.tri_count, &m.error);
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

/* On one thread, and the same on others. */
static mw_triangulation_report triangulate(const mw_point *points, uint32_t n, uint32_t patch)
{
    made one = make(points, n, patch, 1);
    if (one.status != MW_OK) fail_msg("%s", one.error.message);
    check_mesh(&one.mesh, one.duplicate_of);
    for (uint32_t threads = 2; threads <= 4; threads++) {
        made more = make(points, n, patch, threads);
        expect_same(&one, &more, n);
        release(&more);
    }
    mw_triangulation_report report = one.report;
    release(&one);
    return report;
}

static void test_sets(void **state)
{
    (void)state;
    static const uint32_t patches[] = {1, 3, 60, 1000};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        for (size_t k = 0; k < sizeof patches / sizeof *patches; k++) {
            uint32_t n = sets[i].largest < 3000 ? sets[i].largest : 3000;
            mw_point *points = malloc(n * sizeof *points);
            fill(&sets[i], 23, points, n);
            mw_triangulation_report report = triangulate(points, n, patches[k]);
            assert_int_equal(report.points, n);
            free(points);
        }
}

/* Random sequences of up to 14 points of a 4 x 4 grid; most are flat somewhere. What cannot be triangulated is refused in the
 * words that it is without a cut. */
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
        if (cut.status == MW_OK) check_mesh(&cut.mesh, cut.duplicate_of);
        release(&whole);
        release(&cut);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_small_sets),
    };
    return cmocka_run_group_tests_name("delaunay in threads", tests, NULL, NULL);
}
