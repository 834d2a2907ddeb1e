/* test_surface_edit_threads.c - threads probe a surface while one thread edits and deforms it:
 * every answer is of a whole surface, and (under ThreadSanitizer) there is no data race. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/edit_require.h"
#include "oracle/surface/surface_twin.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { READERS = 3, EDITS = 300, PATH = 6 };

typedef struct edited_world {
    surface_twin twin;
    mw_probe_cursor certain[READERS], second[READERS],
        published[READERS]; /* made before the edits begin */
    mw_star_cursor ray[READERS];
    atomic_int editing, next;
    atomic_uint hits, met;
} edited_world;

static void *probe_all_the_time(void *argument)
{
    edited_world *w = argument;
    int me = atomic_fetch_add(&w->next, 1);
    uint64_t random = (uint64_t)me + 7;
    const mw_prober *prober = w->twin.prober;
    do {
        double q[6], one[3] = {1, 2, 3};
        for (int k = 0; k < 6; k++) q[k] = (double)mw__random_below(&random, 41) - 20.25;
        mw_touch touch = mw_probe(prober, &w->certain[me], q, q + 3);
        REQUIRE(touch.state == MW_TOUCH_HIT || touch.state == MW_TOUCH_NONE);
        if (touch.state == MW_TOUCH_HIT) {
            REQUIRE(touch.weight[0] >= 0 && touch.weight[1] >= 0 && touch.weight[2] >= 0);
            atomic_fetch_add(&w->hits, 1);
        }
        touch = mw_probe(prober, &w->published[me], q, q + 3);
        REQUIRE(touch.state == MW_TOUCH_HIT || touch.state == MW_TOUCH_LIMIT);
        mw_nearest_surface_point nearest;
        mw_location met = mw_star_locate(w->twin.star, &w->ray[me], q);
        REQUIRE(met.where == MW_BAD || met.triangle != MW_NONE);
        if (met.where != MW_BAD) atomic_fetch_add(&w->met, 1);
        touch = mw_probe(w->twin.second, &w->second[me], q, q + 3);
        REQUIRE(touch.state == MW_TOUCH_HIT || touch.state == MW_TOUCH_NONE);
        REQUIRE(mw_nearest_on_surface(prober, one, INFINITY, &nearest, NULL) == MW_OK);
    } while (atomic_load(&w->editing));
    return NULL;
}

/* Move all vertices a little, and know how far. */
static void deform(surface_twin *t)
{
    mw_surface_begin_update(t->surface);
    double *p = mw_surface_points(t->surface);
    for (uint32_t i = 0; i < t->now.points; i++) {
        p[3 * i] += 0.001;
        t->now.point[3 * i] = p[3 * i];
    }
    surface_twin_moved(t, 0.0011);
    mw_surface_end_update(t->surface);
}

static void test_probes_while_edited(void **state)
{
    (void)state;
    uint64_t random = 9;
    uint32_t path[2 * PATH];
    pthread_t reader[READERS];
    shape s = shape_ball(3, 15, 0.3, &random);
    edited_world w = {.twin = surface_twin_make(&s, 0)};
    edit_case.name = "threads";
    mw_probe_options certain = {.certain = 1};
    for (int i = 0; i < READERS; i++) {
        REQUIRE(mw_probe_cursor_init(w.twin.prober, &certain, &w.certain[i], NULL) == MW_OK);
        REQUIRE(mw_probe_cursor_init(w.twin.second, &certain, &w.second[i], NULL) == MW_OK);
        REQUIRE(mw_probe_cursor_init(w.twin.prober, NULL, &w.published[i], NULL) == MW_OK);
        REQUIRE(mw_star_cursor_init(w.twin.star, NULL, &w.ray[i], NULL) == MW_OK);
    }
    atomic_store(&w.editing, 1);
    for (int i = 0; i < READERS; i++)
        REQUIRE(pthread_create(&reader[i], NULL, probe_all_the_time, &w) == 0);
    while (atomic_load(&w.met) == 0) sched_yield(); /* before edits end the star-shaped surface */
    for (int i = 0; i < EDITS; i++) {
        mw_surface_edit edit = surface_twin_edit(&w.twin, path, PATH, &random);
        edit_case.step = (uint64_t)i;
        surface_twin_apply(&w.twin, &edit);
        if (i % 10 == 0) deform(&w.twin);
        if (i % 100 == 99) surface_twin_compact(&w.twin);
    }
    atomic_store(&w.editing, 0);
    for (int i = 0; i < READERS; i++) pthread_join(reader[i], NULL);
    REQUIRE(atomic_load(&w.hits) > 0);
    mw_surface_begin_update(w.twin.surface);
    surface_twin_moved(&w.twin, -1); /* boxes without slack */
    mw_surface_end_update(w.twin.surface);
    surface_twin_check(&w.twin, 10, &random);
    surface_twin_free(&w.twin);
    shape_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_probes_while_edited)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
