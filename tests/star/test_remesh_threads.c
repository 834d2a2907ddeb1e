/* test_remesh_threads.c - a polyhedron is sampled anew by threads, in several threads of the caller
 * at once: all get the same, and (under ThreadSanitizer) there is no data race. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/meshes.h"
#include "support/star_shapes.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { CALLERS = 3, LEVEL = 5 };

typedef struct resampled {
    const mw_star *star;
    const mw_prober *prober;
    uint32_t threads, vertices, count;
    double *points;
    uint32_t *triangles;
    mw_location *locations;
    mw_deviation deviation;
    mw_status status;
} resampled;

static void *resample(void *argument)
{
    resampled *r = argument;
    mw_remesh_options options = {.threads = r->threads};
    mw_icosphere_size(LEVEL, &r->vertices, &r->count, NULL);
    r->points = malloc(3 * (size_t)r->vertices * sizeof *r->points);
    r->triangles = malloc(3 * (size_t)r->count * sizeof *r->triangles);
    r->locations = malloc(r->vertices * sizeof *r->locations);
    r->status =
        mw_star_remesh(r->star, LEVEL, &options, r->points, r->triangles, r->locations, NULL);
    if (r->status) return NULL;
    mw_arrays view = {.points = r->points,
                      .point_count = r->vertices,
                      .triangles = r->triangles,
                      .triangle_count = r->count};
    mw_surface *made;
    r->status = mw_surface_create(&view, NULL, &made, NULL);
    if (r->status) return NULL;
    r->status = mw_surface_deviation(made, r->prober, &options, &r->deviation, NULL);
    mw_surface_destroy(made);
    return NULL;
}

static void resampled_free(resampled *r)
{
    free(r->points);
    free(r->triangles);
    free(r->locations);
}

static void expect_same(const resampled *a, const resampled *b)
{
    assert_int_equal(b->status, MW_OK);
    assert_memory_equal(a->points, b->points, 3 * a->vertices * sizeof *a->points);
    assert_memory_equal(a->triangles, b->triangles, 3 * a->count * sizeof *a->triangles);
    for (uint32_t v = 0; v < a->vertices; v++)
        assert_int_equal(a->locations[v].triangle, b->locations[v].triangle);
    assert_true(a->deviation.largest == b->deviation.largest);
    assert_true(a->deviation.mean == b->deviation.mean);
}

static void test_remesh_by_threads(void **state)
{
    (void)state;
    uint64_t random = 8;
    star_shape shape = star_shape_octahedron(4);
    star_shape_stretch(&shape, 2, &random);
    mw_arrays view = star_shape_arrays(&shape);
    mw_surface *surface;
    mw_star *star;
    mw_prober *prober;
    pthread_t caller[CALLERS];
    mw_prober_options boxes = {.boxes = 1};
    expect_ok(mw_surface_create(&view, NULL, &surface, NULL), "surface", NULL);
    expect_ok(mw_star_create(surface, &(mw_star_options){.threads = 3}, &star, NULL), "star", NULL);
    expect_ok(mw_prober_create(surface, &boxes, &prober, NULL), "prober", NULL);
    resampled alone = {.star = star, .prober = prober, .threads = 1}, r[CALLERS];
    resample(&alone);
    assert_int_equal(alone.status, MW_OK);
    for (uint32_t i = 0; i < CALLERS; i++) {
        r[i] = (resampled){.star = star, .prober = prober, .threads = i + 2};
        assert_int_equal(pthread_create(&caller[i], NULL, resample, &r[i]), 0);
    }
    for (uint32_t i = 0; i < CALLERS; i++) {
        pthread_join(caller[i], NULL);
        expect_same(&alone, &r[i]);
        resampled_free(&r[i]);
    }
    resampled_free(&alone);
    mw_prober_destroy(prober);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    star_shape_free(&shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_remesh_by_threads)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
