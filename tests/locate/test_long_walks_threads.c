/* test_long_walks_threads.c - meshes that lie badly where no walk was tried: long walks are paid
 * for until chains are made for all tiles, and from then on no walk is long. Steps are counted, not
 * timed. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "base/threads.h"
#include "locate/locator.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LIMIT = 64, SHORT = LIMIT + 4, PRICE = 16, BLOCK = 512 };

/* --- meshes ----------------------------------------------------------------------------------- */

/* A vertex at the origin with `spokes` edges to a circle, among others outside of it. */
static mw_mesh *wheel(uint32_t spokes, uint32_t others, uint64_t *random)
{
    uint32_t n = 1 + spokes;
    double *at = calloc(2 * (size_t)(1 + spokes + others), sizeof *at);
    assert_non_null(at);
    for (uint32_t i = 1; i <= spokes; i++) {
        const double angle = 6.28318530717958648 * i / spokes;
        at[2 * i] = 0.09 * cos(angle);
        at[2 * i + 1] = 0.09 * sin(angle);
    }
    while (n < 1 + spokes + others) {
        const double x = 2 * random_unit(random) - 1, y = 2 * random_unit(random) - 1;
        if (hypot(x, y) < 0.1) continue;
        at[2 * n] = x;
        at[2 * n++ + 1] = y;
    }
    mw_mesh *mesh = mesh_delaunay(at, n);
    free(at);
    return mesh;
}

/* Points close to the middle of the wheel. */
static void draw(double *q, uint32_t n, uint64_t *random)
{
    for (uint32_t i = 0; i < n; i++) {
        const double angle = 6.28318530717958648 * random_unit(random),
                     radius = exp2(-8 - 30 * random_unit(random));
        q[2 * i] = radius * cos(angle);
        q[2 * i + 1] = radius * sin(angle);
    }
}

static mw_locator_info describe(const mw_locator *locator)
{
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    return info;
}

static uint64_t owed(const mw_locator *locator)
{
    return atomic_load_explicit(&locator->late->owed, memory_order_relaxed);
}

/* A locator that has no chains at first. */
typedef struct unseen {
    mw_mesh *mesh;
    mw_locator *locator;
} unseen;

static void unseen_release(unseen *u)
{
    mw_locator_destroy(u->locator);
    mw_mesh_destroy(u->mesh);
}

/* Look for a wheel that no walk finds which is tried while the locator is made. */
static unseen unseen_wheel(uint32_t spokes, uint32_t others, uint32_t no_late_chains,
                           uint64_t *random)
{
    enum { TRIES = 200 };
    for (int i = 0; i < TRIES; i++) {
        unseen u = {.mesh = wheel(spokes, others, random)};
        u.locator = mesh_locator(
            u.mesh, (mw_locator_options){.threads = 1, .no_late_chains = no_late_chains});
        if (describe(u.locator).chain_bytes == 0) return u;
        unseen_release(&u);
    }
    fail_msg("all wheels were found");
    return (unseen){0};
}

/* --- ways to ask ------------------------------------------------------------------------------ */

/* The answers, and of the triangles visited: the most of one query; all beyond LIMIT of those over
 * SHORT, which is not known of a batch. */
typedef struct asked {
    mw_location at[BLOCK];
    uint64_t most, beyond;
} asked;

typedef void ask(const mw_locator *locator, const double *q, uint32_t n, asked *a);

static void ask_alone(const mw_locator *locator, const double *q, uint32_t n, asked *a)
{
    const mw_query_options options = {.counters = 1};
    for (uint32_t i = 0; i < n; i++) {
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
        a->at[i] = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        const uint64_t visited = cursor.counters.triangles_max;
        if (visited > a->most) a->most = visited;
        a->beyond += visited > SHORT ? visited - LIMIT : 0;
    }
}

/* One cursor for all, and no counters: by the fast path. */
static void ask_fast(const mw_locator *locator, const double *q, uint32_t n, asked *a)
{
    mw_cursor cursor = {0};
    for (uint32_t i = 0; i < n; i++) a->at[i] = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
}

static void ask_batch_by(const mw_locator *locator, const double *q, uint32_t n,
                         mw_query_options options, asked *a)
{
    mw_counters counters = {0};
    assert_int_equal(mw_locate_batch(locator, q, n, 2, &options, a->at, &counters, NULL), MW_OK);
    a->most = counters.triangles_max;
}

static void ask_counted_batch(const mw_locator *locator, const double *q, uint32_t n, asked *a)
{
    ask_batch_by(locator, q, n, (mw_query_options){.counters = 1}, a);
}

static void ask_batch(const mw_locator *locator, const double *q, uint32_t n, asked *a)
{
    ask_batch_by(locator, q, n, (mw_query_options){0}, a);
}

/* Each query has a hint, which is near or not. */
static void ask_with_hints(const mw_locator *locator, const double *q, uint32_t n, asked *a)
{
    uint32_t hints[BLOCK];
    for (uint32_t i = 0; i < n; i++) hints[i] = i * 7919 % mw_mesh_triangle_count(locator->mesh);
    ask_batch_by(locator, q, n, (mw_query_options){.hints = hints}, a);
}

/* The beginnings of segments: each begins where a piece of it does. */
static void ask_segments(const mw_locator *locator, const double *q, uint32_t n, asked *a)
{
    mw_segment_pieces pieces;
    double *segments = malloc(4 * (size_t)n * sizeof *segments);
    assert_non_null(segments);
    for (uint32_t i = 0; i < n; i++) {
        const double ends[4] = {q[2 * i], q[2 * i + 1], q[2 * i] * (i % 2 ? 1 : 1.0001),
                                q[2 * i + 1]};
        memcpy(&segments[4 * (size_t)i], ends, sizeof ends);
    }
    assert_int_equal(mw_segment_batch(locator, segments, n, 4, NULL, &pieces, NULL), MW_OK);
    ask_fast(locator, q, n, a);
    for (uint32_t i = 0; i < n; i++) {
        assert_true(pieces.offset[i] < pieces.offset[i + 1]);
        if (a->at[i].where == MW_INSIDE)
            assert_int_equal(pieces.piece[pieces.offset[i]].triangle, a->at[i].triangle);
    }
    mw_segment_pieces_release(&pieces);
    free(segments);
}

/* --- expectations ----------------------------------------------------------------------------- */

static void expect_answers(const mw_locator *locator, const double *q, uint32_t n,
                           const mw_location *at)
{
    mw_location want[BLOCK];
    const mw_query_options other = {
        .walk = MW_WALK_STRAIGHT, .start = MW_START_SORTED, .threads = 1};
    assert_int_equal(mw_locate_batch(locator, q, n, 2, &other, want, NULL, NULL), MW_OK);
    for (uint32_t i = 0; i < n; i++)
        if (memcmp(&at[i], &want[i], sizeof *at) != 0)
            fail_msg("query %u: triangle %u, not %u", i, at[i].triangle, want[i].triangle);
}

/* Ask until chains are there. Returns the sum of what was visited beyond LIMIT. */
static uint64_t pay(const mw_locator *locator, ask *way, uint64_t *random)
{
    enum { MOST_BLOCKS = 20000 };
    double q[2 * BLOCK];
    uint64_t beyond = 0;
    for (uint32_t i = 0; i < MOST_BLOCKS && describe(locator).chain_bytes == 0; i++) {
        asked a = {.most = 0};
        draw(q, BLOCK, random);
        way(locator, q, BLOCK, &a);
        if (i < 4) expect_answers(locator, q, BLOCK, a.at);
        beyond += a.beyond;
    }
    assert_true(describe(locator).chain_bytes > 0);
    return beyond;
}

/* From now on no query is long, whatever way it is asked. */
static void expect_short(const mw_locator *locator, uint64_t *random)
{
    static ask *const ways[] = {ask_alone, ask_fast,       ask_counted_batch,
                                ask_batch, ask_with_hints, ask_segments};
    const uint64_t before = owed(locator);
    double q[2 * BLOCK];
    for (uint32_t i = 0; i < 2 * sizeof ways / sizeof *ways; i++) {
        asked a = {.most = 0};
        draw(q, BLOCK, random);
        ways[i / 2](locator, q, BLOCK, &a);
        expect_answers(locator, q, BLOCK, a.at);
        assert_true(a.most <= SHORT);
    }
    assert_int_equal(owed(locator), before);
}

/* --- tests ------------------------------------------------------------------------------------ */

/* Small, middle, large. */
static const uint32_t sizes[][2] = {{150, 60}, {400, 600}, {600, 20000}};

static void test_paid(void **state)
{
    (void)state;
    static ask *const ways[] = {ask_alone, ask_fast,       ask_counted_batch,
                                ask_batch, ask_with_hints, ask_segments};
    uint64_t random = environment_print_seed("long walks", 83);
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t *size = sizes[i < 6 ? 1 : i == 6 ? 0 : 2];
        unseen u = unseen_wheel(size[0], size[1], 0, &random);
        const uint64_t tiles = u.locator->tiling.tri_count;
        const mw_locator_info before = describe(u.locator);
        const uint64_t beyond = pay(u.locator, ways[i % 6], &random);
        const mw_locator_info info = describe(u.locator);
        assert_true(owed(u.locator) > PRICE * tiles);
        /* what is asked after the chains is short */
        if (ways[i % 6] == ask_alone)
            assert_true(beyond > PRICE * tiles / 2 && beyond <= PRICE * tiles + tiles);
        assert_int_equal(info.bytes - before.bytes, info.chain_bytes);
        assert_int_equal(info.guide_bytes - before.guide_bytes, info.chain_bytes);
        assert_int_equal(info.guide, before.guide);
        expect_short(u.locator, &random);
        unseen_release(&u);
    }
}

/* Threads that ask at the same time. */
typedef struct team {
    const mw_locator *locator;
    uint64_t random[4];
    uint32_t wrong[4];
} team;

static void team_ask(void *work, uint32_t member)
{
    enum { QUERIES = 40000 };
    team *t = work;
    const mw_query_options other = {.walk = MW_WALK_STRAIGHT};
    mw_cursor cursor = {0}, straight;
    mw_location at, want;
    double q[2];
    if (mw_cursor_init(t->locator, &other, &straight, NULL)) abort();
    for (uint32_t i = 0; i < QUERIES; i++) {
        draw(q, 1, &t->random[member]);
        at = mw_locate(t->locator, &cursor, q[0], q[1]);
        if (i % 16) continue;
        want = mw_locate(t->locator, &straight, q[0], q[1]);
        t->wrong[member] += memcmp(&at, &want, sizeof at) != 0;
    }
}

static void test_threads(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("long walks of threads", 89);
    unseen u = unseen_wheel(400, 600, 0, &random);
    team t = {.locator = u.locator, .random = {1, 2, 3, 4}};
    mw__team_run(4, team_ask, &t);
    for (uint32_t i = 0; i < 4; i++) assert_int_equal(t.wrong[i], 0);
    assert_true(describe(u.locator).chain_bytes > 0);
    expect_short(u.locator, &random);
    unseen_release(&u);
}

/* Where chains are not wanted, no query allocates, and the locator stays as it is. */
static void test_unwanted(void **state)
{
    (void)state;
    enum { QUERIES = 30000 };
    uint64_t random = environment_print_seed("no late chains", 97);
    unseen u = unseen_wheel(400, 600, 1, &random);
    const mw_locator_info before = describe(u.locator);
    double q[2 * BLOCK];
    asked a = {.most = 0};
    assert_null(u.locator->late);
    for (uint32_t i = 0; i < QUERIES / BLOCK; i++) {
        draw(q, BLOCK, &random);
        allocations_left = 0;
        ask_fast(u.locator, q, BLOCK, &a);
        assert_int_equal(allocations_left, 0);
        allocations_left = -1;
    }
    expect_answers(u.locator, q, BLOCK, a.at);
    ask_alone(u.locator, q, BLOCK, &a);
    assert_true(a.most > SHORT);
    const mw_locator_info info = describe(u.locator);
    assert_int_equal(info.bytes, before.bytes);
    assert_int_equal(info.chain_bytes, 0);
    unseen_release(&u);
}

/* If memory lacks, walks stay long and answers right, and it is not tried again. */
static void test_memory(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("late chains without memory", 101);
    bool made = false;
    uint32_t failures = 0;
    for (; !made; failures++) {
        unseen u = unseen_wheel(400, 600, 0, &random);
        const uint64_t limit = PRICE * (uint64_t)u.locator->tiling.tri_count;
        double q[2 * BLOCK];
        asked a = {.most = 0};
        allocations_left = failures;
        while (owed(u.locator) <= limit) {
            draw(q, 1, &random);
            ask_fast(u.locator, q, 1, &a);
        }
        made = allocations_left >= 0;
        assert_int_equal(describe(u.locator).chain_bytes > 0, made);
        allocations_left = 0;
        draw(q, BLOCK, &random);
        ask_fast(u.locator, q, BLOCK, &a);
        assert_int_equal(allocations_left, 0);
        allocations_left = -1;
        expect_answers(u.locator, q, BLOCK, a.at);
        unseen_release(&u);
    }
    assert_true(failures > 8);
}

/* A mapped file makes its own. */
static void test_mapped(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("late chains of a map", 103);
    mw_error error;
    unseen u = unseen_wheel(400, 600, 0, &random);
    char path[] = "test_long_walks_threads.mwm";
    expect_ok(mw_write_prepared(u.locator, path, NULL, &error), "write", &error);
    for (int i = 0; i < 3; i++) {
        mw_prepared *prepared;
        const mw_map_options options = {.trust = i == 1, .no_late_chains = i == 2};
        expect_ok(mw_mesh_map(path, &options, &prepared, &error), "map", &error);
        const mw_locator *locator = mw_prepared_locator(prepared);
        assert_int_equal(describe(locator).chain_bytes, 0);
        assert_int_equal(!locator->late, i == 2);
        if (i < 2) {
            pay(locator, ask_batch, &random);
            expect_short(locator, &random);
        }
        mw_prepared_close(prepared);
    }
    remove(path);
    unseen_release(&u);
}

/* Where queries are spread evenly, none pays. */
static void test_good(void **state)
{
    (void)state;
    enum { POINTS = 20000 };
    uint64_t random = environment_print_seed("short walks", 107);
    double *p = malloc(2 * POINTS * sizeof *p), q[2 * BLOCK];
    assert_non_null(p);
    for (uint32_t i = 0; i < 2 * POINTS; i++) p[i] = random_unit(&random);
    mw_mesh *mesh = mesh_delaunay(p, POINTS);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.threads = 1});
    for (uint32_t i = 0; i < 40; i++) {
        asked a = {.most = 0};
        for (uint32_t k = 0; k < 2 * BLOCK; k++) q[k] = random_unit(&random);
        (i % 2 ? ask_batch : ask_fast)(locator, q, BLOCK, &a);
    }
    assert_int_equal(owed(locator), 0);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_paid),     cmocka_unit_test(test_threads),
        cmocka_unit_test(test_unwanted), cmocka_unit_test(test_memory),
        cmocka_unit_test(test_mapped),   cmocka_unit_test(test_good),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
