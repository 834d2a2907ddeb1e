/* test_edit.c - every edit of small meshes: what it does, what it reports, that it can be taken
 * back, and that nothing has changed where it is refused. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/edit_open.h"
#include "oracle/edit_apply.h"
#include "support/meshes.h"

/* --- small meshes on points of a lattice ------------------------------------------------------ */

static arrays one_triangle(void)
{
    arrays a = arrays_make(3, 1);
    arrays_point(&a, 0, 0);
    arrays_point(&a, 2, 0);
    arrays_point(&a, 1, 2);
    arrays_triangle(&a, 0, 1, 2);
    return a;
}

static arrays square(void)
{
    uint64_t random = 1;
    return arrays_grid(1, 0, &random);
}

static arrays lattice(void)
{
    uint64_t random = 2;
    arrays a = arrays_grid(2, 0, &random);
    arrays_scramble(&a, 0, &random);
    return a;
}

/* As `lattice`, every second triangle clockwise. */
static arrays mixed_lattice(void)
{
    uint64_t random = 3;
    arrays a = arrays_grid(2, 0, &random);
    arrays_scramble(&a, 1, &random);
    return a;
}

/* Eight points round one, in no special position but for the integers. */
static arrays hub(void)
{
    static const double p[9][2] = {{2, 2}, {4, 1}, {4, 3}, {3, 4}, {1, 4},
                                   {0, 3}, {0, 1}, {1, 0}, {3, 0}};
    arrays a = arrays_make(9, 8);
    for (int i = 0; i < 9; i++) arrays_point(&a, p[i][0], p[i][1]);
    for (uint32_t i = 0; i < 8; i++) arrays_triangle(&a, 0, 1 + i, 1 + (i + 1) % 8);
    return a;
}

/* A hull side of many vertices, all joined to one. */
static arrays long_side(void)
{
    arrays a = arrays_make(6, 4);
    for (int i = 0; i < 5; i++) arrays_point(&a, i, 0);
    arrays_point(&a, 2, 3);
    for (uint32_t i = 0; i < 4; i++) arrays_triangle(&a, i, i + 1, 5);
    return a;
}

/* 3 x 3 cells without the ones that `keep` leaves out. */
static arrays cells(const char *keep, uint64_t seed)
{
    arrays a = arrays_grid(3, 0, &seed);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < 18; i++) {
        if (keep[i / 2] != '#') continue;
        memmove(a.triangles + 3 * (size_t)kept++, a.triangles + 3 * (size_t)i,
                3 * sizeof *a.triangles);
    }
    a.triangle_count = kept;
    return a;
}

static arrays ring(void)
{
    return cells("####.####", 4);
}

static arrays bent(void)
{
    return cells("###"
                 "#.."
                 "#..",
                 5);
}

/* Two squares that share a vertex, and one for itself. */
static arrays components(void)
{
    return cells("#.#"
                 ".#."
                 "...",
                 6);
}

typedef struct edit_scene {
    const char *name;
    arrays (*make)(void);
    mw_delaunay_mode delaunay; /* as in the options             */
    uint32_t constraints;      /* of these, so many are set     */
    uint32_t constraint[8];
} edit_scene;

static const edit_scene scenes[] = {
    {"one triangle", one_triangle, MW_DELAUNAY_AUTO, 0, {0}},
    {"square", square, MW_DELAUNAY_AUTO, 0, {0}},
    {"lattice", lattice, MW_DELAUNAY_AUTO, 0, {0}},
    {"lattice with a cross", lattice, MW_DELAUNAY_AUTO, 4, {1, 4, 4, 7, 3, 4, 4, 5}},
    {"lattice with a line", lattice, MW_DELAUNAY_AUTO, 2, {3, 4, 4, 5}},
    {"mixed lattice", mixed_lattice, MW_DELAUNAY_NEVER, 0, {0}},
    {"hub", hub, MW_DELAUNAY_AUTO, 0, {0}},
    {"hub, not to be flipped", hub, MW_DELAUNAY_NEVER, 2, {0, 1, 0, 5}},
    {"hub, made Delaunay", hub, MW_DELAUNAY_MAKE, 0, {0}},
    {"long side", long_side, MW_DELAUNAY_AUTO, 0, {0}},
    {"long side, constrained", long_side, MW_DELAUNAY_AUTO, 3, {1, 2, 2, 3, 2, 5}},
    {"ring", ring, MW_DELAUNAY_AUTO, 0, {0}},
    {"bent", bent, MW_DELAUNAY_MAKE, 0, {0}},
    {"bent, not to be flipped", bent, MW_DELAUNAY_NEVER, 0, {0}},
    {"components", components, MW_DELAUNAY_AUTO, 0, {0}},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static mw_editor_options scene_options(const edit_scene *s)
{
    return (mw_editor_options){.delaunay = s->delaunay,
                               .log = 1,
                               .undo = SIZE_MAX,
                               .constrained_edges = s->constraint,
                               .constrained_edge_count = s->constraints};
}

static void open_scene(const edit_scene *s, twin *t)
{
    arrays a = s->make();
    mw_editor_options options = scene_options(s);
    edit_case.name = s->name;
    twin_open(t, arrays_mesh(&a, (mw_mesh_options){0}), &options);
    arrays_free(&a);
}

/* --- each edit there is, alone ---------------------------------------------------------------- */

typedef struct edit_run {
    twin now, then;
    twin_cursors cursors;
    uint64_t done, refused;
    uint32_t depth; /* edits that follow, at random */
} edit_run;

static void try_edit(edit_run *r, mw_edit e)
{
    edit_case.step++;
    if (twin_apply(&r->now, &e, edit_case.step & 1) != MW_OK) {
        if (r->refused++ % 16 == 0) twin_check_all(&r->now);
        return;
    }
    r->done++;
    twin_check_all(&r->now);
    twin_check_queries(&r->now, &r->cursors);
    twin_undo(&r->now, &r->then);
}

static void try_places(edit_run *r, mw_edit_kind kind, uint32_t vertex, double step)
{
    for (double y = -1; y <= 4; y += step)
        for (double x = -1; x <= 4; x += step)
            try_edit(r, (mw_edit){.kind = kind, .vertex = vertex, .x = x, .y = y, .value = NAN});
}

static void try_pairs(edit_run *r, mw_edit_kind kind)
{
    for (uint32_t v = 0; v <= r->now.vertex_range; v++)
        for (uint32_t w = 0; w <= r->now.vertex_range; w++)
            try_edit(r, (mw_edit){.kind = kind, .vertex = v, .other = w});
}

static void try_all(edit_run *r)
{
    try_places(r, MW_EDIT_INSERT, MW_NONE, 0.5);
    for (uint32_t v = 0; v <= r->now.vertex_range; v++) {
        try_edit(r, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = v});
        try_places(r, MW_EDIT_MOVE, v, v % 3 ? 1 : 0.5);
        if (!twin_bare)
            try_edit(r, (mw_edit){.kind = MW_EDIT_VALUE, .vertex = v, .field = v % 2, .value = -3});
    }
    try_pairs(r, MW_EDIT_FLIP);
    try_pairs(r, MW_EDIT_CONSTRAIN);
    try_pairs(r, MW_EDIT_RELEASE);
}

static void test_each_edit(void **state)
{
    (void)state;
    for (int i = 0; i < SCENES; i++) {
        edit_run r = {0};
        open_scene(&scenes[i], &r.now);
        twin_check_all(&r.now);
        twin_cursors_open(&r.cursors, &r.now, i % 2, (uint64_t)i);
        twin_check_queries(&r.now, &r.cursors);
        r.then = twin_copy(&r.now);
        try_all(&r);
        print_message("%-24s %llu edits done, %llu refused\n", scenes[i].name,
                      (unsigned long long)r.done, (unsigned long long)r.refused);
        assert_true(r.done > 20 && r.refused > 20);
        twin_check_all(&r.now);
        twin_close(&r.then);
        twin_close(&r.now);
    }
}

/* --- some in a row ---------------------------------------------------------------------------- */

enum { ROW = 24 };

static mw_edit any_edit(const twin *t, uint64_t *random)
{
    mw_edit e = {.vertex = mw__random_below(random, t->vertex_range),
                 .other = mw__random_below(random, t->vertex_range)};
    e.x = mw__random_below(random, 11) * 0.5 - 1;
    e.y = mw__random_below(random, 11) * 0.5 - 1;
    e.field = mw__random_below(random, TWIN_FIELDS);
    e.value = mw__random_below(random, 3) ? NAN : 7.25;
    static const mw_edit_kind kinds[16] = {
        MW_EDIT_INSERT,    MW_EDIT_INSERT,    MW_EDIT_INSERT,  MW_EDIT_INSERT,
        MW_EDIT_INSERT,    MW_EDIT_REMOVE,    MW_EDIT_REMOVE,  MW_EDIT_REMOVE,
        MW_EDIT_MOVE,      MW_EDIT_MOVE,      MW_EDIT_MOVE,    MW_EDIT_FLIP,
        MW_EDIT_CONSTRAIN, MW_EDIT_CONSTRAIN, MW_EDIT_RELEASE, MW_EDIT_VALUE};
    e.kind = kinds[mw__random_below(random, 16)];
    if (e.kind == MW_EDIT_RELEASE && t->fixed_count) {
        const uint32_t *edge =
            t->fixed + 2 * (size_t)mw__random_below(random, (uint32_t)t->fixed_count);
        e.vertex = edge[0];
        e.other = edge[1];
    }
    if (e.kind == MW_EDIT_VALUE && twin_bare) e.kind = MW_EDIT_CONSTRAIN;
    if (e.kind == MW_EDIT_VALUE && isnan(e.value)) e.value = 1;
    if (e.kind == MW_EDIT_FLIP && t->delaunay && mw__random_below(random, 8))
        e.kind = MW_EDIT_REMOVE;
    return e;
}

/* After compacting, the log belongs to the mesh as it was given then. */
static void edit_compacted(twin *t, uint64_t *random)
{
    size_t count;
    mw_mesh *mesh, *first = t->first;
    mw_error error;
    expect_ok(mw_editor_mesh(t->editor, NULL, NULL, &mesh, &error), "mesh", &error);
    uint32_t *constraints = mw_editor_constrained_edges(t->editor, &count);
    mw_editor_options options = {.delaunay = t->delaunay ? MW_DELAUNAY_AUTO : MW_DELAUNAY_NEVER,
                                 .log = 1,
                                 .constrained_edges = constraints,
                                 .constrained_edge_count = count};
    for (int i = 0; i < 8; i++) {
        mw_edit e = any_edit(t, random);
        twin_apply(t, &e, false);
    }
    t->first = mesh;
    twin_check_replay(t, &options);
    t->first = first;
    mw_mesh_destroy(mesh);
    free(constraints);
}

/* Edits at random, all checked; then taken back one by one, or replayed, or compacted. */
static void edit_in_a_row(const edit_scene *s, uint64_t seed)
{
    twin t, then[ROW];
    twin_cursors r;
    uint64_t random = edit_case.seed = seed;
    uint32_t done = 0;
    twin_bare = seed % 3 == 0;
    open_scene(s, &t);
    twin_cursors_open(&r, &t, seed % 2, seed);
    for (edit_case.step = 0; edit_case.step < 4 * ROW && done < ROW; edit_case.step++) {
        mw_edit e = any_edit(&t, &random);
        then[done] = twin_copy(&t);
        if (twin_apply(&t, &e, edit_case.step & 1) == MW_OK)
            done++;
        else
            twin_close(&then[done]);
        if (mw__random_below(&random, 4) == 0) {
            twin_check_all(&t);
            twin_check_queries(&t, &r);
        }
    }
    mw_editor_options options = scene_options(s);
    twin_check_replay(&t, &options);
    uint32_t left = mw__random_below(&random, 2) ? 0 : mw__random_below(&random, ROW);
    while (done > left) {
        twin_undo(&t, &then[--done]);
        twin_close(&then[done]);
    }
    twin_check_all(&t);
    twin_check_replay(&t, &options);
    while (done > 0) twin_close(&then[--done]);
    twin_compact(&t);
    twin_check_all(&t);
    edit_compacted(&t, &random);
    twin_check_all(&t);
    twin_check_queries(&t, &r);
    twin_close(&t);
    twin_bare = false;
}

static void test_rows(void **state)
{
    (void)state;
    print_message("seeds 1 to 400\n");
    for (uint64_t seed = 1; seed <= 400; seed++) edit_in_a_row(&scenes[seed % SCENES], seed);
}

/* --- long constraints ------------------------------------------------------------------------- */

/* Some on a lattice, so that ways meet vertices, the others anywhere. */
static mw_mesh *spread_mesh(uint64_t *random, uint32_t n)
{
    double points[2 * 120];
    uint32_t span = mw__random_below(random, 2) ? 12 : 1 << 20;
    mw_mesh *mesh;
    mw_error error;
    for (uint32_t i = 0; i < 2 * n; i++) points[i] = mw__random_below(random, span);
    expect_ok(mw_delaunay(points, n, 2, NULL, NULL, NULL, &mesh, &error), "delaunay", &error);
    return mesh;
}

static void lay_constraints(uint64_t seed)
{
    enum { MOST = 30 };
    twin t, then[MOST];
    uint64_t random = edit_case.seed = seed;
    uint32_t done = 0;
    edit_case.name = "long constraints";
    mw_editor_options options = {
        .delaunay = seed % 4 ? MW_DELAUNAY_AUTO : MW_DELAUNAY_NEVER, .log = 1, .undo = SIZE_MAX};
    twin_open(&t, spread_mesh(&random, 120), &options);
    for (edit_case.step = 0; edit_case.step < 60 && done < MOST; edit_case.step++) {
        mw_edit e = {.kind = MW_EDIT_CONSTRAIN, .vertex = mw__random_below(&random, 120)};
        e.other = mw__random_below(&random, 120);
        if (edit_case.step % 4 == 3 && t.fixed_count) { /* one constrained edge, or more */
            e.kind = MW_EDIT_RELEASE;
            e.vertex = t.fixed[0];
            e.other = t.fixed[1];
        }
        then[done] = twin_copy(&t);
        if (twin_apply(&t, &e, false) == MW_OK)
            done++;
        else
            twin_close(&then[done]);
        twin_check_all(&t);
    }
    twin_check_replay(&t, &options);
    while (done > 0) {
        twin_undo(&t, &then[--done]);
        twin_close(&then[done]);
    }
    twin_check_all(&t);
    twin_close(&t);
}

/* A segment of two constrained edges, the first of which turns over the lowest triangle of the
 * vertex between them. */
static void lay_two_edges(void)
{
    const double p[] = {5.5, 3.5, 7.5, 1, 2.5, 3.5, 1.5, 3,   4.5, 0.5, 3.5,
                        7,   2,   3.5, 5, 4.5, 7.5, 0,   2.5, 6,   3,   5.5};
    mw_mesh *mesh;
    mw_error error;
    twin t;
    expect_ok(mw_delaunay(p, 11, 2, NULL, NULL, NULL, &mesh, &error), "delaunay", &error);
    twin_open(&t, mesh, NULL);
    assert_int_equal(
        twin_apply(&t, &(mw_edit){.kind = MW_EDIT_CONSTRAIN, .vertex = 1, .other = 9}, false),
        MW_OK);
    twin_check_all(&t);
    assert_int_equal(t.fixed_count, 2);
    twin_close(&t);
}

static void test_long_constraints(void **state)
{
    (void)state;
    print_message("seeds 1 to 30\n");
    for (uint64_t seed = 1; seed <= 30; seed++) lay_constraints(seed);
    lay_two_edges();
}

/* --- what is refused, and how it is said ------------------------------------------------------ */

static mw_status create(const arrays *a, mw_editor_options options, mw_error *error)
{
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){.tolerant = 1});
    mw_editor *editor = (mw_editor *)mesh;
    *error = (mw_error){0};
    mw_status status = mw_editor_create(mesh, &options, &editor, error);
    assert_true((editor != NULL) == (status == MW_OK));
    assert_int_equal(error->status, status);
    if (status) assert_true(strlen(error->message) > 8);
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
    return status;
}

static void test_bad_meshes(void **state)
{
    (void)state;
    mw_error error;
    arrays a = lattice();
    assert_int_equal(create(&a, (mw_editor_options){0}, &error), MW_OK);
    assert_int_equal(create(&a, (mw_editor_options){.delaunay = (mw_delaunay_mode)3}, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(create(&a, (mw_editor_options){.constrained_edge_count = 1}, &error),
                     MW_ERROR_ARGUMENT);
    const uint32_t none[] = {0, 4, 0, 8}, beyond[] = {0, 9};
    assert_int_equal(
        create(&a, (mw_editor_options){.constrained_edges = none + 2, .constrained_edge_count = 1},
               &error),
        MW_ERROR_INPUT);
    assert_true(error.vertex == 0 || error.vertex == 8);
    assert_int_not_equal(
        create(&a, (mw_editor_options){.constrained_edges = beyond, .constrained_edge_count = 1},
               &error),
        MW_OK);
    a.points[2 * 4] = 7; /* the middle vertex is outside now */
    assert_int_equal(create(&a, (mw_editor_options){0}, &error), MW_ERROR_INPUT);
    assert_true(error.triangle >= 0);
    arrays_free(&a);
    a = long_side(); /* flat beside the long side */
    arrays_triangle(&a, 0, 1, 2);
    assert_int_equal(create(&a, (mw_editor_options){0}, &error), MW_ERROR_INPUT);
    assert_true(error.triangle >= 0);
    arrays_free(&a);
    a = components(); /* coincident vertices, both used */
    uint32_t twice = arrays_point(&a, a.points[2 * 5], a.points[2 * 5 + 1]);
    int changed = 0;
    for (uint32_t i = 0; i < 3 * a.triangle_count; i++)
        if (a.triangles[i] == 5 && i >= 12) a.triangles[i] = twice, changed++;
    assert_true(changed > 0);
    assert_int_equal(create(&a, (mw_editor_options){0}, &error), MW_ERROR_INPUT);
    assert_true(error.vertex == 5 || error.vertex == twice);
    arrays_free(&a);
}

static void test_arguments(void **state)
{
    (void)state;
    twin t;
    mw_error error;
    mw_editor *none;
    size_t count = 7;
    const mw_index *index = NULL;
    open_scene(&scenes[2], &t);
    assert_int_equal(mw_editor_create(NULL, NULL, &none, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_editor_create(t.first, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_apply(t.editor, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_apply(NULL, &(mw_edit){0}, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_insert(NULL, 0, 0, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_undo(NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_apply(t.editor, &(mw_edit){.kind = MW_EDIT_KIND_COUNT}, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_value(t.editor, TWIN_FIELDS, 0, 1, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_value(t.editor, MW_NONE, 0, 1, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_apply(t.editor, &(mw_edit){.x = 1.1, .y = 1.3, .value = 5, .field = 9},
                                   NULL, &error),
                     MW_ERROR_ARGUMENT); /* the value would be lost */
    assert_int_equal(mw_editor_index(t.editor, MW_START_LAST, NULL, &index, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_editor_field_by_name(t.editor, "mark"), 1);
    assert_int_equal(mw_editor_field_by_name(t.editor, "no such"), MW_NONE);
    assert_true(isnan(mw_editor_value(t.editor, TWIN_FIELDS, 0)));
    twin_check_same(&t);
    mw_editor_log(t.editor, &count);
    assert_int_equal(count, 0);
    mw_editor_destroy(NULL);
    twin_close(&t);
}

/* An edit is refused with these numbers named in the text. */
static void expect_refused(twin *t, mw_edit e, const char *word, int64_t number)
{
    mw_error error = {0};
    char digits[32];
    snprintf(digits, sizeof digits, "%lld", (long long)number);
    assert_int_equal(mw_edit_apply(t->editor, &e, NULL, &error), MW_ERROR_INPUT);
    if (!strstr(error.message, word)) fail_msg("\"%s\" does not say \"%s\"", error.message, word);
    if (number >= 0 && !strstr(error.message, digits))
        fail_msg("\"%s\" does not name %s", error.message, digits);
    twin_check_same(t);
}

static void test_refusals(void **state)
{
    (void)state;
    twin t;
    open_scene(&scenes[11], &t); /* ring */
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_INSERT, .x = 1.5, .y = 1.5, .value = NAN}, "", -1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_INSERT, .x = 5, .y = 1.5, .value = NAN}, "", -1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_INSERT, .x = NAN, .y = 1.5, .value = NAN},
                   "finite", -1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 5}, "", 5);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 0}, "", 0);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 99}, "", 99);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_FLIP, .vertex = 0, .other = 1}, "", 0);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_FLIP, .vertex = 0, .other = 15}, "", 15);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_CONSTRAIN, .vertex = 4, .other = 11}, "", -1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_CONSTRAIN, .vertex = 0, .other = 15}, "", -1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_RELEASE, .vertex = 0, .other = 1}, "", -1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_MOVE, .vertex = 0, .x = 2.5, .y = 0.5}, "", 0);
    twin_close(&t);
    open_scene(&scenes[3], &t); /* lattice with a cross */
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_CONSTRAIN, .vertex = 0, .other = 5}, "4", 1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_CONSTRAIN, .vertex = 0, .other = 0}, "", 0);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_CONSTRAIN, .vertex = 0, .other = 77}, "", 77);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_RELEASE, .vertex = 0, .other = 1}, "0", 1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 4}, "constraint", 4);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_MOVE, .vertex = 0, .x = 2, .y = 2}, "8", 8);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_FLIP, .vertex = 1, .other = 4}, "4", 1);
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_FLIP, .vertex = 0, .other = 8}, "8", 0);
    twin_close(&t);
    open_scene(&scenes[0], &t); /* one triangle */
    expect_refused(&t, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 1}, "left", 1);
    twin_close(&t);
}

/* --- undo, log -------------------------------------------------------------------------------- */

static void test_undo_limit(void **state)
{
    (void)state;
    const size_t limits[] = {0, 1, 3, 100};
    for (int i = 0; i < 4; i++) {
        arrays a = lattice();
        twin t, then[13];
        mw_error error;
        mw_editor_options options = {.undo = limits[i]};
        twin_open(&t, arrays_mesh(&a, (mw_mesh_options){0}), &options);
        arrays_free(&a);
        size_t count = 7;
        assert_true(mw_editor_log(t.editor, &count) == NULL && count == 0);
        for (uint32_t k = 0; k < 12; k++) {
            then[k] = twin_copy(&t);
            mw_edit e = {.kind = k % 3 == 2 ? MW_EDIT_REMOVE : MW_EDIT_INSERT,
                         .vertex = t.vertex_range - 1};
            e.x = 0.1 + 0.13 * k;
            e.y = 0.2 + 0.11 * (k % 7);
            e.value = k;
            assert_int_equal(twin_apply(&t, &e, false), MW_OK);
            mw_editor_info info;
            mw_editor_describe(t.editor, &info);
            assert_int_equal(info.undoable, k + 1 < limits[i] ? k + 1 : limits[i]);
            assert_int_equal(info.edits, k + 1);
        }
        size_t can = limits[i] < 12 ? limits[i] : 12;
        for (size_t k = 0; k < can; k++) twin_undo(&t, &then[11 - k]);
        assert_int_equal(mw_edit_undo(t.editor, NULL, &error), MW_ERROR_INPUT);
        assert_true(strlen(error.message) > 8);
        twin_check_all(&t);
        assert_int_equal(twin_apply(&t, &(mw_edit){.x = 5, .y = 5, .value = NAN}, false), MW_OK);
        twin_check_all(&t);
        for (int k = 0; k < 12; k++) twin_close(&then[k]);
        twin_close(&t);
    }
}

/* A vertex outside of the hull takes the values of the nearest vertex that it is joined to, in all
 * fields but the one that is given. */
static void test_values_outside(void **state)
{
    (void)state;
    enum { FIELDS = 3, CORNERS = 4 };
    static const double corners[2 * CORNERS] = {0, 0, 4, 0, 4, 4, 0, 4};
    static const struct {
        double x, y;
        uint32_t near;
    } outside[] = {{6, 1, 1}, {6, 3.5, 2}, {-1, -1, 0}, {1, 9, 3}};
    for (uint32_t given = 0; given <= FIELDS; given++) {
        mw_mesh *mesh;
        mw_editor *editor;
        REQUIRE(mw_delaunay(corners, CORNERS, 2, NULL, NULL, NULL, &mesh, NULL) == MW_OK);
        for (int f = 0; f < FIELDS; f++) {
            const char name[2] = {(char)('a' + f), 0};
            double values[CORNERS];
            for (int v = 0; v < CORNERS; v++) values[v] = 100 * f + v;
            REQUIRE(mw_mesh_set_field(mesh, name, values, 0, NULL) == MW_OK);
        }
        for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
            mw_change change;
            mw_edit edit = {.kind = MW_EDIT_INSERT,
                            .x = outside[i].x,
                            .y = outside[i].y,
                            .field = given < FIELDS ? given : 0,
                            .value = given < FIELDS ? 7.5 : NAN};
            REQUIRE(mw_editor_create(mesh, NULL, &editor, NULL) == MW_OK);
            REQUIRE(mw_edit_apply(editor, &edit, &change, NULL) == MW_OK);
            assert_int_equal(change.vertex, CORNERS);
            for (uint32_t f = 0; f < FIELDS; f++)
                assert_true(mw_editor_value(editor, f, change.vertex) ==
                            (f == given ? 7.5 : 100 * f + outside[i].near));
            mw_editor_destroy(editor);
        }
        mw_mesh_destroy(mesh);
    }
}

/* The memory reported grows with the fields and with the log, and its parts are no more than it. */
static void test_bytes(void **state)
{
    (void)state;
    enum { FIELDS = 3, POINTS = 200 };
    static double points[2 * POINTS], values[POINTS];
    uint64_t random = 61;
    for (size_t i = 0; i < 2 * POINTS; i++) points[i] = (double)mw__random_below(&random, 1 << 20);
    mw_mesh *mesh;
    mw_editor_info bare, full, logged;
    mw_editor *editor;
    REQUIRE(mw_delaunay(points, POINTS, 2, NULL, NULL, NULL, &mesh, NULL) == MW_OK);
    REQUIRE(mw_editor_create(mesh, NULL, &editor, NULL) == MW_OK);
    mw_editor_describe(editor, &bare);
    mw_editor_destroy(editor);
    for (int f = 0; f < FIELDS; f++) {
        const char name[2] = {(char)('a' + f), 0};
        REQUIRE(mw_mesh_set_field(mesh, name, values, 0, NULL) == MW_OK);
    }
    REQUIRE(mw_editor_create(mesh, &(mw_editor_options){.log = 1, .undo = 50}, &editor, NULL) ==
            MW_OK);
    mw_editor_describe(editor, &full);
    assert_true(full.bytes >= bare.bytes + FIELDS * POINTS * sizeof(double));
    for (int i = 0; i < 1000; i++)
        REQUIRE(mw_edit_value(editor, 0, (uint32_t)i % POINTS, i, NULL) == MW_OK);
    mw_editor_describe(editor, &logged);
    assert_true(logged.bytes >= full.bytes + 1000 * sizeof(mw_edit));
    assert_true(logged.undo_bytes > full.undo_bytes && logged.undo_bytes <= logged.bytes);
    assert_true(bare.index_bytes > 0 && bare.index_bytes <= bare.bytes);
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
}

/* Insertions are counted also if no change report is requested. */
static void test_edits_unreported(void **state)
{
    (void)state;
    arrays a = lattice();
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_editor *editor;
    mw_error error;
    expect_ok(mw_editor_create(mesh, NULL, &editor, &error), "editor", &error);
    for (int k = 0; k < 3; k++) {
        mw_edit e = {.kind = MW_EDIT_INSERT, .x = 0.3 + 0.2 * k, .y = 0.4, .value = NAN};
        expect_ok(mw_edit_apply(editor, &e, NULL, &error), "insertion", &error);
        mw_editor_info info;
        mw_editor_describe(editor, &info);
        assert_int_equal(info.edits, k + 1);
    }
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* --- degenerate ------------------------------------------------------------------------------- */

/* All of a vertex's neighbours on one circle, and so many that a star of a square of them would
 * show. */
static void test_hub(void **state)
{
    (void)state;
    enum { SPOKES = 10000 };
    arrays a = arrays_fan(SPOKES);
    twin t;
    mw_editor_options options = {.undo = SIZE_MAX};
    twin_open(&t, arrays_mesh(&a, (mw_mesh_options){0}), &options);
    arrays_free(&a);
    twin then = twin_copy(&t);
    assert_int_equal(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 0}, true), MW_OK);
    twin_check_all(&t);
    assert_int_equal(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_INSERT, .value = NAN}, true), MW_OK);
    twin_check_all(&t);
    mw_editor_info info;
    mw_editor_describe(t.editor, &info);
    assert_true(info.delaunay && info.triangles == SPOKES);
    twin now = twin_copy(&t);
    assert_int_equal(
        twin_apply(&t, &(mw_edit){.kind = MW_EDIT_MOVE, .vertex = SPOKES + 1, .x = 0.5, .y = 0.1},
                   true),
        MW_OK);
    twin_check_all(&t);
    twin_undo(&t, &now);
    twin_close(&now);
    assert_int_equal(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_REMOVE, .vertex = SPOKES + 1}, true),
                     MW_OK);
    for (int i = 0; i < 3; i++) assert_int_equal(mw_edit_undo(t.editor, NULL, NULL), MW_OK);
    twin_check_same(&then);
    twin_close(&then);
    twin_close(&t);
}

/* From one triangle to many, all of them outside of what is there; then down to one again. */
static void grow_and_shrink(uint32_t count, const double *points)
{
    mw_mesh *mesh;
    mw_error error;
    twin t;
    mw_editor_options options = {.undo = 5};
    expect_ok(mw_delaunay(points, 3, 2, NULL, NULL, NULL, &mesh, &error), "delaunay", &error);
    twin_open(&t, mesh, &options);
    twin_cursors r;
    twin_cursors_open(&r, &t, true, 9);
    for (uint32_t i = 3; i < count; i++) {
        mw_edit e = {.x = points[2 * i], .y = points[2 * i + 1], .value = NAN};
        assert_int_equal(twin_apply(&t, &e, true), MW_OK);
        if ((i & (i - 1)) == 0) twin_check_all(&t);
    }
    twin_check_all(&t);
    twin_check_queries(&t, &r);
    for (uint32_t v = 0, left = t.vertices; v < t.vertex_range; v++) {
        mw_edit e = {.kind = MW_EDIT_REMOVE, .vertex = v};
        left -= twin_apply(&t, &e, true) == MW_OK;
        if ((left & (left - 1)) == 0) twin_check_all(&t);
    }
    twin_check_all(&t);
    twin_check_queries(&t, &r);
    assert_true(t.triangles < 4);
    twin_close(&t);
}

enum { GROWN = 1500 };

static void test_grow(void **state)
{
    (void)state;
    double points[2 * GROWN];
    edit_case.name = "spiral";
    for (uint32_t i = 0; i < GROWN; i++) {
        points[2 * i] = (5 + i) * cos(i);
        points[2 * i + 1] = (5 + i) * sin(i);
    }
    grow_and_shrink(GROWN, points);
    edit_case.name = "growing triangles";
    for (uint32_t i = 0; i < 150; i++) {
        static const double corner[3][2] = {{0, 1}, {-1, -1}, {1, -1}};
        for (int k = 0; k < 2; k++)
            points[2 * i + (uint32_t)k] = ldexp(corner[i % 3][k], (int)(i / 3));
    }
    grow_and_shrink(150, points);
    edit_case.name = "lattice, from the middle";
    for (uint32_t i = 0, n = 0; n < 400;
         i++) { /* by turns to all sides, so that hull sides are full of vertices */
        int x = (int)(i * 7 % 20), y = (int)(i / 20 % 20);
        points[2 * n] = x;
        points[2 * n++ + 1] = (y + 7 * x) % 20;
    }
    points[0] = points[1] = points[3] = points[4] = 0;
    points[2] = points[5] = 1;
    grow_and_shrink(400, points);
}

/* Coordinates so far apart, so small or so large that products of them are no doubles. */
static void test_magnitudes(void **state)
{
    (void)state;
    const double scales[] = {1, 1e-300, 1e300, 0x1p-1070, 1e15};
    for (int i = 0; i < 5; i++) {
        double points[2 * 60];
        uint64_t random = 5;
        edit_case.name = "magnitudes";
        edit_case.seed = (uint64_t)i;
        for (uint32_t k = 0; k < 120; k++) {
            points[k] = (double)mw__random_below(&random, 12) * scales[i];
            if (i == 4 && k % 5) points[k] = (double)mw__random_below(&random, 12) - 4;
        }
        points[0] = points[1] = points[3] = points[4] = 0;
        points[2] = points[5] = scales[i];
        grow_and_shrink(60, points);
    }
}

/* Vertices that no triangle has stay, alone, and are no obstacle. */
static void test_duplicates(void **state)
{
    (void)state;
    const double p[] = {0, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 0, 1, 1};
    mw_mesh *mesh;
    mw_error error;
    twin t;
    edit_case.name = "duplicates";
    expect_ok(mw_delaunay(p, 7, 2, NULL, NULL, NULL, &mesh, &error), "delaunay", &error);
    mw_editor_options options = {.undo = SIZE_MAX, .log = 1};
    twin_open(&t, mesh, &options);
    twin_cursors r;
    twin_cursors_open(&r, &t, true, 4);
    twin_check_all(&t);
    assert_int_equal(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 2}, true),
                     MW_ERROR_INPUT);
    assert_int_equal(
        twin_apply(&t, &(mw_edit){.kind = MW_EDIT_MOVE, .vertex = 5, .x = 1.5, .y = 1}, true),
        MW_ERROR_INPUT);
    assert_int_equal(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_INSERT, .value = NAN}, true), MW_OK);
    assert_int_equal(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 0}, true), MW_OK);
    twin_check_all(&t);
    assert_int_equal(twin_apply(&t, &(mw_edit){.kind = MW_EDIT_INSERT, .value = NAN}, true), MW_OK);
    assert_int_equal(t.vertex_range, 8);
    twin_check_all(&t);
    twin_check_queries(&t, &r);
    twin_check_replay(&t, &options);
    twin_compact(&t);
    twin_check_all(&t);
    twin_check_queries(&t, &r);
    twin_close(&t);
}

/* --- answers that are easily wrong ------------------------------------------------------------ */

static mw_editor *editor_of(const double *points, size_t n, const uint32_t *triangles, size_t m,
                            const mw_editor_options *options)
{
    mw_arrays given = {
        .points = points, .point_count = n, .triangles = triangles, .triangle_count = m};
    mw_mesh *mesh;
    mw_editor *editor;
    mw_error error;
    REQUIRE(mw_mesh_create(&given, NULL, &mesh, &error) == MW_OK);
    double values[16];
    for (size_t i = 0; i < n; i++) values[i] = (double)i;
    REQUIRE(mw_mesh_set_field(mesh, "z", values, 0, &error) == MW_OK);
    REQUIRE(mw_editor_create(mesh, options, &editor, &error) == MW_OK);
    mw_mesh_destroy(mesh);
    return editor;
}

/* An edit may be one of the log, which grows by it. */
static void test_log_entry_again(void **state)
{
    (void)state;
    const double square[] = {0, 0, 8, 0, 8, 8, 0, 8};
    mw_editor *editor =
        editor_of(square, 4, (uint32_t[]){0, 1, 2, 0, 2, 3}, 2, &(mw_editor_options){.log = 1});
    REQUIRE(mw_edit_insert(editor, 1, 2, NULL, NULL) == MW_OK);
    for (size_t n = 1; n < 100; n++) {
        size_t count;
        const mw_edit *log = mw_editor_log(editor, &count);
        REQUIRE(count == n && log[n - 1].x == 1 && log[n - 1].y == 2);
        REQUIRE(mw_edit_apply(editor, &log[n - 1], NULL, NULL) == MW_OK);
    }
    mw_editor_destroy(editor);
}

/* A location of before an edit that took its triangle away. */
static void test_value_of_what_is_gone(void **state)
{
    (void)state;
    const double square[] = {0, 0, 8, 0, 8, 8, 0, 8};
    mw_editor *editor = editor_of(square, 4, (uint32_t[]){0, 1, 2, 0, 2, 3}, 2, NULL);
    mw_change change;
    REQUIRE(mw_edit_insert(editor, 3, 5, &change, NULL) == MW_OK);
    mw_location at[2] = {{.triangle = change.triangle[0].triangle, .weight = {1, 0, 0}},
                         {.triangle = 12345}};
    double value[2] = {0, 0};
    mw_editor_interpolate(editor, 0, at, 1, value);
    REQUIRE(!isnan(value[0]));
    REQUIRE(mw_edit_remove(editor, change.vertex, NULL, NULL) == MW_OK);
    mw_editor_interpolate(editor, 0, at, 2, value);
    REQUIRE(isnan(value[0]) && isnan(value[1]));
    mw_editor_destroy(editor);
}

/* On a border round a single ghost, too, from the first to the last. */
static void test_around_a_notch(void **state)
{
    (void)state;
    const double points[] = {0, 0, 4, 0, 2, 1, 4, 4, 0, 4};
    const uint32_t expected[] = {3, 4, 0, 1};
    mw_editor *editor = editor_of(points, 5, (uint32_t[]){0, 1, 2, 0, 2, 4, 2, 3, 4}, 3, NULL);
    uint32_t around[8];
    assert_int_equal(mw_editor_adjacent_vertices(editor, 2, around, 8), 4);
    assert_memory_equal(around, expected, sizeof expected);
    mw_editor_destroy(editor);
}

/* Where nothing is to be flipped, a vertex that goes from the hull takes no triangle with it that
 * it did not have. */
static void test_no_flips_beside_a_star(void **state)
{
    (void)state;
    enum { V, A, W, B, C, D, Z };
    const double points[] = {.1, 100, -1, 5, 0, 10, 0, 0, 1, 1, 1.5, 5, 0, -100};
    const uint32_t triangles[] = {V, A, W, V, W, B, V, B, C, V, C, D,
                                  A, B, W, Z, B, A, Z, C, B, Z, D, C};
    mw_editor *editor =
        editor_of(points, 7, triangles, 8, &(mw_editor_options){.delaunay = MW_DELAUNAY_NEVER});
    mw_change change;
    REQUIRE(mw_edit_remove(editor, V, &change, NULL) == MW_OK);
    for (size_t i = change.made; i < change.made + change.reused + change.freed; i++) {
        const uint32_t *v = change.triangle[i].before;
        REQUIRE(v[0] == V || v[1] == V || v[2] == V);
    }
    mw_editor_destroy(editor);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_edit),
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_long_constraints),
        cmocka_unit_test(test_bad_meshes),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_undo_limit),
        cmocka_unit_test(test_values_outside),
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_edits_unreported),
        cmocka_unit_test(test_hub),
        cmocka_unit_test(test_grow),
        cmocka_unit_test(test_magnitudes),
        cmocka_unit_test(test_duplicates),
        cmocka_unit_test(test_log_entry_again),
        cmocka_unit_test(test_value_of_what_is_gone),
        cmocka_unit_test(test_around_a_notch),
        cmocka_unit_test(test_no_flips_beside_a_star),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
