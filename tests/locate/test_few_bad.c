/* test_few_bad.c - few triangles of a good mesh lie badly: the grid stays the guide, and chains for
 * these few end walks that become long. Steps are counted, not timed. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "locate/locator.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GOOD = 100000, FEW = 1400 };

/* --- meshes ----------------------------------------------------------------------------------- */

typedef struct point_set {
    double *at;
    uint32_t count;
} point_set;

static void add(point_set *p, double x, double y)
{
    p->at[2 * p->count] = x;
    p->at[2 * p->count++ + 1] = y;
}

/* Uniform points of a square, none within `radius` of its middle. */
static point_set good_points(double radius, uint64_t *random)
{
    point_set p = {malloc(2 * (GOOD + FEW) * sizeof *p.at), 0};
    assert_non_null(p.at);
    while (p.count < GOOD) {
        const double x = 2 * random_unit(random) - 1, y = 2 * random_unit(random) - 1;
        if (hypot(x, y) > radius) add(&p, x, y);
    }
    return p;
}

static point_set with_graded(uint64_t *random)
{
    point_set p = good_points(0.4, random);
    for (int i = 0; i < FEW / 2; i++) {
        const double x = exp2(-40.0 * i / (FEW / 2.0)) / 5 - 0.1;
        add(&p, x, -0.1);
        add(&p, x, 0.1);
    }
    return p;
}

static point_set with_wheel(uint64_t *random)
{
    point_set p = good_points(0.1, random);
    for (int i = 0; i < FEW; i++) {
        const double angle = 6.28318530717958648 * i / FEW, radius = i ? 0.09 : 0;
        add(&p, radius * cos(angle), radius * sin(angle));
    }
    return p;
}

static point_set without_few(uint64_t *random)
{
    return good_points(0, random);
}

/* --- queries ---------------------------------------------------------------------------------- */

/* In triangles with a vertex of the few; close to one corner, or not. */
static double *draw(const mw_mesh *mesh, uint32_t n, uint64_t *random)
{
    double *q = malloc(2 * (size_t)n * sizeof *q);
    assert_non_null(q);
    for (uint32_t i = 0; i < n;) {
        uint32_t v[3];
        double c[3][2], near = i % 2 ? exp2(-20 * random_unit(random)) : 1;
        mw_mesh_triangle(mesh, mw__random_below(random, mw_mesh_triangle_count(mesh)), v);
        if (v[0] < GOOD && v[1] < GOOD && v[2] < GOOD) continue;
        const uint32_t k = mw__random_below(random, 3);
        const double s = near * random_unit(random), t = (near - s) * random_unit(random);
        for (uint32_t j = 0; j < 3; j++) mw_mesh_vertex(mesh, v[(k + j) % 3], c[j]);
        for (int x = 0; x < 2; x++)
            q[2 * i + (uint32_t)x] = (1 - s - t) * c[0][x] + s * c[1][x] + t * c[2][x];
        i++;
    }
    return q;
}

static void expect_same(const mw_location *at, const mw_location *want, uint32_t n, const char *how)
{
    for (uint32_t i = 0; i < n; i++)
        if (memcmp(&at[i], &want[i], sizeof *at) != 0)
            fail_msg("%s, query %u: triangle %u, not %u", how, i, at[i].triangle, want[i].triangle);
}

/* The answers are those of a walk without chains. */
static void expect_answers(const mw_locator *locator, const double *q, uint32_t n)
{
    mw_location *want = malloc(n * sizeof *want), *at = malloc(n * sizeof *at);
    mw_query_options other = {.walk = MW_WALK_STRAIGHT, .start = MW_START_SORTED};
    assert_true(want && at);
    assert_int_equal(mw_locate_batch(locator, q, n, 2, &other, want, NULL, NULL), MW_OK);
    assert_int_equal(mw_locate_batch(locator, q, n, 2, NULL, at, NULL, NULL), MW_OK);
    expect_same(at, want, n, "batch");
    mw_cursor cursor = {0};
    for (uint32_t i = 0; i < n; i++) at[i] = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
    expect_same(at, want, n, "alone");
    free(want);
    free(at);
}

/* A walk of 64 tiles, a search in chains, and a few tiles where the point is near the few only. */
static void expect_few_steps(const mw_locator *locator, const double *q, uint32_t n)
{
    enum { SHORT = 2 * 64 + 4 };
    const double most = log2(locator->tiling.tri_count + 1.0) + 3;
    mw_query_options options = {.counters = 1};
    mw_location *at = malloc(n * sizeof *at);
    mw_counters c;
    assert_non_null(at);
    assert_int_equal(mw_locate_batch(locator, q, n, 2, &options, at, &c, NULL), MW_OK);
    assert_true(c.triangles_max <= SHORT);
    assert_true((double)c.orient_init <= most * n);
    for (uint32_t i = 0; i < n; i++) {
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
        mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        assert_true(cursor.counters.triangles_max <= SHORT);
    }
    free(at);
}

static mw_locator *locator_of(point_set (*make)(uint64_t *), uint32_t threads, uint64_t *random,
                              mw_mesh **mesh)
{
    point_set p = make(random);
    *mesh = mesh_delaunay(p.at, p.count);
    free(p.at);
    return mesh_locator(*mesh, (mw_locator_options){.threads = threads});
}

/* --- tests ------------------------------------------------------------------------------------ */

static void test_few_bad(void **state)
{
    (void)state;
    enum { QUERIES = 2000 };
    point_set (*const make[])(uint64_t *) = {with_graded, with_wheel};
    uint64_t random = environment_print_seed("few bad", 61);
    for (uint32_t i = 0; i < 2; i++) {
        mw_mesh *mesh;
        mw_locator *locator = locator_of(make[i], 1 + i, &random, &mesh);
        mw_locator_info info;
        mw_locator_describe(locator, &info);
        assert_int_equal(info.guide, MW_START_GRID);
        assert_true(info.chain_bytes > 0 && info.chain_bytes < info.guide_bytes);
        assert_true(info.chain_bytes < 400 * FEW); /* for the few alone */
        double *q = draw(mesh, QUERIES, &random);
        expect_few_steps(locator, q, QUERIES);
        expect_answers(locator, q, QUERIES);
        free(q);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
}

/* Where no walk is long there are no chains. */
static void test_all_good(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("all good", 67);
    mw_mesh *mesh;
    mw_locator *locator = locator_of(without_few, 1, &random, &mesh);
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    assert_int_equal(info.chain_bytes, 0);
    assert_int_equal(locator->fallback.start, MW_START_AUTO);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

/* A prepared file keeps the chains: steps and answers are the same. */
static void test_prepared(void **state)
{
    (void)state;
    enum { QUERIES = 500 };
    uint64_t random = environment_print_seed("prepared", 71);
    mw_mesh *mesh;
    mw_error error;
    mw_locator *locator = locator_of(with_wheel, 1, &random, &mesh);
    double *q = draw(mesh, QUERIES, &random);
    char path[] = "test_few_bad.mwm";
    expect_ok(mw_write_prepared(locator, path, NULL, &error), "write", &error);
    mw_prepared *prepared;
    expect_ok(mw_mesh_map(path, NULL, &prepared, &error), "open", &error);
    const mw_locator *same = mw_prepared_locator(prepared);
    assert_int_equal(same->fallback.chains.tiles, locator->fallback.chains.tiles);
    expect_few_steps(same, q, QUERIES);
    expect_answers(same, q, QUERIES);
    mw_prepared_close(prepared);
    remove(path);
    free(q);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few_bad),
        cmocka_unit_test(test_all_good),
        cmocka_unit_test(test_prepared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
