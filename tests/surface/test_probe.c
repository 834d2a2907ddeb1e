/* test_probe.c - probes: walks over surfaces along planes, against brute force in rationals. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "base/random.h"
#include "oracle/touch_oracle.h"
#include "support/meshes.h"
#include "support/shapes.h"

/* --- surfaces --------------------------------------------------------------------------------- */

typedef struct probe_world {
    const char *name;
    shape s;
    mw_surface_options options;
    mw_surface *surface;
    mw_prober *prober, *guided; /* the second one has a guide */
} probe_world;

enum { WORLDS = 10, STAR_SHAPED = 0, PATCH = 3 };

static probe_world worlds[WORLDS];

static mw_prober *prober_of(const mw_surface *surface, int guide)
{
    mw_prober_options options = {.boxes = 1, .guide = guide};
    mw_prober *prober;
    assert_int_equal(mw_prober_create(surface, &options, &prober, NULL), MW_OK);
    return prober;
}

static probe_world world_of(const char *name, shape s, mw_surface_options options)
{
    probe_world w = {.name = name, .s = s, .options = options};
    w.surface = shape_surface(&w.s, options);
    w.prober = prober_of(w.surface, 0);
    w.guided = prober_of(w.surface, 1);
    return w;
}

static void world_free(probe_world *w)
{
    mw_prober_destroy(w->prober);
    mw_prober_destroy(w->guided);
    mw_surface_destroy(w->surface);
    shape_free(&w->s);
}

static int make_worlds(void **state)
{
    (void)state;
    uint64_t random = 20;
    mw_surface_options plain = {0}, weld = {.weld = 1}, tolerant = {.tolerant = 1};
    worlds[STAR_SHAPED] = world_of("ball", shape_ball(4, 32, 0.3, &random), plain);
    worlds[1] = world_of("torus", shape_torus(12, 8, 4), plain);
    shape two = shape_join(shape_ball(3, 16, 0.2, &random), shape_ball(2, 8, 0.2, &random), 14);
    shape_shuffle(&two, &random);
    worlds[2] = world_of("two components", two, plain);
    worlds[PATCH] = world_of("patch", shape_patch(8, 5, &random), plain);
    shape clashing = shape_ball(4, 16, 0.2, &random);
    shape_clash(&clashing, 0.3, &random);
    worlds[4] = world_of("clashing", clashing, plain);
    shape flat = shape_ball(4, 16, 0.2, &random);
    shape_flatten(&flat, 0.1, &random);
    shape_shuffle(&flat, &random);
    worlds[5] = world_of("flat triangles", flat, plain);
    shape torn = shape_ball(4, 32, 0.5, &random);
    shape_tear(&torn, &random);
    shape_shuffle(&torn, &random);
    worlds[6] = world_of("welded", torn, weld);
    worlds[7] = world_of("plane", shape_patch(6, 0, &random), plain);
    worlds[8] = world_of("soup", shape_soup(12, 150, &random), tolerant);
    shape spoilt = shape_ball(4, 16, 0.2, &random);
    spoilt.points[7] = NAN;
    spoilt.points[60] = INFINITY;
    worlds[9] = world_of("not finite", spoilt, tolerant);
    return 0;
}

static int free_worlds(void **state)
{
    (void)state;
    for (int i = 0; i < WORLDS; i++) world_free(&worlds[i]);
    return 0;
}

static mw_probe_cursor cursor_of(const probe_world *w, mw_probe_options options)
{
    mw_probe_cursor cursor;
    assert_int_equal(mw_probe_cursor_init(w->prober, &options, &cursor, NULL), MW_OK);
    return cursor;
}

static mw_touch ask(const probe_world *w, mw_probe_cursor *cursor, const double query[6])
{
    return mw_probe(w->prober, cursor, query, query + 3);
}

/* --- what is right ---------------------------------------------------------------------------- */

static void check_fields(const touch_oracle *o, const mw_touch *touch)
{
    double sum = 0, expected = touch_oracle_distance(o, touch->triangle);
    int local, where = touch_oracle_where(o, touch->triangle, &local);
    assert_int_equal(touch->where, where);
    assert_int_equal(touch->local, local);
    assert_true(fabs(touch->distance - expected) <= 1e-12 * fabs(expected));
    for (int k = 0; k < 3; k++) {
        assert_true(touch->weight[k] >= 0);
        sum += touch->weight[k];
    }
    assert_true(fabs(sum - 1) < 1e-14);
}

/* A touch is one, in reach, with the lowest number at its place. */
static void check_touch(const probe_world *w, const touch_oracle *o, const mw_touch *touch,
                        double reach)
{
    if (touch->state != MW_TOUCH_HIT) {
        assert_int_equal(touch->triangle, MW_NONE);
        assert_true(isnan(touch->distance));
        return;
    }
    uint32_t t = touch->triangle;
    assert_true(t < o->count);
    assert_true(o->touched[t]);
    assert_true(touch_oracle_in_reach(o, t, reach));
    assert_int_equal(t, touch_oracle_lowest_linked(o, w->surface, t));
    check_fields(o, touch);
}

/* --- tests ------------------------------------------------------------------------------------ */

static void test_names(void **state)
{
    (void)state;
    assert_string_equal(mw_touch_state_name(MW_TOUCH_HIT), "hit");
    assert_string_equal(mw_touch_state_name(MW_TOUCH_NONE), "none");
    assert_string_equal(mw_touch_state_name(MW_TOUCH_LIMIT), "limit");
    assert_string_equal(mw_touch_state_name(MW_TOUCH_BAD), "bad");
    assert_null(mw_touch_state_name(MW_TOUCH_STATE_COUNT));
    assert_string_equal(mw_probe_start_name(MW_PROBE_START_AUTO), "auto");
    assert_string_equal(mw_probe_start_name(MW_PROBE_START_LAST), "last");
    assert_string_equal(mw_probe_start_name(MW_PROBE_START_SAMPLE), "sample");
    assert_string_equal(mw_probe_start_name(MW_PROBE_START_RANDOM), "random");
    assert_null(mw_probe_start_name(MW_PROBE_START_COUNT));
}

static void test_arguments(void **state)
{
    (void)state;
    const probe_world *w = &worlds[STAR_SHAPED];
    mw_probe_cursor cursor;
    mw_prober *bare;
    mw_touch touch;
    double query[6] = {0, 0, 1, 0, 0, 1};
    assert_int_equal(mw_probe_cursor_init(w->prober, NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_probe_cursor_init(NULL, NULL, &cursor, NULL), MW_ERROR_ARGUMENT);
    mw_probe_options options = {.start = MW_PROBE_START_COUNT};
    assert_int_equal(mw_probe_cursor_init(w->prober, &options, &cursor, NULL), MW_ERROR_ARGUMENT);
    const double wrong[] = {-1, NAN, -INFINITY};
    for (int i = 0; i < 3; i++) {
        options = (mw_probe_options){.max_distance = wrong[i]};
        assert_int_equal(mw_probe_cursor_init(w->prober, &options, &cursor, NULL),
                         MW_ERROR_ARGUMENT);
    }
    options = (mw_probe_options){.certain = 1};
    assert_int_equal(mw_prober_create(w->surface, NULL, &bare, NULL), MW_OK);
    assert_int_equal(mw_probe_cursor_init(bare, &options, &cursor, NULL), MW_ERROR_ARGUMENT);
    mw_prober_destroy(bare);
    assert_int_equal(mw_probe_batch(w->prober, query, 1, 5, NULL, &touch, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_probe_batch(w->prober, NULL, 1, 0, NULL, &touch, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_probe_batch(w->prober, query, 1, 0, NULL, NULL, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_probe_batch(w->prober, NULL, 0, 0, NULL, NULL, NULL, NULL), MW_OK);
}

/* k as in the thesis, which tells it for these numbers of vertices. */
static void test_sample_count(void **state)
{
    (void)state;
    static const uint32_t known[][2] = {{154, 10},  {2832, 28},  {6475, 36},
                                        {8036, 40}, {10002, 42}, {20002, 54}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        shape s = shape_make(known[i][0], 100);
        for (uint32_t v = 0; v < known[i][0]; v++) shape_point(&s, v, v % 7, v * v % 11);
        for (uint32_t t = 0; t < 100; t++) shape_triangle(&s, t, t + 1, t + 2);
        mw_surface *surface = shape_surface(&s, (mw_surface_options){.tolerant = 1});
        mw_prober *prober;
        mw_probe_cursor cursor;
        assert_int_equal(mw_prober_create(surface, NULL, &prober, NULL), MW_OK);
        assert_int_equal(mw_probe_cursor_init(prober, NULL, &cursor, NULL), MW_OK);
        assert_int_equal(cursor.options.samples, known[i][1]);
        mw_prober_destroy(prober);
        mw_surface_destroy(surface);
        shape_free(&s);
    }
}

static void test_bad_queries(void **state)
{
    (void)state;
    const probe_world *w = &worlds[STAR_SHAPED];
    const double bad[][6] = {{NAN, 0, 0, 0, 0, 1}, {0, 0, INFINITY, 0, 0, 1},
                             {0, 0, 0, 0, NAN, 1}, {0, 0, 0, -INFINITY, 0, 0},
                             {0, 0, 0, 0, 0, 0},   {0, 0, 0, 0, -0.0, 0}};
    for (int certain = 0; certain < 2; certain++) {
        mw_probe_cursor cursor =
            cursor_of(w, (mw_probe_options){.certain = certain, .counters = 1});
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
            mw_touch touch = ask(w, &cursor, bad[i]);
            assert_int_equal(touch.state, MW_TOUCH_BAD);
            assert_int_equal(touch.triangle, MW_NONE);
            assert_int_equal(touch.where, MW_BAD);
        }
        assert_int_equal(cursor.counters.queries, sizeof bad / sizeof *bad);
        assert_int_equal(cursor.counters.hits + cursor.counters.iterations, 0);
    }
}

/* A line that passes by, and one that touches: what the modes say. */
static void test_limit_or_none(void **state)
{
    (void)state;
    const probe_world *w = &worlds[STAR_SHAPED];
    const double past[6] = {1000, 0, 0, 0, 0, -1}, tiny[6] = {1e-3, 2e-3, 90, 0, 0, -1e-300};
    mw_probe_cursor walks = cursor_of(w, (mw_probe_options){.iterations = 7, .counters = 1});
    mw_probe_cursor certain = cursor_of(w, (mw_probe_options){.certain = 1});
    assert_int_equal(ask(w, &walks, past).state, MW_TOUCH_LIMIT);
    assert_int_equal(walks.counters.iterations, 7);
    assert_int_equal(ask(w, &certain, past).state, MW_TOUCH_NONE);
    assert_int_equal(ask(w, &walks, tiny).state, MW_TOUCH_HIT);
    assert_int_equal(ask(w, &certain, tiny).state, MW_TOUCH_HIT);
    assert_true(ask(w, &certain, tiny).distance > 50);
}

/* A surface that turns its back: no first triangle is found, the search ends. */
static void test_nothing_faces(void **state)
{
    (void)state;
    const probe_world *w = &worlds[PATCH];
    const double up[6] = {9, 9, -50, 0, 0, 1}, down[6] = {9, 9, -50, 0, 0, -1};
    for (int start = 0; start < MW_PROBE_START_COUNT; start++) {
        mw_probe_cursor cursor = cursor_of(
            w, (mw_probe_options){.start = (mw_probe_start)start, .samples = 5, .counters = 1});
        assert_int_equal(ask(w, &cursor, up).state, MW_TOUCH_LIMIT);
        assert_int_equal(cursor.counters.iterations, 10);
        assert_int_equal(cursor.counters.samples, 10 * 9 * 5);
        assert_int_equal(cursor.counters.triangles, 0);
        mw_touch touch = ask(w, &cursor, down);
        assert_int_equal(touch.state, MW_TOUCH_HIT);
        assert_true(touch.distance < -40); /* behind the probe */
    }
}

/* Every surface, start and reach: what is told of is true. */
static void test_touches_are_true(void **state)
{
    (void)state;
    enum { QUERIES = 250 };
    uint64_t random = 21;
    for (int i = 0; i < WORLDS; i++) {
        const probe_world *w = &worlds[i];
        size_t hits = 0, boundary = 0;
        double *query = shape_queries(&w->s, QUERIES, &random);
        for (size_t j = 0; j < QUERIES; j++) {
            const double *q = query + 6 * j;
            if (!touch_oracle_finite(q, 6)) continue;
            double reach = j % 3 == 0   ? 0
                           : j % 3 == 1 ? sqrt(q[3] * q[3] + q[4] * q[4] + q[5] * q[5])
                                        : INFINITY;
            mw_probe_options options = {.start = (mw_probe_start)(j % MW_PROBE_START_COUNT),
                                        .seed = j,
                                        .max_distance = reach};
            probe_world asked = *w;
            if (j % 8 < 4) asked.prober = w->guided;
            mw_probe_cursor cursor = cursor_of(&asked, options);
            touch_oracle o = touch_oracle_make(&w->s, q);
            for (int again = 0; again < 3; again++) {
                mw_touch touch = ask(&asked, &cursor, q);
                check_touch(w, &o, &touch, reach);
                hits += touch.state == MW_TOUCH_HIT;
                boundary += touch.state == MW_TOUCH_HIT && touch.where != MW_INSIDE;
            }
            touch_oracle_free(&o);
        }
        free(query);
        if (hits < QUERIES / 2 || boundary < QUERIES / 10)
            fail_msg("%s: %zu hits, of them %zu on edges and vertices", w->name, hits, boundary);
    }
}

/* A guide leads near the touch: without looking at a sample, to shorter walks. */
static void test_guide(void **state)
{
    (void)state;
    uint64_t random = 23;
    probe_world w = world_of("large ball", shape_ball(80, 4096, 0.1, &random),
                             (mw_surface_options){0}),
                guided = w;
    guided.prober = w.guided;
    mw_probe_cursor sampling = cursor_of(&w, (mw_probe_options){.counters = 1}),
                    guide = cursor_of(&guided, (mw_probe_options){.counters = 1});
    for (int i = 0; i < 2000; i++) {
        double q[6];
        for (int k = 0; k < 3; k++) {
            q[3 + k] = random_unit(&random) - 0.5;
            q[k] = -9000 * q[3 + k]; /* about at the ball, and into it */
        }
        assert_int_equal(ask(&w, &sampling, q).state, MW_TOUCH_HIT);
        assert_int_equal(ask(&guided, &guide, q).state, MW_TOUCH_HIT);
    }
    assert_true(5 * guide.counters.triangles < 3 * sampling.counters.triangles);
    assert_true(guide.counters.samples < sampling.counters.samples / 50);
    mw_prober_info info, plain;
    mw_prober_describe(w.guided, &info);
    mw_prober_describe(w.prober, &plain);
    assert_true(info.guide_bytes > 0 && info.guide_bytes < 3 * (size_t)w.s.triangle_count);
    assert_int_equal(info.bytes, plain.bytes + info.guide_bytes);
    assert_int_equal(plain.guide_bytes, 0);
    world_free(&w);
}

/* A plane through the centre cuts a star-shaped surface in one closed line: one walk is enough. */
static void test_through_the_centre(void **state)
{
    (void)state;
    const probe_world *w = &worlds[STAR_SHAPED];
    uint64_t random = 22;
    for (uint32_t i = 0; i < 600; i++) {
        double q[6] = {0}, scale = i % 3 == 0 ? -1 : -0.5;
        for (uint32_t k = 0; k < 3; k++) {
            double any = random_unit(&random) - 0.5;
            q[3 + k] = i % 2 ? w->s.points[3 * (size_t)(i / 2 % w->s.point_count) + k] : any;
            q[k] = scale * q[3 + k];
        }
        mw_probe_cursor cursor = cursor_of(w, (mw_probe_options){.iterations = 1, .seed = i});
        touch_oracle o = touch_oracle_make(&w->s, q);
        mw_touch touch = ask(w, &cursor, q);
        assert_int_equal(touch.state, MW_TOUCH_HIT);
        check_touch(w, &o, &touch, 0);
        touch_oracle_free(&o);
    }
}

/* With iterations enough every touch of a ball is found. */
static void test_finds_in_the_end(void **state)
{
    (void)state;
    const probe_world *w = &worlds[STAR_SHAPED];
    uint64_t random = 23;
    enum { QUERIES = 400 };
    double *query = shape_queries(&w->s, QUERIES, &random);
    size_t touched = 0;
    for (size_t j = 0; j < QUERIES; j++) {
        const double *q = query + 6 * j;
        touch_oracle o = touch_oracle_make(&w->s, q);
        uint32_t best = touch_oracle_best(&o, 0);
        mw_probe_cursor cursor = cursor_of(w, (mw_probe_options){.iterations = 1000, .seed = j});
        mw_touch touch = ask(w, &cursor, q);
        if ((touch.state == MW_TOUCH_HIT) != (best != MW_NONE))
            fail_msg("query %zu: %s", j, mw_touch_state_name((mw_touch_state)touch.state));
        touched += best != MW_NONE;
        touch_oracle_free(&o);
    }
    assert_true(touched > QUERIES / 2);
    free(query);
}

/* Certain mode: the best triangle of all, from any triangle before. */
static void test_certain(void **state)
{
    (void)state;
    enum { QUERIES = 150 };
    uint64_t random = 24;
    for (int i = 0; i < WORLDS; i++) {
        const probe_world *w = &worlds[i];
        double *query = shape_queries(&w->s, QUERIES, &random);
        mw_probe_cursor cursor =
            cursor_of(w, (mw_probe_options){.certain = 1, .race = i % 2 ? 4 : 0, .counters = 1});
        for (size_t j = 0; j < QUERIES; j++) {
            const double *q = query + 6 * j;
            if (!touch_oracle_finite(q, 6)) continue;
            double reach = j % 2 ? 0 : sqrt(q[3] * q[3] + q[4] * q[4] + q[5] * q[5]);
            cursor.options.max_distance = reach;
            touch_oracle o = touch_oracle_make(&w->s, q);
            uint32_t best = touch_oracle_best(&o, reach);
            mw_touch touch = ask(w, &cursor, q);
            assert_int_equal(touch.state, best == MW_NONE ? MW_TOUCH_NONE : MW_TOUCH_HIT);
            assert_int_equal(touch.triangle, best);
            if (best != MW_NONE) check_fields(&o, &touch);
            touch_oracle_free(&o);
        }
        free(query);
        assert_true(cursor.counters.triangles > 0); /* walks from the last triangle */
        assert_true(cursor.counters.triangles_max <= 64);
    }
}

/* In certain mode the walk from the last triangle is a short one. */
static void test_seed_is_short(void **state)
{
    (void)state;
    uint64_t random = 29;
    probe_world w = world_of("long patch", shape_patch(60, 3, &random), (mw_surface_options){0});
    const double far[6] = {238, 239, 20, 0, 0, -1}, past[6] = {250, 250, 20, 0, 0, -1};
    mw_probe_cursor cursor = cursor_of(
        &w, (mw_probe_options){.certain = 1, .start = MW_PROBE_START_LAST, .counters = 1});
    cursor.last = 0;
    mw_touch touch = ask(&w, &cursor, far);
    assert_int_equal(touch.state, MW_TOUCH_HIT);
    assert_int_equal(cursor.counters.triangles, 64);
    cursor.last = 0;
    assert_int_equal(ask(&w, &cursor, past).state, MW_TOUCH_NONE);
    assert_int_equal(cursor.counters.triangles, 128);
    world_free(&w);
}

/* The nearest of a sample is a better first triangle than any. */
static void test_sample_helps(void **state)
{
    (void)state;
    uint64_t random = 30;
    probe_world w =
        world_of("large ball", shape_ball(20, 1000, 0.1, &random), (mw_surface_options){0});
    uint64_t visited[2];
    for (int i = 0; i < 2; i++) {
        mw_probe_cursor cursor = cursor_of(
            &w, (mw_probe_options){.start = i ? MW_PROBE_START_RANDOM : MW_PROBE_START_SAMPLE,
                                   .counters = 1});
        for (uint32_t v = 0; v < w.s.point_count; v++) {
            const double *p = w.s.points + 3 * (size_t)v,
                         q[6] = {p[0], p[1], p[2], 0.5 - p[0], 0.25 - p[1], -p[2]};
            assert_int_equal(ask(&w, &cursor, q).state, MW_TOUCH_HIT);
        }
        visited[i] = cursor.counters.triangles;
    }
    assert_true(3 * visited[0] < 2 * visited[1]);
    world_free(&w);
}

/* The triangle touched before is the first of the next walk, if it faces the probe. */
static void test_coherence(void **state)
{
    (void)state;
    const probe_world *w = &worlds[STAR_SHAPED];
    mw_probe_cursor cursor =
        cursor_of(w, (mw_probe_options){.start = MW_PROBE_START_LAST, .counters = 1});
    double down[6] = {1, 2, 90, 0.01, 0.02, -1}, up[6] = {1, 2, 90, 0.01, 0.02, 1};
    assert_int_equal(ask(w, &cursor, down).state, MW_TOUCH_HIT);
    assert_true(cursor.counters.samples > 0);
    mw_probe_counters before = cursor.counters;
    assert_int_equal(ask(w, &cursor, down).state, MW_TOUCH_HIT);
    assert_int_equal(cursor.counters.samples, before.samples);
    assert_int_equal(cursor.counters.triangles, before.triangles + 1);
    assert_int_equal(cursor.counters.iterations, before.iterations + 1);
    assert_int_equal(cursor.counters.intersections, before.intersections + 1);
    assert_int_equal(ask(w, &cursor, up).state, MW_TOUCH_HIT);
    assert_true(cursor.counters.samples > before.samples);
    assert_int_equal(cursor.counters.queries, 3);
    assert_int_equal(cursor.counters.hits, 3);
}

/* Whether walks are counted changes no answer, also where the probe stays, or moves little, and
 * need not walk. */
static void test_counting(void **state)
{
    (void)state;
    enum { QUERIES = 200, STEPS = 6 };
    uint64_t random = 34;
    for (int i = 0; i < WORLDS; i++) {
        const probe_world *w = &worlds[i];
        double *query = shape_queries(&w->s, QUERIES, &random);
        mw_probe_cursor plain = cursor_of(w, (mw_probe_options){.start = MW_PROBE_START_LAST});
        mw_probe_cursor counted =
            cursor_of(w, (mw_probe_options){.start = MW_PROBE_START_LAST, .counters = 1});
        for (size_t j = 0; j < QUERIES * STEPS; j++) {
            double *q = query + j / STEPS * 6;
            if (j % STEPS > 1) q[j % 3] += 0.125 * (random_unit(&random) - 0.5);
            mw_touch one = ask(w, &plain, q), other = ask(w, &counted, q);
            assert_memory_equal(&one, &other, sizeof one);
        }
        free(query);
    }
}

/* By itself a probe begins at the triangle touched before where that is near, and looks for
 * another where it is not. */
static void test_auto(void **state)
{
    (void)state;
    uint64_t random = 31;
    probe_world w =
        world_of("large ball", shape_ball(20, 1000, 0.1, &random), (mw_surface_options){0});
    mw_probe_cursor cursor = cursor_of(&w, (mw_probe_options){.counters = 1});
    for (uint32_t v = 0; v < 40; v++) {
        const double *p = w.s.points + 3 * (size_t)(v % 2 ? v : w.s.point_count - 1 - v);
        double q[6] = {p[0], p[1], p[2], 0.5 - p[0], 0.25 - p[1], -p[2]};
        uint64_t before = cursor.counters.samples;
        assert_int_equal(ask(&w, &cursor, q).state, MW_TOUCH_HIT);
        uint64_t first = cursor.counters.samples - before;
        assert_int_equal(ask(&w, &cursor, q).state, MW_TOUCH_HIT); /* it is there already */
        assert_int_equal(cursor.counters.samples, before + first);
        for (int k = 0; k < 3; k++) {
            q[k] = -q[k]; /* the other side of the ball */
            q[3 + k] = -q[3 + k];
        }
        before = cursor.counters.samples;
        assert_int_equal(ask(&w, &cursor, q).state, MW_TOUCH_HIT);
        assert_true(cursor.counters.samples > before);
    }
    world_free(&w);
}

/* The path is what the counters count: no walk visits a triangle twice, its triangles are linked,
 * and it passes by none that is touched; on any surface. */
static void test_path(void **state)
{
    (void)state;
    enum { QUERIES = 150 };
    uint64_t random = 25;
    for (int i = 0; i < WORLDS; i++) {
        const probe_world *w = &worlds[i];
        uint32_t n = w->s.triangle_count, room = 11 * n, *path = malloc(room * sizeof *path),
                 *walk = malloc(room * sizeof *walk), *seen = calloc(n, sizeof *seen);
        double *query = shape_queries(&w->s, QUERIES, &random);
        size_t turned = 0;
        for (uint32_t j = 0; j < QUERIES; j++) {
            const double *q = query + 6 * (size_t)j;
            mw_probe_options options = {.counters = 1, .seed = j, .max_distance = j % 2 ? 1e-9 : 0};
            mw_probe_cursor cursor = cursor_of(w, options), other = cursor;
            mw_touch touch, same = ask(w, &other, q);
            size_t length = mw_probe_path(w->prober, &cursor, q, q + 3, path, walk, room, &touch);
            assert_memory_equal(&touch, &same, sizeof touch);
            assert_memory_equal(&cursor.counters, &other.counters, sizeof cursor.counters);
            assert_int_equal(length, cursor.counters.triangles);
            if (touch.state == MW_TOUCH_BAD) continue;
            assert_true(cursor.counters.iterations >= 1);
            uint32_t first = 0;
            touch_oracle o = touch_oracle_make(&w->s, q);
            for (uint32_t k = 0; k < length; k++) {
                int last = touch.state == MW_TOUCH_HIT && k + 1 == length;
                int touched =
                    o.touched[path[k]] && touch_oracle_in_reach(&o, path[k], options.max_distance);
                assert_int_equal(touched, last);
                assert_true(walk[k] < cursor.counters.iterations);
                int begins = k == 0 || walk[k] != walk[k - 1];
                if (begins) first = path[k];
                assert_int_not_equal(seen[path[k]], walk[k] + 1 + 20 * j);
                seen[path[k]] = walk[k] + 1 + 20 * j;
                int linked = begins, to_first = 0;
                for (uint32_t e = 0; e < 3 && !begins; e++) {
                    linked =
                        linked || mw_surface_neighbour(w->surface, path[k - 1], e, NULL) == path[k];
                    to_first =
                        to_first || mw_surface_neighbour(w->surface, first, e, NULL) == path[k];
                }
                assert_true(linked || to_first);
                turned += !linked;
            }
            touch_oracle_free(&o);
            uint32_t two[2] = {MW_NONE, MW_NONE};
            other = cursor_of(w, options);
            assert_int_equal(mw_probe_path(w->prober, &other, q, q + 3, two, NULL, 1, NULL),
                             length);
            assert_int_equal(two[1], MW_NONE);
            other = cursor_of(w, options);
            assert_int_equal(mw_probe_path(w->prober, &other, q, q + 3, NULL, NULL, 0, NULL),
                             length);
        }
        if (i == PATCH) assert_true(turned > 0);
        free(query);
        free(path);
        free(walk);
        free(seen);
    }
}

/* An iteration that starts near one border finds what lies beyond the first triangle, on the way
 * to the other border. */
static void test_border(void **state)
{
    (void)state;
    /* A strip of quadrangles bent upwards at its ends, and a line through its last one: from any
     * triangle that faces the line the walk must find it, to whatever side it sets out first. */
    enum { N = 12 };
    shape s = shape_make(2 * N + 2, 2 * N);
    for (int i = 0; i <= N; i++) {
        shape_point(&s, i, 0, (i - 6) * (i - 6) / 8.0);
        shape_point(&s, i, 4, (i - 6) * (i - 6) / 8.0);
    }
    for (uint32_t i = 0; i < N; i++) {
        shape_triangle(&s, 2 * i, 2 * i + 2, 2 * i + 3);
        shape_triangle(&s, 2 * i, 2 * i + 3, 2 * i + 1);
    }
    probe_world w = world_of("strip", s, (mw_surface_options){0});
    for (uint32_t first = 0; first < 2 * N; first++) {
        double q[6] = {11.5, 2.1, 20, 0, 0, -1};
        mw_probe_cursor cursor = cursor_of(
            &w, (mw_probe_options){.start = MW_PROBE_START_LAST, .iterations = 1, .counters = 1});
        cursor.last = first;
        mw_touch touch = ask(&w, &cursor, q);
        assert_int_equal(touch.state, MW_TOUCH_HIT);
        assert_true(touch.triangle >= 2 * N - 2);
        q[0] = -0.5; /* beyond the border: the walk goes to both ends */
        cursor = cursor_of(
            &w, (mw_probe_options){.start = MW_PROBE_START_LAST, .iterations = 1, .counters = 1});
        cursor.last = first;
        assert_int_equal(ask(&w, &cursor, q).state, MW_TOUCH_LIMIT);
        assert_true(cursor.counters.triangles <= 2 * N);
        assert_true(cursor.counters.triangles >= 2 * (first / 2 + 1) - 1);
    }
    world_free(&w);
}

/* The line through the middle of the first triangle, through its corners and along its plane. */
static void test_degenerate_planes(void **state)
{
    (void)state;
    shape s = shape_make(4, 4);
    shape_point(&s, 0, 0, 0);
    shape_point(&s, 3, 0, 0);
    shape_point(&s, 0, 3, 0);
    shape_point(&s, 0, 0, 3);
    static const uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (int i = 0; i < 4; i++) shape_triangle(&s, faces[i][0], faces[i][1], faces[i][2]);
    probe_world w = world_of("tetrahedron", s, (mw_surface_options){0});
    const double lines[][6] = {{1, 1, 1, -1, -1, -1}, {0, 0, 3, 0, 0, -1},   {3, 0, 0, -1, 0, 0},
                               {0, 0, 3, -1, -1, -2}, {3, 0, 0, -2, -1, -1}, {1, 0, 0, 0, 1, 0},
                               {2, 1, 0, -1, -1, -1}, {1, 1, 0, 0, 0, 1}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        touch_oracle o = touch_oracle_make(&w.s, lines[i]);
        uint32_t best = touch_oracle_best(&o, 0);
        for (uint32_t first = 0; first < 4; first++) {
            mw_probe_cursor cursor =
                cursor_of(&w, (mw_probe_options){.start = MW_PROBE_START_LAST, .iterations = 200});
            cursor.last = first;
            mw_touch touch = ask(&w, &cursor, lines[i]);
            check_touch(&w, &o, &touch, 0);
            assert_int_equal(touch.triangle, best);
        }
        touch_oracle_free(&o);
    }
    mw_probe_cursor cursor = cursor_of(&w, (mw_probe_options){.start = MW_PROBE_START_LAST,
                                                              .iterations = 1,
                                                              .max_distance = 1e-9,
                                                              .counters = 1});
    const double middle[6] = {2, 2, 2, -1, -1, -1};
    cursor.last = 2; /* its middle (1, 1, 1) lies on the line and spans no plane with it */
    assert_int_equal(ask(&w, &cursor, middle).state, MW_TOUCH_LIMIT);
    assert_true(cursor.counters.triangles > 1);
    world_free(&w);
}

/* Coordinates as far apart as doubles are. */
static void test_extremes(void **state)
{
    (void)state;
    uint64_t random = 26;
    const double scales[] = {0x1p-1000, 0x1p-200, 0x1p300, 0x1p1000};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        shape s = shape_ball(3, 32, 0.3, &random);
        double *query = shape_queries(&s, 60, &random);
        for (uint32_t k = 0; k < 3 * s.point_count; k++) s.points[k] *= scales[i];
        probe_world w = world_of("scaled", s, (mw_surface_options){0});
        size_t hits = 0;
        for (size_t j = 0; j < 60; j++) {
            double *q = query + 6 * j;
            for (int k = 0; k < 3; k++) q[k] *= scales[i];
            touch_oracle o = touch_oracle_make(&w.s, q);
            mw_probe_cursor cursor = cursor_of(&w, (mw_probe_options){.seed = j});
            mw_touch touch = ask(&w, &cursor, q);
            if (touch.state == MW_TOUCH_HIT) {
                assert_true(o.touched[touch.triangle]);
                assert_int_equal(touch.triangle,
                                 touch_oracle_lowest_linked(&o, w.surface, touch.triangle));
                hits++;
            }
            touch_oracle_free(&o);
        }
        assert_true(hits > 30);
        free(query);
        world_free(&w);
    }
}

/* Vertices that were welded and are moved apart: walks still end, and tell the truth. */
static void test_welded_moved_apart(void **state)
{
    (void)state;
    uint64_t random = 27;
    shape s = shape_ball(4, 32, 0.3, &random);
    shape_tear(&s, &random);
    probe_world w = world_of("apart", s, (mw_surface_options){.weld = 1});
    mw_surface_begin_update(w.surface);
    double *points = mw_surface_points(w.surface);
    for (uint32_t i = 0; i < 3 * w.s.point_count; i++)
        points[i] = w.s.points[i] += mw__random_below(&random, 5) - 2.0;
    mw_prober_update(w.prober, -1, 1);
    mw_surface_end_update(w.surface);
    double *query = shape_queries(&w.s, 300, &random);
    size_t hits = 0;
    for (size_t j = 0; j < 300; j++) {
        const double *q = query + 6 * j;
        mw_probe_cursor cursor = cursor_of(&w, (mw_probe_options){.seed = j, .counters = 1});
        touch_oracle o = touch_oracle_make(&w.s, q);
        mw_touch touch = ask(&w, &cursor, q);
        if (touch.state == MW_TOUCH_HIT) assert_true(o.touched[touch.triangle]);
        assert_true(cursor.counters.triangles <= 10 * w.s.triangle_count);
        hits += touch.state == MW_TOUCH_HIT;
        touch_oracle_free(&o);
    }
    assert_true(hits > 100);
    free(query);
    world_free(&w);
}

/* After an update without the prober: certain probes say so, walks go on. */
static void test_out_of_date(void **state)
{
    (void)state;
    uint64_t random = 28;
    probe_world w =
        world_of("updated", shape_ball(3, 32, 0.3, &random), (mw_surface_options){.shared = 1});
    const double q[6] = {1, 2, 90, 0.01, 0.02, -1};
    mw_probe_cursor walks = cursor_of(&w, (mw_probe_options){0});
    mw_probe_cursor certain = cursor_of(&w, (mw_probe_options){.certain = 1});
    mw_touch before = ask(&w, &certain, q);
    assert_int_equal(before.state, MW_TOUCH_HIT);
    mw_surface_begin_update(w.surface);
    double *points = mw_surface_points(w.surface);
    for (uint32_t i = 0; i < w.s.point_count; i++) points[3 * i + 2] += 8;
    mw_surface_end_update(w.surface);
    assert_int_equal(ask(&w, &certain, q).state, MW_TOUCH_BAD);
    mw_touch moved = ask(&w, &walks, q);
    assert_int_equal(moved.state, MW_TOUCH_HIT);
    assert_true(fabs(moved.distance - before.distance) > 7);
    mw_surface_begin_update(w.surface);
    mw_prober_update(w.prober, -1, 1);
    mw_surface_end_update(w.surface);
    mw_touch after = ask(&w, &certain, q);
    assert_int_equal(after.state, MW_TOUCH_HIT);
    assert_true(fabs(after.distance - moved.distance) < 1e-9);
    world_free(&w);
}

/* One triangle, from its front and from its back. */
static void test_single_triangle(void **state)
{
    (void)state;
    shape s = shape_make(3, 1);
    shape_point(&s, 0, 0, 0);
    shape_point(&s, 4, 0, 0);
    shape_point(&s, 0, 4, 0);
    shape_triangle(&s, 0, 1, 2);
    probe_world w = world_of("triangle", s, (mw_surface_options){0});
    mw_probe_cursor cursor = cursor_of(&w, (mw_probe_options){.max_distance = 5});
    const double on[6] = {1, 1, 5, 0, 0, -3}, below[6] = {1, 1, -5, 0, 0, -3},
                 above[6] = {1, 1, 5.001, 0, 0, -3}, back[6] = {1, 1, 5, 0, 0, 3},
                 beside[6] = {3, 3, 1, 0, 0, -1}, edge[6] = {2, 2, 1, 0, 0, -1};
    mw_touch touch = ask(&w, &cursor, on);
    assert_int_equal(touch.state, MW_TOUCH_HIT);
    assert_true(touch.distance == 5);
    assert_true(ask(&w, &cursor, below).distance == -5);
    assert_int_equal(ask(&w, &cursor, above).state, MW_TOUCH_LIMIT);
    assert_int_equal(ask(&w, &cursor, back).state, MW_TOUCH_LIMIT);
    assert_int_equal(ask(&w, &cursor, beside).state, MW_TOUCH_LIMIT);
    touch = ask(&w, &cursor, edge);
    assert_int_equal(touch.where, MW_ON_EDGE);
    assert_int_equal(touch.local, 1);
    world_free(&w);
}

/* --- counters --------------------------------------------------------------------------------- */

static void test_counters_add_up(void **state)
{
    (void)state;
    enum { COUNT = sizeof(mw_probe_counters) / sizeof(uint64_t) };
    const size_t most[] = {offsetof(mw_probe_counters, triangles_max),
                           offsetof(mw_probe_counters, tests_max),
                           offsetof(mw_probe_counters, iterations_max)};
    uint64_t a[COUNT], b[COUNT], sum[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        a[i] = sum[i] = 100 + i;
        b[i] = i % 2 ? 7 : 1000 + i;
    }
    mw_probe_counters_add((mw_probe_counters *)sum, (const mw_probe_counters *)b);
    for (size_t i = 0; i < COUNT; i++) {
        bool is_most = false;
        for (size_t k = 0; k < 3; k++) is_most = is_most || most[k] == i * sizeof *sum;
        assert_int_equal(sum[i], !is_most ? a[i] + b[i] : a[i] > b[i] ? a[i] : b[i]);
    }
}

/* A line through a ball, from a random first triangle: each triangle of the walk takes two tests,
 * the first one four; the one that is touched one more; and each look for a first triangle one. */
static void test_counters_of_a_walk(void **state)
{
    (void)state;
    uint64_t random = 41;
    enum { LINES = 300 };
    probe_world w = world_of("round", shape_ball(8, 4096, 0, &random), (mw_surface_options){0});
    mw_probe_counters sum = {0}, each[LINES];
    double *query = calloc(LINES, 6 * sizeof *query);
    for (size_t i = 0; i < LINES; i++) {
        double *q = query + 6 * i;
        for (int k = 0; k < 3; k++) q[3 + k] = random_unit(&random) - 0.5;
        for (int k = 0; k < 3; k++) q[k] = 900 * (random_unit(&random) - 0.5) - 30000 * q[3 + k];
        mw_probe_cursor cursor = cursor_of(
            &w, (mw_probe_options){.start = MW_PROBE_START_RANDOM, .seed = i, .counters = 1});
        assert_int_equal(ask(&w, &cursor, q).state, MW_TOUCH_HIT);
        const mw_probe_counters *c = &cursor.counters;
        assert_int_equal(c->queries, 1);
        assert_int_equal(c->hits, 1);
        assert_int_equal(c->iterations, 1);
        assert_int_equal(c->intersections, 1);
        assert_int_equal(c->tests, 2 * c->triangles + 2 + 1 + c->samples);
        assert_int_equal(c->tests_max, c->tests);
        assert_int_equal(c->triangles_max, c->triangles);
        assert_int_equal(c->iterations_max, 1);
        assert_int_equal(c->boxes + c->box_triangles, 0);
        each[i] = *c;
        mw_probe_counters_add(&sum, c);
    }
    uint64_t tests = 0, longest = 0;
    for (size_t i = 0; i < LINES; i++) {
        tests += each[i].tests;
        if (each[i].tests > longest) longest = each[i].tests;
    }
    assert_int_equal(sum.tests, tests);
    assert_int_equal(sum.tests_max, longest);
    assert_true(sum.triangles > 5 * LINES);
    free(query);
    world_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counters_add_up),
        cmocka_unit_test(test_counters_of_a_walk),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_sample_count),
        cmocka_unit_test(test_bad_queries),
        cmocka_unit_test(test_limit_or_none),
        cmocka_unit_test(test_nothing_faces),
        cmocka_unit_test(test_touches_are_true),
        cmocka_unit_test(test_through_the_centre),
        cmocka_unit_test(test_finds_in_the_end),
        cmocka_unit_test(test_certain),
        cmocka_unit_test(test_seed_is_short),
        cmocka_unit_test(test_sample_helps),
        cmocka_unit_test(test_coherence),
        cmocka_unit_test(test_counting),
        cmocka_unit_test(test_auto),
        cmocka_unit_test(test_guide),
        cmocka_unit_test(test_path),
        cmocka_unit_test(test_border),
        cmocka_unit_test(test_degenerate_planes),
        cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_welded_moved_apart),
        cmocka_unit_test(test_out_of_date),
        cmocka_unit_test(test_single_triangle),
    };
    return cmocka_run_group_tests(tests, make_worlds, free_worlds);
}
