/* test_surface_edit_stars.c - a star follows the editor of its surface: after each edit it equals
 * one made anew, or is refused as that is; single cases, and streams of edits that keep most
 * surfaces star-shaped. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/edit_require.h"
#include "oracle/surface/star_twin.h"
#include "star/star.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/star_shapes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct edited_star {
    mw_surface *surface;
    mw_surface_editor *editor;
    mw_star *star;
    mw_star_cursor cursor;
    star_twin_counts counts;
    uint64_t *random;
    uint32_t hole[3]; /* the last triangle that was removed, by its vertices */
    uint32_t busy;    /* a vertex that is edited often, or MW_NONE */
} edited_star;

static edited_star edited_star_make(star_shape shape, int angles, uint64_t *random)
{
    edited_star s = {.random = random, .busy = MW_NONE};
    mw_arrays view = star_shape_arrays(&shape);
    mw_star_options options = {.angles = angles, .threads = 1};
    mw_surface_editor_options undo = {.undo = SIZE_MAX};
    mw_error error;
    expect_ok(mw_surface_create(&view, NULL, &s.surface, &error), "surface", &error);
    expect_ok(mw_star_create(s.surface, &options, &s.star, &error), "star", &error);
    expect_ok(mw_surface_editor_create(s.surface, &undo, &s.editor, &error), "editor", &error);
    expect_ok(mw_surface_editor_attach_star(s.editor, s.star, &error), "attach", &error);
    expect_ok(mw_star_cursor_init(s.star, NULL, &s.cursor, &error), "cursor", &error);
    star_shape_free(&shape);
    return s;
}

static void edited_star_free(edited_star *s)
{
    mw_surface_editor_destroy(s->editor);
    mw_star_destroy(s->star);
    mw_surface_destroy(s->surface);
}

static void check(edited_star *s, int rays)
{
    star_twin_check(s->star, &s->cursor, rays, &s->counts, s->random);
}

/* --- streams --- */

static uint32_t any_triangle(const edited_star *s)
{
    uint32_t v[3], t, at[200];
    if (s->busy != MW_NONE && mw__random_below(s->random, 2)) {
        size_t n = mw_surface_editor_triangles_of(s->editor, s->busy, at, 200);
        if (n > 0) return at[mw__random_below(s->random, (uint32_t)(n < 200 ? n : 200))];
    }
    do t = mw__random_below(s->random, mw_surface_triangle_count(s->surface));
    while (!mw_surface_editor_triangle(s->editor, t, v));
    return t;
}

/* Another place for a vertex: along its ray, off it, or, rarely, where another vertex is. */
static void any_place(const edited_star *s, uint32_t vertex, uint32_t other, double point[3])
{
    uint32_t kind = mw__random_below(s->random, 12);
    mw_surface_editor_vertex(s->editor, kind == 0 ? other : vertex, point);
    for (int k = 0; k < 3 && kind > 0; k++)
        point[k] = point[k] * (kind < 4 ? 1.125 : 0.9375) +
                   (kind > 8 ? 0.25 * (random_unit(s->random) - 0.5) : 0);
    if (kind == 11 && mw__random_below(s->random, 4) == 0) point[0] = -point[0];
}

static mw_status edit(edited_star *s)
{
    uint32_t t = any_triangle(s), v[3], k = mw__random_below(s->random, 3), path[3];
    double point[3];
    mw_surface_editor_triangle(s->editor, t, v);
    uint32_t a = v[k], b = v[(k + 1) % 3];
    switch (mw__random_below(s->random, 16)) {
    case 0:
    case 1:
    case 2: return mw_surface_edit_split_edge(s->editor, a, b, NULL, NULL, NULL);
    case 3:
    case 4: return mw_surface_edit_split_triangle(s->editor, t, NULL, NULL, NULL);
    case 5:
    case 6:
    case 7: return mw_surface_edit_flip(s->editor, a, b, NULL, NULL);
    case 8:
    case 9: return mw_surface_edit_collapse(s->editor, a, b, NULL, NULL, NULL);
    case 10:
        memcpy(s->hole, v, sizeof v);
        return mw_surface_edit_remove_triangle(s->editor, t, NULL, NULL);
    case 11: return mw_surface_edit_add_triangle(s->editor, s->hole, NULL, NULL);
    case 12:
        if (mw__random_below(s->random, 2))
            return mw_surface_edit_remove_vertex(s->editor, a, NULL, NULL);
        memcpy(path, v, sizeof path);
        return mw_surface_edit_cut(s->editor, path, 3, NULL, NULL);
    default:
        any_place(s, a, b, point);
        return mw_surface_edit_move_vertex(s->editor, a, point, NULL, NULL);
    }
}

/* Vertices moved by hand, and edits, as one update. */
static void edits_in_an_update(edited_star *s)
{
    uint32_t moved[3];
    mw_surface_begin_update(s->surface);
    edit(s);
    for (int i = 0; i < 3; i++) {
        uint32_t v[3];
        mw_surface_editor_triangle(s->editor, any_triangle(s), v);
        double *p = mw_surface_points(s->surface) + 3 * (size_t)(moved[i] = v[0]);
        for (int k = 0; k < 3; k++) p[k] *= 1.0625;
    }
    mw_star_update(s->star, &(mw_star_update_options){.moved = moved, .moved_count = 3}, NULL);
    mw_surface_end_update(s->surface);
}

static void step(edited_star *s)
{
    uint32_t what = mw__random_below(s->random, 50);
    if (what == 0)
        assert_int_equal(mw_surface_editor_compact(s->editor, NULL, NULL, NULL), MW_OK);
    else if (what == 1)
        edits_in_an_update(s);
    else if (what < 5 || (!(mw_star_ready(s->star) && s->star->track.on) && what < 40))
        mw_surface_edit_undo(s->editor, NULL, NULL);
    else
        edit(s);
}

static void stream(edited_star *s, uint64_t seed, int steps)
{
    edit_case.name = "stars";
    edit_case.seed = seed;
    for (int i = 0; i < steps; i++) {
        edit_case.step = (uint64_t)i;
        step(s);
        check(s, 6);
    }
    while (mw_surface_edit_undo(s->editor, NULL, NULL) == MW_OK) check(s, 2);
    edited_star_free(s);
}

static void add_counts(star_twin_counts *sum, const star_twin_counts *more)
{
    sum->ready += more->ready;
    sum->refused += more->refused;
    sum->flat += more->flat;
}

static void test_streams(void **state)
{
    (void)state;
    uint64_t seed = environment_print_seed("stars that follow edits", 31);
    int streams = environment_is_long() ? 4000 : 12;
    star_twin_counts sum = {0};
    for (int i = 0; i < streams; i++) {
        uint64_t random = mw__random_seed(seed, (uint64_t)i);
        star_shape shape = star_shape_octahedron(1 + mw__random_below(&random, 2));
        star_shape_stretch(&shape, 3, &random);
        if (mw__random_below(&random, 2)) star_shape_shuffle(&shape, &random);
        edited_star s = edited_star_make(shape, i % 2, &random);
        stream(&s, seed, 150);
        add_counts(&sum, &s.counts);
    }
    printf("%d star-shaped, %d refused, %d with flat facets\n", (int)sum.ready, (int)sum.refused,
           (int)sum.flat);
    assert_true(sum.ready > 100 && sum.refused > 100 && sum.flat > 10);
}

/* A pole gets more facets than a hub needs, and fewer. */
static void test_hubs(void **state)
{
    (void)state;
    uint64_t seed = environment_print_seed("hubs that follow edits", 32);
    for (uint32_t around = 58; around < 74; around += 5) {
        uint64_t random = mw__random_seed(seed, around);
        edited_star s = edited_star_make(star_shape_globe(around, 3), 1, &random);
        s.busy = 0;
        uint32_t at[200], v[3], most = 0;
        for (int i = 0; i < 30; i++) {
            mw_surface_editor_triangles_of(s.editor, 0, at, 200);
            assert_int_equal(mw_surface_edit_split_triangle(s.editor, at[0], NULL, NULL, NULL),
                             MW_OK);
            check(&s, 6);
            if (s.star->hubs.count > most) most = s.star->hubs.count;
        }
        assert_true(most >= 1);
        for (uint32_t i = 0, n; i < 300; i++) {
            n = (uint32_t)mw_surface_editor_triangles_of(s.editor, 0, at, 200);
            if (n < 20) break;
            mw_surface_editor_triangle(s.editor, at[mw__random_below(&random, n)], v);
            uint32_t k = v[0] == 0 ? 1 : v[1] == 0 ? 2 : 0;
            mw_surface_edit_collapse(s.editor, v[k], v[(k + 1) % 3], NULL, NULL, NULL);
            check(&s, 3);
        }
        assert_true(mw_surface_editor_triangles_of(s.editor, 0, at, 200) < 32);
        for (uint32_t i = 0; i < s.star->hubs.count; i++)
            assert_int_not_equal(s.star->hubs.hub[i].vertex, 0);
        stream(&s, seed, 60);
    }
}

/* A pole merges into a vertex beside it, which becomes a hub in its place. */
static void test_hub_merges(void **state)
{
    (void)state;
    uint64_t random = 5;
    edited_star s = edited_star_make(star_shape_globe(80, 3), 0, &random);
    assert_int_equal(mw_surface_edit_collapse(s.editor, 0, 2, NULL, NULL, NULL), MW_OK);
    assert_true(mw_star_ready(s.star));
    check(&s, 50);
    assert_int_equal(s.star->hubs.count, 2);
    assert_int_equal(s.star->hubs.hub[1].vertex, 2);
    assert_int_equal(mw_surface_edit_undo(s.editor, NULL, NULL), MW_OK);
    check(&s, 50);
    assert_int_equal(s.star->hubs.hub[0].vertex, 0);
    edited_star_free(&s);
}

/* --- starts --- */

/* Facets that a query visits on average. */
static double visits(const mw_star *star, uint64_t *random)
{
    mw_star_query_options options = {.counters = 1};
    mw_star_cursor cursor;
    expect_ok(mw_star_cursor_init(star, &options, &cursor, NULL), "cursor", NULL);
    for (int i = 0; i < 4000; i++) {
        double q[3];
        for (int k = 0; k < 3; k++) q[k] = random_unit(random) - 0.5;
        assert_int_not_equal(mw_star_locate(star, &cursor, q).where, MW_BAD);
    }
    return (double)cursor.counters.triangles_visited / (double)cursor.counters.queries;
}

/* Queries of a star that has followed many edits begin about as near as those of a new one. */
static void expect_near_starts(const edited_star *s)
{
    mw_star *fresh;
    expect_ok(mw_star_create(s->surface, NULL, &fresh, NULL), "star", NULL);
    double is = visits(s->star, s->random), should = visits(fresh, s->random);
    printf("%u facets: %.2f visited, by a new star %.2f\n", fresh->facet_count, is, should);
    assert_true(is < 2 * should);
    mw_star_destroy(fresh);
}

/* Each facet is split, and then all new vertices go again. */
static void test_starts(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("starts that follow edits", 33);
    edited_star s = edited_star_make(star_shape_octahedron(5), 0, &random);
    uint32_t facets = mw_surface_triangle_count(s.surface),
             vertices = mw_surface_vertex_count(s.surface), at, v[3];
    for (uint32_t t = 0; t < facets; t++)
        assert_int_equal(mw_surface_edit_split_triangle(s.editor, t, NULL, NULL, NULL), MW_OK);
    expect_near_starts(&s);
    for (uint32_t i = vertices; i < vertices + facets; i++) {
        mw_surface_editor_triangles_of(s.editor, i, &at, 1);
        assert_true(mw_surface_editor_triangle(s.editor, at, v));
        uint32_t kept = v[0] == i ? v[1] : v[0];
        assert_int_equal(mw_surface_edit_collapse(s.editor, i, kept, NULL, NULL, NULL), MW_OK);
    }
    assert_true(mw_star_ready(s.star));
    expect_near_starts(&s);
    edited_star_free(&s);
}

/* --- single cases --- */

static int ready_after(edited_star *s, mw_status status)
{
    assert_int_equal(status, MW_OK);
    return mw_star_ready(s->star);
}

/* A hole: no answer, and the defect by its name; filled again: answers. Not attached: none. */
static void test_hole(void **state)
{
    (void)state;
    uint64_t random = 3;
    edited_star s = edited_star_make(star_shape_octahedron(2), 0, &random);
    mw_error error;
    uint32_t v[3];
    assert_true(mw_surface_editor_triangle(s.editor, 5, v));
    assert_false(ready_after(&s, mw_surface_edit_remove_triangle(s.editor, 5, NULL, NULL)));
    assert_int_equal(mw_star_update(s.star, NULL, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "has no neighbour: the polyhedron is not closed"));
    assert_true(ready_after(&s, mw_surface_edit_add_triangle(s.editor, v, NULL, NULL)));
    assert_true(ready_after(&s, mw_surface_edit_split_triangle(s.editor, 7, NULL, NULL, NULL)));
    check(&s, 50);
    mw_surface_editor_detach_star(s.editor, s.star);
    mw_surface_editor_detach_star(s.editor, s.star);
    assert_true(mw_star_ready(s.star));
    assert_false(ready_after(&s, mw_surface_edit_split_triangle(s.editor, 8, NULL, NULL, NULL)));
    expect_ok(mw_surface_editor_attach_star(s.editor, s.star, &error), "attach", &error);
    expect_ok(mw_surface_editor_attach_star(s.editor, s.star, &error), "again", &error);
    assert_true(mw_star_ready(s.star));
    check(&s, 50);
    edited_star_free(&s);
}

/* What cannot be attached. */
static void test_arguments(void **state)
{
    (void)state;
    uint64_t random = 4;
    edited_star s = edited_star_make(star_shape_octahedron(1), 0, &random),
                other = edited_star_make(star_shape_octahedron(1), 0, &random);
    mw_error error;
    mw_prober *prober;
    assert_int_equal(mw_prober_create(other.surface, NULL, &prober, NULL), MW_OK);
    assert_int_equal(mw_surface_editor_attach_star(s.editor, other.star, &error),
                     MW_ERROR_ARGUMENT);
    assert_string_equal(error.message, "the star is one of another surface");
    assert_int_equal(mw_surface_editor_attach_prober(s.editor, prober, &error), MW_ERROR_ARGUMENT);
    assert_string_equal(error.message, "the prober is one of another surface");
    assert_int_equal(mw_surface_editor_attach_star(s.editor, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_editor_attach_star(NULL, s.star, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_editor_attach_prober(s.editor, NULL, NULL), MW_ERROR_ARGUMENT);
    mw_surface_editor_detach_prober(s.editor, prober);
    mw_prober_destroy(prober);
    edited_star_free(&s);
    edited_star_free(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_streams),    cmocka_unit_test(test_hubs),
        cmocka_unit_test(test_hub_merges), cmocka_unit_test(test_starts),
        cmocka_unit_test(test_hole),       cmocka_unit_test(test_arguments)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
