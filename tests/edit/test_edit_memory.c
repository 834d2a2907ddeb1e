/* test_edit_memory.c - every allocation of an editor fails once: the call says so, nothing has
 * changed, and the same call succeeds afterwards. */
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

/* --- calls that fail as often as they allocate ------------------------------------------------ */

typedef struct editor_call {
    twin *t;
    const mw_edit *edit; /* NULL: undo */
    mw_change change;
    mw_editor_options *options;
    mw_editor *made;
    mw_mesh *mesh;
} editor_call;

typedef mw_status editor_job(editor_call *c, mw_error *error);

static long failures_seen;

/* Let allocation 0, 1, 2, ... of the job fail until it gets through; it may also do without. */
static mw_status exhaust(editor_job *run, editor_call *c)
{
    for (long k = 0;; k++) {
        mw_error error = {0};
        allocations_left = k;
        mw_status status = run(c, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        if (status != MW_ERROR_MEMORY) return status;
        REQUIRE(failed);
        REQUIRE(error.status == MW_ERROR_MEMORY && strcmp(error.message, "out of memory") == 0);
        if (c->t) twin_check_all(c->t);
        failures_seen++;
    }
}

static mw_status edit_job(editor_call *c, mw_error *error)
{
    return mw_edit_apply(c->t->editor, c->edit, &c->change, error);
}

/* The same by an editor that keeps nothing of its edits, of which nobody asks what they changed.
 * `before`: what it should hold. */
static mw_status edit_plainly(mw_editor *plain, const twin *before, const mw_edit *edit)
{
    for (long k = 0;; k++) {
        allocations_left = k;
        mw_status status = mw_edit_apply(plain, edit, NULL, NULL);
        allocations_left = -1;
        if (status != MW_ERROR_MEMORY) return status;
        twin held = *before;
        held.editor = plain;
        twin_check_same(&held);
        failures_seen++;
    }
}

static mw_status undo_job(editor_call *c, mw_error *error)
{
    return mw_edit_undo(c->t->editor, &c->change, error);
}

static mw_status create_job(editor_call *c, mw_error *error)
{
    return mw_editor_create(c->mesh, c->options, &c->made, error);
}

static mw_status mesh_job(editor_call *c, mw_error *error)
{
    mw_status status = mw_editor_mesh(c->t->editor, NULL, NULL, &c->mesh, error);
    REQUIRE((c->mesh != NULL) == (status == MW_OK));
    return status;
}

static mw_status compact_job(editor_call *c, mw_error *error)
{
    return mw_editor_compact(c->t->editor, NULL, NULL, error);
}

static mw_status index_job(editor_call *c, mw_error *error)
{
    for (int start = 0; start < MW_START_COUNT; start++) {
        const mw_index *index = NULL;
        if (!mw_start_has_index((mw_start_kind)start)) continue;
        mw_status status = mw_editor_index(c->t->editor, (mw_start_kind)start, NULL, &index, error);
        if (status) return status;
        REQUIRE(index != NULL);
    }
    return MW_OK;
}

static mw_status constraints_job(editor_call *c, mw_error *error)
{
    size_t count;
    uint32_t *edge = mw_editor_constrained_edges(c->t->editor, &count);
    if (!edge) return mw__fail_memory(error);
    REQUIRE(count == c->t->fixed_count);
    free(edge);
    return MW_OK;
}

/* --- sessions --------------------------------------------------------------------------------- */

static mw_mesh *square_mesh(bool hole)
{
    uint64_t random = 3;
    arrays a = arrays_grid(4, 0, &random);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < a.triangle_count; i++)
        if (!hole || i / 2 != 5)
            memmove(a.triangles + 3 * (size_t)kept++, a.triangles + 3 * (size_t)i, 12);
    a.triangle_count = kept;
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    arrays_free(&a);
    return mesh;
}

static mw_edit any_edit(const twin *t, uint64_t *random, uint32_t step, uint32_t steps)
{
    uint32_t chance = mw__random_below(random, 20), growing = step < steps / 2;
    mw_edit e = {.vertex = mw__random_below(random, t->vertex_range),
                 .other = mw__random_below(random, t->vertex_range)};
    e.x = mw__random_below(random, 81) / 16.0 - 0.5;
    e.y = mw__random_below(random, 81) / 16.0 - 0.5;
    e.value = mw__random_below(random, 2) ? (double)NAN : step;
    e.kind = chance < (growing ? 11 : 3) ? MW_EDIT_INSERT
             : chance < 13               ? MW_EDIT_REMOVE
             : chance < 16               ? MW_EDIT_MOVE
             : chance < 18               ? MW_EDIT_CONSTRAIN
             : chance < 19               ? MW_EDIT_RELEASE
                                         : MW_EDIT_VALUE;
    if (e.kind == MW_EDIT_RELEASE && t->fixed_count) {
        e.vertex = t->fixed[0];
        e.other = t->fixed[1];
    }
    return e;
}

static void run_session(bool hole, bool indexed, uint64_t seed)
{
    enum { STEPS = 700 };
    twin t;
    twin_cursors r = {0};
    uint64_t random = edit_case.seed = seed;
    mw_editor_options options = {.delaunay = MW_DELAUNAY_MAKE, .undo = SIZE_MAX, .log = 1};
    edit_case.name = "session";
    twin_open(&t, square_mesh(hole), &options);
    editor_call c = {.t = &t, .options = &options};
    mw_editor *plain;
    REQUIRE(mw_editor_create(t.first, &(mw_editor_options){.delaunay = MW_DELAUNAY_MAKE}, &plain,
                             NULL) == MW_OK);
    if (indexed) assert_int_equal(exhaust(index_job, &c), MW_OK);
    twin_cursors_open(&r, &t, indexed, seed);
    for (edit_case.step = 0; edit_case.step < STEPS; edit_case.step++) {
        mw_edit e = edit_case.edit = any_edit(&t, &random, (uint32_t)edit_case.step, STEPS);
        twin_outcome expected = twin_predict(&t, &e);
        c.edit = &e;
        mw_status status = exhaust(edit_job, &c);
        REQUIRE(status == MW_OK || status == MW_ERROR_INPUT);
        REQUIRE((status == MW_OK) == (expected == TWIN_DONE));
        if (status == MW_OK) {
            twin then = twin_copy(&t);
            if (edit_case.step % 8 != 3) REQUIRE(edit_plainly(plain, &then, &e) == MW_OK);
            twin_take_over(&t, &e, &c.change);
            if (edit_case.step % 8 == 3) {
                assert_int_equal(exhaust(undo_job, &c), MW_OK);
                twin_undone(&t, &then, &c.change);
            }
            twin_close(&then);
        }
        twin_check_same(&t);
        if (edit_case.step % 32 == 0) twin_check_all(&t);
        if (edit_case.step % 64 == 0) twin_check_queries(&t, &r);
    }
    assert_int_equal(exhaust(mesh_job, &c), MW_OK);
    mw_mesh_destroy(c.mesh);
    assert_int_equal(exhaust(constraints_job, &c), MW_OK);
    twin_check_replay(&t, &options);
    assert_int_equal(exhaust(compact_job, &c), MW_OK);
    mw_editor_destroy(plain);
    twin_close(&t);
}

static void test_sessions(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 6; seed++) {
        failures_seen = 0;
        run_session(seed % 2, seed > 2, seed);
        print_message("seed %llu: %ld allocations failed\n", (unsigned long long)seed,
                      failures_seen);
        assert_true(failures_seen > 50);
    }
}

static void test_create(void **state)
{
    (void)state;
    const uint32_t edges[] = {0, 1, 1, 2};
    for (int i = 0; i < 8; i++) {
        mw_editor_options options = {
            .delaunay = i % 4 / 2 ? MW_DELAUNAY_MAKE : MW_DELAUNAY_AUTO, .log = 1, .undo = 4};
        if (i >= 4) options.constrained_edges = edges, options.constrained_edge_count = 2;
        editor_call c = {.mesh = square_mesh(i % 2), .options = &options};
        twin_set_fields(c.mesh);
        failures_seen = 0;
        assert_int_equal(exhaust(create_job, &c), MW_OK);
        assert_true(failures_seen > 5);
        mw_editor_destroy(c.made);
        mw_mesh_destroy(c.mesh);
    }
}

/* The middle of an edge of some triangle. */
static mw_edit halve_any(const mw_editor *editor, uint64_t *random)
{
    mw_editor_info info;
    uint32_t v[3];
    double a[2], b[2];
    mw_editor_describe(editor, &info);
    while (!mw_editor_triangle(editor, mw__random_below(random, info.triangle_range), v)) {
    }
    uint32_t k = mw__random_below(random, 3);
    mw_editor_vertex(editor, v[k], a);
    mw_editor_vertex(editor, v[(k + 1) % 3], b);
    return (mw_edit){
        .kind = MW_EDIT_INSERT, .x = (a[0] + b[0]) / 2, .y = (a[1] + b[1]) / 2, .value = NAN};
}

/* A point on an edge changes tiles on either side: where there is no room for those of the second,
 * the first have to be put back. */
static void test_halves(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 8; seed++) {
        twin t;
        mw_editor *plain;
        uint64_t random = edit_case.seed = seed;
        mw_editor_options options = {.delaunay = MW_DELAUNAY_MAKE, .undo = SIZE_MAX, .log = 1};
        edit_case.name = "halves";
        failures_seen = 0;
        twin_open(&t, square_mesh(seed % 2), &options);
        REQUIRE(mw_editor_create(t.first, &(mw_editor_options){.delaunay = MW_DELAUNAY_MAKE},
                                 &plain, NULL) == MW_OK);
        for (edit_case.step = 0; edit_case.step < 300; edit_case.step++) {
            mw_edit e = edit_case.edit = halve_any(t.editor, &random);
            REQUIRE(edit_plainly(plain, &t, &e) == MW_OK);
            REQUIRE(twin_apply(&t, &e, false) == MW_OK);
        }
        print_message("seed %d: %ld allocations failed\n", (int)seed, failures_seen);
        mw_editor_destroy(plain);
        twin_close(&t);
    }
}

/* A value is written when nothing can fail any more: the first report of an editor has to be
 * allocated. */
static void test_value(void **state)
{
    (void)state;
    const double square[] = {0, 0, 8, 0, 8, 8, 0, 8}, values[] = {1, 2, 3, 4};
    mw_arrays given = {.points = square,
                       .point_count = 4,
                       .triangles = (uint32_t[]){0, 1, 2, 0, 2, 3},
                       .triangle_count = 2};
    mw_mesh *mesh;
    mw_editor *editor;
    REQUIRE(mw_mesh_create(&given, NULL, &mesh, NULL) == MW_OK);
    REQUIRE(mw_mesh_set_field(mesh, "z", values, 0, NULL) == MW_OK);
    REQUIRE(mw_editor_create(mesh, NULL, &editor, NULL) == MW_OK);
    mw_change change;
    mw_edit edit = {.kind = MW_EDIT_VALUE, .vertex = 2, .value = 99};
    long k = 0;
    for (;; k++) {
        allocations_left = k;
        mw_status status = mw_edit_apply(editor, &edit, &change, NULL);
        allocations_left = -1;
        if (status == MW_OK) break;
        REQUIRE(mw_editor_value(editor, 0, 2) == 3);
    }
    REQUIRE(k > 0 && mw_editor_value(editor, 0, 2) == 99);
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sessions),
        cmocka_unit_test(test_halves),
        cmocka_unit_test(test_create),
        cmocka_unit_test(test_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
