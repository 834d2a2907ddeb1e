/* test_chains.c - meshes on which walks are long: the locator takes chains for its guide, and a
 * query makes O(log n) tests. Steps are counted, not timed. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "locate/locator.h"
#include "support/meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- meshes of about n vertices --------------------------------------------------------------- */

static arrays strip(uint32_t n, double range)
{
    uint32_t steps = n / 2;
    arrays a = arrays_make(2 * steps + 2, 2 * steps);
    for (uint32_t i = 0; i <= steps; i++)
        for (int y = 0; y < 2; y++) arrays_point(&a, exp2(range * (0.5 - (double)i / steps)), y);
    for (uint32_t i = 0; i < 2 * steps; i += 2) {
        arrays_triangle(&a, i, i + 1, i + 2);
        arrays_triangle(&a, i + 2, i + 1, i + 3);
    }
    return a;
}

static arrays strip_30(uint32_t n)
{
    return strip(n, 30);
}

static arrays strip_2000(uint32_t n)
{
    return strip(n, 2000);
}

/* All triangles at one vertex. */
static arrays fan(uint32_t n)
{
    arrays a = arrays_make(n, n);
    arrays_point(&a, 0, 0);
    for (uint32_t i = 1; i < n; i++) arrays_point(&a, i, 1e6);
    for (uint32_t i = 1; i + 1 < n; i++) arrays_triangle(&a, 0, i + 1, i);
    return a;
}

/* All triangles at one vertex inside. */
static arrays wheel(uint32_t n)
{
    arrays a = arrays_make(n, n);
    arrays_point(&a, 0, 0);
    for (uint32_t i = 1; i < n; i++) {
        double angle = 6.28318530717958648 * i / (n - 1);
        arrays_point(&a, cos(angle), sin(angle));
    }
    for (uint32_t i = 1; i < n; i++) arrays_triangle(&a, 0, i, i % (n - 1) + 1);
    return a;
}

static arrays rings(uint32_t n)
{
    uint32_t count = n / 4;
    arrays a = arrays_make(4 * count, 8 * count);
    for (uint32_t r = 1; r <= count; r++) {
        double radius = r;
        arrays_point(&a, radius, 0);
        arrays_point(&a, 0, radius);
        arrays_point(&a, -radius, 0);
        arrays_point(&a, 0, -radius);
    }
    for (uint32_t r = 0; r + 1 < count; r++)
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t p = 4 * r + k, q = 4 * r + (k + 1) % 4;
            arrays_triangle(&a, p, p + 4, q);
            arrays_triangle(&a, q, p + 4, q + 4);
        }
    return a;
}

/* Layers round a circle, from a billionth of a thousandth apart on. Neither a grid nor the curve
 * leads well. */
static mw_mesh *boundary_layers(uint32_t n)
{
    enum { LAYERS = 60 };
    uint32_t per_layer = n / LAYERS;
    double *p = malloc(2 * (size_t)n * sizeof *p), thickness = 1e-12;
    assert_non_null(p);
    for (uint32_t layer = 0, i = 0; layer < LAYERS; layer++, thickness *= 1.4)
        for (uint32_t k = 0; k < per_layer; k++, i++) {
            double angle = 6.28318530717958648 * (k + 0.5 * (layer & 1)) / per_layer;
            p[2 * i] = (1 + thickness) * cos(angle);
            p[2 * i + 1] = (1 + thickness) * sin(angle);
        }
    mw_mesh *mesh = mesh_delaunay(p, LAYERS * per_layer);
    free(p);
    return mesh;
}

/* --- what queries do -------------------------------------------------------------------------- */

typedef arrays make_arrays(uint32_t n);

/* In random triangles, at their corners, and around the mesh. */
static double *draw(const arrays *a, size_t n, uint64_t *random)
{
    double *q = malloc(2 * n * sizeof *q);
    assert_non_null(q);
    for (size_t i = 0; i < n; i++) {
        const uint32_t *v = a->triangles + 3 * (size_t)mw__random_below(random, a->triangle_count);
        double s = sqrt(random_unit(random)), t = random_unit(random);
        double share[3] = {1 - s, s * (1 - t), s * t};
        if (i % 8 == 1) share[0] = 1, share[1] = share[2] = 0;
        if (i % 8 == 2) share[0] = share[1] = 0.5, share[2] = 0;
        if (i % 8 == 3) share[0] = 3, share[1] = -1, share[2] = -1;
        for (size_t k = 0; k < 2; k++)
            q[2 * i + k] = share[0] * a->points[2 * v[0] + k] + share[1] * a->points[2 * v[1] + k] +
                           share[2] * a->points[2 * v[2] + k];
    }
    return q;
}

/* A walk that begins near by, or outside at an edge of the hull, may get long: then, once, it goes
 * on where a search leads. */
static void expect_counts(const mw_counters *c, int queries, double most)
{
    enum { SHORT = 64 + 4 };
    assert_true(c->triangles_max <= SHORT);
    assert_true((double)c->orient_init <= 2 * most * queries);
    assert_true((double)c->comparisons <= 2 * most * most * queries);
    assert_int_equal(c->cycles, 0);
}

static void expect_same(const mw_location *at, const mw_location *want, const char *how)
{
    if (at->triangle != want->triangle || at->where != want->where || at->local != want->local ||
        memcmp(at->weight, want->weight, sizeof at->weight) != 0)
        fail_msg("%s: triangle %u, not %u", how, at->triangle, want->triangle);
}

/* The answers are those of a walk that knows no chains: in a batch, with hints that are far off, in
 * a stream whose queries are near one another, and not. */
static void expect_answers(const mw_locator *locator, const double *q, uint32_t n, uint64_t *random)
{
    mw_location *want = malloc(n * sizeof *want), *at = malloc(n * sizeof *at);
    uint32_t *hints = malloc(n * sizeof *hints);
    mw_query_options other = {.walk = MW_WALK_STRAIGHT, .start = MW_START_SORTED}, hinted = {0};
    mw_cursor cursor = {0};
    assert_true(want && at && hints);
    assert_int_equal(mw_locate_batch(locator, q, n, 2, &other, want, NULL, NULL), MW_OK);
    assert_int_equal(mw_locate_batch(locator, q, n, 2, NULL, at, NULL, NULL), MW_OK);
    for (uint32_t i = 0; i < n; i++) expect_same(&at[i], &want[i], "batch");
    for (uint32_t i = 0; i < n; i++)
        hints[i] = mw__random_below(random, mw_mesh_triangle_count(locator->mesh));
    hinted.hints = hints;
    assert_int_equal(mw_locate_batch(locator, q, n, 2, &hinted, at, NULL, NULL), MW_OK);
    for (uint32_t i = 0; i < n; i++) expect_same(&at[i], &want[i], "hints");
    for (uint32_t i = 0; i < n; i++) {
        mw_location one = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        expect_same(&one, &want[i], "stream");
        one = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        expect_same(&one, &want[i], "again");
    }
    free(want);
    free(at);
    free(hints);
}

static void expect_few_steps(make_arrays *make, uint32_t n, uint64_t *random)
{
    enum { QUERIES = 400 };
    arrays a = make(n);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_locator_info info;
    mw_locator_describe(locator, &info);
    assert_int_equal(info.guide, MW_START_CHAINS);
    assert_true(info.guide_bytes > 0 &&
                info.guide_bytes < 90 * (uint64_t)locator->tiling.tri_count);
    double *q = draw(&a, QUERIES, random), most = log2(locator->tiling.tri_count + 1.0) + 3;
    mw_query_options options = {.counters = 1};
    mw_cursor cursor;
    for (int i = 0; i < QUERIES; i++) { /* alone, each from a new cursor: none is near the last */
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
        mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        expect_counts(&cursor.counters, 1, most);
    }
    mw_counters c;
    mw_location at[QUERIES];
    assert_int_equal(mw_locate_batch(locator, q, QUERIES, 2, &options, at, &c, NULL), MW_OK);
    expect_counts(&c, QUERIES, most);
    expect_answers(locator, q, QUERIES, random);
    free(q);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

static void test_traps(void **state)
{
    (void)state;
    make_arrays *const traps[] = {strip_30, strip_2000, fan, wheel, rings};
    uint64_t random = 17;
    print_message("seed %llu\n", (unsigned long long)random);
    for (size_t i = 0; i < sizeof traps / sizeof *traps; i++)
        for (uint32_t n = 4000; n <= 16000; n *= 2) expect_few_steps(traps[i], n, &random);
}

/* Where no grid serves for a guide, chains do. Large batches are sorted, and chains end walks that
 * get long. */
static void test_without_grid(void **state)
{
    (void)state;
    enum { QUERIES = 4000 };
    uint64_t random = 20;
    mw_mesh *mesh = boundary_layers(18000);
    arrays a = arrays_of_mesh(mesh);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    assert_true(locator->guide.start == MW_START_CHAINS && locator->guide.sort_batches);
    double *q = draw(&a, QUERIES, &random);
    mw_location *at = malloc(QUERIES * sizeof *at);
    mw_query_options options = {.counters = 1};
    mw_counters c;
    assert_int_equal(mw_locate_batch(locator, q, QUERIES, 2, &options, at, &c, NULL), MW_OK);
    expect_counts(&c, QUERIES, log2(locator->tiling.tri_count + 1.0) + 3);
    assert_true(c.orient_init < 4 * QUERIES);
    expect_answers(locator, q, QUERIES, &random);
    free(q);
    free(at);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Where a grid leads well, nothing else is built. */
static void test_good_meshes(void **state)
{
    (void)state;
    uint64_t random = 18;
    for (uint32_t side = 4; side <= 128; side *= 2) {
        arrays a = arrays_grid(side, 0.4, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_locator_info info;
        mw_locator_describe(locator, &info);
        assert_int_equal(info.guide, MW_START_GRID);
        assert_true(info.guide_bytes < 2 * (uint64_t)mw_mesh_triangle_count(mesh) + 64);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* Squares of lengths under- and overflow: the guide leads as well as at the extent 1, and a query
 * does not begin at the last triangle, wherever that is. */
static void test_extents(void **state)
{
    (void)state;
    enum { QUERIES = 1000, SIDE = 100 };
    static const double extents[] = {1, 1e-150, 1e-290, 5e-306, 1e150, 1e250, 1e300};
    uint64_t random = 19;
    for (size_t i = 0; i < sizeof extents / sizeof *extents; i++) {
        arrays a = arrays_grid(SIDE, 0.4, &random);
        arrays_transform(&a, extents[i], 0, 0);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_query_options options = {.counters = 1};
        mw_cursor cursor;
        assert_int_equal(locator->guide.start, MW_START_GRID);
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
        double q[2 * QUERIES];
        mw_counters c;
        mw_location at[QUERIES];
        for (size_t k = 0; k < 2 * QUERIES; k++) q[k] = extents[i] * SIDE * random_unit(&random);
        for (size_t k = 0; k < QUERIES; k++) mw_locate(locator, &cursor, q[2 * k], q[2 * k + 1]);
        assert_true(cursor.counters.triangles_visited < 6 * QUERIES);
        assert_int_equal(mw_locate_batch(locator, q, QUERIES, 2, &options, at, &c, NULL), MW_OK);
        assert_true(c.triangles_visited < 6 * QUERIES);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_traps),
        cmocka_unit_test(test_without_grid),
        cmocka_unit_test(test_good_meshes),
        cmocka_unit_test(test_extents),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
