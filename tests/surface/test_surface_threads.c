/* test_surface_threads.c - queries in threads while one thread, or two, keep updating: everybody
 * sees whole updates only, and (under ThreadSanitizer) there is no data race. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "surface/surface.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

enum { READERS = 4, UPDATERS = 2, UPDATES = 200, POINTS = 300 };

typedef struct surface_world {
    mw_surface *surface;
    atomic_int updaters_left, torn;
    atomic_uint inside, queries;
    double last; /* of the points, without protection but the gate */
    int updates; /* likewise                                       */
} surface_world;

/* A query: all points hold the same numbers, those of the last update. */
static void *query(void *argument)
{
    surface_world *w = argument;
    double seen = 0;
    do {
        mw__surface_read_lock(w->surface);
        atomic_fetch_add(&w->inside, 1);
        double first[3];
        mw_surface_vertex(w->surface, 0, first);
        int torn = first[0] != w->last || first[0] < seen;
        for (uint32_t v = 0; v < POINTS; v++) {
            const double *p = mw__surface_point(w->surface, v);
            torn |= p[0] != first[0] || p[1] != first[0] || p[2] != first[0];
        }
        seen = first[0];
        if (torn) atomic_store(&w->torn, 1);
        atomic_fetch_add(&w->queries, 1);
        atomic_fetch_sub(&w->inside, 1);
        mw__surface_read_unlock(w->surface);
    } while (atomic_load(&w->updaters_left) > 0);
    return NULL;
}

static void *update(void *argument)
{
    surface_world *w = argument;
    for (int i = 0; i < UPDATES; i++) {
        mw_surface_begin_update(w->surface);
        if (atomic_load(&w->inside) > 0) atomic_store(&w->torn, 1);
        double *p = mw_surface_points(w->surface), value = p[0] + 1;
        for (uint32_t k = 0; k < 3 * POINTS; k++) p[k] = value;
        w->last = value;
        w->updates++;
        if (atomic_load(&w->inside) > 0) atomic_store(&w->torn, 1);
        mw_surface_end_update(w->surface);
        if (i % 8 == 0) sched_yield();
    }
    atomic_fetch_sub(&w->updaters_left, 1);
    return NULL;
}

static void test_gate(void **state)
{
    (void)state;
    static double points[3 * POINTS];
    static const uint32_t triangle[3] = {0, 1, 2};
    mw_arrays arrays = {
        .points = points, .point_count = POINTS, .triangles = triangle, .triangle_count = 1};
    surface_world w = {.updaters_left = UPDATERS};
    assert_int_equal(
        mw_surface_create(&arrays, &(mw_surface_options){.shared = 1}, &w.surface, NULL), MW_OK);
    pthread_t thread[READERS + UPDATERS];
    for (int i = 0; i < READERS + UPDATERS; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, i < READERS ? query : update, &w), 0);
    for (int i = 0; i < READERS + UPDATERS; i++) assert_int_equal(pthread_join(thread[i], NULL), 0);
    assert_int_equal(atomic_load(&w.torn), 0);
    assert_int_equal(w.updates, UPDATERS * UPDATES);
    assert_true(w.last == UPDATERS * UPDATES && w.surface->version == UPDATERS * UPDATES);
    assert_true(atomic_load(&w.queries) >= READERS);
    mw_surface_destroy(w.surface);
}

/* An update that begins while a query is inside waits for it. */
typedef struct meeting {
    mw_surface *surface;
    /* 1: the query is inside, 2: the update is about to begin, 3: the query is about to leave */
    atomic_int stage;
    int begun, too_soon; /* the update has begun; while the query was inside */
} meeting;

static void wait_for(meeting *m, int stage)
{
    while (atomic_load(&m->stage) < stage) sched_yield();
}

static void *early_query(void *argument)
{
    meeting *m = argument;
    mw__surface_read_lock(m->surface);
    atomic_store(&m->stage, 1);
    wait_for(m, 2);
    for (int i = 0; i < 100; i++) sched_yield(); /* it could begin now */
    m->too_soon = m->begun;
    atomic_store(&m->stage, 3);
    mw__surface_read_unlock(m->surface);
    return NULL;
}

static void *one_update(void *argument)
{
    meeting *m = argument;
    wait_for(m, 1);
    atomic_store(&m->stage, 2);
    mw_surface_begin_update(m->surface);
    m->begun = 1;
    m->too_soon |= atomic_load(&m->stage) < 3;
    mw_surface_end_update(m->surface);
    return NULL;
}

static void test_update_waits(void **state)
{
    (void)state;
    mw_arrays nothing = {0};
    for (int round = 0; round < 100; round++) {
        meeting m = {0};
        assert_int_equal(
            mw_surface_create(&nothing, &(mw_surface_options){.shared = 1}, &m.surface, NULL),
            MW_OK);
        pthread_t thread[2];
        assert_int_equal(pthread_create(&thread[0], NULL, early_query, &m), 0);
        assert_int_equal(pthread_create(&thread[1], NULL, one_update, &m), 0);
        for (int i = 0; i < 2; i++) assert_int_equal(pthread_join(thread[i], NULL), 0);
        assert_true(m.begun && !m.too_soon);
        mw_surface_destroy(m.surface);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gate),
                                       cmocka_unit_test(test_update_waits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
