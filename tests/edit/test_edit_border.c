/* test_edit_border.c - vertices of a border, or of constraints, that move. A move is done exactly
 * where the triangles are an embedding afterwards, by a check from scratch (edit_predict.h). The
 * answers then are those of a locator made from nothing; undo and replay lead to the same. Refusals
 * tell the reason. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/edit_open.h"
#include "oracle/edit_apply.h"
#include "support/allocations.h"
#include "support/meshes.h"

enum { HOLES = 64, QUERIES = 60 };

/* --- answers as by a locator made anew -------------------------------------------------------- */

/* The same holes, whatever their numbers: which number is which. */
typedef struct pairing {
    uint32_t fresh[HOLES], edited[HOLES];
} pairing;

static void pair_holes(pairing *p, uint32_t edited, uint32_t fresh)
{
    REQUIRE((edited == MW_NONE) == (fresh == MW_NONE));
    if (edited == MW_NONE) return;
    REQUIRE(edited < HOLES && fresh < HOLES);
    if (p->fresh[edited] == MW_NONE && p->edited[fresh] == MW_NONE) {
        p->fresh[edited] = fresh;
        p->edited[fresh] = edited;
    }
    REQUIRE(p->fresh[edited] == fresh && p->edited[fresh] == edited);
}

static mw_location locate_once(const mw_locator *locator, const double *q)
{
    mw_cursor cursor;
    REQUIRE(mw_cursor_init(locator, NULL, &cursor, NULL) == MW_OK);
    return mw_locate(locator, &cursor, q[0], q[1]);
}

static void check_fresh(const twin *t, const double *queries, size_t n)
{
    uint32_t *triangles = require_room(t->triangle_range, sizeof *triangles);
    mw_mesh *mesh;
    mw_error error = {0};
    expect_ok(mw_editor_mesh(t->editor, triangles, NULL, &mesh, &error), "mesh", &error);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    pairing pairs;
    memset(&pairs, 0xff, sizeof pairs); /* MW_NONE */
    for (size_t i = 0; i < n; i++) {
        mw_location edited = locate_once(mw_editor_locator(t->editor), queries + 2 * i);
        mw_location fresh = locate_once(locator, queries + 2 * i);
        REQUIRE(edited.where == fresh.where && edited.local == fresh.local);
        REQUIRE(fresh.triangle ==
                (edited.triangle == MW_NONE ? MW_NONE : triangles[edited.triangle]));
        pair_holes(&pairs, edited.hole, fresh.hole);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(triangles);
}

/* --- at random -------------------------------------------------------------------------------- */

typedef struct soup {
    const char *name;
    uint32_t cells, keep; /* cells a side, and of 16 triangles so many stay */
    double jitter;
    mw_delaunay_mode delaunay;
    uint32_t constraints; /* at most */
} soup;

static const soup soups[] = {
    {"half of a lattice", 4, 8, 0, MW_DELAUNAY_NEVER, 0},
    {"half of a lattice, kept Delaunay", 4, 8, 0, MW_DELAUNAY_MAKE, 0},
    {"most of a lattice", 5, 13, 0, MW_DELAUNAY_MAKE, 0},
    {"holes", 6, 12, 0.4, MW_DELAUNAY_MAKE, 0},
    {"holes, constraints", 5, 13, 0.4, MW_DELAUNAY_MAKE, 8},
    {"holes, constraints, not to be flipped", 5, 13, 0.4, MW_DELAUNAY_NEVER, 8},
    {"components", 6, 5, 0.4, MW_DELAUNAY_NEVER, 0},
    {"full, constraints", 3, 16, 0, MW_DELAUNAY_MAKE, 6},
    {"full, constraints, not to be flipped", 3, 16, 0, MW_DELAUNAY_NEVER, 6},
};

/* The twin knows a mesh as it was given: edges are flipped before. */
static mw_mesh *make_delaunay(mw_mesh *mesh)
{
    mw_editor *editor;
    mw_mesh *result;
    mw_error error = {0};
    expect_ok(
        mw_editor_create(mesh, &(mw_editor_options){.delaunay = MW_DELAUNAY_MAKE}, &editor, &error),
        "editor", &error);
    expect_ok(mw_editor_mesh(editor, NULL, NULL, &result, &error), "mesh", &error);
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
    return result;
}

static mw_mesh *make_soup(const soup *s, uint64_t *random)
{
    arrays a = arrays_grid(s->cells, s->jitter, random);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < a.triangle_count; i++) {
        if (mw__random_below(random, 16) >= s->keep) continue;
        memmove(a.triangles + 3 * (size_t)kept++, a.triangles + 3 * (size_t)i,
                3 * sizeof *a.triangles);
    }
    a.triangle_count = kept > 0 ? kept : 1;
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    arrays_free(&a);
    return s->delaunay == MW_DELAUNAY_MAKE ? make_delaunay(mesh) : mesh;
}

/* Edges of some triangles. */
static uint32_t choose_constraints(const mw_mesh *mesh, uint32_t most, uint32_t *ends,
                                   uint64_t *random)
{
    for (uint32_t i = 0; i < most; i++) {
        uint32_t v[3], k = mw__random_below(random, 3);
        mw_mesh_triangle(mesh, mw__random_below(random, mw_mesh_triangle_count(mesh)), v);
        ends[2 * i] = v[k];
        ends[2 * i + 1] = v[(k + 1) % 3];
    }
    return most;
}

/* Somewhere: near, far, half-way to another vertex, or on the integers, where much is in line. */
static void choose_target(const twin *t, uint32_t v, double *q, uint64_t *random)
{
    const double *p = twin_point(t, v),
                 *w = twin_point(t, mw__random_below(random, t->vertex_range));
    const uint32_t kind = mw__random_below(random, 8), range = 14;
    for (int i = 0; i < 2; i++) {
        q[i] = p[i] + (random_unit(random) - 0.5) * (kind < 3 ? 1 : 3);
        if (kind == 4) q[i] = p[i] / 2 + w[i] / 2;
        if (kind == 5) q[i] = p[i] * 2 - w[i];
        if (kind >= 6) q[i] = mw__random_below(random, range) / (double)(kind - 5) - 1;
    }
}

typedef struct tally {
    uint64_t done, refused, pinched, made;
} tally;

static void note_holes(const twin *t, const double *queries, uint32_t *holes)
{
    for (size_t i = 0; i < QUERIES; i++)
        holes[i] = locate_once(mw_editor_locator(t->editor), queries + 2 * i).hole;
}

/* A move of a border vertex, as foretold; taken back now and then. */
static void try_move(twin *t, const double *queries, tally *n, uint64_t *random)
{
    uint32_t v = mw__random_below(random, t->vertex_range), before[QUERIES], after[QUERIES];
    if (!twin_uses_vertex(t, v)) return;
    twin_star s = twin_star_of(t, v);
    const bool fixed = s.fixed_count > 0, pinched = s.border_count > 2;
    twin_star_free(&s);
    if (!fixed && mw__random_below(random, 4)) return;
    double q[2];
    choose_target(t, v, q, random);
    note_holes(t, queries, before);
    twin then = twin_copy(t);
    if (twin_apply(t, &(mw_edit){.kind = MW_EDIT_MOVE, .vertex = v, .x = q[0], .y = q[1]}, true) ==
        MW_OK) {
        n->done++;
        n->pinched += pinched;
        n->made += t->triangle_range > then.triangle_range;
        check_fresh(t, queries, QUERIES);
        note_holes(t, queries, after);
        for (size_t i = 0; i < QUERIES && !pinched; i++)
            if (before[i] != MW_NONE && after[i] != MW_NONE) REQUIRE(before[i] == after[i]);
        if (mw__random_below(random, 3) == 0) {
            twin_undo(t, &then);
            note_holes(t, queries, after);
            REQUIRE(memcmp(before, after, sizeof before) == 0);
        }
    } else {
        n->refused++;
    }
    twin_close(&then);
}

static void run_soup(const soup *s, uint64_t seed, tally *n)
{
    enum { MOVES = 60 };
    uint64_t random = mw__random_seed(seed, 11);
    edit_case.name = s->name;
    edit_case.seed = seed;
    mw_mesh *mesh = make_soup(s, &random);
    uint32_t ends[2 * 8];
    mw_editor_options options = {
        .delaunay = s->delaunay, .undo = SIZE_MAX, .log = 1, .constrained_edges = ends};
    options.constrained_edge_count = choose_constraints(mesh, s->constraints, ends, &random);
    twin t;
    twin_cursors cursors;
    twin_open(&t, mesh, &options);
    twin_cursors_open(&cursors, &t, seed % 2, seed);
    double queries[2 * QUERIES];
    for (int i = 0; i < 2 * QUERIES; i++)
        queries[i] = (i % 4 < 2 ? random_unit(&random) : mw__random_below(&random, 16) / 16.0) *
                         (s->cells + 1) -
                     0.5;
    for (edit_case.step = 0; edit_case.step < MOVES; edit_case.step++) {
        try_move(&t, queries, n, &random);
        if (edit_case.step % 10 == 0) twin_check_all(&t);
    }
    twin_check_all(&t);
    twin_check_queries(&t, &cursors);
    twin_check_replay(&t, &options);
    twin_compact(&t);
    check_fresh(&t, queries, QUERIES);
    twin_close(&t);
}

static void test_soups(void **state)
{
    (void)state;
    enum { SEEDS = 25 };
    twin_bare = true;
    for (size_t i = 0; i < sizeof soups / sizeof *soups; i++) {
        tally n = {0};
        for (uint64_t seed = 1; seed <= SEEDS; seed++) run_soup(&soups[i], seed, &n);
        print_message(
            "%-38s %llu moves, %llu refused; %llu where components meet, %llu made triangles\n",
            soups[i].name, (unsigned long long)n.done, (unsigned long long)n.refused,
            (unsigned long long)n.pinched, (unsigned long long)n.made);
        assert_true(n.done > 50 && n.refused > 50);
    }
    twin_bare = false;
}

/* --- by hand ---------------------------------------------------------------------------------- */

static void open_arrays(twin *t, const arrays *a, const mw_editor_options *options)
{
    twin_open(t, arrays_mesh(a, (mw_mesh_options){0}), options);
}

static arrays make_arrays(const double *points, uint32_t n, const uint32_t *triangles, uint32_t m)
{
    arrays a = arrays_make(n, m);
    memcpy(a.points, points, 2 * sizeof *points * n);
    memcpy(a.triangles, triangles, 3 * sizeof *triangles * m);
    a.point_count = n;
    a.triangle_count = m;
    return a;
}

static void move_to(twin *t, uint32_t v, double x, double y)
{
    REQUIRE(twin_apply(t, &(mw_edit){.kind = MW_EDIT_MOVE, .vertex = v, .x = x, .y = y}, true) ==
            MW_OK);
    twin_check_all(t);
}

/* The mesh of a report: a vertex on the border of a pocket, whose ghosts turn over. */
static void test_pocket(void **state)
{
    (void)state;
    static const double p[] = {0, 0, 3, 0, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3};
    static const uint32_t v[] = {0, 1, 4, 0, 4, 5, 0, 5, 7, 5, 6, 7, 1, 2, 4, 2, 3, 4};
    arrays a = make_arrays(p, 8, v, 6);
    twin t;
    edit_case.name = "pocket";
    open_arrays(&t, &a, &(mw_editor_options){.undo = 9});
    move_to(&t, 6, 1, 2.5);
    move_to(&t, 6, 1.75, 2);
    move_to(&t, 6, 1, 9);
    move_to(&t, 6, -0.25, 9);
    move_to(&t, 2, 2.5, 1.25);
    arrays_free(&a);
    twin_close(&t);
}

/* Two arms that meet at vertex 0 make a ring. In its hole lies a frame, which has a hole too. */
static arrays ring_and_frame(void)
{
    static const double p[] = {4,   0,   3,   2,    2.5, 1,    -3,  2,    -2,  1,    -3,  -2,
                               -2,  -1,  3,   -2,   2.5, -1,   2.8, -0.2, 3.2, -0.2, 3.2, 0.2,
                               2.8, 0.2, 2.9, -0.1, 3.1, -0.1, 3.1, 0.1,  2.9, 0.1};
    static const uint32_t v[] = {0,  1,  2,  0,  8,  7,  1,  3,  4,  1,  4,  2, 3,  5,  6,  3,
                                 6,  4,  5,  7,  8,  5,  8,  6,  9,  10, 14, 9, 14, 13, 10, 11,
                                 15, 10, 15, 14, 11, 12, 16, 11, 16, 15, 12, 9, 13, 12, 13, 16};
    return make_arrays(p, 17, v, 16);
}

/* Vertex 0 goes past the frame, which then lies outside. */
static void test_past_a_component(void **state)
{
    (void)state;
    static const double queries[] = {0, 0, 3, 0, 2.6, 0, 3.5, 0};
    arrays a = ring_and_frame();
    twin t;
    uint32_t hole[4];
    edit_case.name = "past a component";
    open_arrays(&t, &a, &(mw_editor_options){.undo = 9, .delaunay = MW_DELAUNAY_NEVER});
    const mw_locator *locator = mw_editor_locator(t.editor);
    for (int turn = 0; turn < 3; turn++) {
        const bool away = turn == 1;
        for (int i = 0; i < 4; i++) hole[i] = locate_once(locator, queries + 2 * i).hole;
        assert_int_equal(hole[0], 0);
        assert_int_equal(hole[1], 1);
        assert_int_equal(hole[2], away ? MW_NONE : 0);
        assert_int_equal(hole[3], away ? MW_NONE : 0);
        check_fresh(&t, queries, 4);
        if (turn < 2) move_to(&t, 0, away ? 4 : 2.25, 0);
    }
    arrays_free(&a);
    twin_close(&t);
}

static const mw_delaunay_mode kept_or_not[] = {MW_DELAUNAY_AUTO, MW_DELAUNAY_NEVER};

static arrays two_halves(void)
{
    static const double p[] = {0, 0, 2, 0, 2, 2, 0, 2};
    static const uint32_t v[] = {0, 1, 2, 0, 2, 3};
    return make_arrays(p, 4, v, 2);
}

/* A mesh that fills its hull, with a constraint at a corner: what the corner uncovers becomes
 * triangles. */
static void test_corner_with_constraint(void **state)
{
    (void)state;
    static const uint32_t ends[] = {0, 2};
    arrays a = two_halves();
    for (int mode = 0; mode < 2; mode++) {
        const mw_delaunay_mode delaunay = kept_or_not[mode];
        twin t;
        mw_editor_options options = {.undo = 9,
                                     .log = 1,
                                     .delaunay = delaunay,
                                     .constrained_edges = ends,
                                     .constrained_edge_count = 1};
        edit_case.name = "corner with constraint";
        open_arrays(&t, &a, &options);
        twin then = twin_copy(&t);
        move_to(&t, 2, 0.75, 0.75);
        assert_int_equal(t.triangles, 3);
        move_to(&t, 0, 0.7, 0.7);
        assert_int_equal(t.triangles, 3);
        twin_check_replay(&t, &options);
        for (int i = 0; i < 2; i++) REQUIRE(mw_edit_undo(t.editor, NULL, NULL) == MW_OK);
        twin_check_same(&then);
        twin_close(&then);
        twin_close(&t);
    }
    arrays_free(&a);
}

/* Whichever allocation fails, nothing has changed. Each time by another editor, whose scratch is
 * empty. */
static void fail_move(const arrays *a, const mw_editor_options *options, uint32_t v, double x,
                      double y)
{
    mw_status status = MW_ERROR_MEMORY;
    long failures = -1;
    for (long k = 0; status == MW_ERROR_MEMORY; k++, failures++) {
        twin t;
        open_arrays(&t, a, options);
        allocations_left = k;
        status = mw_edit_move(t.editor, v, x, y, NULL, NULL);
        allocations_left = -1;
        if (status == MW_ERROR_MEMORY) twin_check_all(&t);
        twin_close(&t);
    }
    assert_int_equal(status, MW_OK);
    assert_true(failures > 2);
}

static void test_memory(void **state)
{
    (void)state;
    static const uint32_t ends[] = {0, 2};
    arrays ring = ring_and_frame(), halves = two_halves();
    edit_case.name = "memory";
    for (int mode = 0; mode < 2; mode++) {
        const mw_delaunay_mode delaunay = kept_or_not[mode];
        fail_move(&ring, &(mw_editor_options){.delaunay = delaunay}, 0, 2.25, 0);
        fail_move(&ring, &(mw_editor_options){.delaunay = delaunay, .undo = 9}, 3, -9, 9);
        fail_move(&halves,
                  &(mw_editor_options){
                      .delaunay = delaunay, .constrained_edges = ends, .constrained_edge_count = 1},
                  2, 0.75, 0.75);
    }
    arrays_free(&ring);
    arrays_free(&halves);
}

/* --- refusals --------------------------------------------------------------------------------- */

static void expect_reason(const twin *t, uint32_t v, double x, double y, const char *reason)
{
    mw_error error = {0};
    assert_int_equal(mw_edit_move(t->editor, v, x, y, NULL, &error), MW_ERROR_INPUT);
    assert_string_equal(error.message, reason);
    twin_check_same(t);
}

static void test_reasons(void **state)
{
    (void)state;
    static const double p[] = {0, 0, 3, 0, 3, 3,    2, 3,   2, 1,   1,
                               1, 1, 3, 0, 3, 1.25, 4, 1.8, 4, 1.5, 5};
    static const uint32_t v[] = {0, 1, 4, 0, 4, 5, 0, 5, 7, 5, 6, 7, 1, 2, 4, 2, 3, 4, 8, 9, 10};
    arrays a = make_arrays(p, 11, v, 7);
    twin t;
    edit_case.name = "reasons";
    open_arrays(&t, &a, &(mw_editor_options){.undo = 9});
    expect_reason(&t, 6, 1, 0.5,
                  "vertex 6 cannot move there: triangle 3 would turn over or be flat");
    expect_reason(&t, 7, 1, 5, "vertex 7 cannot move there: triangle 3 would turn over or be flat");
    expect_reason(&t, 6, 2.5, 2.75, "vertex 6 cannot move there: it would lie in triangle 5");
    expect_reason(&t, 6, 2, 2,
                  "vertex 6 cannot move there: it would lie on the edge from vertex 3 to 4");
    expect_reason(&t, 6, 2, 3, "vertex 6 cannot move there: vertex 3 lies there already");
    expect_reason(
        &t, 6, 2.5, 3.5,
        "vertex 6 cannot move there: its edge to vertex 5 would cross the edge from vertex 2 to 3");
    expect_reason(
        &t, 6, 1.5, 6,
        "vertex 6 cannot move there: its edge to vertex 5 would cross the edge from vertex "
        "8 to 10");
    expect_reason(&t, 6, 1.5, 7,
                  "vertex 6 cannot move there: vertex 8 would lie on its edge to vertex 5");
    expect_reason(&t, 10, 1.5, 3.5,
                  "vertex 10 cannot move there: triangle 6 would turn over or be flat");
    expect_reason(&t, 0, NAN, 0, "the point is not finite");
    twin_check_all(&t);
    arrays_free(&a);
    twin_close(&t);
}

/* No edge is crossed where a triangle comes to lie over a component as a whole. */
static void test_cover(void **state)
{
    (void)state;
    static const double p[] = {0, 0, 10, 0, 5, 1, 4, 3, 6, 3, 5, 4};
    static const uint32_t v[] = {0, 1, 2, 3, 4, 5};
    arrays a = make_arrays(p, 6, v, 2);
    twin t;
    mw_error error = {0};
    edit_case.name = "cover";
    open_arrays(&t, &a, NULL);
    assert_int_equal(mw_edit_move(t.editor, 2, 5, 40, NULL, &error), MW_ERROR_INPUT);
    assert_non_null(
        strstr(error.message, "vertex 2 cannot move there: triangle 0 would cover vertex "));
    assert_int_equal(error.triangle, 0);
    assert_true(error.vertex >= 3);
    twin_check_all(&t);
    move_to(&t, 2, 5, 2.5);
    arrays_free(&a);
    twin_close(&t);
}

/* --- compaction ------------------------------------------------------------------------------- */

/* A border that is fixed stays so when a move makes it convex: compaction must not take the mesh
 * for one that fills its hull, where insertions outside are done. */
static void test_compaction_keeps_the_border(void **state)
{
    (void)state;
    twin t;
    arrays a = arrays_make(5, 3);
    const double points[5][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 1}};
    for (int i = 0; i < 5; i++) arrays_point(&a, points[i][0], points[i][1]);
    arrays_triangle(&a, 0, 1, 4);
    arrays_triangle(&a, 1, 2, 4);
    arrays_triangle(&a, 0, 4, 3);
    twin_open(&t, arrays_mesh(&a, (mw_mesh_options){0}), NULL);
    REQUIRE(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_MOVE, .vertex = 4, .x = 2, .y = 4}, true) ==
            MW_OK);
    twin_compact(&t);
    REQUIRE(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_INSERT, .x = 2, .y = 5}, true) ==
            MW_ERROR_INPUT);
    twin_check_all(&t);
    twin_close(&t);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_soups),
        cmocka_unit_test(test_pocket),
        cmocka_unit_test(test_past_a_component),
        cmocka_unit_test(test_corner_with_constraint),
        cmocka_unit_test(test_compaction_keeps_the_border),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_reasons),
        cmocka_unit_test(test_cover),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
