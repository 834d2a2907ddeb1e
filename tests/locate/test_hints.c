/* test_hints.c - batches whose queries begin at triangles of their own (mw_query_options.hints):
 * the answers are those without, whatever the hints; walks from good ones are short; what is
 * written back is what was found; edits do no harm. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/environment.h"
#include "support/meshes.h"
#include "support/start_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A mesh, queries that find fault with it, and their answers without hints. */
typedef struct hint_field {
    mw_mesh *mesh;
    mw_locator *locator;
    double *query;
    size_t n;
    mw_location *want, *at;
    uint32_t *hint, *given;
    uint64_t random;
} hint_field;

static hint_field field_create(const arrays *a, mw_locator_options options, uint64_t seed)
{
    hint_field f = {.random = seed};
    mw_error error;
    f.mesh = arrays_mesh(a, (mw_mesh_options){0});
    f.locator = mesh_locator(f.mesh, options);
    f.query = arrays_queries(a, 60, &f.n, &f.random);
    f.want = calloc(f.n, sizeof *f.want);
    f.at = calloc(f.n, sizeof *f.at);
    f.hint = calloc(f.n, sizeof *f.hint);
    f.given = calloc(f.n, sizeof *f.given);
    expect_ok(mw_locate_batch(f.locator, f.query, f.n, 2, NULL, f.want, NULL, &error),
              "without hints", &error);
    return f;
}

static void field_release(hint_field *f)
{
    mw_locator_destroy(f->locator);
    mw_mesh_destroy(f->mesh);
    free(f->query);
    free(f->want);
    free(f->at);
    free(f->hint);
    free(f->given);
}

/* --- what is given ---------------------------------------------------------------------------- */

enum { NO_HINTS, ANY_TRIANGLE, ANY_NUMBER, LIMITS, GOOD, HINTS };
static const char *const hints_name[] = {"none", "any triangle", "any number", "limits", "good"};

static void field_give_hints(hint_field *f, int kind)
{
    uint32_t count = mw_mesh_triangle_count(f->mesh);
    const uint32_t limits[] = {0, count - 1, count, MW_MAX_TRIANGLES, UINT32_MAX - 1, MW_NONE};
    for (size_t i = 0; i < f->n; i++) {
        uint32_t any = (uint32_t)mw__random(&f->random);
        f->given[i] = kind == ANY_TRIANGLE ? any % count
                      : kind == ANY_NUMBER ? any
                      : kind == LIMITS     ? limits[any % 6]
                      : kind == GOOD       ? f->want[i].triangle
                                           : MW_NONE;
    }
}

/* --- what comes back -------------------------------------------------------------------------- */

static void field_expect(hint_field *f, mw_query_options options, const char *how)
{
    mw_error error;
    memcpy(f->hint, f->given, f->n * sizeof *f->hint);
    options.hints = f->hint;
    memset(f->at, 0x55, f->n * sizeof *f->at);
    expect_ok(mw_locate_batch(f->locator, f->query, f->n, 2, &options, f->at, NULL, &error), how,
              &error);
    for (size_t i = 0; i < f->n; i++) {
        if (memcmp(&f->at[i], &f->want[i], sizeof f->at[i]) != 0)
            fail_msg("hints %s: query %zu is answered differently from triangle %u", how, i,
                     f->given[i]);
        uint32_t next = f->want[i].triangle == MW_NONE ? f->given[i] : f->want[i].triangle;
        if (f->hint[i] != next)
            fail_msg("hints %s: hint %zu became %u, not %u", how, i, f->hint[i], next);
    }
}

static void field_try_all(hint_field *f)
{
    mw_index *index[MW_START_COUNT];
    starts_open(f->locator, index);
    for (int kind = 0; kind < HINTS; kind++) {
        field_give_hints(f, kind);
        for (int start = 0; start < MW_START_COUNT; start++) {
            mw_query_options options = {
                .start = (mw_start_kind)start, .index = index[start], .threads = 1};
            field_expect(f, options, hints_name[kind]);
            options.lanes = 1 + (uint32_t)start;
            options.counters = 1;
            field_expect(f, options, hints_name[kind]);
        }
        for (int walk = 0; walk < MW_WALK_COUNT; walk++) {
            mw_query_options options = {
                .walk = (mw_walk_kind)walk, .lanes = (uint32_t)walk, .threads = 2};
            options.arithmetic = walk % 2 ? MW_EXACT : MW_DOUBLE;
            field_expect(f, options, hints_name[kind]);
        }
    }
    starts_close(index);
}

/* --- the tests -------------------------------------------------------------------------------- */

static void test_meshes(void **state)
{
    (void)state;
    uint64_t random = environment_seed(60);
    for (int kind = 0; kind < 4; kind++) {
        arrays a = kind == 2 ? arrays_trap()
                             : arrays_grid(kind == 0 ? 3 : 24, kind == 1 ? 0.4 : 0, &random);
        if (kind != 2) arrays_scramble(&a, 1, &random);
        if (kind == 3) arrays_punch(&a, 0.2, &random);
        hint_field f = field_create(&a, (mw_locator_options){0}, random);
        field_try_all(&f);
        field_release(&f);
        arrays_free(&a);
    }
}

/* A triangle with a vertex inside an edge, two triangles below, and a flat one in the gap. */
static void arrays_add_cut(arrays *a, double x)
{
    static const double corner[5][2] = {{0, 0}, {2, 0}, {1, 2}, {1, 0}, {1, -2}};
    static const uint32_t triangle[4][3] = {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}, {0, 3, 1}};
    uint32_t v[5];
    for (int k = 0; k < 5; k++) v[k] = arrays_point(a, x + corner[k][0], corner[k][1]);
    for (int k = 0; k < 4; k++)
        arrays_triangle(a, v[triangle[k][0]], v[triangle[k][1]], v[triangle[k][2]]);
}

/* Flat triangles have no tile, cut ones several: the tiles have other places than the triangles. */
static void test_other_tiles_than_triangles(void **state)
{
    (void)state;
    uint64_t random = environment_seed(61);
    arrays a = arrays_make(100, 100);
    for (int i = 0; i < 20; i++) arrays_add_cut(&a, 3 * i);
    for (int scrambled = 0; scrambled < 2; scrambled++) {
        hint_field f = field_create(&a, (mw_locator_options){0}, random);
        field_try_all(&f);
        field_release(&f);
        arrays_scramble(&a, 1, &random);
    }
    arrays_free(&a);
}

/* Without ghosts only the border walk finds its way; with a tolerance points outside have a
 * triangle. */
static void test_open_border_and_tolerance(void **state)
{
    (void)state;
    uint64_t random = environment_seed(62);
    arrays a = arrays_grid(20, 0.3, &random);
    arrays_punch(&a, 0.2, &random);
    for (int open = 0; open < 2; open++) {
        mw_locator_options made = {.border = 1, .fill = open ? MW_FILL_NO : MW_FILL_YES};
        hint_field f = field_create(&a, made, random);
        mw_query_options options = {.tolerance = 0.2};
        mw_error error;
        expect_ok(mw_locate_batch(f.locator, f.query, f.n, 2, &options, f.want, NULL, &error),
                  "tolerance", &error);
        for (int kind = 0; kind < HINTS; kind++) {
            field_give_hints(&f, kind);
            field_expect(&f, options, hints_name[kind]);
        }
        field_release(&f);
    }
    arrays_free(&a);
}

static void test_walks_are_short(void **state)
{
    (void)state;
    uint64_t random = environment_seed(63);
    arrays a = arrays_grid(60, 0.4, &random);
    arrays_scramble(&a, 1, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    enum { N = 2000 };
    static double q[2 * N];
    static mw_location at[N];
    static uint32_t hint[N];
    for (size_t i = 0; i < 2 * N; i++) q[i] = 60 * random_unit(&random);
    memset(hint, 0xff, sizeof hint);
    mw_query_options options = {.start = MW_START_LAST, .counters = 1, .hints = hint};
    mw_counters counters;
    assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, &counters, NULL), MW_OK);
    assert_true(counters.triangles_visited > 2 * N);
    assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, &counters, NULL), MW_OK);
    assert_int_equal(counters.triangles_visited, N);
    /* What is far from its hint is led by the guide: a walk across the mesh would visit dozens. */
    for (size_t i = 0; i < N; i++)
        hint[i] = mw__random_below(&random, mw_mesh_triangle_count(mesh));
    options.start = MW_START_AUTO;
    assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, &counters, NULL), MW_OK);
    assert_true(counters.triangles_visited < 5 * N);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* A batch is cut into blocks: hints go with their queries. */
static void test_more_than_a_block(void **state)
{
    (void)state;
    enum { N = (1 << 22) + 100, PLACES = 7 };
    uint64_t random = 64;
    arrays a = arrays_grid(4, 0.3, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    double *q = malloc((size_t)2 * N * sizeof *q);
    mw_location *at = malloc(N * sizeof *at);
    uint32_t *hint = malloc(N * sizeof *hint);
    assert_true(q && at && hint);
    for (size_t i = 0; i < N; i++) {
        q[2 * i] = (double)(i % PLACES) / 2 + 0.1;
        q[2 * i + 1] = 0.6;
        hint[i] = MW_NONE;
    }
    mw_query_options options = {.hints = hint};
    assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, NULL, NULL), MW_OK);
    for (size_t i = 0; i < N; i++)
        if (hint[i] != at[i % PLACES].triangle || hint[i] == MW_NONE)
            fail_msg("hint %zu is %u", i, hint[i]);
    free(q);
    free(at);
    free(hint);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Hints from before an edit: of triangles that are gone, that came back by undo, or never were. */
static void test_edits(void **state)
{
    (void)state;
    enum { N = 500, EDITS = 60 };
    uint64_t random = environment_seed(65);
    arrays a = arrays_grid(12, 0.4, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_editor *editor;
    mw_editor_options made = {.undo = 8};
    assert_int_equal(mw_editor_create(mesh, &made, &editor, NULL), MW_OK);
    double q[2 * N];
    uint32_t hint[N];
    mw_location at[N], want[N];
    for (size_t i = 0; i < 2 * N; i++) q[i] = 14 * random_unit(&random) - 1;
    memset(hint, 0xff, sizeof hint);
    for (int edit = 0; edit < EDITS; edit++) {
        if (edit % 4 == 3)
            assert_int_equal(mw_edit_undo(editor, NULL, NULL), MW_OK);
        else
            mw_edit_insert(editor, 12 * random_unit(&random), 12 * random_unit(&random), NULL,
                           NULL);
        if (edit % 5 == 4)
            mw_edit_remove(editor, mw__random_below(&random, a.point_count), NULL, NULL);
        const mw_locator *locator = mw_editor_locator(editor);
        mw_query_options options = {.hints = hint,
                                    .start = edit % 2 ? MW_START_AUTO : MW_START_LAST};
        memset(at, 0, sizeof at);
        memset(want, 0, sizeof want);
        for (size_t i = 0; i < N; i++) q[i] += 0.2 * (random_unit(&random) - 0.5);
        assert_int_equal(mw_locate_batch(locator, q, N, 2, NULL, want, NULL, NULL), MW_OK);
        assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, NULL, NULL), MW_OK);
        assert_memory_equal(at, want, sizeof at);
        hint[mw__random_below(&random, N)] = (uint32_t)mw__random(&random);
    }
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_meshes),
        cmocka_unit_test(test_other_tiles_than_triangles),
        cmocka_unit_test(test_open_border_and_tolerance),
        cmocka_unit_test(test_walks_are_short),
        cmocka_unit_test(test_more_than_a_block),
        cmocka_unit_test(test_edits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
