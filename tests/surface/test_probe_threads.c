/* test_probe_threads.c - probes in threads: batches, races, cursors of their own, and a surface
 * that moves between queries; the same answers, and (under ThreadSanitizer) no data race. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/touch_oracle.h"
#include "support/meshes.h"
#include "support/shapes.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { QUERIES = 10000, FEW = 300, THREADS = 4 };

typedef struct race_world {
    shape s;
    mw_surface *surface;
    mw_prober *prober;
    double *query;
} race_world;

static int make_world(void **state)
{
    static race_world w;
    uint64_t random = 40;
    w.s = shape_join(shape_ball(6, 64, 0.3, &random), shape_torus(20, 12, 8), 70);
    w.surface = shape_surface(&w.s, (mw_surface_options){.shared = 1});
    mw_prober_options options = {.boxes = 1};
    assert_int_equal(mw_prober_create(w.surface, &options, &w.prober, NULL), MW_OK);
    w.query = shape_queries(&w.s, QUERIES, &random);
    w.query[6 * 100] = NAN;
    *state = &w;
    return 0;
}

static int destroy_world(void **state)
{
    race_world *w = *state;
    mw_prober_destroy(w->prober);
    mw_surface_destroy(w->surface);
    shape_free(&w->s);
    free(w->query);
    return 0;
}

static mw_touch *probe_batch(const race_world *w, mw_probe_options options,
                             mw_probe_counters *counters)
{
    mw_touch *touch = calloc(QUERIES, sizeof *touch);
    assert_non_null(touch);
    assert_int_equal(
        mw_probe_batch(w->prober, w->query, QUERIES, 0, &options, touch, counters, NULL), MW_OK);
    return touch;
}

/* Answers and counters do not depend on the threads, in any mode and from any start. */
static void test_batches(void **state)
{
    const race_world *w = *state;
    for (int start = 0; start < 2 * MW_PROBE_START_COUNT; start++) {
        mw_probe_options options = {.start = (mw_probe_start)(start % MW_PROBE_START_COUNT),
                                    .certain = start >= MW_PROBE_START_COUNT,
                                    .max_distance = 100,
                                    .seed = 5,
                                    .counters = 1,
                                    .threads = 1};
        mw_probe_counters one, many;
        mw_touch *expected = probe_batch(w, options, &one);
        assert_int_equal(one.queries, QUERIES);
        assert_true(one.hits > QUERIES / 4);
        assert_int_equal(expected[100].state, MW_TOUCH_BAD);
        for (uint32_t threads = 0; threads <= THREADS; threads++) {
            options.threads = threads;
            mw_touch *touch = probe_batch(w, options, &many);
            assert_memory_equal(touch, expected, QUERIES * sizeof *touch);
            assert_memory_equal(&many, &one, sizeof one);
            free(touch);
        }
        options.counters = 0;
        mw_touch *uncounted = probe_batch(w, options, &many);
        assert_memory_equal(uncounted, expected, QUERIES * sizeof *expected);
        assert_int_equal(many.queries + many.triangles, 0);
        free(uncounted);
        free(expected);
    }
}

/* A query of a batch that knows nothing of the one before is answered as one alone. */
static void test_batch_as_single(void **state)
{
    const race_world *w = *state;
    mw_probe_options options = {.start = MW_PROBE_START_SAMPLE};
    mw_touch *touch = probe_batch(w, options, NULL), *wide = calloc(FEW, sizeof *wide);
    double *spread = calloc(FEW, 8 * sizeof *spread);
    for (size_t i = 0; i < FEW; i++) memcpy(spread + 8 * i, w->query + 6 * i, 6 * sizeof *spread);
    assert_int_equal(mw_probe_batch(w->prober, spread, FEW, 8, &options, wide, NULL, NULL), MW_OK);
    assert_memory_equal(wide, touch, FEW * sizeof *wide);
    free(wide);
    free(spread);
    free(touch);
}

/* What a race finds is a touch; it finds where one walk after the other does; in certain mode the
 * answer is the same. */
static void test_race(void **state)
{
    const race_world *w = *state;
    size_t hits = 0;
    mw_probe_cursor serial, race, certain, sure;
    mw_probe_options options = {
        .start = MW_PROBE_START_SAMPLE, .iterations = 12, .max_distance = 200, .counters = 1};
    assert_int_equal(mw_probe_cursor_init(w->prober, &options, &serial, NULL), MW_OK);
    options.race = THREADS;
    assert_int_equal(mw_probe_cursor_init(w->prober, &options, &race, NULL), MW_OK);
    options.certain = 1;
    assert_int_equal(mw_probe_cursor_init(w->prober, &options, &sure, NULL), MW_OK);
    options.race = 0;
    assert_int_equal(mw_probe_cursor_init(w->prober, &options, &certain, NULL), MW_OK);
    for (size_t i = 0; i < FEW; i++) {
        const double *q = w->query + 6 * i;
        mw_touch a = mw_probe(w->prober, &serial, q, q + 3),
                 b = mw_probe(w->prober, &race, q, q + 3);
        mw_touch c = mw_probe(w->prober, &certain, q, q + 3),
                 d = mw_probe(w->prober, &sure, q, q + 3);
        assert_memory_equal(&c, &d, sizeof c);
        assert_int_equal(a.state, b.state);
        if (b.state != MW_TOUCH_HIT) continue;
        touch_oracle o = touch_oracle_make(&w->s, q);
        assert_true(o.touched[b.triangle]);
        assert_true(touch_oracle_in_reach(&o, b.triangle, 200));
        assert_int_equal(b.triangle, touch_oracle_lowest_linked(&o, w->surface, b.triangle));
        touch_oracle_free(&o);
        hits++;
    }
    assert_true(hits > FEW / 4);
    assert_int_equal(race.counters.queries, FEW);
    assert_int_equal(race.counters.hits, hits);
    assert_true(race.counters.iterations >= FEW);
    assert_true(race.counters.iterations_max <= 12);
    assert_true(race.counters.triangles >= hits);
}

static void test_race_in_batch(void **state)
{
    const race_world *w = *state;
    mw_touch touch[FEW];
    mw_probe_counters counters;
    mw_probe_options options = {.race = 3, .threads = THREADS, .counters = 1};
    assert_int_equal(mw_probe_batch(w->prober, w->query, FEW, 6, &options, touch, &counters, NULL),
                     MW_OK);
    assert_int_equal(counters.queries, FEW);
    size_t hits = 0;
    for (size_t i = 0; i < FEW; i++) hits += touch[i].state == MW_TOUCH_HIT;
    assert_int_equal(counters.hits, hits);
    assert_true(hits > FEW / 4);
}

/* --- a surface that moves between queries ----------------------------------------------------- */

typedef struct probe_job {
    const race_world *world;
    const mw_star *star;
    uint32_t number;
    const _Atomic int *stop;
    size_t hits;
} probe_job;

static void draw_direction(uint64_t *random, double m[3])
{
    for (int k = 0; k < 3; k++) m[k] = random_unit(random) - 0.5;
}

/* Probes from the outside to the middle of the ball, until told to stop. Wherever it has moved,
 * they touch. */
static void *probing(void *argument)
{
    probe_job *j = argument;
    mw_probe_options options = {.certain = j->number % 2,
                                .race = j->number == 2 ? 2 : 0,
                                .iterations = 10000,
                                .seed = j->number};
    mw_probe_cursor cursor;
    if (mw_probe_cursor_init(j->world->prober, &options, &cursor, NULL)) return "no cursor";
    uint64_t random = j->number;
    do {
        double q[3], m[3];
        draw_direction(&random, m);
        for (int k = 0; k < 3; k++) q[k] = -200 * m[k];
        mw_touch touch = mw_probe(j->world->prober, &cursor, q, m);
        if (touch.state != MW_TOUCH_HIT) return "a probe of the middle touches nothing";
        j->hits++;
    } while (!atomic_load(j->stop) || j->hits < 200);
    return NULL;
}

/* Rays from the middle meanwhile: the star is always up to date. */
static void *shining(void *argument)
{
    probe_job *j = argument;
    mw_star_cursor cursor;
    if (mw_star_cursor_init(j->star, NULL, &cursor, NULL)) return "no cursor";
    uint64_t random = j->number;
    do {
        double q[3];
        draw_direction(&random, q);
        if (mw_star_locate(j->star, &cursor, q).where == MW_BAD) return "a ray meets nothing";
        j->hits++;
    } while (!atomic_load(j->stop) || j->hits < 200);
    return NULL;
}

/* Frame after frame each vertex moves along its ray; sometimes it is known how far at most. */
static void deform(race_world *w, mw_star *star, int frame)
{
    double moved = 0, *points = mw_surface_points(w->surface);
    mw_surface_begin_update(w->surface);
    for (uint32_t v = 0; v < w->s.point_count; v++) {
        double *p = points + 3 * (size_t)v, factor = 1 + (frame % 2 ? -0.01 : 0.01) * (v % 7) / 7.0,
               square = 0;
        for (int k = 0; k < 3; k++) {
            double before = p[k];
            p[k] *= factor;
            square += (p[k] - before) * (p[k] - before);
        }
        moved = fmax(moved, sqrt(square));
    }
    mw_prober_update(w->prober, frame % 10 ? moved * 1.0001 : -1, 1);
    assert_int_equal(mw_star_update(star, NULL, NULL), MW_OK);
    mw_surface_end_update(w->surface);
}

/* A thousand times a second, while four threads query. */
static void test_moving(void **state)
{
    enum { FRAMES = 300, FRAME_NS = 1000000 };
    (void)state;
    uint64_t random = 41;
    race_world ball = {.s = shape_ball(6, 64, 0.3, &random)}, *w = &ball;
    mw_prober_options options = {.boxes = 1};
    _Atomic int stop = 0;
    mw_star *star;
    w->surface = shape_surface(&w->s, (mw_surface_options){.shared = 1});
    assert_int_equal(mw_prober_create(w->surface, &options, &w->prober, NULL), MW_OK);
    assert_int_equal(mw_star_create(w->surface, NULL, &star, NULL), MW_OK);
    pthread_t thread[THREADS];
    probe_job jobs[THREADS];
    for (uint32_t i = 0; i < THREADS; i++) {
        jobs[i] = (probe_job){w, star, i, &stop, 0};
        assert_int_equal(pthread_create(&thread[i], NULL, i == 0 ? shining : probing, &jobs[i]), 0);
    }
    struct timespec next;
    clock_gettime(CLOCK_MONOTONIC, &next);
    for (int frame = 0; frame < FRAMES; frame++) {
        deform(w, star, frame);
        next.tv_nsec += FRAME_NS;
        next.tv_sec += next.tv_nsec / 1000000000;
        next.tv_nsec %= 1000000000;
        /* at once where a frame took longer */
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
    }
    atomic_store(&stop, 1);
    const char *wrong = NULL;
    for (uint32_t i = 0; i < THREADS; i++) {
        void *result;
        assert_int_equal(pthread_join(thread[i], &result), 0);
        if (result) wrong = result;
    }
    mw_star_destroy(star);
    mw_prober_destroy(w->prober);
    mw_surface_destroy(w->surface);
    shape_free(&w->s);
    if (wrong) fail_msg("%s", wrong);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_batches), cmocka_unit_test(test_batch_as_single),
        cmocka_unit_test(test_race),    cmocka_unit_test(test_race_in_batch),
        cmocka_unit_test(test_moving),
    };
    return cmocka_run_group_tests(tests, make_world, destroy_world);
}
