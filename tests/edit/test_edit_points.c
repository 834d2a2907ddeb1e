/* test_edit_points.c - many points at once: mesh, numbers, values, report, undo and log are held
 * against insertions one by one in the order that the log tells, and against a comparison of all
 * that was there before and after. MW_TEST_SEED=n: other points. */
/* wrap: malloc calloc realloc aligned_alloc */
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
#include "edit/editor.h"
#include "oracle/edit_open.h"
#include "oracle/edit_apply.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"

/* --- points in a square of 16 ----------------------------------------------------------------- */

static void uniform(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = mw__random_below(random, 1 << 24) * 0x1p-20;
}

static void lattice(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = mw__random_below(random, 33) / 2.0;
}

/* Exactly on four circles. */
static void cocircular(uint64_t *random, double *q)
{
    static const double leg[5][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {65, 0}};
    const double *l = leg[mw__random_below(random, 5)],
                 size = (1 + mw__random_below(random, 4)) / 64.0;
    uint32_t turn = mw__random_below(random, 8);
    for (int k = 0; k < 2; k++) {
        double away = l[(turn & 1) ^ (unsigned)k] * size;
        q[k] = 8 + (turn >> (k + 1) & 1 ? -away : away);
    }
}

static void clustered(uint64_t *random, double *q)
{
    static const double centre[3][2] = {{3, 4}, {13, 5}, {7, 12}};
    const double *c = centre[mw__random_below(random, 3)];
    for (int k = 0; k < 2; k++) q[k] = c[k] + mw__random_below(random, 1 << 16) * 0x1p-36;
}

/* Points of a lattice, except for a rounding. */
static void near_lattice(uint64_t *random, double *q)
{
    lattice(random, q);
    for (int k = 0; k < 2; k++) {
        uint32_t which = mw__random_below(random, 4);
        if (which == 1) q[k] = nextafter(q[k], 100);
        if (which == 2) q[k] = nextafter(q[k], -100);
    }
}

/* On two lines: most lie on edges, or on the hull. */
static void in_line(uint64_t *random, double *q)
{
    uint32_t along = mw__random_below(random, 2);
    q[along] = mw__random_below(random, 257) / 16.0;
    q[!along] = 8;
}

static void huge(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = (mw__random_below(random, 41) - 20.0) * 0x1p1018;
}

static void subnormal(uint64_t *random, double *q)
{
    for (int k = 0; k < 2; k++) q[k] = mw__random_below(random, 60) * 0x1p-1074;
}

/* --- sessions --------------------------------------------------------------------------------- */

typedef struct points_session {
    const char *name;
    void (*draw_point)(uint64_t *random, double *q);
    mw_delaunay_mode delaunay; /* as in the options                              */
    bool constraints;          /* a few edges are fixed                          */
    bool hole;                 /* the mesh is a lattice that has one             */
} points_session;

static const points_session sessions[] = {
    {"uniform", uniform, MW_DELAUNAY_AUTO, false, false},
    {"lattice", lattice, MW_DELAUNAY_AUTO, false, false},
    {"cocircular", cocircular, MW_DELAUNAY_AUTO, false, false},
    {"clustered", clustered, MW_DELAUNAY_AUTO, false, false},
    {"near lattice", near_lattice, MW_DELAUNAY_AUTO, false, false},
    {"in line", in_line, MW_DELAUNAY_AUTO, false, false},
    {"huge", huge, MW_DELAUNAY_AUTO, false, false},
    {"subnormal", subnormal, MW_DELAUNAY_AUTO, false, false},
    {"uniform, constraints", uniform, MW_DELAUNAY_AUTO, true, false},
    {"lattice, constraints", lattice, MW_DELAUNAY_AUTO, true, false},
    {"cocircular, constraints", cocircular, MW_DELAUNAY_AUTO, true, false},
    {"uniform, a hole", uniform, MW_DELAUNAY_MAKE, false, true},
    {"lattice, a hole, constraints", lattice, MW_DELAUNAY_MAKE, true, true},
    {"near lattice, a hole", near_lattice, MW_DELAUNAY_MAKE, false, true},
    {"uniform, not to be flipped", uniform, MW_DELAUNAY_NEVER, true, false},
    {"lattice, not to be flipped", lattice, MW_DELAUNAY_NEVER, true, false},
    {"cocircular, not to be flipped, a hole", cocircular, MW_DELAUNAY_NEVER, true, true},
};
enum { SESSIONS = sizeof sessions / sizeof *sessions };

static mw_mesh *first_mesh(const points_session *s, uint64_t *random)
{
    enum { FEW = 24 };
    if (!s->hole) {
        double points[2 * FEW];
        for (int i = 0; i < FEW; i++) s->draw_point(random, points + 2 * i);
        if (s->draw_point == in_line) points[0] = points[1] = 4;
        return mesh_delaunay(points, FEW);
    }
    return mesh_with_hole(8, random);
}

/* Edges of every fifth triangle, two vertices each; released by the caller. */
static uint32_t *some_edges(const mw_mesh *mesh, size_t *count)
{
    uint32_t n = mw_mesh_triangle_count(mesh), *edge = require_room(2 * (size_t)n, sizeof *edge);
    *count = 0;
    for (uint32_t k = 0; k < n; k += 5) {
        uint32_t v[3];
        mw_mesh_triangle(mesh, k, v);
        edge[2 * *count] = v[0];
        edge[2 * (*count)++ + 1] = v[1];
    }
    return edge;
}

/* --- points ----------------------------------------------------------------------------------- */

typedef struct points {
    double *at;
    size_t n, stride;
    bool along; /* each near the one before */
} points;

static const double *point_of(const points *p, size_t i)
{
    return p->at + i * (p->stride ? p->stride : 2);
}

static int by_x(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return a[0] != b[0] ? (a[0] > b[0]) - (a[0] < b[0]) : (a[1] > b[1]) - (a[1] < b[1]);
}

/* Each becomes the nearest to the one before of those that are left. */
static void line_up(points *p, size_t step)
{
    for (size_t i = 1; i < p->n; i++) {
        const double *from = p->at + (i - 1) * step;
        size_t best = i;
        double least = INFINITY;
        for (size_t j = i; j < p->n; j++) {
            const double *q = p->at + j * step;
            double away = fabs(q[0] / 2 - from[0] / 2) + fabs(q[1] / 2 - from[1] / 2);
            best = away < least ? j : best;
            least = fmin(away, least);
        }
        for (int k = 0; k < 2; k++) {
            double swap = p->at[i * step + (size_t)k];
            p->at[i * step + (size_t)k] = p->at[best * step + (size_t)k];
            p->at[best * step + (size_t)k] = swap;
        }
    }
}

/* Some of which are where others or vertices are. */
static points make_points(const points_session *s, const twin *t, size_t n, bool along,
                          uint64_t *random)
{
    static const size_t strides[] = {0, 2, 3, 5};
    points p = {.n = n, .stride = strides[mw__random_below(random, 4)], .along = along};
    size_t step = p.stride ? p.stride : 2;
    p.at = require_room(n * step, sizeof *p.at);
    for (size_t i = 0; i < n; i++) {
        double *q = p.at + i * step;
        uint32_t chance = mw__random_below(random, 12),
                 v = mw__random_below(random, t->vertex_range);
        do {
            s->draw_point(random, q);
            if (chance == 0 && t->state[v] == TWIN_USED) memcpy(q, twin_point(t, v), 2 * sizeof *q);
            if (chance == 1 && i > 0)
                memcpy(q, p.at + (size_t)mw__random_below(random, (uint32_t)i) * step,
                       2 * sizeof *q);
            for (size_t k = 2; k < step; k++) q[k] = NAN;
        } while (!t->convex && twin_locate(t, q).triangle == MW_NONE);
    }
    if (along) line_up(&p, step);
    return p;
}

/* The order in which they were inserted, by the log: all of them, and as they came where they come
 * along a curve. */
static void check_log(const twin *t, const points *p, size_t before)
{
    size_t count;
    const mw_edit *log = mw_editor_log(t->editor, &count);
    REQUIRE(count == before + p->n);
    double *one = require_room(2 * p->n, sizeof *one), *two = require_room(2 * p->n, sizeof *two);
    for (size_t i = 0; i < p->n; i++) {
        const mw_edit *e = &log[before + i];
        REQUIRE(e->kind == MW_EDIT_INSERT && isnan(e->value));
        one[2 * i] = e->x;
        one[2 * i + 1] = e->y;
        memcpy(two + 2 * i, point_of(p, i), 2 * sizeof *two);
    }
    if (p->along) REQUIRE(memcmp(one, two, 2 * p->n * sizeof *one) == 0);
    qsort(one, p->n, 2 * sizeof *one, by_x);
    qsort(two, p->n, 2 * sizeof *two, by_x);
    for (size_t i = 0; i < 2 * p->n; i++) REQUIRE(one[i] == two[i]);
    free(one);
    free(two);
}

/* --- what changed: all triangles before and after --------------------------------------------- */

/* Take over what the editor holds now, and hold the report against it. */
static void take_over_all(twin *t, const mw_change *change)
{
    mw_editor_info info;
    mw_editor_describe(t->editor, &info);
    static const mw_changed_triangle none;
    const mw_changed_triangle *list = change->triangle ? change->triangle : &none;
    const mw_changed_triangle *c[3] = {list, list + change->made,
                                       list + change->made + change->reused};
    size_t n[3] = {0};
    uint32_t was_vertices = t->vertex_range, was_triangles = t->triangle_range;
    twin_grow(t, info.vertex_range, info.triangle_range);
    uint32_t range = was_triangles > info.triangle_range ? was_triangles : info.triangle_range;
    t->triangles = 0;
    for (uint32_t k = 0; k < range; k++) {
        uint32_t now[3] = {MW_NONE, MW_NONE, MW_NONE}, *mine = t->triangle + 3 * (size_t)k;
        int there = mw_editor_triangle(t->editor, k, now);
        t->triangles += there != 0;
        if (memcmp(now, mine, sizeof now) == 0) continue;
        int which = mine[0] == MW_NONE ? 0 : there ? 1 : 2;
        REQUIRE(n[which] < (which == 0   ? change->made
                            : which == 1 ? change->reused
                                         : change->freed));
        REQUIRE(c[which][n[which]].triangle == k);
        REQUIRE(memcmp(c[which][n[which]++].before, mine, sizeof now) == 0);
        memcpy(mine, now, sizeof now);
    }
    REQUIRE(n[0] == change->made && n[1] == change->reused && n[2] == change->freed);
    t->triangle_range = info.triangle_range;
    uint32_t made = 0, freed = 0, first = MW_NONE;
    range = was_vertices > info.vertex_range ? was_vertices : info.vertex_range;
    for (uint32_t v = 0; v < range; v++) {
        double p[2];
        bool there = mw_editor_vertex(t->editor, v, p), was = t->state[v] != TWIN_GONE;
        if (there != was && first == MW_NONE) first = v;
        if (there != was) REQUIRE(v - first == made + freed);
        made += there && !was;
        freed += was && !there;
        t->state[v] = !there                                           ? TWIN_GONE
                      : mw_editor_triangle_of(t->editor, v) == MW_NONE ? TWIN_ALONE
                                                                       : TWIN_USED;
        if (!there || was) continue;
        twin_read_vertex(t, v);
        twin_split_fixed(t, v);
    }
    REQUIRE(change->vertices_made == made && change->vertices_freed == freed);
    REQUIRE(change->vertex == first);
    t->vertices += made - freed;
    t->vertex_range = info.vertex_range;
    for (int i = 0; i < 6; i++) REQUIRE(change->reserved[i] == 0);
}

/* --- a batch ---------------------------------------------------------------------------------- */

static size_t log_length(const twin *t)
{
    size_t count;
    mw_editor_log(t->editor, &count);
    return count;
}

static uint64_t edits_of(const twin *t)
{
    mw_editor_info info;
    mw_editor_describe(t->editor, &info);
    return info.edits;
}

static void insert_all(twin *t, const points *p, uint32_t *vertices)
{
    mw_change change;
    mw_error error = {0};
    size_t logged = log_length(t);
    uint64_t edits = edits_of(t);
    uint32_t range = t->vertex_range;
    memset(&change, 77, sizeof change);
    vertices[p->n] = 4711;
    expect_ok(mw_edit_insert_points(t->editor, p->at, p->n, p->stride, vertices, &change, &error),
              "points", &error);
    REQUIRE(vertices[p->n] == 4711);
    take_over_all(t, &change);
    REQUIRE(change.freed == 0 && change.vertices_freed == 0);
    REQUIRE(t->vertex_range == range + change.vertices_made && edits_of(t) == edits + p->n);
    for (size_t i = 0; i < p->n; i++) {
        REQUIRE(twin_uses_vertex(t, vertices[i]));
        for (int k = 0; k < 2; k++) REQUIRE(twin_point(t, vertices[i])[k] == point_of(p, i)[k]);
    }
    check_log(t, p, logged);
}

static void undo_all(twin *t, const twin *then)
{
    mw_change change;
    mw_error error = {0};
    memset(&change, 77, sizeof change);
    expect_ok(mw_edit_undo(t->editor, &change, &error), "undo", &error);
    take_over_all(t, &change);
    twin c = twin_copy(then);
    c.shared = t->shared;
    t->shared = true;
    twin_close(t);
    *t = c;
    twin_check_same(t);
}

/* Some points of all kinds. */
static void ask_some(const points_session *s, const twin *t, twin_cursors *r, uint64_t *random)
{
    for (int i = 0; i < 60; i++) {
        double q[2];
        uint32_t v = mw__random_below(random, t->vertex_range), around[8];
        size_t n = mw_editor_adjacent_vertices(t->editor, v, around, 8);
        s->draw_point(random, q);
        for (int k = 0; k < 2 && n > 0 && i % 3 < 2; k++)
            q[k] = i % 3
                       ? twin_point(t, v)[k]
                       : twin_point(t, v)[k] / 2 + twin_point(t, around[n < 8 ? n - 1 : 7])[k] / 2;
        twin_cursors_check(r, t, q, twin_locate(t, q));
    }
}

/* Vertices come and go between the points, also in the editor that keeps nothing, if there is one.
 */
static void mix(const points_session *s, twin *t, mw_editor *plain, uint64_t *random)
{
    for (int i = 0; i < 12; i++) {
        mw_edit e = {.kind = i % 3 ? MW_EDIT_REMOVE : MW_EDIT_MOVE, .value = NAN};
        double q[2];
        s->draw_point(random, q);
        e.vertex = mw__random_below(random, t->vertex_range);
        e.x = q[0];
        e.y = q[1];
        edit_case.edit = e;
        mw_status status = twin_apply(t, &e, false);
        if (plain) REQUIRE(mw_edit_apply(plain, &e, NULL, NULL) == status);
    }
}

/* An editor that keeps nothing of its edits, and of which nobody asks what they changed, comes to
 * the same. `t`: after the points. */
static void insert_plainly(mw_editor *plain, const twin *t, const points *p,
                           const uint32_t *vertices)
{
    uint32_t *own = require_room(p->n, sizeof *own);
    mw_error error = {0};
    expect_ok(mw_edit_insert_points(plain, p->at, p->n, p->stride, own, NULL, &error), "plainly",
              &error);
    for (size_t i = 0; i < p->n; i++) REQUIRE(own[i] == vertices[i]);
    twin held = *t;
    held.editor = plain;
    twin_check_same(&held);
    free(own);
}

/* Insert, take back, insert again: the same numbers. The twin then is as it was, or with the
 * points. */
static void try_points(const points_session *s, twin *t, mw_editor *plain, twin_cursors *r,
                       const points *p, uint64_t *random)
{
    twin then = twin_copy(t);
    uint32_t *vertices = require_room(p->n + 1, sizeof *vertices),
             *again = require_room(p->n + 1, sizeof *again);
    size_t logged = log_length(t);
    insert_all(t, p, vertices);
    twin_check_all(t);
    ask_some(s, t, r, random);
    if (p->n > 0) {
        undo_all(t, &then);
        REQUIRE(log_length(t) == logged);
        twin_check_all(t);
        ask_some(s, t, r, random);
        twin_close(&then);
        then = twin_copy(t);
        insert_all(t, p, again);
        REQUIRE(memcmp(vertices, again, p->n * sizeof *again) == 0);
        twin_check_all(t);
    }
    ask_some(s, t, r, random);
    if (p->n < 50) twin_check_queries(t, r);
    insert_plainly(plain, t, p, vertices);
    twin_close(&then);
    free(vertices);
    free(again);
}

static void run_session(const points_session *s, uint64_t seed)
{
    static const size_t sizes[] = {1, 30, 0, 2, 400, 7, 1000};
    uint64_t random = mw__random_seed(seed, 11);
    mw_mesh *mesh = first_mesh(s, &random);
    mw_editor_options options = {.delaunay = s->delaunay, .undo = SIZE_MAX, .log = 1};
    uint32_t *edges = some_edges(mesh, &options.constrained_edge_count);
    twin t;
    twin_cursors r;
    options.constrained_edges = edges;
    if (!s->constraints) options.constrained_edge_count = 0;
    edit_case.name = s->name;
    edit_case.seed = seed;
    twin_open(&t, mesh, &options);
    twin_cursors_open(&r, &t, true, random);
    mw_editor *plain;
    options.undo = 0;
    options.log = 0;
    mw_error error = {0};
    expect_ok(mw_editor_create(t.first, &options, &plain, &error), "plain editor", &error);
    options.undo = SIZE_MAX;
    options.log = 1;
    for (edit_case.step = 0; edit_case.step < sizeof sizes / sizeof *sizes; edit_case.step++) {
        points p = make_points(s, &t, sizes[edit_case.step], mw__random_below(&random, 2), &random);
        t.editor->upkeep.large = plain->upkeep.large = edit_case.step % 2 == 0; /* as if it were */
        try_points(s, &t, plain, &r, &p, &random);
        free(p.at);
        mix(s, &t, plain, &random);
        twin_check_replay(&t, &options);
    }
    twin_check_all(&t);
    mw_editor_info info;
    mw_editor_describe(t.editor, &info);
    print_message("%-40s seed %llu: %u vertices, %zu constraints, %llu refreshes\n", s->name,
                  (unsigned long long)seed, t.vertices, t.fixed_count,
                  (unsigned long long)info.refreshes);
    mw_editor_destroy(plain);
    twin_close(&t);
    free(edges);
}

static void test_sessions(void **state)
{
    (void)state;
    for (int i = 0; i < SESSIONS; i++) {
        twin_bare = i % 4 == 3;
        run_session(&sessions[i], environment_seed(1) + (uint64_t)i);
    }
    twin_bare = false;
}

/* --- refused ---------------------------------------------------------------------------------- */

/* One point of many is bad: it is named, and nothing has changed. */
static void refuse(const points_session *s, twin *t, twin_cursors *r, double x, double y, size_t n,
                   uint64_t *random)
{
    points p = make_points(s, t, n, false, random);
    size_t bad = mw__random_below(random, (uint32_t)n), named = 0, logged = log_length(t);
    double *q = p.at + bad * (p.stride ? p.stride : 2);
    uint64_t edits = edits_of(t);
    uint32_t *vertices = require_room(n, sizeof *vertices);
    mw_change change;
    mw_error error = {0};
    q[0] = x;
    q[1] = y;
    REQUIRE(mw_edit_insert_points(t->editor, p.at, n, p.stride, vertices, &change, &error) ==
            MW_ERROR_INPUT);
    REQUIRE(error.status == MW_ERROR_INPUT && sscanf(error.message, "point %zu: ", &named) == 1 &&
            named == bad);
    REQUIRE(log_length(t) == logged && edits_of(t) == edits);
    twin_check_all(t);
    ask_some(s, t, r, random);
    mix(s, t, NULL, random);
    free(vertices);
    free(p.at);
}

static void test_refused(void **state)
{
    (void)state;
    for (int hole = 0; hole < 2; hole++) {
        points_session s = {"refused", hole ? lattice : uniform,
                            hole ? MW_DELAUNAY_MAKE : MW_DELAUNAY_AUTO, false, hole};
        uint64_t random = mw__random_seed(environment_seed(1), 5);
        mw_editor_options options = {.undo = SIZE_MAX, .log = 1, .delaunay = s.delaunay};
        twin t;
        twin_cursors r;
        edit_case.name = s.name;
        edit_case.seed = environment_seed(1);
        twin_open(&t, first_mesh(&s, &random), &options);
        twin_cursors_open(&r, &t, true, random);
        for (edit_case.step = 0; edit_case.step < 12; edit_case.step++) {
            size_t n = 1 + mw__random_below(&random, edit_case.step % 4 == 3 ? 1500 : 60);
            refuse(&s, &t, &r, NAN, 1, n, &random);
            refuse(&s, &t, &r, 1, -INFINITY, n, &random);
            if (hole) refuse(&s, &t, &r, 6.5, 6.5, n, &random);
            if (hole) refuse(&s, &t, &r, 17, 3, n, &random);
        }
        twin_check_queries(&t, &r);
        twin_check_replay(&t, &options);
        twin_close(&t);
    }
}

/* Nothing has changed, either, where nobody asks for a report and nothing is kept for undo. */
static void test_refused_plain(void **state)
{
    (void)state;
    enum { MANY = 150 };
    static const double bad[][2] = {{6.5, 6.5}, {17, 3}, {NAN, 1}};
    const points_session s = {"refused plainly", lattice, MW_DELAUNAY_MAKE, false, true};
    const mw_editor_options nothing = {.delaunay = s.delaunay};
    uint64_t random = mw__random_seed(environment_seed(1), 6);
    twin t;
    edit_case.name = s.name;
    edit_case.seed = environment_seed(1);
    twin_open(&t, first_mesh(&s, &random), &nothing);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        points p = make_points(&s, &t, MANY, false, &random);
        double *q = p.at + (MANY / 2 + i) * (p.stride ? p.stride : 2);
        mw_error error;
        q[0] = bad[i][0];
        q[1] = bad[i][1];
        REQUIRE(mw_edit_insert_points(t.editor, p.at, MANY, p.stride, NULL, NULL, &error) ==
                MW_ERROR_INPUT);
        twin_check_same(&t);
        free(p.at);
    }
    twin_close(&t);
}

static void test_arguments(void **state)
{
    (void)state;
    const double square[] = {0, 0, 8, 0, 8, 8, 0, 8};
    uint32_t vertex[2] = {4711, 4711};
    mw_mesh *mesh = mesh_delaunay(square, 4);
    mw_editor *editor;
    mw_change change;
    mw_error error;
    expect_ok(mw_editor_create(mesh, &(mw_editor_options){.undo = 2}, &editor, &error), "editor",
              &error);
    assert_int_equal(mw_edit_insert_points(NULL, square, 4, 2, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_insert_points(editor, NULL, 4, 2, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_insert_points(editor, square, 4, 1, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_edit_insert_points(editor, NULL, 0, 0, NULL, &change, &error), MW_OK);
    assert_true(change.vertex == MW_NONE && change_is_empty(&change));
    assert_int_equal(mw_edit_undo(editor, NULL, &error), MW_ERROR_INPUT); /* none is no edit */
    assert_int_equal(mw_edit_insert_points(editor, square, 4, 0, NULL, &change, &error), MW_OK);
    assert_true(change.vertex == MW_NONE && change_is_empty(&change)); /* all are there */
    assert_int_equal(mw_edit_undo(editor, &change, &error), MW_OK);
    assert_true(change.vertex == MW_NONE && change_is_empty(&change));
    /* So many edits can be undone: those of points count as one. */
    for (int i = 1; i <= 3; i++) {
        const double q[] = {i, 2 * i, 2 * i, i};
        assert_int_equal(mw_edit_insert_points(editor, q, 2, 0, vertex, NULL, NULL), MW_OK);
        assert_int_equal(vertex[0], 2 + 2 * i);
        assert_int_equal(vertex[1], 3 + 2 * i);
    }
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    assert_int_equal(info.undoable, 2);
    for (int i = 3; i > 1; i--) {
        assert_int_equal(mw_edit_undo(editor, &change, &error), MW_OK);
        assert_true(change.vertices_freed == 2 && change.vertex == 2 + 2 * (uint32_t)i &&
                    !change.vertices_made);
    }
    assert_int_equal(mw_edit_undo(editor, &change, &error), MW_ERROR_INPUT);
    mw_editor_describe(editor, &info);
    assert_true(info.vertices == 6 && info.vertex_range == 6);
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
}

/* When they can no longer be undone, many points at once leave no more memory in use than one by
 * one. */
static void test_bytes(void **state)
{
    (void)state;
    enum { N = 20000 };
    const double square[] = {0, 0, 16, 0, 16, 16, 0, 16};
    double *p = require_room(2 * N, sizeof *p);
    uint64_t random = environment_seed(1);
    for (size_t i = 0; i < N; i++) uniform(&random, p + 2 * i);
    for (size_t undo = 0; undo < 6; undo += 5) {
        size_t bytes[2];
        for (int single = 0; single < 2; single++) {
            mw_mesh *mesh = mesh_delaunay(square, 4);
            mw_editor *editor;
            mw_editor_info info;
            mw_error error;
            expect_ok(mw_editor_create(mesh, &(mw_editor_options){.undo = undo}, &editor, &error),
                      "editor", &error);
            if (!single)
                expect_ok(mw_edit_insert_points(editor, p, N, 2, NULL, NULL, &error), "points",
                          &error);
            for (size_t i = 0; i < (single ? N : 20); i++)
                expect_ok(mw_edit_insert(editor, p[2 * i], p[2 * i + 1], NULL, &error), "insert",
                          &error);
            mw_editor_describe(editor, &info);
            bytes[single] = info.bytes;
            mw_editor_destroy(editor);
            mw_mesh_destroy(mesh);
        }
        print_message("%zu can be undone: %zu bytes, one by one %zu\n", undo, bytes[0], bytes[1]);
        assert_true(bytes[0] <= bytes[1] + bytes[1] / 4);
    }
    free(p);
}

/* --- each allocation fails once --------------------------------------------------------------- */

static void fail_each(const points_session *s, twin *t, const points *p, long *failures)
{
    mw_change change;
    mw_error error = {0};
    twin then = twin_copy(t);
    uint32_t *vertices = require_room(p->n, sizeof *vertices);
    size_t logged = log_length(t);
    mw_editor_info info;
    mw_editor_describe(t->editor, &info);
    for (long k = 0;; k++, (*failures)++) {
        allocations_left = k;
        mw_status status =
            mw_edit_insert_points(t->editor, p->at, p->n, p->stride, vertices, &change, &error);
        allocations_left = -1;
        if (status == MW_OK) break;
        REQUIRE(status == MW_ERROR_MEMORY && strcmp(error.message, "out of memory") == 0);
        mw_editor_info now;
        mw_editor_describe(t->editor, &now);
        REQUIRE(now.undoable == info.undoable && now.edits == info.edits &&
                log_length(t) == logged);
        twin_check_same(t);
        if (k % 4 == 0) twin_check_all(t);
    }
    take_over_all(t, &change);
    twin_check_all(t);
    undo_all(t, &then);
    twin_check_all(t);
    expect_ok(mw_edit_insert_points(t->editor, p->at, p->n, p->stride, vertices, &change, &error),
              s->name, &error);
    take_over_all(t, &change);
    twin_close(&then);
    free(vertices);
}

static void test_memory(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++) {
        points_session s = {"memory", i % 2 ? lattice : uniform, i / 2 == 1, false, i / 2 == 1};
        uint64_t random = mw__random_seed(environment_seed(1), (uint32_t)i);
        mw_editor_options options = {.undo = SIZE_MAX, .log = 1, .delaunay = i / 2 == 1};
        long failures = 0;
        twin t;
        twin_cursors r;
        edit_case.name = s.name;
        edit_case.seed = environment_seed(1);
        twin_open(&t, first_mesh(&s, &random), &options);
        twin_cursors_open(&r, &t, i >= 4, random);
        for (edit_case.step = 0; edit_case.step < 6;
             edit_case.step++) { /* 300 in random order are sorted, fewer are not */
            uint32_t count = edit_case.step == 3 || edit_case.step == 5
                                 ? 300
                                 : 1 + 20 * (uint32_t)edit_case.step;
            points p =
                make_points(&s, &t, count, edit_case.step % 2 && edit_case.step < 5, &random);
            fail_each(&s, &t, &p, &failures);
            ask_some(&s, &t, &r, &random);
            free(p.at);
        }
        while (t.shared == false && log_length(&t) > 0) {
            mw_error error = {0};
            expect_ok(mw_edit_undo(t.editor, NULL, &error), "undo", &error);
        }
        mw_editor_info info;
        mw_editor_describe(t.editor, &info);
        REQUIRE(info.undoable == 0 && info.vertices == mw_mesh_vertex_count(t.first));
        print_message("%ld allocations failed\n", failures);
        assert_true(failures > 10);
        twin_close(&t);
    }
}

/* Where nobody asks all room is made before anything changes, or, where there is not as much, what
 * is changed is recorded: that an allocation failed need not show, but nothing is done by half. */
static void test_memory_plain(void **state)
{
    (void)state;
    enum { MANY = 150 };
    long failures = 0, all_the_same = 0;
    for (int i = 0; i < SESSIONS; i++) {
        const points_session *s = &sessions[i];
        uint64_t random = mw__random_seed(environment_seed(1), (uint32_t)i);
        mw_editor_options options = {.undo = 1, .log = 1, .delaunay = s->delaunay};
        const mw_editor_options nothing = {.delaunay = s->delaunay};
        if (s->constraints) continue;
        twin t;
        edit_case.name = s->name;
        edit_case.seed = environment_seed(1);
        twin_open(&t, first_mesh(s, &random), &options);
        points p = make_points(s, &t, MANY, i % 2, &random);
        twin before = twin_copy(&t);
        uint32_t *vertices = require_room(MANY + 1, sizeof *vertices),
                 *own = require_room(MANY, sizeof *own);
        insert_all(&t, &p, vertices);
        bool failed = true;
        for (long k = 0; failed; k++) {
            mw_editor *plain;
            mw_error error = {0};
            expect_ok(mw_editor_create(t.first, &nothing, &plain, &error), s->name, &error);
            allocations_left = k;
            mw_status status = mw_edit_insert_points(plain, p.at, p.n, p.stride, own, NULL, &error);
            failed = allocations_left < 0;
            allocations_left = -1;
            REQUIRE(status == MW_OK || (failed && status == MW_ERROR_MEMORY));
            twin held = status ? before : t;
            held.editor = plain;
            twin_check_same(&held);
            if (!status) REQUIRE(memcmp(own, vertices, MANY * sizeof *own) == 0);
            failures += status != MW_OK;
            all_the_same += !status && failed;
            mw_editor_destroy(plain);
        }
        free(vertices);
        free(own);
        free(p.at);
        twin_close(&before);
        twin_close(&t);
    }
    print_message("%ld allocations failed, %ld without showing\n", failures, all_the_same);
    assert_true(failures > 20 && all_the_same > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arguments),     cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_sessions),      cmocka_unit_test(test_refused),
        cmocka_unit_test(test_memory),        cmocka_unit_test(test_memory_plain),
        cmocka_unit_test(test_refused_plain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
