/* test_surface_edit.c - streams of edits of surfaces: each against its twin, and the surface, its
 * boxes and its probes against ones made anew. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/edit_require.h"
#include "oracle/surface/surface_twin.h"
#include "support/environment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH = 8 };

/* A shape of one of several kinds. */
static shape any_shape(uint64_t *random)
{
    switch (mw__random_below(random, 6)) {
    case 0: return shape_ball(2, 20, 0.4, random);
    case 1: return shape_patch(5, 3, random);
    case 2: return shape_torus(4, 3, 4);
    case 3: return shape_join(shape_ball(1, 10, 0.3, random), shape_patch(3, 2, random), 30);
    case 4: {
        shape s = shape_patch(4, 2, random);
        shape_clash(&s, 0.2, random);
        return s;
    }
    default: {
        shape s = shape_torus(4, 4, 3);
        shape_shuffle(&s, random);
        return s;
    }
    }
}

static void run_stream(uint64_t seed, int edits, uint64_t kinds[MW_SURFACE_EDIT_KIND_COUNT][2])
{
    uint64_t random = seed;
    uint32_t path[2 * PATH];
    shape s = any_shape(&random);
    surface_twin t = surface_twin_make(&s, mw__random_below(&random, 3) * 5);
    edit_case.name = "surface edits";
    edit_case.seed = seed;
    for (int i = 0; i < edits; i++) {
        edit_case.step = (uint64_t)i;
        uint32_t what = mw__random_below(&random, 40);
        if (what < 4) {
            surface_twin_undo(&t);
        } else if (what == 4) {
            surface_twin_compact(&t);
        } else {
            mw_surface_edit edit = surface_twin_edit(&t, path, PATH, &random);
            edit_case.edit.vertex = edit.vertex[0]; /* for the message */
            edit_case.edit.other = (uint32_t)edit.kind;
            kinds[edit.kind][surface_twin_apply(&t, &edit)]++;
        }
        surface_twin_check(&t, i % 4 == 0 ? 3 : 0, &random);
    }
    while (surface_twin_undo(&t)) surface_twin_check(&t, 1, &random);
    surface_twin_free(&t);
    shape_free(&s);
}

static void test_streams(void **state)
{
    (void)state;
    uint64_t kinds[MW_SURFACE_EDIT_KIND_COUNT][2] = {{0}};
    uint64_t seed = environment_print_seed("surface edits", 31);
    int streams = environment_is_long() ? 20000 : 60;
    for (int i = 0; i < streams; i++) run_stream(mw__random_seed(seed, (uint64_t)i), 60, kinds);
    for (int k = 0; k < MW_SURFACE_EDIT_KIND_COUNT; k++) { /* each kind succeeds and is refused */
        printf("%s: %d refused, %d done\n", mw_surface_edit_name((mw_surface_edit_kind)k),
               (int)kinds[k][0], (int)kinds[k][1]);
        assert_true(kinds[k][1] > 0);
        assert_true(kinds[k][0] > 0 || k == MW_SURFACE_ADD_VERTEX);
    }
}

/* --- cases ------------------------------------------------------------------------------------ */

/* Two squares of two triangles each, side by side:
 *     3---4---5
 *     | \ | \ |
 *     0---1---2      */
static shape two_squares(void)
{
    shape s = shape_make(6, 4);
    for (int i = 0; i < 6; i++) shape_point(&s, i % 3, i / 3, 0);
    shape_triangle(&s, 0, 1, 3);
    shape_triangle(&s, 1, 4, 3);
    shape_triangle(&s, 1, 2, 4);
    shape_triangle(&s, 2, 5, 4);
    return s;
}

static void expect_refused(mw_surface_editor *editor, mw_surface_edit edit, const char *message)
{
    mw_error error = {0};
    assert_int_equal(mw_surface_edit_apply(editor, &edit, NULL, &error), MW_ERROR_INPUT);
    assert_string_equal(error.message, message);
}

/* Each defect by its name. */
static void test_refusals(void **state)
{
    (void)state;
    shape s = two_squares();
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_surface_editor *e;
    assert_int_equal(mw_surface_editor_create(surface, NULL, &e, NULL), MW_OK);
    expect_refused(e, (mw_surface_edit){.kind = MW_SURFACE_FLIP, .vertex = {0, 4}},
                   "no edge joins the vertices 0 and 4");
    expect_refused(e, (mw_surface_edit){.kind = MW_SURFACE_FLIP, .vertex = {0, 1}},
                   "the edge from 0 to 1 is a border");
    expect_refused(e, (mw_surface_edit){.kind = MW_SURFACE_REMOVE_VERTEX, .vertex = {6}},
                   "there is no vertex 6");
    expect_refused(e, (mw_surface_edit){.kind = MW_SURFACE_SPLIT_TRIANGLE, .triangle = 4},
                   "there is no triangle 4");
    expect_refused(e, (mw_surface_edit){.kind = MW_SURFACE_ADD_TRIANGLE, .vertex = {1, 4, 0}},
                   "the edge from 1 to 4 would have a third triangle; one of the others is 1");
    expect_refused(e, (mw_surface_edit){.kind = MW_SURFACE_ADD_TRIANGLE, .vertex = {0, 1, 5}},
                   "the triangles at the edge from 0 to 1 would have opposite orientation; one of "
                   "them is 0");
    expect_refused(e, (mw_surface_edit){.kind = MW_SURFACE_ADD_TRIANGLE, .vertex = {0, 5, 5}},
                   "a triangle cannot have vertex 5 twice");
    expect_refused(
        e,
        (mw_surface_edit){.kind = MW_SURFACE_COLLAPSE, .vertex = {1, 4}, .point = {NAN, NAN, NAN}},
        "the edge from 1 to 4 cannot be collapsed: both ends lie on a border, and the "
        "edge does not");
    expect_refused(
        e,
        (mw_surface_edit){.kind = MW_SURFACE_COLLAPSE, .vertex = {0, 1}, .point = {1, INFINITY, 0}},
        "a coordinate is not finite");
    expect_refused(
        e, (mw_surface_edit){.kind = MW_SURFACE_CUT, .path = (uint32_t[]){0, 1}, .path_count = 2},
        "the edge from 0 to 1 is a border already");
    expect_refused(
        e,
        (mw_surface_edit){.kind = MW_SURFACE_CUT, .path = (uint32_t[]){1, 4, 1}, .path_count = 3},
        "the path has the edge from 1 to 4 twice");
    expect_refused(e,
                   (mw_surface_edit){.kind = MW_SURFACE_SEW,
                                     .path = (uint32_t[]){0, 1},
                                     .other = (uint32_t[]){1, 4},
                                     .path_count = 2},
                   "the edge from 1 to 4 is no border");
    expect_refused(e,
                   (mw_surface_edit){.kind = MW_SURFACE_SEW,
                                     .path = (uint32_t[]){0, 1},
                                     .other = (uint32_t[]){0, 1},
                                     .path_count = 2},
                   "the edge from 0 to 1 cannot be sewn to itself");
    expect_refused(e,
                   (mw_surface_edit){.kind = MW_SURFACE_SEW,
                                     .path = (uint32_t[]){0, 1},
                                     .other = (uint32_t[]){1, 2},
                                     .path_count = 2},
                   "vertex 1 would merge into two vertices, 0 and 1");
    expect_refused(e,
                   (mw_surface_edit){.kind = MW_SURFACE_SEW,
                                     .path = (uint32_t[]){0, 1},
                                     .other = (uint32_t[]){3, 4},
                                     .path_count = 2},
                   "triangle 0 would have vertex 0 twice");
    mw_surface_editor_destroy(e);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* A cut across the squares parts them, and a seam makes them one again, with the same links. */
static void test_cut_and_sew(void **state)
{
    (void)state;
    uint64_t random = 5;
    shape s = two_squares();
    surface_twin t = surface_twin_make(&s, 4);
    const uint32_t path[2] = {1, 4}, other[2] = {6, 7};
    mw_surface_info info;
    assert_true(surface_twin_apply(
        &t, &(mw_surface_edit){.kind = MW_SURFACE_CUT, .path = path, .path_count = 2}));
    surface_twin_check(&t, 10, &random);
    assert_int_equal(mw_surface_describe(t.surface, &info, NULL), MW_OK);
    assert_int_equal(info.components, 2);
    assert_true(surface_twin_apply(
        &t,
        &(mw_surface_edit){.kind = MW_SURFACE_SEW, .path = path, .other = other, .path_count = 2}));
    surface_twin_check(&t, 10, &random);
    for (uint32_t i = 0; i < 4; i++)
        assert_memory_equal(t.now.triangle + 3 * i, s.triangles + 3 * i, 3 * sizeof(uint32_t));
    assert_true(surface_twin_undo(&t) && surface_twin_undo(&t));
    surface_twin_check(&t, 10, &random);
    surface_twin_free(&t);
    shape_free(&s);
}

/* Within an update the prober is brought up to date by its call, as after any other change. */
static void test_updates(void **state)
{
    (void)state;
    shape s = two_squares();
    mw_surface *surface = shape_surface(&s, (mw_surface_options){.shared = 1});
    mw_prober *prober;
    mw_prober_options boxes = {.boxes = 1};
    assert_int_equal(mw_prober_create(surface, &boxes, &prober, NULL), MW_OK);
    mw_surface_editor *e, *second;
    mw_surface_editor_options options = {.prober = prober};
    assert_int_equal(mw_surface_editor_create(surface, &options, &e, NULL), MW_OK);
    assert_int_equal(mw_surface_editor_create(surface, &options, &second, NULL), MW_ERROR_ARGUMENT);
    assert_null(second);
    assert_int_equal(mw_surface_flip(surface, 0, 1, NULL), MW_ERROR_ARGUMENT);
    mw_probe_cursor cursor;
    mw_probe_options certain = {.certain = 1};
    assert_int_equal(mw_probe_cursor_init(prober, &certain, &cursor, NULL), MW_OK);
    const double q[3] = {0.25, 0.25, 1}, m[3] = {0, 0, -1};
    assert_int_equal(mw_probe(prober, &cursor, q, m).triangle, 0);
    mw_surface_begin_update(surface);
    for (int i = 0; i < 6; i++) mw_surface_points(surface)[3 * i + 2] = 0.5;
    assert_int_equal(mw_surface_edit_remove_triangle(e, 0, NULL, NULL), MW_OK);
    mw_surface_end_update(surface);
    assert_int_equal(mw_probe(prober, &cursor, q, m).state, MW_TOUCH_BAD);
    assert_int_equal(mw_surface_edit_flip(e, 1, 4, NULL, NULL), MW_OK);
    assert_int_equal(mw_probe(prober, &cursor, q, m).state, MW_TOUCH_BAD); /* it was before */
    mw_surface_begin_update(surface);
    mw_prober_update(prober, -1, 1);
    mw_surface_end_update(surface);
    assert_int_equal(mw_probe(prober, &cursor, q, m).state, MW_TOUCH_NONE);
    mw_surface_begin_update(surface);
    assert_int_equal(mw_surface_edit_add_triangle(e, (uint32_t[]){0, 1, 3}, NULL, NULL), MW_OK);
    mw_prober_update(prober, 0, 1);
    mw_surface_end_update(surface);
    mw_touch touch = mw_probe(prober, &cursor, q, m);
    assert_int_equal(touch.triangle, 4);
    assert_true(touch.distance == 0.5);
    mw_surface_editor_destroy(e);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* A star, and a prober that does not follow, are out of date after edits, and right again after
 * their update, which follows the numbers of triangles and vertices. */
static void test_others_catch_up(void **state)
{
    (void)state;
    uint64_t random = 12;
    for (int round = 0; round < 40; round++) {
        shape s = shape_ball(2, 30, 0.2, &random);
        surface_twin t = surface_twin_make(&s, 0);
        mw_star *star, *fresh_star;
        mw_prober *other;
        mw_prober_options boxes = {.boxes = 1};
        uint32_t path[2 * PATH], *number;
        assert_int_equal(mw_star_create(t.surface, NULL, &star, NULL), MW_OK);
        assert_int_equal(mw_prober_create(t.surface, &boxes, &other, NULL), MW_OK);
        for (int i = 0; i < 12; i++) {
            mw_surface_edit edit = surface_twin_edit(&t, path, PATH, &random);
            bool closed = edit.kind >= MW_SURFACE_SPLIT_EDGE && edit.kind < MW_SURFACE_CUT;
            if (edit.kind != MW_SURFACE_COLLAPSE || round % 2) edit.point[0] = NAN;
            if (closed || (round == 7 && edit.kind == MW_SURFACE_REMOVE_TRIANGLE))
                surface_twin_apply(&t, &edit);
        }
        const double ray[3] = {1, 2, 3}, motion[3] = {-1, -2, -3};
        mw_star_cursor cursor = {0};
        if (t.applied) assert_int_equal(mw_star_locate(star, &cursor, ray).where, MW_BAD);
        shape now = surface_twin_shape(&t, &number);
        mw_surface *fresh = shape_surface(&now, (mw_surface_options){0});
        mw_status status = mw_star_create(fresh, NULL, &fresh_star, NULL);
        assert_int_equal(mw_star_update(star, NULL, NULL), status);
        for (int i = 0; i < 50; i++) {
            double q[3];
            for (int k = 0; k < 3; k++) q[k] = (double)mw__random_below(&random, 41) - 20;
            mw_star_cursor fresh_cursor = {0};
            mw_location is = mw_star_locate(star, &cursor, q), should = {0};
            if (status == MW_OK) should = mw_star_locate(fresh_star, &fresh_cursor, q);
            assert_int_equal(is.where, status == MW_OK ? should.where : MW_BAD);
            if (status == MW_OK && should.triangle != MW_NONE)
                assert_int_equal(is.triangle, number[should.triangle]);
        }
        mw_probe_cursor probe;
        mw_probe_options certain = {.certain = 1};
        assert_int_equal(mw_probe_cursor_init(other, &certain, &probe, NULL), MW_OK);
        if (t.applied) {
            assert_int_equal(mw_probe(other, &probe, ray, motion).state, MW_TOUCH_BAD);
            mw_prober_update(other, 0, 1);
        }
        t.certain = probe;
        mw_prober *followed = t.prober;
        t.prober = other; /* check this one */
        surface_twin_check_probes(&t, 10, &random);
        t.prober = followed;
        mw_star_destroy(star);
        mw_star_destroy(fresh_star);
        mw_prober_destroy(other);
        mw_surface_destroy(fresh);
        surface_twin_free(&t);
        shape_free(&now);
        shape_free(&s);
        free(number);
    }
}

/* What cannot be edited, and NULL. */
static void test_arguments(void **state)
{
    (void)state;
    shape s = two_squares(), bad = two_squares();
    mw_surface_editor *e;
    mw_error error;
    for (int i = 0; i < 2; i++) {
        mw_surface *surface =
            shape_surface(&s, (mw_surface_options){.weld = i == 0, .borrow = i == 1});
        assert_int_equal(mw_surface_editor_create(surface, NULL, &e, NULL), MW_ERROR_ARGUMENT);
        mw_surface_destroy(surface);
    }
    bad.triangles[0] = bad.triangles[1];
    mw_surface *twice = shape_surface(&bad, (mw_surface_options){.tolerant = 1});
    assert_int_equal(mw_surface_editor_create(twice, NULL, &e, &error), MW_ERROR_INPUT);
    assert_string_equal(error.message, "triangle 0 names a vertex twice");
    mw_surface_destroy(twice);
    for (int k = 0; k < 3; k++) bad.triangles[k] = bad.triangles[3 + k]; /* three at one edge */
    bad.triangles[9] = 1, bad.triangles[10] = 4, bad.triangles[11] = 0;
    mw_surface *third = shape_surface(&bad, (mw_surface_options){.tolerant = 1});
    assert_int_equal(mw_surface_editor_create(third, NULL, &e, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "has more than two triangles"));
    mw_surface_destroy(third);
    assert_int_equal(mw_surface_editor_create(NULL, NULL, &e, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_edit_apply(NULL, NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_edit_undo(NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    mw_surface_editor_destroy(NULL);
    assert_null(mw_surface_edit_name(MW_SURFACE_EDIT_KIND_COUNT));
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    assert_int_equal(mw_surface_editor_create(surface, NULL, &e, NULL), MW_OK);
    assert_int_equal(mw_surface_edit_cut(e, (uint32_t[]){0}, 1, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_edit_sew(e, (uint32_t[]){0, 1}, NULL, 2, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    mw_surface_editor_destroy(e);
    mw_surface_destroy(surface);
    shape_free(&bad);
    shape_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_streams),         cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_cut_and_sew),     cmocka_unit_test(test_updates),
        cmocka_unit_test(test_others_catch_up), cmocka_unit_test(test_arguments)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
