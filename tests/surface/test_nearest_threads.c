/* test_nearest_threads.c - the nearest points of many: the answers of single calls, bit for bit, in
 * any order and for any number of threads; and (under ThreadSanitizer) no data race. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "support/allocations.h"
#include "support/environment.h"
#include "support/make_prober.h"
#include "support/meshes.h"
#include "support/shapes.h"

enum { POINTS = 2200 };

static mw_nearest_surface_point found[POINTS], wanted[POINTS];

/* Points near the surface, on its corners and middles, in its box and far away; some that are not
 * finite. `stride` numbers each. */
static double *draw_points(const shape *s, size_t stride, uint64_t *random)
{
    double *points = malloc(POINTS * stride * sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < POINTS; i++) {
        uint32_t kind = mw__random_below(random, 5);
        const uint32_t *v = s->triangles + 3 * (size_t)mw__random_below(random, s->triangle_count);
        for (size_t k = 0; k < 3; k++) {
            double a = s->points[3 * v[0] + k], b = s->points[3 * v[1] + k],
                   off = random_unit(random) - 0.5;
            points[i * stride + k] = kind == 0   ? a
                                     : kind == 1 ? (a + b) / 2
                                     : kind == 2 ? a + off
                                     : kind == 3 ? 300 * off
                                                 : 1e30 * off;
        }
        for (size_t k = 3; k < stride; k++) points[i * stride + k] = NAN;
    }
    points[4 * stride] = NAN;
    points[7 * stride + 2] = INFINITY;
    return points;
}

/* Memory between the members of a record is not compared. */
static void expect_nearest(const mw_nearest_surface_point *a, const mw_nearest_surface_point *b)
{
    assert_int_equal(a->triangle, b->triangle);
    assert_memory_equal(&a->distance, &b->distance, sizeof a->distance);
    assert_memory_equal(a->point, b->point, sizeof a->point);
    assert_memory_equal(a->weight, b->weight, sizeof a->weight);
}

static void expect_as_single(const mw_prober *prober, const double *points, size_t stride,
                             double max_distance)
{
    mw_error error;
    for (size_t i = 0; i < POINTS; i++)
        expect_ok(
            mw_nearest_on_surface(prober, points + i * stride, max_distance, &wanted[i], &error),
            "nearest", &error);
    for (uint32_t form = 0; form < 4; form++) {
        mw_nearest_options options = {.in_order = form % 2, .threads = 1 + form / 2};
        memset(found, 0xff, sizeof found);
        expect_ok(mw_nearest_on_surface_batch(prober, points, POINTS, stride == 3 ? 0 : stride,
                                              max_distance, &options, found, &error),
                  "nearest points", &error);
        for (size_t i = 0; i < POINTS; i++) expect_nearest(&found[i], &wanted[i]);
    }
}

static void test_as_single(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("nearest batches", 20261128);
    for (int kind = 0; kind < 5; kind++) {
        shape s = kind == 0   ? shape_ball(8, 100, 0.3, &random)
                  : kind == 1 ? shape_patch(12, 3, &random)
                  : kind == 2 ? shape_soup(60, 300, &random)
                  : kind == 3 ? shape_torus(12, 8, 16)
                              : shape_ball(4, 100, 0.3, &random);
        if (kind == 1) shape_flatten(&s, 0.2, &random);
        if (kind == 4) s.points[7] = s.points[30] = NAN;
        mw_surface *surface = shape_surface(&s, (mw_surface_options){.tolerant = 1});
        mw_prober *prober = prober_with_boxes(surface);
        size_t stride = kind % 2 ? 5 : 3;
        double *points = draw_points(&s, stride, &random);
        expect_as_single(prober, points, stride, INFINITY);
        expect_as_single(prober, points, stride, 0.4);
        expect_as_single(prober, points, stride, 0);
        free(points);
        mw_prober_destroy(prober);
        mw_surface_destroy(surface);
        shape_free(&s);
    }
}

/* More points than are sorted at a time. */
static void test_blocks_of_points(void **state)
{
    (void)state;
    enum { MANY = (1 << 20) + 5000 };
    static const double corners[] = {0, 0, 0, 4, 0, 0, 4, 4, 1, 0, 4, 0};
    static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    mw_arrays view = {
        .points = corners, .point_count = 4, .triangles = triangles, .triangle_count = 2};
    mw_surface *surface;
    expect_ok(mw_surface_create(&view, NULL, &surface, NULL), "surface", NULL);
    mw_prober *prober = prober_with_boxes(surface);
    double *points = malloc(3 * (size_t)MANY * sizeof *points);
    mw_nearest_surface_point *nearest = malloc(MANY * sizeof *nearest), one;
    assert_true(points && nearest);
    uint64_t random = 5;
    for (size_t i = 0; i < 3 * (size_t)MANY; i++) points[i] = 6 * random_unit(&random) - 1;
    expect_ok(mw_nearest_on_surface_batch(prober, points, MANY, 0, INFINITY, NULL, nearest, NULL),
              "points", NULL);
    for (size_t i = 0; i < MANY; i += i < MANY - 6000 ? 997 : 1) {
        expect_ok(mw_nearest_on_surface(prober, points + 3 * i, INFINITY, &one, NULL), "one", NULL);
        expect_nearest(&nearest[i], &one);
    }
    free(points);
    free(nearest);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
}

/* --- a surface that moves while it is asked --- */

typedef struct nearest_race {
    mw_surface *surface;
    mw_prober *prober;
    const double *points;
} nearest_race;

static void *race_move(void *work)
{
    nearest_race *r = work;
    for (int i = 0; i < 40; i++) {
        mw_surface_begin_update(r->surface);
        mw_surface_points(r->surface)[i] += 0.25;
        mw_prober_update(r->prober, 0.25, 1);
        mw_surface_end_update(r->surface);
    }
    return NULL;
}

static void test_moves_beside(void **state)
{
    (void)state;
    uint64_t random = 7;
    shape s = shape_ball(8, 100, 0.3, &random);
    nearest_race r = {.surface = shape_surface(&s, (mw_surface_options){.shared = 1})};
    r.prober = prober_with_boxes(r.surface);
    double *points = draw_points(&s, 3, &random);
    pthread_t mover;
    assert_int_equal(pthread_create(&mover, NULL, race_move, &r), 0);
    for (int i = 0; i < 4; i++)
        expect_ok(mw_nearest_on_surface_batch(r.prober, points, POINTS, 0, INFINITY,
                                              &(mw_nearest_options){.threads = 2}, found, NULL),
                  "nearest points", NULL);
    assert_int_equal(pthread_join(mover, NULL), 0);
    expect_as_single(r.prober, points, 3, INFINITY);
    free(points);
    mw_prober_destroy(r.prober);
    mw_surface_destroy(r.surface);
    shape_free(&s);
}

/* --- arguments, memory --- */

static mw_status ask(const mw_prober *prober, const double *points, size_t n, size_t stride,
                     double max_distance)
{
    mw_error error;
    const mw_nearest_options options = {.threads = 1};
    return mw_nearest_on_surface_batch(prober, points, n, stride, max_distance, &options, found,
                                       &error);
}

static void test_arguments_of_batch(void **state)
{
    (void)state;
    uint64_t random = 3;
    shape s = shape_patch(4, 1, &random);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface), *bare;
    expect_ok(mw_prober_create(surface, NULL, &bare, NULL), "prober", NULL);
    double *points = draw_points(&s, 3, &random);
    const mw_nearest_options wrong = {.reserved = {1}};
    assert_int_equal(ask(NULL, points, 9, 0, 1), MW_ERROR_ARGUMENT);
    assert_int_equal(ask(bare, points, 9, 0, 1), MW_ERROR_ARGUMENT);
    assert_int_equal(ask(prober, NULL, 9, 0, 1), MW_ERROR_ARGUMENT);
    assert_int_equal(ask(prober, NULL, 0, 0, 1), MW_OK);
    assert_int_equal(ask(prober, points, 9, 2, 1), MW_ERROR_ARGUMENT);
    assert_int_equal(ask(prober, points, 9, 0, -1), MW_ERROR_ARGUMENT);
    assert_int_equal(ask(prober, points, 9, 0, NAN), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_nearest_on_surface_batch(prober, points, 9, 0, 1, &wrong, found, NULL),
                     MW_ERROR_ARGUMENT);
    mw_surface_begin_update(surface);
    mw_surface_end_update(surface);
    assert_int_equal(ask(prober, points, 9, 0, 1), MW_ERROR_ARGUMENT); /* outdated */
    mw_prober_update(prober, 0, 1);
    assert_int_equal(ask(prober, points, 9, 0, 1), MW_OK);
    allocations_left = 0;
    assert_int_equal(ask(prober, points, POINTS, 0, 1), MW_ERROR_MEMORY);
    allocations_left = 0;
    assert_int_equal(ask(prober, points, 9, 0, 1), MW_OK); /* too few to be sorted */
    allocations_left = -1;
    free(points);
    mw_prober_destroy(bare);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_as_single),
        cmocka_unit_test(test_blocks_of_points),
        cmocka_unit_test(test_moves_beside),
        cmocka_unit_test(test_arguments_of_batch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
