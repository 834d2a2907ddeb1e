/* test_auto.c - what batches choose by: the caches, how much of the mesh queries touch, the order
 * in which they come. And that answers are the same whatever is chosen. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "locate/batch_profile.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 100 }; /* a grid has 20,000 triangles, 800 KB */

/* --- queries over a mesh of 0..SIDE, whose edges are about 1 long ----------------------------- */

typedef enum query_spread { ANYWHERE, SMALL_PART, PATH, STEPS, ROWS, ODD, SPREADS } query_spread;

/* A path of steps of one length, that turns and does not leave the mesh. */
static void draw_path(double *q, size_t n, size_t stride, double step, uint64_t *random)
{
    double x = SIDE / 2.0, y = SIDE / 3.0, heading = 0;
    for (size_t i = 0; i < n; i++) {
        double dx, dy;
        do {
            heading += random_unit(random) - 0.4;
            dx = step * cos(heading);
            dy = step * sin(heading);
        } while (x + dx < 0 || x + dx > SIDE || y + dy < 0 || y + dy > SIDE);
        q[i * stride] = x += dx;
        q[i * stride + 1] = y += dy;
    }
}

static void draw_rows(double *q, size_t n, size_t stride)
{
    size_t columns = (size_t)sqrt((double)n) + 1;
    for (size_t i = 0; i < n; i++) {
        q[i * stride] = SIDE * (double)(i % columns) / (double)columns;
        q[i * stride + 1] = SIDE * (double)(i / columns) / (double)columns;
    }
}

static void draw_box(double *q, size_t n, size_t stride, double from, double to, uint64_t *random)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 2; k++) q[i * stride + k] = from + (to - from) * random_unit(random);
}

/* n queries; what lies between the points, if stride is over 2, is no number. */
static double *draw(query_spread kind, size_t n, size_t stride, uint64_t *random)
{
    double *q = malloc((n * stride + 1) * sizeof *q);
    assert_non_null(q);
    for (size_t i = 0; i < n * stride; i++) q[i] = NAN;
    switch (kind) {
    case ANYWHERE: draw_box(q, n, stride, -0.1 * SIDE, 1.1 * SIDE, random); break;
    case SMALL_PART: draw_box(q, n, stride, 0.4 * SIDE, 0.5 * SIDE, random); break;
    case PATH: draw_path(q, n, stride, 0.05, random); break;
    case STEPS: draw_path(q, n, stride, 1, random); break;
    case ROWS: draw_rows(q, n, stride); break;
    default: /* a path with what is no point, or far away, in it */
        draw_path(q, n, stride, 0.05, random);
        for (size_t i = 0; i < n; i += 1 + mw__random_below(random, 64)) {
            const double odd[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300};
            q[i * stride + mw__random_below(random, 2)] = odd[mw__random_below(random, 5)];
        }
        break;
    }
    return q;
}

/* --- answers ---------------------------------------------------------------------------------- */

typedef struct ask {
    const mw_locator *locator;
    const double *q;
    size_t n, stride;
} ask;

static mw_counters answer(const ask *a, mw_query_options options, mw_location *at)
{
    mw_error error;
    mw_counters counters;
    memset(at, 0x55, a->n * sizeof *at);
    expect_ok(mw_locate_batch(a->locator, a->q, a->n, a->stride, &options, at, &counters, &error),
              "batch", &error);
    return counters;
}

static void expect_same(const mw_location *want, const mw_location *got, const ask *a,
                        const char *how)
{
    for (size_t i = 0; i < a->n; i++)
        if (memcmp(&want[i], &got[i], sizeof *want) != 0)
            fail_msg("%s: query %zu of %zu, (%.17g, %.17g): triangle %u where %d, not %u %d", how,
                     i, a->n, a->q[i * a->stride], a->q[i * a->stride + 1], got[i].triangle,
                     got[i].where, want[i].triangle, want[i].where);
}

static void expect_auto(const ask *a)
{
    mw_location *want = malloc((a->n + 1) * sizeof *want), *got = malloc((a->n + 1) * sizeof *got);
    assert_non_null(want);
    assert_non_null(got);
    answer(a, (mw_query_options){.start = MW_START_SAMPLE, .counters = 1, .threads = 1}, want);
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        answer(a, (mw_query_options){.threads = threads}, got);
        expect_same(want, got, a, "auto");
        answer(a, (mw_query_options){.threads = threads, .lanes = 5}, got);
        expect_same(want, got, a, "auto in 5 lanes");
    }
    mw_counters one = answer(a, (mw_query_options){.counters = 1, .threads = 1}, got);
    expect_same(want, got, a, "auto, counted");
    mw_counters three = answer(a, (mw_query_options){.counters = 1, .threads = 3}, got);
    assert_memory_equal(&one, &three, sizeof one);
    free(want);
    free(got);
}

static void expect_spreads(const mw_locator *locator, size_t most, uint64_t *random)
{
    static const size_t counts[] = {0, 1, 2, 5, 16, 63, 64, 65, 129, 700, 20000};
    for (query_spread kind = ANYWHERE; kind < SPREADS; kind++)
        for (size_t i = 0; i < sizeof counts / sizeof *counts && counts[i] <= most; i++) {
            size_t stride = 2 + i % 3;
            double *q = draw(kind, counts[i], stride, random);
            expect_auto(&(ask){locator, q, counts[i], stride});
            free(q);
        }
}

/* A Delaunay mesh of n points, nearly all of them in 40..43 of 0..100; along a curve in memory,
 * for the guide. */
static mw_mesh *refined_mesh(uint32_t n, uint64_t *random)
{
    double *point = malloc(2 * n * sizeof *point);
    assert_non_null(point);
    draw_box(point, n, 2, 0, SIDE, random);
    draw_box(point, n - 100, 2, 40, 43, random);
    mw_mesh *drawn = mesh_delaunay(point, n);
    arrays a = arrays_of_mesh(drawn);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){.layout = 1});
    mw_mesh_destroy(drawn);
    arrays_free(&a);
    free(point);
    return mesh;
}

/* By a grid, by the curve where vertices are crowded, and without a guide. */
static void test_answers(void **state)
{
    (void)state;
    uint64_t random = 31;
    print_message("seed %llu\n", (unsigned long long)random);
    arrays a = arrays_grid(SIDE, 0.5, &random), holed = arrays_grid(SIDE, 0.5, &random);
    arrays_punch(&holed, 0.1, &random);
    mw_mesh *mesh[] = {arrays_mesh(&a, (mw_mesh_options){0}), refined_mesh(10000, &random),
                       arrays_mesh(&holed, (mw_mesh_options){0})};
    const mw_start_kind guide[] = {MW_START_GRID, MW_START_CURVE, MW_START_AUTO};
    for (int i = 0; i < 3; i++) {
        mw_locator *locator = mesh_locator(mesh[i], (mw_locator_options){.fill = MW_FILL_NO});
        assert_int_equal(locator->guide.start, guide[i]);
        expect_spreads(locator, i == 2 ? 700 : SIZE_MAX, &random);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh[i]);
    }
    arrays_free(&a);
    arrays_free(&holed);
}

/* --- choices ---------------------------------------------------------------------------------- */

typedef struct auto_place {
    mw_mesh *mesh;
    mw_locator *locator;
} auto_place;

static int make_place(void **state)
{
    static auto_place p;
    uint64_t random = 32;
    arrays a = arrays_grid(SIDE, 0.5, &random);
    p.mesh = arrays_mesh(&a, (mw_mesh_options){0});
    p.locator = mesh_locator(p.mesh, (mw_locator_options){0});
    arrays_free(&a);
    *state = &p;
    return 0;
}

static int drop_place(void **state)
{
    auto_place *p = *state;
    mw_locator_destroy(p->locator);
    mw_mesh_destroy(p->mesh);
    return 0;
}

static void test_caches(void **state)
{
    (void)state;
    mw_caches a = mw__caches(), b = mw__caches();
    assert_true(a.second > 0);
    assert_true(a.reach >= a.second);
    assert_int_equal(a.second, b.second);
    assert_int_equal(a.reach, b.reach);
}

static mw_cache_level level_of_queries(const auto_place *p, const mw_caches *caches,
                                       const double *q, size_t n)
{
    return mw__cache_level_of_queries(p->locator, caches, &(mw_queries){q, n, 2});
}

static void test_room(void **state)
{
    const auto_place *p = *state;
    uint64_t random = 33;
    print_message("seed %llu\n", (unsigned long long)random);
    enum { N = 20000, FEW = 600, FEWER = 100 };
    const mw_caches small = {20000, 100000}, middling = {100000, 1000000},
                    large = {1000000, 2000000};
    assert_int_equal(mw__cache_level_of_mesh(p->locator, &small), MW_CACHE_NONE);
    assert_int_equal(mw__cache_level_of_mesh(p->locator, &middling), MW_CACHE_SHARED);
    assert_int_equal(mw__cache_level_of_mesh(p->locator, &large), MW_CACHE_OWN);
    double *all = draw(ANYWHERE, N, 2, &random), *part = draw(SMALL_PART, N, 2, &random);
    assert_int_equal(level_of_queries(p, &small, all, N), MW_CACHE_NONE);
    assert_int_equal(level_of_queries(p, &middling, all, N), MW_CACHE_SHARED);
    assert_int_equal(level_of_queries(p, &large, all, N), MW_CACHE_OWN);
    assert_int_equal(level_of_queries(p, &small, part, N), MW_CACHE_OWN); /* 8 KB */
    assert_int_equal(level_of_queries(p, &middling, part, N), MW_CACHE_OWN);
    assert_int_equal(level_of_queries(p, &small, part, FEW), MW_CACHE_OWN);
    assert_int_equal(level_of_queries(p, &small, part, FEWER), MW_CACHE_NONE); /* not looked at */
    for (size_t i = 0; i < N; i++) part[2 * i] = i % 2 ? NAN : part[2 * i];
    assert_int_equal(level_of_queries(p, &small, part, N), MW_CACHE_OWN);
    for (size_t i = 0; i < N; i++) part[2 * i] = part[2 * i + 1] = NAN;
    level_of_queries(p, &small, part, N);
    part[0] = -INFINITY;
    part[N] = INFINITY;
    part[1] = -1e300;
    level_of_queries(p, &small, part, N);
    const mw_caches quarter = {200000, 400000};
    draw_box(part, N, 2, 0.3 * SIDE, 0.7 * SIDE, &random); /* 128 KB */
    assert_int_equal(level_of_queries(p, &quarter, part, N), MW_CACHE_OWN);
    /* seldom met again */
    assert_int_equal(level_of_queries(p, &quarter, part, FEW), MW_CACHE_NONE);
    free(all);
    free(part);
}

/* Nearly all tiles lie in a thousandth of the extent. */
static void test_refined(void **state)
{
    (void)state;
    uint64_t random = 34;
    print_message("seed %llu\n", (unsigned long long)random);
    enum { N = 20000 };
    double *q = malloc(2 * N * sizeof *q);
    assert_non_null(q);
    mw_mesh *mesh = refined_mesh(10000, &random);
    auto_place p = {mesh, mesh_locator(mesh, (mw_locator_options){0})};
    const mw_caches caches = {20000, 100000};
    draw_box(q, N, 2, 40, 43, &random);
    assert_int_equal(level_of_queries(&p, &caches, q, N), MW_CACHE_NONE);
    draw_box(q, N, 2, 70, 73, &random);
    assert_int_equal(level_of_queries(&p, &caches, q, N), MW_CACHE_OWN);
    mw_locator_destroy(p.locator);
    mw_mesh_destroy(mesh);
    free(q);
}

/* How queries of a kind are judged, with `change` made to one of them. */
typedef struct verdict {
    bool densely, in_order;
} verdict;

static verdict judge(const auto_place *p, query_spread kind, size_t n, size_t at, double change,
                     uint64_t *random)
{
    double *q = draw(kind, n, 3, random);
    if (at < n) q[3 * at] = change;
    mw_queries queries = {q, n, 3};
    verdict v = {mw__queries_are_dense(p->locator, &queries),
                 mw__queries_are_in_order(p->locator, &queries)};
    free(q);
    return v;
}

static void expect_verdict(verdict v, bool densely, bool in_order)
{
    assert_int_equal(v.densely, densely);
    assert_int_equal(v.in_order, in_order);
}

static void test_order(void **state)
{
    const auto_place *p = *state;
    uint64_t random = 35;
    print_message("seed %llu\n", (unsigned long long)random);
    for (size_t n = 64; n <= 16384; n *= 4) {
        size_t no = n;
        expect_verdict(judge(p, ANYWHERE, n, no, 0, &random), false, false);
        expect_verdict(judge(p, PATH, n, no, 0, &random), true, true);
        expect_verdict(judge(p, PATH, n, n / 2, NAN, &random), false, false);
        expect_verdict(judge(p, PATH, n, n - 1, INFINITY, &random), false, false);
        expect_verdict(judge(p, PATH, n, 0, -1e300, &random), false, false);
        assert_false(judge(p, STEPS, n, no, 0, &random).densely);
    }
    expect_verdict(judge(p, ROWS, 1000000, 1000000, 0, &random), true, true);
    /* steps of 1.4, and back */
    expect_verdict(judge(p, ROWS, 5000, 5000, 0, &random), false, false);
    assert_true(judge(p, STEPS, 1000, 1000, 0, &random).in_order);
    assert_false(judge(p, STEPS, 1000000, 1000000, 0, &random).in_order);
}

/* One stray query makes the extent of the queries large, but a small part in any order is still
 * worth a sort. */
static void test_stray(void **state)
{
    const auto_place *p = *state;
    uint64_t random = 36;
    print_message("seed %llu\n", (unsigned long long)random);
    double *q = draw(SMALL_PART, 64, 2, &random);
    q[0] = q[1] = 0.99 * SIDE;
    assert_false(mw__queries_are_in_order(p->locator, &(mw_queries){q, 64, 2}));
    free(q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_answers),
        cmocka_unit_test(test_caches),
        cmocka_unit_test_setup_teardown(test_room, make_place, drop_place),
        cmocka_unit_test(test_refined),
        cmocka_unit_test_setup_teardown(test_order, make_place, drop_place),
        cmocka_unit_test_setup_teardown(test_stray, make_place, drop_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
