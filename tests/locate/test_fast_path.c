/* test_fast_path.c - the fast path of queries gives the very answers of the walks that count, bit
 * for bit: from every start, in any number of lanes, on any processor, alone and in batches; and
 * leaves to the walks what rounding cannot decide. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "locate/interleaved.h"
#include "support/meshes.h"
#include "support/start_list.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void expect_same(const mw_location *want, const mw_location *got, const double *q, size_t n,
                        const char *how)
{
    for (size_t i = 0; i < n; i++)
        if (memcmp(&want[i], &got[i], sizeof *want) != 0)
            fail_msg("%s: (%.17g, %.17g): triangle %u where %d weights %.17g %.17g, not %u %d "
                     "%.17g %.17g",
                     how, q[2 * i], q[2 * i + 1], got[i].triangle, got[i].where, got[i].weight[0],
                     got[i].weight[1], want[i].triangle, want[i].where, want[i].weight[0],
                     want[i].weight[1]);
}

/* Without the instructions that only some processors have. */
static void expect_portable(const mw_locator *locator, const mw_query_options *options,
                            const double *q, size_t n, const mw_location *want, mw_location *at)
{
    mw_cursor cursor;
    assert_int_equal(mw_cursor_init(locator, options, &cursor, NULL), MW_OK);
    mw_batch queries = {.points = q, .locations = at, .stride = 2};
    for (int chained = 0; chained < 2; chained++)
        for (uint32_t lanes = 4; lanes <= 64; lanes *= 4) {
            mw_interleaved of = {&queries, locator, &cursor, chained, true};
            memset(at, 0x55, n * sizeof *at);
            mw__locate_interleaved(&of, 0, (uint32_t)n, lanes);
            expect_same(want, at, q, n, "portable");
        }
}

static void expect_start(const mw_locator *locator, mw_query_options options, const double *q,
                         size_t n, const mw_location *want, mw_location *at)
{
    static const uint32_t lanes[] = {0, 1, 4, 7, 13, 64};
    mw_error error;
    for (size_t i = 0; i < sizeof lanes / sizeof *lanes; i++) {
        char how[80];
        options.lanes = lanes[i];
        options.threads = 1 + (uint32_t)i % 2;
        snprintf(how, sizeof how, "from %s in %u lanes", mw_start_name(options.start), lanes[i]);
        memset(at, 0x55, n * sizeof *at);
        expect_ok(mw_locate_batch(locator, q, n, 2, &options, at, NULL, &error), how, &error);
        expect_same(want, at, q, n, how);
    }
    mw_cursor cursor;
    expect_ok(mw_cursor_init(locator, &options, &cursor, &error), "cursor", &error);
    for (size_t i = 0; i < n; i++) at[i] = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
    expect_same(want, at, q, n, mw_start_name(options.start));
    expect_portable(locator, &options, q, n, want, at);
}

static void expect_fast_path(const arrays *a, size_t random_queries, uint64_t *random)
{
    size_t n;
    double *q = arrays_queries(a, random_queries, &n, random);
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_location *want = malloc(n * sizeof *want), *at = malloc(n * sizeof *at);
    mw_index *index[MW_START_COUNT];
    mw_counters counters;
    mw_error error;
    mw_query_options counted = {.walk = MW_WALK_CELESTIAL, .start = MW_START_SAMPLE, .counters = 1};
    expect_ok(mw_locate_batch(locator, q, n, 2, &counted, want, &counters, &error), "counted",
              &error);
    starts_open(locator, index);
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++)
        expect_start(locator,
                     (mw_query_options){.start = (mw_start_kind)start, .index = index[start]}, q, n,
                     want, at);
    starts_close(index);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(q);
    free(want);
    free(at);
}

static void test_meshes(void **state)
{
    (void)state;
    uint64_t random = 20;
    print_message("seed %llu\n", (unsigned long long)random);
    for (uint32_t n = 1; n <= 41; n += 8)
        for (int jitter = 0; jitter < 2; jitter++) {
            arrays a = arrays_grid(n, jitter ? 0.4 : 0, &random);
            arrays_scramble(&a, 1, &random);
            expect_fast_path(&a, 200, &random);
            arrays_free(&a);
        }
}

/* Ghosts in pockets and holes; long ways round the vertex of a fan; a mesh on which the
 * remembering walk goes in circles. */
static void test_what_needs_the_walks(void **state)
{
    (void)state;
    uint64_t random = 21;
    print_message("seed %llu\n", (unsigned long long)random);
    arrays holes = arrays_grid(30, 0.3, &random), fan = arrays_fan(500), trap = arrays_trap();
    arrays_punch(&holes, 0.2, &random);
    expect_fast_path(&holes, 200, &random);
    expect_fast_path(&fan, 200, &random);
    expect_fast_path(&trap, 500, &random);
    arrays_free(&holes);
    arrays_free(&fan);
    arrays_free(&trap);
}

/* Areas that leave the range where the rounded ones are weights. */
static void test_scales(void **state)
{
    (void)state;
    static const double scale[] = {1e-290, 1e-160, 1e-140, 1e-122, 1e-119, 1e-100, 1e100,
                                   1e118,  1e123,  1e140,  1e153,  1e250,  1e300};
    uint64_t random = 22;
    print_message("seed %llu\n", (unsigned long long)random);
    for (size_t i = 0; i < sizeof scale / sizeof *scale; i++) {
        arrays a = arrays_grid(9, 0.4, &random);
        arrays_transform(&a, scale[i], 0, 0);
        expect_fast_path(&a, 100, &random);
        arrays_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_meshes),
        cmocka_unit_test(test_what_needs_the_walks),
        cmocka_unit_test(test_scales),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
