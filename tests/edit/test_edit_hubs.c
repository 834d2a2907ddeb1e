/* test_edit_hubs.c - vertices of very many triangles in an editor: which triangle of theirs is the
 * lowest is known without going round them, after any edit. MW_TEST_SEED=n: other edits. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "edit/editor.h"
#include "support/allocations.h"
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static mw_editor *editor_of(const arrays *a, mw_editor_options options)
{
    mw_error error;
    mw_editor *editor;
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    expect_ok(mw_editor_create(mesh, &options, &editor, &error), "editor", &error);
    mw_mesh_destroy(mesh);
    return editor;
}

static uint32_t degree_of(const mw_tiling *tiling, uint32_t v)
{
    uint32_t degree = 0;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (int k = 0; k < 3; k++) degree += tiling->tri[t].v[k] == v;
    return degree;
}

/* The heap is in order, its first number is that of going round, and it is not too long. */
static void check_hubs(const mw_editor *editor)
{
    const mw_tiling *tiling = &editor->locator.tiling;
    const mw_hub_table *hubs = &editor->upkeep.hubs;
    assert_ptr_equal(tiling->hubs, hubs->count > 0 ? hubs : NULL);
    for (uint32_t i = 0; hubs->hub && i <= hubs->mask; i++) {
        const mw_hub *hub = &hubs->hub[i];
        if (hub->vertex == MW_NONE || hub->count == 0) continue;
        assert_ptr_equal(mw__hub_find(hubs, hub->vertex), hub);
        assert_int_equal(hub->number[0], mw__lowest_around_vertex(
                                             tiling, tiling->tile_at[hub->vertex], hub->vertex));
        for (uint32_t k = 1; k < hub->count; k++)
            assert_true(hub->number[(k - 1) / 2] <= hub->number[k]);
    }
}

static const mw_hub *hub_of_number(const mw_editor *editor, uint32_t vertex)
{
    const mw_hub *hub =
        mw__hub_find(editor->locator.tiling.hubs, editor->dynamic.vertex_slot[vertex]);
    return hub && hub->count > 0 ? hub : NULL;
}

static void test_found(void **state)
{
    (void)state;
    enum { SPOKES = 3000 };
    arrays a = arrays_fan(SPOKES);
    mw_editor *editor = editor_of(&a, (mw_editor_options){0});
    assert_non_null(hub_of_number(editor, 0));
    mw_cursor cursor;
    mw_error error;
    expect_ok(mw_cursor_init(mw_editor_locator(editor), NULL, &cursor, &error), "cursor", &error);
    assert_int_equal(mw_locate(mw_editor_locator(editor), &cursor, 0, 0).triangle, 0);
    /* gone, and made again at once, by an edit that records nothing */
    expect_ok(mw_edit_remove(editor, 0, NULL, &error), "remove", &error);
    check_hubs(editor);
    expect_ok(mw_edit_insert(editor, 0, 0, NULL, &error), "insert", &error);
    check_hubs(editor);
    assert_non_null(hub_of_number(editor, SPOKES + 1));
    mw_editor_destroy(editor);
    arrays_free(&a);
}

/* A hub that grows, point by point. It is found before it has many times MW_HUB_DEGREE tiles. */
static void test_grows(void **state)
{
    (void)state;
    enum { POINTS = 6000 };
    static const double corner[8] = {-3, -3, 3, -3, 3, 3, -3, 3};
    mw_error error;
    mw_mesh *mesh;
    mw_editor *editor;
    expect_ok(mw_delaunay(corner, 4, 2, NULL, NULL, NULL, &mesh, &error), "delaunay", &error);
    expect_ok(mw_editor_create(mesh, NULL, &editor, &error), "editor", &error);
    mw_mesh_destroy(mesh);
    expect_ok(mw_edit_insert(editor, 0, 0, NULL, &error), "insert", &error);
    uint32_t found = 0;
    for (uint32_t i = 0; i < POINTS; i++) {
        double angle = 6.28318530717958648 * ((i * UINT64_C(2654435769) & 0xffffffff) * 0x1p-32);
        expect_ok(mw_edit_insert(editor, cos(angle), sin(angle), NULL, &error), "insert", &error);
        if (!found && hub_of_number(editor, 4)) found = i;
    }
    check_hubs(editor);
    assert_in_range(found, MW_HUB_DEGREE / 2, MW_HUB_DEGREE + 16 * MW_HUB_EDITS);
    mw_editor_destroy(editor);
}

/* --- random edits round two hubs -------------------------------------------------------------- */

/* Two apices above and below a row of points. */
static arrays two_hubs(uint32_t n)
{
    arrays a = arrays_make(n + 2, 2 * n);
    arrays_point(&a, n / 2.0, n);
    arrays_point(&a, n / 2.0, -(double)n);
    for (uint32_t i = 0; i < n; i++) arrays_point(&a, i, 0);
    for (uint32_t i = 2; i + 1 < n + 2; i++) {
        arrays_triangle(&a, i, i + 1, 0);
        arrays_triangle(&a, i + 1, i, 1);
    }
    return a;
}

static mw_edit random_edit(const mw_editor *editor, uint32_t n, uint64_t *random)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    mw_edit e = {.kind = (mw_edit_kind)mw__random_below(random, MW_EDIT_VALUE), .value = NAN};
    e.vertex = mw__random_below(random, dynamic->vertex_count);
    e.other = mw__random_below(random, 2);
    if (mw__random_below(random, 40) == 0) e.vertex = mw__random_below(random, 2);
    double side = n * (random_unit(random) - 0.5), at = random_unit(random);
    e.x = n / 2.0 + (n * random_unit(random) - n / 2.0) * at;
    e.y = (side < 0 ? -1.0 : 1.0) * n * (1 - at);
    /* into the lowest triangle of a hub */
    if (e.kind == MW_EDIT_INSERT && side > 0) {
        uint32_t t = mw_editor_triangle_of(editor, e.other), v[3];
        double p[3][2];
        if (t != MW_NONE && mw_editor_triangle(editor, t, v)) {
            for (int k = 0; k < 3; k++) mw_editor_vertex(editor, v[k], p[k]);
            e.x = (p[0][0] + p[1][0] + p[2][0]) / 3;
            e.y = (p[0][1] + p[1][1] + p[2][1]) / 3;
        }
    }
    return e;
}

static void insert_many(mw_editor *editor, uint32_t n, uint32_t count, uint64_t *random)
{
    double *p = malloc(2 * count * sizeof *p);
    mw_error error;
    for (uint32_t i = 0; i < count; i++) {
        p[2 * i] = n * (0.4 + 0.2 * random_unit(random));
        p[2 * i + 1] = n * (random_unit(random) - 0.5) / 4;
    }
    (void)mw_edit_insert_points(editor, p, count, 2, NULL, NULL, &error);
    free(p);
}

static void edit_at_random(mw_delaunay_mode delaunay, size_t undo, uint64_t *random)
{
    enum { VERTICES = 700, EDITS = 1000 };
    arrays a = two_hubs(VERTICES);
    mw_editor *editor = editor_of(&a, (mw_editor_options){.delaunay = delaunay, .undo = undo});
    if (delaunay == MW_DELAUNAY_NEVER) assert_non_null(hub_of_number(editor, 1));
    for (uint32_t i = 0; i < EDITS; i++) {
        mw_edit e = random_edit(editor, VERTICES, random);
        uint32_t what = mw__random_below(random, 100);
        allocations_left = what < 10 ? (long)mw__random_below(random, 6) : -1;
        if (what == 20)
            insert_many(editor, VERTICES, 1 + mw__random_below(random, 600), random);
        else if (what == 21)
            (void)mw_editor_compact(editor, NULL, NULL, NULL);
        else if (what > 80)
            (void)mw_edit_undo(editor, NULL, NULL);
        else
            (void)mw_edit_apply(editor, &e, NULL, NULL);
        allocations_left = -1;
        check_hubs(editor);
    }
    mw_editor_destroy(editor);
    arrays_free(&a);
}

static void test_followed(void **state)
{
    (void)state;
    const char *seed = getenv("MW_TEST_SEED");
    uint64_t random = seed ? strtoull(seed, NULL, 10) : 7;
    fprintf(stderr, "MW_TEST_SEED=%llu\n", (unsigned long long)random);
    for (int k = 0; k < 2; k++) {
        edit_at_random(MW_DELAUNAY_NEVER, 0, &random);
        edit_at_random(MW_DELAUNAY_NEVER, 20, &random);
        edit_at_random(MW_DELAUNAY_AUTO, 3, &random);
    }
}

/* Many edits of one hub leave its heap as short as it was. */
static void test_heap_stays_short(void **state)
{
    (void)state;
    enum { SPOKES = 1000, EDITS = 20000 };
    arrays a = arrays_fan(SPOKES);
    mw_error error;
    mw_change change;
    mw_editor *editor = editor_of(&a, (mw_editor_options){.undo = 1});
    uint32_t last = MW_NONE;
    for (uint32_t i = 0; i < EDITS; i++) {
        double angle = 6.28318530717958648 * (i % SPOKES + 0.5) / SPOKES;
        expect_ok(mw_edit_insert(editor, 1.1 * cos(angle), 1.1 * sin(angle), &change, &error),
                  "insert", &error);
        last = change.vertex;
        if (i % 3) expect_ok(mw_edit_remove(editor, last, NULL, &error), "remove", &error);
        if (i % 3 == 1) expect_ok(mw_edit_undo(editor, NULL, &error), "undo", &error);
        if (i % 1000 == 0) check_hubs(editor);
    }
    const mw_hub *hub = hub_of_number(editor, 0);
    assert_non_null(hub);
    assert_true(hub->room <=
                4 * degree_of(&editor->locator.tiling, hub->vertex) + 2 * MW_HUB_DEGREE);
    mw_editor_destroy(editor);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_found),
        cmocka_unit_test(test_grows),
        cmocka_unit_test(test_followed),
        cmocka_unit_test(test_heap_stays_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
