/* test_edit_ties.c - what is numbered depends on the edits alone, however ties fall: of two
 * editors that are given the same edits, one is also given others that are taken back, one by one
 * or many at once. After each edit both hold the same triangles. Places are such that many lie in
 * line, on circles, or nearly so, and round hubs of all degrees. MW_TEST_SEED=n: other ones. */
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
#include "support/environment.h"
#include "support/meshes.h"

typedef struct ties_scene {
    const char *name;
    uint32_t span;             /* points are multiples of 16 / span                  */
    bool near;                 /* but for a rounding                                 */
    uint32_t hub;              /* this degree and less: vertices on a circle round one */
    double scale;              /* of all coordinates                                 */
    mw_delaunay_mode delaunay; /* as in the options                                  */
    bool hole;                 /* the mesh has two holes and a pocket                */
} ties_scene;

static const ties_scene scenes[] = {
    {"lattice", 8, false, 0, 1, MW_DELAUNAY_AUTO, false},
    {"nearly a lattice", 8, true, 0, 1, MW_DELAUNAY_AUTO, false},
    {"hubs", 16, false, 20, 1, MW_DELAUNAY_AUTO, false},
    {"hubs, nearly", 16, true, 20, 1, MW_DELAUNAY_AUTO, false},
    {"tiny", 8, false, 12, 0x1p-1060, MW_DELAUNAY_AUTO, false},
    {"huge", 8, false, 12, 0x1p1019, MW_DELAUNAY_AUTO, false},
    {"holes", 16, false, 0, 1, MW_DELAUNAY_MAKE, true},
    {"holes, nearly", 16, true, 12, 1, MW_DELAUNAY_MAKE, true},
    {"not to be flipped", 8, false, 12, 1, MW_DELAUNAY_NEVER, false},
    {"holes, not to be flipped", 16, false, 0, 1, MW_DELAUNAY_NEVER, true},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static void any_place(const ties_scene *s, uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = mw__random_below(random, s->span + 1) * (16.0 / s->span);
    if (s->hub &&
        mw__random_below(random, 2)) { /* exactly on a circle of radius 65/16 round the middle */
        static const double leg[5][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {65, 0}};
        const double *l = leg[mw__random_below(random, 5)];
        uint32_t turn = mw__random_below(random, 8);
        for (int k = 0; k < 2; k++) {
            double away = l[(turn & 1) ^ (unsigned)k] / 16;
            q[k] = 8 + (turn >> (k + 1) & 1 ? -away : away);
        }
    }
    for (int k = 0; k < 2; k++) {
        q[k] *= s->scale;
        uint32_t which = s->near ? mw__random_below(random, 5) : 0;
        if (which == 1) q[k] = nextafter(q[k], INFINITY);
        if (which == 2) q[k] = nextafter(q[k], -INFINITY);
    }
}

static mw_mesh *scene_mesh(const ties_scene *s, uint64_t *random)
{
    if (!s->hole) {
        double points[40];
        for (int i = 0; i < 20; i++) any_place(s, random, points + 2 * (size_t)i);
        return mesh_delaunay(points, 20);
    }
    arrays a = arrays_grid(16, 0, random);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < a.triangle_count; i++) {
        uint32_t x = i / 2 % 16, y = i / 32;
        bool hole = x >= 3 && x < 6 && y >= 4 && y < 9,
             other = x >= 9 && x < 12 && y >= 9 && y<11, pocket = x> 12 && y >= 5 && y < 8;
        if (hole || other || pocket) continue;
        memmove(a.triangles + 3 * (size_t)kept++, a.triangles + 3 * (size_t)i,
                3 * sizeof *a.triangles);
    }
    a.triangle_count = kept;
    arrays_scramble(&a, 0, random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    arrays_free(&a);
    return mesh;
}

static mw_edit random_edit(const ties_scene *s, const mw_editor *editor, uint64_t *random)
{
    static const mw_edit_kind kinds[] = {MW_EDIT_INSERT,    MW_EDIT_INSERT, MW_EDIT_INSERT,
                                         MW_EDIT_REMOVE,    MW_EDIT_REMOVE, MW_EDIT_MOVE,
                                         MW_EDIT_CONSTRAIN, MW_EDIT_RELEASE};
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    mw_edit e = {.kind = kinds[mw__random_below(random, 8)], .value = NAN};
    double q[2];
    any_place(s, random, q);
    e.x = q[0];
    e.y = q[1];
    uint32_t around[32], tries = 0;
    do e.vertex = mw__random_below(random, info.vertex_range);
    while (mw_editor_triangle_of(editor, e.vertex) == MW_NONE && tries++ < 1000);
    size_t n = mw_editor_adjacent_vertices(editor, e.vertex, around, 32);
    e.other = n ? around[mw__random_below(random, (uint32_t)(n < 32 ? n : 32))] : 0;
    if (e.kind == MW_EDIT_CONSTRAIN && info.constrained_edges > 6) e.kind = MW_EDIT_RELEASE;
    if (e.kind == MW_EDIT_RELEASE) {
        size_t count;
        uint32_t *edge = mw_editor_constrained_edges(editor, &count);
        if (count) e.vertex = edge[0], e.other = edge[1];
        free(edge);
    }
    if (s->delaunay == MW_DELAUNAY_NEVER && mw__random_below(random, 8) == 0) e.kind = MW_EDIT_FLIP;
    if (s->hub && e.kind == MW_EDIT_INSERT && mw__random_below(random, 8) == 0)
        e.x = e.y = 8 * s->scale;
    return e;
}

/* Edits and points that are taken back at once, some of them refused. */
static void there_and_back(const ties_scene *s, mw_editor *editor, uint64_t *random)
{
    uint32_t done = 0;
    for (uint32_t i = mw__random_below(random, 5); i > 0; i--) {
        mw_edit e = random_edit(s, editor, random);
        double q[2 * 30];
        size_t n = 1 + mw__random_below(random, 30);
        for (size_t k = 0; k < n; k++) any_place(s, random, q + 2 * k);
        if (mw__random_below(random, 3))
            done += mw_edit_apply(editor, &e, NULL, NULL) == MW_OK;
        else
            done += mw_edit_insert_points(editor, q, n, 0, NULL, NULL, NULL) == MW_OK;
    }
    mw_error error = {0};
    for (; done > 0; done--) expect_ok(mw_edit_undo(editor, NULL, &error), "undo", &error);
}

static void run_scene(const ties_scene *s, uint64_t seed, uint32_t edits)
{
    uint64_t random = mw__random_seed(seed, 17), done = 0, least = MW_NONE, most = 0;
    mw_editor_options options = {.delaunay = s->delaunay, .undo = 64, .log = 1};
    mw_editor *plain;
    mw_error error = {0};
    twin_cursors r;
    twin t;
    edit_case.name = s->name;
    edit_case.seed = seed;
    twin_open(&t, scene_mesh(s, &random), &options);
    expect_ok(
        mw_editor_create(t.first, &(mw_editor_options){.delaunay = s->delaunay}, &plain, &error),
        "editor", &error);
    twin_cursors_open(&r, &t, true, random);
    for (edit_case.step = 0; edit_case.step < edits; edit_case.step++) {
        there_and_back(s, t.editor, &random);
        mw_edit e = random_edit(s, t.editor, &random);
        size_t degree =
            e.kind == MW_EDIT_REMOVE ? mw_editor_adjacent_vertices(t.editor, e.vertex, NULL, 0) : 0;
        mw_status status = twin_apply(&t, &e, false);
        REQUIRE(mw_edit_apply(plain, &e, NULL, &error) == status);
        done += status == MW_OK;
        if (status == MW_OK && degree)
            least = degree < least ? degree : least, most = degree > most ? degree : most;
        twin other = t;
        other.editor = plain;
        twin_check_same(&other);
        double q[2];
        uint32_t v = mw__random_below(&random, t.vertex_range);
        any_place(s, &random, q);
        if (twin_uses_vertex(&t, v)) memcpy(q, twin_point(&t, v), sizeof q);
        twin_cursors_check(&r, &t, q, twin_locate(&t, q));
        if (edit_case.step % 50 == 49) {
            twin_check_all(&t);
            twin_check_queries(&t, &r);
        }
    }
    twin_check_all(&t);
    twin_check_replay(&t, &options);
    print_message("%-26s seed %llu: %llu edits of %u done, degrees removed %llu to %llu\n", s->name,
                  (unsigned long long)seed, (unsigned long long)done, edits,
                  (unsigned long long)least, (unsigned long long)most);
    assert_true(done > edits / 4);
    mw_editor_destroy(plain);
    twin_close(&t);
}

static void test_scenes(void **state)
{
    (void)state;
    uint64_t seed = environment_seed(1);
    for (int i = 0; i < SCENES; i++) {
        twin_bare = i % 3 == 2;
        run_scene(&scenes[i], seed + (uint64_t)i, 400);
    }
    twin_bare = false;
}

/* A vertex with n others on a circle round it, exactly for some n: taken out and put back, in both
 * ways of filling a ring. */
static void test_hubs(void **state)
{
    (void)state;
    static const double legs[6][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {52, 39}, {65, 0}};
    for (uint32_t n = 3; n <= 24; n++)
        for (uint32_t even = 0; even < 2; even++) {
            twin t;
            mw_editor_options options = {.undo = SIZE_MAX, .log = 1};
            double points[2 * 26] = {0};
            uint32_t hub = n / 2, k = 0;
            edit_case.name = "hub";
            edit_case.seed = n;
            for (uint32_t i = 0; i <= n; i++) {
                double *q = points + 2 * (size_t)i, angle = 2 * 3.14159265358979 * k / n;
                if (i == hub) continue;
                const double *l = legs[k % 6];
                uint32_t turn = k / 6;
                q[0] = even ? (turn == 0   ? l[0]
                               : turn == 1 ? -l[1]
                               : turn == 2 ? -l[0]
                                           : l[1])
                            : 65 * cos(angle);
                q[1] = even ? (turn == 0   ? l[1]
                               : turn == 1 ? l[0]
                               : turn == 2 ? -l[1]
                                           : -l[0])
                            : 65 * sin(angle);
                k++;
            }
            twin_open(&t, mesh_delaunay(points, n + 1), &options);
            for (edit_case.step = 0; edit_case.step < 6; edit_case.step++) {
                twin then = twin_copy(&t);
                mw_edit e = {.kind = MW_EDIT_REMOVE, .vertex = hub, .value = NAN};
                if (twin_apply(&t, &e, true) == MW_OK) {
                    twin_check_all(&t);
                    twin_undo(&t, &then);
                    REQUIRE(twin_apply(&t, &e, true) == MW_OK);
                }
                twin_close(&then);
                mw_edit back = {.kind = MW_EDIT_INSERT, .value = NAN};
                if (edit_case.step % 2) back.x = nextafter(0, 1), back.y = nextafter(0, -1);
                hub = t.vertex_range;
                REQUIRE(twin_apply(&t, &back, true) == MW_OK);
                twin_check_all(&t);
                if (!twin_uses_vertex(&t, hub)) break;
            }
            twin_check_replay(&t, &options);
            twin_close(&t);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scenes),
        cmocka_unit_test(test_hubs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
