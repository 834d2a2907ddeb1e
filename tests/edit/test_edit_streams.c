/* test_edit_streams.c - long streams of edits and queries at random: all is predicted or found
 * again by brute force, and at intervals the whole mesh is held against one made from nothing.
 * MW_TEST_LONG=1 runs streams of a million edits and as many queries, MW_TEST_SEED=n other ones. */
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
#include "oracle/location_oracle.h"
#include "oracle/predicate_oracle.h"
#include "support/environment.h"
#include "support/meshes.h"

/* --- points: multiples of a power of two, so that the middle between two of them is exact ----- */

static void uniform(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = mw__random_below(random, 1 << 24) * 0x1p-20;
}

static void grid(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = mw__random_below(random, 17);
}

/* Exactly on circles of a few radii round a few centres. */
static void cocircular(uint64_t *random, double *q)
{
    static const double legs[9][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {52, 39},
                                      {56, 33}, {60, 25}, {63, 16}, {65, 0}};
    const double *leg = legs[mw__random_below(random, 9)];
    double radius = 1 + mw__random_below(random, 4), x = leg[0] * radius, y = leg[1] * radius;
    uint32_t turn = mw__random_below(random, 4);
    q[0] = (turn == 0 ? x : turn == 1 ? -y : turn == 2 ? -x : y) / 64 + 8;
    q[1] = (turn == 0 ? y : turn == 1 ? x : turn == 2 ? -y : -x) / 64 + 8;
}

/* Within about 2^-20 of a few points. */
static void clustered(uint64_t *random, double *q)
{
    static const double centre[5][2] = {{1, 2}, {15, 3}, {14, 14}, {3, 13}, {7, 8}};
    const double *c = centre[mw__random_below(random, 5)];
    for (int k = 0; k < 2; k++) {
        double away = 0;
        for (int i = 0; i < 4; i++) away += mw__random_below(random, 1 << 16) - 32767.5;
        q[k] = c[k] + away * 0x1p-36;
    }
}

/* Where products of differences are no numbers any more. */
static void subnormal(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = mw__random_below(random, 40) * 0x1p-1074;
}

static void huge(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = (mw__random_below(random, 41) - 20.0) * 0x1p1018;
}

/* Of all magnitudes. */
static void scattered(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) {
        q[k] =
            ldexp(1 + mw__random_below(random, 8) / 8.0, (int)mw__random_below(random, 100) - 50);
        if (mw__random_below(random, 2)) q[k] = -q[k];
    }
}

/* --- streams ---------------------------------------------------------------------------------- */

typedef struct edit_stream {
    const char *name;
    void (*draw_point)(uint64_t *random, double *q);
    uint32_t vertices;         /* about so many are there           */
    mw_delaunay_mode delaunay; /* as in the options                 */
    bool constraints;          /* are set and released              */
    bool hole;                 /* the mesh begins with a square hole */
} edit_stream;

static const edit_stream streams[] = {
    {"uniform", uniform, 400, MW_DELAUNAY_AUTO, false, false},
    {"grid", grid, 160, MW_DELAUNAY_AUTO, false, false},
    {"cocircular", cocircular, 90, MW_DELAUNAY_AUTO, false, false},
    {"clustered", clustered, 300, MW_DELAUNAY_AUTO, false, false},
    {"subnormal", subnormal, 120, MW_DELAUNAY_AUTO, true, false},
    {"huge", huge, 120, MW_DELAUNAY_AUTO, true, false},
    {"scattered", scattered, 100, MW_DELAUNAY_AUTO, true, false},
    {"uniform, constraints", uniform, 200, MW_DELAUNAY_AUTO, true, false},
    {"grid, constraints", grid, 120, MW_DELAUNAY_AUTO, true, false},
    {"grid with a hole", grid, 160, MW_DELAUNAY_MAKE, false, true},
    {"uniform with a hole, constraints", uniform, 200, MW_DELAUNAY_MAKE, true, true},
    {"uniform, not to be flipped", uniform, 150, MW_DELAUNAY_NEVER, true, false},
    {"cocircular, not to be flipped, a hole", cocircular, 80, MW_DELAUNAY_NEVER, true, true},
};
enum { STREAMS = sizeof streams / sizeof *streams };

static mw_mesh *first_mesh(const edit_stream *s, uint64_t *random)
{
    mw_mesh *mesh;
    mw_error error;
    if (s->hole) return mesh_with_hole(10, random);
    double *points = require_room(2 * (size_t)s->vertices, sizeof *points);
    for (uint32_t i = 0; i < s->vertices; i++) s->draw_point(random, points + 2 * (size_t)i);
    expect_ok(mw_delaunay(points, s->vertices, 2, NULL, NULL, NULL, &mesh, &error), "delaunay",
              &error);
    free(points);
    return mesh;
}

static uint32_t any_vertex(const twin *t, uint64_t *random)
{
    for (;;) {
        uint32_t v = mw__random_below(random, t->vertex_range);
        if (twin_uses_vertex(t, v) || mw__random_below(random, 1000) == 0) return v;
    }
}

/* One that an edge or two join to v, as a rule. */
static uint32_t near_vertex(const twin *t, uint32_t v, uint64_t *random)
{
    uint32_t around[16];
    for (uint32_t steps = 1 + mw__random_below(random, 3); steps > 0; steps--) {
        size_t n = mw_editor_adjacent_vertices(t->editor, v, around, 16);
        if (n == 0) break;
        v = around[mw__random_below(random, (uint32_t)(n < 16 ? n : 16))];
    }
    return v;
}

static void near_place(const twin *t, uint32_t v, uint64_t *random, double *q)
{
    uint32_t w = near_vertex(t, v, random);
    for (int k = 0; k < 2; k++) {
        double d = (twin_point(t, w)[k] - twin_point(t, v)[k]) *
                   (mw__random_below(random, 9) / 8.0 - 0.25);
        q[k] = rint((twin_point(t, v)[k] + d) * 0x1p36) * 0x1p-36;
    }
}

static mw_edit_kind any_kind(const edit_stream *s, const twin *t, uint64_t *random)
{
    uint32_t chance = mw__random_below(random, 100);
    if (chance < (t->vertices < s->vertices ? 42 : 25)) return MW_EDIT_INSERT;
    if (chance < 65) return MW_EDIT_REMOVE;
    if (chance < 88 || (!s->constraints && s->delaunay != MW_DELAUNAY_NEVER))
        return chance < 97 ? MW_EDIT_MOVE : MW_EDIT_VALUE;
    if (chance < 91) return s->delaunay == MW_DELAUNAY_NEVER ? MW_EDIT_FLIP : MW_EDIT_MOVE;
    if (chance < 92) return MW_EDIT_VALUE;
    bool many = t->fixed_count > s->vertices / 8;
    return chance < (many ? 93 : 97) ? MW_EDIT_CONSTRAIN : MW_EDIT_RELEASE;
}

static mw_edit any_edit(const edit_stream *s, const twin *t, uint64_t *random)
{
    mw_edit e = {.kind = any_kind(s, t, random), .vertex = any_vertex(t, random), .value = NAN};
    double q[2];
    if (mw__random_below(random, 3) == 0)
        near_place(t, e.vertex, random, q);
    else
        s->draw_point(random, q);
    if (mw__random_below(random, 50) == 0 && !s->hole) q[0] = q[0] * 2 - 8;
    e.x = q[0];
    e.y = q[1];
    e.other =
        mw__random_below(random, 8) ? near_vertex(t, e.vertex, random) : any_vertex(t, random);
    e.field = mw__random_below(random, TWIN_FIELDS);
    if (e.kind == MW_EDIT_VALUE && twin_bare) e.kind = MW_EDIT_MOVE;
    if (e.kind == MW_EDIT_VALUE || mw__random_below(random, 4) == 0)
        e.value = mw__random_below(random, 1000);
    if (e.kind == MW_EDIT_RELEASE && t->fixed_count) {
        const uint32_t *edge =
            t->fixed + 2 * (size_t)mw__random_below(random, (uint32_t)t->fixed_count);
        e.vertex = edge[0];
        e.other = edge[1];
    }
    return e;
}

/* A vertex, the middle of an edge, or any point. */
static void any_query(const edit_stream *s, const twin *t, uint64_t *random, double *q)
{
    uint32_t v = any_vertex(t, random), w = near_vertex(t, v, random);
    switch (mw__random_below(random, 5)) {
    case 0: memcpy(q, twin_point(t, v), 2 * sizeof *q); break;
    case 1:
        for (int k = 0; k < 2; k++) q[k] = twin_point(t, v)[k] / 2 + twin_point(t, w)[k] / 2;
        break;
    default: s->draw_point(random, q);
    }
}

/* A few edits that are taken back again. */
static void back_and_forth(const edit_stream *s, twin *t, uint64_t *random)
{
    twin then[8];
    uint32_t done = 0, wanted = 1 + mw__random_below(random, 8);
    while (done < wanted) {
        mw_edit e = any_edit(s, t, random);
        if (s->delaunay != MW_DELAUNAY_NEVER && mw__random_below(random, 4) == 0)
            e.kind = MW_EDIT_FLIP;
        then[done] = twin_copy(t);
        if (twin_apply(t, &e, false) == MW_OK)
            done++;
        else
            twin_close(&then[done]);
    }
    while (done > 0) {
        twin_undo(t, &then[--done]);
        twin_close(&then[done]);
    }
}

static void run_stream(const edit_stream *s, uint64_t seed, uint64_t edits)
{
    twin t;
    twin_cursors r;
    uint64_t random = mw__random_seed(seed, 3), done = 0;
    mw_editor_options options = {.delaunay = s->delaunay, .undo = 8};
    edit_case.name = s->name;
    edit_case.seed = seed;
    twin_open(&t, first_mesh(s, &random), &options);
    twin_cursors_open(&r, &t, true, random);
    for (edit_case.step = 0; edit_case.step < edits; edit_case.step++) {
        mw_edit e = any_edit(s, &t, &random);
        double q[2];
        done += twin_apply(&t, &e, edit_case.step & 1) == MW_OK;
        any_query(s, &t, &random, q);
        twin_cursors_check(&r, &t, q, twin_locate(&t, q));
        if (edit_case.step % 64 == 20) back_and_forth(s, &t, &random);
        if (edit_case.step % 128 == 99) twin_check_all(&t);
        if (edit_case.step % 512 == 200) twin_check_queries(&t, &r);
        if (t.triangle_range > 6 * t.triangles && edit_case.step % 256 == 255) twin_compact(&t);
    }
    twin_check_all(&t);
    twin_check_queries(&t, &r);
    mw_editor_info info;
    mw_editor_describe(t.editor, &info);
    print_message(
        "%-40s seed %llu: %llu of %llu edits done, %u vertices, %zu constraints, %llu refreshes\n",
        s->name, (unsigned long long)seed, (unsigned long long)done, (unsigned long long)edits,
        t.vertices, t.fixed_count, (unsigned long long)info.refreshes);
    assert_true(done > edits / 4);
    twin_close(&t);
}

static void test_streams(void **state)
{
    (void)state;
    for (int i = 0; i < STREAMS; i++) {
        twin_bare = i % 4 == 3;
        run_stream(&streams[i], environment_seed(1) + (uint64_t)i,
                   environment_is_long() ? 100000 : 1500);
    }
    twin_bare = false;
}

/* --- large meshes: too large for brute force at each edit ------------------------------------- */

/* The triangle that an answer names contains the point, and of those round the edge or vertex that
 * it is on none is lower. */
static void check_answer(const twin *t, const mw_location *l, const double *q)
{
    location_answer answer;
    REQUIRE(twin_has_triangle(t, l->triangle) && twin_triangle_holds(t, l->triangle, q, &answer));
    REQUIRE(answer.where == l->where && answer.local == l->local);
    if (l->where == MW_INSIDE) return;
    uint32_t v = twin_corners(t, l->triangle)[l->local];
    if (l->where == MW_ON_VERTEX) REQUIRE(mw_editor_triangle_of(t->editor, v) == l->triangle);
}

static void large_edit(twin *t, mw_edit e)
{
    mw_change change;
    mw_error error = {0};
    edit_case.edit = e;
    mw_status status = mw_edit_apply(t->editor, &e, &change, &error);
    if (status == MW_ERROR_INPUT) return;
    expect_ok(status, "edit", &error);
    twin_absorb(t, &change, false);
    if (e.kind == MW_EDIT_INSERT || e.kind == MW_EDIT_MOVE) twin_read_vertex(t, change.vertex);
    if (e.kind == MW_EDIT_VALUE) t->value[e.field][e.vertex] = e.value;
    for (size_t i = 0; i < change.made + change.reused; i++) { /* Delaunay round about */
        uint32_t k = change.triangle[i].triangle, around[64];
        const uint32_t *v = twin_corners(t, k);
        REQUIRE(twin_turn(t, k) > 0);
        size_t n = mw_editor_adjacent_vertices(t->editor, v[i % 3], around, 64);
        for (size_t j = 0; j < n && j < 64; j++)
            REQUIRE(plane_incircle(twin_point(t, v[0]), twin_point(t, v[1]), twin_point(t, v[2]),
                                   twin_point(t, around[j])) <= 0);
    }
}

static void test_large(void **state)
{
    (void)state;
    const edit_stream s = {"large", uniform, environment_is_long() ? 100000 : 6000,
                           0,       false,   false};
    uint64_t random = mw__random_seed(environment_seed(1), 4),
             edits = environment_is_long() ? 1000000 : 12000;
    twin t;
    twin_cursors r;
    mw_editor_options options = {.undo = 3};
    edit_case.name = s.name;
    edit_case.seed = environment_seed(1);
    print_message("seed %llu\n", (unsigned long long)edit_case.seed);
    twin_open(&t, first_mesh(&s, &random), &options);
    twin_cursors_open(&r, &t, true, random);
    for (edit_case.step = 0; edit_case.step < edits; edit_case.step++) {
        double q[2];
        large_edit(&t, any_edit(&s, &t, &random));
        any_query(&s, &t, &random, q);
        int walk = (int)(edit_case.step % MW_WALK_COUNT);
        mw_location l = mw_locate(mw_editor_locator(t.editor), &r.cursor[walk], q[0], q[1]);
        if (l.triangle != MW_NONE) check_answer(&t, &l, q);
        if (edit_case.step % (edits / 4) == edits / 5) twin_check_all(&t);
    }
    twin_check_all(&t);
    twin_compact(&t);
    twin_check_all(&t);
    twin_close(&t);
}

/* --- memory ----------------------------------------------------------------------------------- */

static size_t bytes_of(const mw_editor *editor)
{
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    return info.bytes;
}

/* What comes and goes leaves behind its numbers only: four bytes each, room to grow counted twice.
 * Compacting gives them back. */
static void test_memory(void **state)
{
    (void)state;
    enum { SLACK = 65536 };
    const edit_stream s = {"memory", uniform, 2000, 0, false, false};
    uint64_t random = 6, cycles = environment_is_long() ? 1000000 : 60000;
    mw_mesh *mesh = first_mesh(&s, &random);
    mw_editor *editor;
    mw_error error;
    expect_ok(mw_editor_create(mesh, &(mw_editor_options){.undo = 10}, &editor, &error), "editor",
              &error);
    mw_mesh_destroy(mesh);
    size_t before = bytes_of(editor);
    for (uint64_t i = 0; i < cycles; i++) {
        double q[2];
        mw_change change;
        uniform(&random, q);
        expect_ok(mw_edit_insert(editor, q[0], q[1], &change, &error), "insert", &error);
        if (!change.vertices_made) continue;
        if (i % 3 == 0)
            expect_ok(mw_edit_move(editor, change.vertex, q[1], q[0], &change, &error), "move",
                      &error);
        expect_ok(mw_edit_remove(editor, change.vertex, &change, &error), "remove", &error);
    }
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    size_t numbers = info.vertex_range + (size_t)info.triangle_range;
    print_message("%zu bytes, %zu after %llu insertions and removals, ", before, info.bytes,
                  (unsigned long long)cycles);
    assert_true(info.bytes <= 2 * before + 8 * numbers + SLACK);
    expect_ok(mw_editor_compact(editor, NULL, NULL, &error), "compact", &error);
    print_message("%zu compact\n", bytes_of(editor));
    assert_true(bytes_of(editor) <= 2 * before + SLACK);
    mw_editor_destroy(editor);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_streams),
        cmocka_unit_test(test_large),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
