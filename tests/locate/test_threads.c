/* test_threads.c - one mesh and one locator, many threads: the same answers, bit for bit, and
 * (under ThreadSanitizer) no data race. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/meshes.h"
#include "support/start_list.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 3000, QUERIES = 40000, THREADS = 4 };

/* A square of random triangles with a round hole, the queries, and their answers by one thread. */
typedef struct locate_world {
    mw_mesh *mesh;
    mw_locator *locator;
    mw_index *index[MW_START_COUNT];
    double *value, *query;
    mw_location *answer;
} locate_world;

static double *random_numbers(size_t n, double low, double high, uint64_t seed)
{
    double *number = malloc(n * sizeof *number);
    assert_non_null(number);
    for (size_t i = 0; i < n; i++) number[i] = low + (high - low) * random_unit(&seed);
    return number;
}

/* Triangles of `whole` that do not have all vertices near the middle. */
static mw_mesh *with_hole(const mw_mesh *whole, const double *points)
{
    uint32_t count = mw_mesh_triangle_count(whole), kept = 0;
    uint32_t *triangles = malloc(3 * sizeof *triangles * count);
    assert_non_null(triangles);
    for (uint32_t t = 0; t < count; t++) {
        uint32_t *v = triangles + (size_t)3 * kept;
        int near = 0;
        mw_mesh_triangle(whole, t, v);
        for (int k = 0; k < 3; k++) {
            double x = points[2 * v[k]] - 0.5, y = points[2 * v[k] + 1] - 0.5;
            near += x * x + y * y < 0.04;
        }
        kept += near < 3;
    }
    mw_arrays view = {
        .points = points, .point_count = POINTS, .triangles = triangles, .triangle_count = kept};
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    free(triangles);
    return mesh;
}

static int make_world(void **state)
{
    static locate_world w;
    double *points = random_numbers((size_t)2 * POINTS, 0, 1, 1);
    mw_mesh *whole;
    assert_int_equal(mw_delaunay(points, POINTS, 2, NULL, NULL, NULL, &whole, NULL), MW_OK);
    w.mesh = with_hole(whole, points);
    mw_mesh_destroy(whole);
    w.query = random_numbers((size_t)2 * QUERIES, -0.05, 1.05, 2);
    /* Some at vertices, where the rule of ties decides. */
    for (size_t i = 0; i < POINTS; i++)
        memcpy(w.query + 20 * i, points + 2 * i, 2 * sizeof(double));
    free(points);
    w.value = random_numbers(POINTS, 0, 100, 3);
    mw_locator_options options = {.border = 1};
    assert_int_equal(mw_locator_create(w.mesh, &options, &w.locator, NULL), MW_OK);
    starts_open(w.locator, w.index);
    w.answer = malloc(QUERIES * sizeof *w.answer);
    assert_non_null(w.answer);
    mw_cursor cursor;
    assert_int_equal(mw_cursor_init(w.locator, NULL, &cursor, NULL), MW_OK);
    for (size_t i = 0; i < QUERIES; i++)
        w.answer[i] = mw_locate(w.locator, &cursor, w.query[2 * i], w.query[2 * i + 1]);
    *state = &w;
    return 0;
}

static int destroy_world(void **state)
{
    locate_world *w = *state;
    starts_close(w->index);
    mw_locator_destroy(w->locator);
    mw_mesh_destroy(w->mesh);
    free(w->answer);
    free(w->query);
    free(w->value);
    return 0;
}

/* --- what the threads do: each returns NULL, or what went wrong ------------------------------- */

typedef struct locate_job {
    const locate_world *world;
    unsigned number;
} locate_job;

static void run_threads(const locate_world *w, void *(*work)(void *))
{
    pthread_t thread[THREADS];
    locate_job jobs[THREADS];
    for (unsigned i = 0; i < THREADS; i++) {
        jobs[i] = (locate_job){w, i};
        assert_int_equal(pthread_create(&thread[i], NULL, work, &jobs[i]), 0);
    }
    const char *wrong = NULL;
    for (unsigned i = 0; i < THREADS; i++) {
        void *result;
        assert_int_equal(pthread_join(thread[i], &result), 0);
        if (result) wrong = result;
    }
    if (wrong) fail_msg("%s", wrong);
}

static void *single_queries(void *argument)
{
    const locate_job *j = argument;
    const locate_world *w = j->world;
    mw_query_options options = {.walk = (mw_walk_kind)(1 + j->number % (MW_WALK_COUNT - 1)),
                                .start = (mw_start_kind)(j->number % MW_START_COUNT),
                                .seed = j->number,
                                .counters = 1};
    options.index = w->index[options.start];
    mw_cursor cursor;
    if (mw_cursor_init(w->locator, &options, &cursor, NULL)) return "no cursor";
    for (size_t i = 0; i < QUERIES; i++) {
        const double *q = w->query + 2 * i;
        mw_location at = mw_locate(w->locator, &cursor, q[0], q[1]);
        if (memcmp(&at, &w->answer[i], sizeof at) != 0) return "a query is answered differently";
    }
    return cursor.counters.queries == QUERIES ? NULL : "queries are not counted";
}

static void *border_and_values(void *argument)
{
    const locate_world *w = ((const locate_job *)argument)->world;
    for (size_t i = 0; i < QUERIES; i += 10) {
        mw_nearest_border_point hit;
        double value;
        const double *q = w->query + 2 * i;
        if (mw_nearest_border(w->locator, q[0], q[1], &hit, NULL)) return "no nearest border";
        mw_interpolate(w->mesh, w->value, &w->answer[i], 1, &value);
        if ((w->answer[i].triangle == MW_NONE) != isnan(value))
            return "a value where there is no triangle";
    }
    return NULL;
}

static void *batches(void *argument)
{
    const locate_job *j = argument;
    const locate_world *w = j->world;
    mw_location *location = malloc(QUERIES * sizeof *location);
    uint32_t *hint = malloc(QUERIES * sizeof *hint);
    int same = location && hint;
    if (same) memset(hint, 0xff, QUERIES * sizeof *hint);
    for (int round = 0; same && round < 3;
         round++) { /* the first without hints, the last with good ones */
        mw_query_options options = {.threads = 2, .seed = j->number, .lanes = 1 + 7 * j->number};
        if (round > 0) options.hints = hint;
        mw_status status =
            mw_locate_batch(w->locator, w->query, QUERIES, 2, &options, location, NULL, NULL);
        same = !status && memcmp(location, w->answer, QUERIES * sizeof *location) == 0;
    }
    free(location);
    free(hint);
    return same ? NULL : "a batch is answered differently";
}

static void *locators(void *argument)
{
    const locate_job *j = argument;
    const locate_world *w = j->world;
    mw_locator_options options = {.border = j->number % 2 == 0};
    for (int i = 0; i < 3; i++) {
        mw_locator *locator;
        mw_cursor cursor;
        if (mw_locator_create(w->mesh, &options, &locator, NULL)) return "no locator";
        mw_status status = mw_cursor_init(locator, NULL, &cursor, NULL);
        mw_location at = mw_locate(locator, &cursor, w->query[0], w->query[1]);
        mw_locator_destroy(locator);
        if (status || memcmp(&at, &w->answer[0], sizeof at) != 0)
            return "another locator answers differently";
    }
    return NULL;
}

/* --- the tests -------------------------------------------------------------------------------- */

static void test_world(void **state)
{
    const locate_world *w = *state;
    uint32_t count[MW_WHERE_COUNT] = {0};
    for (size_t i = 0; i < QUERIES; i++) count[w->answer[i].where]++;
    assert_true(count[MW_INSIDE] > QUERIES / 2);
    assert_true(count[MW_ON_VERTEX] > POINTS / 2);
    assert_true(count[MW_OUTSIDE] > QUERIES / 20);
    assert_true(count[MW_IN_HOLE] > QUERIES / 20);
}

static void test_single_queries(void **state)
{
    run_threads(*state, single_queries);
}
static void test_border_and_values(void **state)
{
    run_threads(*state, border_and_values);
}
static void test_batches_at_the_same_time(void **state)
{
    run_threads(*state, batches);
}
static void test_locators_at_the_same_time(void **state)
{
    run_threads(*state, locators);
}

static void test_batch_threads(void **state)
{
    const locate_world *w = *state;
    mw_location *location = malloc(QUERIES * sizeof *location);
    assert_non_null(location);
    for (int walk = 0; walk < MW_WALK_COUNT; walk++) {
        mw_counters one = {0}, more;
        for (uint32_t threads = 1; threads <= THREADS; threads++) {
            mw_query_options options = {
                .walk = (mw_walk_kind)walk, .threads = threads, .counters = 1};
            memset(location, 0, QUERIES * sizeof *location);
            assert_int_equal(
                mw_locate_batch(w->locator, w->query, QUERIES, 2, &options, location, &more, NULL),
                MW_OK);
            assert_memory_equal(location, w->answer, QUERIES * sizeof *location);
            if (threads == 1) one = more;
            assert_int_equal(more.queries, QUERIES);
            assert_memory_equal(&one, &more, sizeof one);
        }
    }
    free(location);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_world),
        cmocka_unit_test(test_single_queries),
        cmocka_unit_test(test_border_and_values),
        cmocka_unit_test(test_batch_threads),
        cmocka_unit_test(test_batches_at_the_same_time),
        cmocka_unit_test(test_locators_at_the_same_time),
    };
    return cmocka_run_group_tests(tests, make_world, destroy_world);
}
