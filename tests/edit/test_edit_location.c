/* test_edit_location.c - location while a mesh is edited: every walk from every start, with
 * cursors and indices that are older than the edits, answers as a locator made anew does; and what
 * leads to a first triangle stays near. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "edit/editor.h"
#include "support/allocations.h"
#include "support/meshes.h"

#include <math.h>
#include <meshwalk/edit.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- meshes ----------------------------------------------------------------------------------- */

enum { UNIFORM, GRID, CIRCLE, CLUSTERS, PATCHES, HOLES, MESHES };
static const char *const mesh_name[] = {"uniform",  "grid",    "circle",
                                        "clusters", "patches", "holes"};

/* A point as those of a mesh lie, all of them about within the square from 0 to 16; a few outside.
 */
static void random_place(int kind, uint64_t *random, double p[2])
{
    for (int k = 0; k < 2; k++) p[k] = 16 * random_unit(random);
    if (kind == GRID)
        for (int k = 0; k < 2; k++) p[k] = mw__random_below(random, 17);
    if (kind == CIRCLE) {
        static const double on[9][2] = {{5, 0},  {3, 4},  {4, 3},  {0, 5},  {-3, 4},
                                        {-4, 3}, {-5, 0}, {4, -3}, {-3, -4}};
        uint32_t i = mw__random_below(random, 9), scale = 1 + mw__random_below(random, 12);
        for (int k = 0; k < 2; k++) p[k] = 8 + on[i][k] * scale / 8;
    }
    if (kind == CLUSTERS) {
        uint32_t i = mw__random_below(random, 5);
        for (int k = 0; k < 2; k++)
            p[k] = 8 + 4 * cos(i * 1.3 + k) + (random_unit(random) - 0.5) * 0.01;
    }
    if (kind == PATCHES) /* a twentieth of the square */
        for (int k = 0; k < 2; k++)
            p[k] = 3.2 * mw__random_below(random, 5) + 0.7 * random_unit(random);
    if (kind != HOLES && mw__random_below(random, 40) == 0)
        for (int k = 0; k < 2; k++) p[k] = 40 * random_unit(random) - 12;
}

static mw_mesh *make_mesh(int kind, uint32_t n, uint64_t *random)
{
    if (kind == HOLES) {
        arrays a = arrays_grid(16, 0.5, random);
        arrays_punch(&a, 0.1, random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        arrays_free(&a);
        return mesh;
    }
    double *points = malloc(2 * n * sizeof *points);
    for (uint32_t i = 0; i < n; i++) random_place(kind, random, points + 2 * i);
    mw_mesh *raw = mesh_delaunay(points, n);
    free(points);
    arrays a = arrays_of_mesh(raw);
    mw_mesh_destroy(raw);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    arrays_free(&a);
    return mesh;
}

static mw_editor *make_editor(int kind, uint32_t n, mw_editor_options options, uint64_t *random)
{
    mw_mesh *mesh = make_mesh(kind, n, random);
    mw_editor *editor;
    mw_error error;
    expect_ok(mw_editor_create(mesh, &options, &editor, &error), "editor", &error);
    mw_mesh_destroy(mesh);
    return editor;
}

/* --- edits ------------------------------------------------------------------------------------ */

static uint32_t random_vertex(const mw_editor *editor, uint64_t *random)
{
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    for (;;) {
        uint32_t v = mw__random_below(random, info.vertex_range);
        if (mw_editor_triangle_of(editor, v) != MW_NONE) return v;
    }
}

static uint32_t random_neighbour(const mw_editor *editor, uint32_t v, uint64_t *random)
{
    uint32_t around[64];
    size_t n = mw_editor_adjacent_vertices(editor, v, around, 64);
    return around[mw__random_below(random, (uint32_t)(n < 64 ? n : 64))];
}

/* Where to insert or move to: anywhere, or in the middle of an edge. */
static void edit_place(const mw_editor *editor, int kind, uint64_t *random, double p[2])
{
    random_place(kind, random, p);
    if (mw__random_below(random, 6) > 0) return;
    uint32_t v = random_vertex(editor, random), w = random_neighbour(editor, v, random);
    double a[2], b[2];
    mw_editor_vertex(editor, v, a);
    mw_editor_vertex(editor, w, b);
    for (int k = 0; k < 2; k++) p[k] = a[k] / 2 + b[k] / 2;
}

static mw_status move_somewhere(mw_editor *editor, int kind, uint64_t *random)
{
    uint32_t v = random_vertex(editor, random);
    double p[2], q[2];
    edit_place(editor, kind, random, p);
    mw_editor_vertex(editor, v, q);
    if (mw__random_below(random, 4) > 0)
        for (int k = 0; k < 2; k++) p[k] = q[k] + 0.3 * (random_unit(random) - 0.5);
    return mw_edit_move(editor, v, p[0], p[1], NULL, NULL);
}

/* One edit of any kind; `grow` of 8 of those that insert or remove insert. Refused ones are none.
 */
static bool random_edit(mw_editor *editor, int kind, uint32_t grow, uint64_t *random)
{
    uint32_t v, w;
    double p[2];
    switch (mw__random_below(random, 16)) {
    case 0:
        v = random_vertex(editor, random);
        return !mw_edit_flip(editor, v, random_neighbour(editor, v, random), NULL, NULL);
    case 1:
        v = random_vertex(editor, random);
        w = random_neighbour(editor, v, random);
        w = random_neighbour(editor, w, random);
        return v != w && !mw_edit_constrain(editor, v, w, NULL, NULL);
    case 2:
    case 3:
        v = random_vertex(editor, random);
        return !mw_edit_release(editor, v, random_neighbour(editor, v, random), NULL, NULL);
    case 4: return !mw_edit_undo(editor, NULL, NULL);
    case 5:
    case 6:
    case 7: return !move_somewhere(editor, kind, random);
    default:
        if (mw__random_below(random, 8) >= grow)
            return !mw_edit_remove(editor, random_vertex(editor, random), NULL, NULL);
        edit_place(editor, kind, random, p);
        return !mw_edit_insert(editor, p[0], p[1], NULL, NULL);
    }
}

/* --- answers ---------------------------------------------------------------------------------- */

/* What is there now, made anew. */
typedef struct fresh {
    mw_mesh *mesh;
    mw_locator *locator;
    uint32_t *triangle; /* its numbers by the editor's */
    double *q;
    size_t n;
    mw_location *want;
} fresh;

static fresh make_fresh(const mw_editor *editor, size_t n, uint64_t *random)
{
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    fresh f = {.triangle = malloc(info.triangle_range * sizeof *f.triangle)};
    mw_error error;
    expect_ok(mw_editor_mesh(editor, f.triangle, NULL, &f.mesh, &error), "mesh", &error);
    f.locator = mesh_locator(f.mesh, (mw_locator_options){.fill = MW_FILL_YES});
    arrays a = arrays_of_mesh(f.mesh);
    f.q = arrays_queries(&a, n, &f.n, random);
    arrays_free(&a);
    f.q[0] = NAN;
    f.want = malloc(f.n * sizeof *f.want);
    expect_ok(mw_locate_batch(f.locator, f.q, f.n, 2, NULL, f.want, NULL, &error), "batch", &error);
    return f;
}

static void free_fresh(fresh *f)
{
    mw_locator_destroy(f->locator);
    mw_mesh_destroy(f->mesh);
    free(f->triangle);
    free(f->q);
    free(f->want);
}

/* Holes keep their numbers, and the lowest triangles beside them do not: only that q lies in one
 * is compared. */
static void expect_same(const fresh *f, size_t i, const mw_location *got, const char *how)
{
    const mw_location *want = &f->want[i];
    uint32_t triangle = got->triangle == MW_NONE ? MW_NONE : f->triangle[got->triangle];
    bool same = triangle == want->triangle && got->where == want->where &&
                got->local == want->local && (got->hole == MW_NONE) == (want->hole == MW_NONE);
    for (int k = 0; k < 3 && got->triangle != MW_NONE; k++)
        same = same && fabs(got->weight[k] - want->weight[k]) < 1e-9;
    if (!same)
        fail_msg("%s: (%.17g, %.17g): triangle %u (%u now), where %d, local %d; not %u, %d, %d",
                 how, f->q[2 * i], f->q[2 * i + 1], got->triangle, triangle, got->where, got->local,
                 want->triangle, want->where, want->local);
}

/* Cursors that live as long as the editor, one for each walk and start. */
typedef struct cursors {
    mw_cursor of[MW_WALK_COUNT][MW_START_COUNT][2];
    const mw_index *index[MW_START_COUNT];
} cursors;

static void open_cursors(mw_editor *editor, const mw_index_options *kept, cursors *c)
{
    mw_error error;
    memset(c->index, 0, sizeof c->index);
    for (int start = 0; start < MW_START_COUNT; start++)
        if (mw_start_has_index((mw_start_kind)start))
            expect_ok(mw_editor_index(editor, (mw_start_kind)start, kept, &c->index[start], &error),
                      "index", &error);
    for (int walk = 0; walk < MW_WALK_COUNT; walk++)
        for (int start = 0; start < MW_START_COUNT; start++)
            for (int i = 0; i < 2; i++) {
                mw_query_options options = {.walk = (mw_walk_kind)walk,
                                            .start = (mw_start_kind)start,
                                            .index = c->index[start],
                                            .arithmetic = (mw_arithmetic)((walk + start) % 2 && i),
                                            .counters = i};
                expect_ok(mw_cursor_init(mw_editor_locator(editor), &options,
                                         &c->of[walk][start][i], &error),
                          "cursor", &error);
            }
}

static void expect_alone(const mw_editor *editor, cursors *c, const fresh *f)
{
    const mw_locator *locator = mw_editor_locator(editor);
    for (int walk = 0; walk < MW_WALK_COUNT; walk++)
        for (int start = 0; start < MW_START_COUNT; start++)
            for (int k = 0; k < 2; k++) {
                mw_cursor *cursor = &c->of[walk][start][k];
                char how[80];
                snprintf(how, sizeof how, "alone %s from %s", mw_walk_name((mw_walk_kind)walk),
                         mw_start_name((mw_start_kind)start));
                for (size_t i = (size_t)(walk + k) % 3; i < f->n; i += 3) {
                    mw_location at = mw_locate(locator, cursor, f->q[2 * i], f->q[2 * i + 1]);
                    expect_same(f, i, &at, how);
                }
                mw_location at;
                mw_walk_path(locator, cursor, f->q[2], f->q[3], NULL, 0, &at);
                expect_same(f, 1, &at, how);
            }
}

static void expect_batches(const mw_editor *editor, const cursors *c, const fresh *f)
{
    mw_location *at = malloc(f->n * sizeof *at);
    mw_error error;
    for (int walk = 0; walk < MW_WALK_COUNT; walk++)
        for (int start = 0; start < MW_START_COUNT; start++) {
            char how[80];
            snprintf(how, sizeof how, "batch %s from %s", mw_walk_name((mw_walk_kind)walk),
                     mw_start_name((mw_start_kind)start));
            mw_query_options options = {.walk = (mw_walk_kind)walk,
                                        .start = (mw_start_kind)start,
                                        .index = c->index[start],
                                        .threads = 1 + (uint32_t)(walk + start) % 3,
                                        .counters = (walk + start) % 4 == 3};
            expect_ok(mw_locate_batch(mw_editor_locator(editor), f->q, f->n, 2, &options, at, NULL,
                                      &error),
                      how, &error);
            for (size_t i = 0; i < f->n; i++) expect_same(f, i, &at[i], how);
        }
    free(at);
}

static void expect_answers(const mw_editor *editor, cursors *c, size_t n, uint64_t *random)
{
    fresh f = make_fresh(editor, n, random);
    expect_alone(editor, c, &f);
    expect_batches(editor, c, &f);
    free_fresh(&f);
}

/* --- tests ------------------------------------------------------------------------------------ */

typedef struct location_session {
    uint32_t vertices, rounds, edits;
    mw_editor_options options;
    mw_index_options kept;
} location_session;

/* Each tile is found by its number, and from the guide as near as by a look at that alone. */
static void expect_numbers(const mw_editor *editor, int kind, uint64_t *random)
{
    const mw_locator *locator = &editor->locator;
    const mw_tiling *tiling = &locator->tiling;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        if (!(tiling->tri[t].user & MW_GHOST))
            assert_int_equal(tiling->tile_of[tiling->tri[t].user & MW_USER_MASK], t);
    for (int i = 0; i < 20; i++) {
        double q[2];
        random_place(kind, random, q);
        const mw_point p = {q[0], q[1]};
        assert_int_equal(mw__index_tile(tiling, &locator->guide, p),
                         mw__index_tile_ahead(tiling, &locator->guide, p));
    }
}

static void run_session(int kind, const location_session *s, uint64_t *random)
{
    mw_editor *editor = make_editor(kind, s->vertices, s->options, random);
    cursors *c = malloc(sizeof *c);
    open_cursors(editor, &s->kept, c);
    for (uint32_t round = 0; round < s->rounds; round++) {
        uint32_t grow = 2 + 4 * (round / 2 % 2); /* of 8 */
        for (uint32_t i = 0; i < s->edits; i++) {
            editor->upkeep.large = round % 2; /* as if it were */
            random_edit(editor, kind, grow, random);
        }
        expect_numbers(editor, kind, random);
        if (round % 5 == 3) assert_int_equal(mw_editor_compact(editor, NULL, NULL, NULL), MW_OK);
        expect_numbers(editor, kind, random);
        expect_answers(editor, c, 6, random);
    }
    free(c);
    mw_editor_destroy(editor);
}

static void test_sessions(void **state)
{
    (void)state;
    uint64_t seed = 701, random = seed;
    printf("seed %llu\n", (unsigned long long)seed);
    static const uint32_t vertices[] = {4, 12, 100, 400}, edits[] = {1, 10, 100};
    for (int kind = 0; kind < MESHES; kind++)
        for (int i = 0; i < 6; i++) {
            location_session s = {
                .vertices = vertices[i % 4],
                .rounds = 12,
                .edits = edits[i % 3],
                .options = {.delaunay = (mw_delaunay_mode)(i % 3), .undo = i % 2 ? SIZE_MAX : 5},
                .kept = {.ratio = i % 2 ? 0.4 : 0, .layers = i % 2 ? 4 : 0}};
            printf("%s, session %d\n", mesh_name[kind], i);
            run_session(kind, &s, &random);
        }
}

/* A layer is the Delaunay triangulation of vertices that are there below, each known from there. */
static void check_layer(const mw_live_layers *live, uint32_t i)
{
    const mw_layer *layer = &live->layers->layer[i];
    const mw_tiling *tiling = &layer->tiling,
                    *beneath = i ? &live->layers->layer[i - 1].tiling : live->mesh->tiling;
    const mw_point *p = tiling->point;
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *tile = &tiling->tri[t];
        assert_true(mw__orient2d(p[tile->v[0]], p[tile->v[1]], p[tile->v[2]]) > 0);
        for (uint32_t k = 0; k < 3; k++) {
            if (tile->link[k] == MW_NONE) continue;
            uint32_t across = mw__apex(&live->dynamic[i], tile->link[k]);
            assert_true(mw__incircle(p[tile->v[0]], p[tile->v[1]], p[tile->v[2]], p[across]) <= 0);
        }
    }
    uint32_t there = 0, below_there = 0;
    for (uint32_t v = 0; v < tiling->point_count; v++) {
        if (tiling->tile_at[v] == MW_NONE) continue;
        there++;
        uint32_t below = layer->below[v];
        assert_true(below < beneath->point_count && beneath->tile_at[below] != MW_NONE);
        assert_true(beneath->point[below].x == p[v].x && beneath->point[below].y == p[v].y);
        assert_int_equal(live->up[i][below], v);
    }
    for (uint32_t v = 0; v < beneath->point_count; v++)
        below_there += v < live->up_room[i] && live->up[i][v] != MW_NONE;
    assert_int_equal(there, below_there);
    assert_int_equal(there, tiling->point_count - layer->vacant);
}

/* Layers follow insertions, removals, moves, and what takes these back; some are given up or built
 * anew on the way. */
static void test_layers_follow(void **state)
{
    (void)state;
    uint64_t seed = 705, random = seed, checked = 0;
    printf("seed %llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < MESHES; kind++)
        for (int size = 0; size < 2; size++) {
            mw_editor *editor =
                make_editor(kind, size ? 500 : 20, (mw_editor_options){.undo = 50}, &random);
            const mw_index *index;
            mw_index_options kept = {.ratio = 0.3, .layers = 5};
            assert_int_equal(mw_editor_index(editor, MW_START_LAYERS, &kept, &index, NULL), MW_OK);
            for (int i = 0; i < 400; i++) {
                if (size == 0 && i % 10 == 0) allocations_left = mw__random_below(&random, 10);
                random_edit(editor, kind, 3 + (uint32_t)i / 100, &random);
                allocations_left = -1;
                const mw_live_layers *live = &editor->upkeep.live;
                assert_ptr_equal(live->layers, &index->layers);
                for (uint32_t k = 0; k + 1 < live->layers->count; k++) check_layer(live, k);
                checked += live->layers->count - 1;
                mw_index_info info;
                mw_editor_info now;
                mw_index_describe(index, &info);
                mw_editor_describe(editor, &now);
                assert_true(info.vertices[0] <= now.vertices);
            }
            mw_editor_destroy(editor);
        }
    assert_true(checked > 8000); /* most of the time there are layers */
    printf("%llu layers checked\n", (unsigned long long)checked);
}

/* Where memory fails in the middle of edits, they fail or not; what is kept up is kept or stays
 * behind; answers are right. */
static void test_memory(void **state)
{
    (void)state;
    uint64_t seed = 702, random = seed;
    printf("seed %llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < MESHES; kind++) {
        mw_editor *editor = make_editor(kind, 30, (mw_editor_options){.undo = 20}, &random);
        cursors *c = malloc(sizeof *c);
        open_cursors(editor, &(mw_index_options){.ratio = 0.4, .layers = 4}, c);
        for (uint32_t round = 0; round < 30; round++) {
            for (uint32_t i = 0; i < 60; i++) {
                allocations_left = mw__random_below(&random, 12);
                random_edit(editor, kind, 7, &random);
                if (i % 20 == 7) mw_editor_compact(editor, NULL, NULL, NULL);
                mw_start_kind start = round % 2 ? MW_START_LAYERS : MW_START_TWO_LEVEL_GRID;
                const mw_index *index = c->index[start];
                if (i % 20 == 13 && mw_editor_index(editor, start, NULL, &index, NULL))
                    index = c->index[start];
                allocations_left = -1;
                assert_ptr_equal(index, c->index[start]);
            }
            expect_answers(editor, c, 3, &random);
        }
        free(c);
        mw_editor_destroy(editor);
    }
}

/* Triangles that a query from the one before visits. */
static uint64_t visits(const mw_editor *editor, mw_cursor *cursor, const double q[2])
{
    cursor->counters = (mw_counters){0};
    mw_locate(mw_editor_locator(editor), cursor, q[0], q[1]);
    return cursor->counters.triangles_visited;
}

static void insert_within(mw_editor *editor, double x, double y, double side, uint64_t *random)
{
    x += side * random_unit(random);
    y += side * random_unit(random);
    assert_int_equal(mw_edit_insert(editor, x, y, NULL, NULL), MW_OK);
}

/* A cursor stays in a corner of the mesh. Its triangle goes by removals round about, by insertions
 * that are undone, by flips; far away much happens, so that tiles move to other slots. It begins
 * where its triangle was. */
static void test_cursors_recover(void **state)
{
    (void)state;
    uint64_t seed = 703, random = seed;
    printf("seed %llu\n", (unsigned long long)seed);
    enum { VERTICES = 20000, NEAR = 60, ROUNDS = 200 };
    mw_editor *editor = make_editor(UNIFORM, VERTICES, (mw_editor_options){.undo = 1000}, &random);
    const mw_locator *locator = mw_editor_locator(editor);
    mw_cursor cursor;
    mw_query_options options = {.walk = MW_WALK_REMEMBERING, .start = MW_START_LAST, .counters = 1};
    assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
    double q[2] = {1, 15}, far[2] = {15, 1};
    mw_cursor other = cursor;
    visits(editor, &cursor, q);
    visits(editor, &other, far);
    assert_true(visits(editor, &other, q) > 2 * NEAR); /* what a restart would take */
    uint64_t most = 0;
    for (int round = 0; round < ROUNDS; round++) {
        mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
        uint32_t v[3], gone = at.triangle;
        int steps = round % 7;
        for (int i = 0; i < steps && mw_editor_triangle(editor, gone, v); i++)
            assert_int_equal(mw_edit_remove(editor, v[i % 3], NULL, NULL), MW_OK);
        for (int i = 0; i < 5 && round % 2 == 0; i++)
            insert_within(editor, q[0], q[1], 0.1, &random);
        for (int i = 0; i < 20; i++) {
            insert_within(editor, 8, 1, 7, &random);
            mw_edit_remove(editor, random_vertex(editor, &random), NULL, NULL);
        }
        if (round % 3 == 0) {
            insert_within(editor, q[0], q[1], 1e-3, &random);
            visits(editor, &cursor, q); /* ends in a triangle that is made, then taken back */
            assert_int_equal(mw_edit_undo(editor, NULL, NULL), MW_OK);
        }
        if (round % 5 ==
            0) { /* the same by a vertex that comes from anywhere, and goes back there */
            assert_int_equal(mw_edit_move(editor, random_vertex(editor, &random), q[0] + 1e-3,
                                          q[1] + 1e-3, NULL, NULL),
                             MW_OK);
            visits(editor, &cursor, q);
            assert_int_equal(mw_edit_undo(editor, NULL, NULL), MW_OK);
        }
        uint64_t n = visits(editor, &cursor, q);
        most = n > most ? n : most;
    }
    printf("at most %llu triangles from where the triangle was\n", (unsigned long long)most);
    assert_true(most <= NEAR);
    mw_editor_destroy(editor);
}

/* --- what is kept up stays near --- */

enum { QUERIES = 20000 };

/* Queries at vertices, moved a little: where the mesh is. */
static double *queries_at(const mw_editor *editor, uint64_t *random)
{
    double *q = malloc(2 * QUERIES * sizeof *q);
    for (size_t i = 0; i < QUERIES; i++) {
        mw_editor_vertex(editor, random_vertex(editor, random), q + 2 * i);
        for (size_t k = 0; k < 2; k++) q[2 * i + k] += 1e-4 * (random_unit(random) - 0.5);
    }
    return q;
}

/* Triangles visited from each start, on average, those of layers too. From that of auto it is the
 * guide. */
static void measure(const mw_editor *editor, const mw_index *const *index, const double *q,
                    double mean[MW_START_COUNT])
{
    mw_location *at = malloc(QUERIES * sizeof *at);
    for (int start = 0; start < MW_START_COUNT; start++) {
        mw_query_options options = {.walk = MW_WALK_REMEMBERING,
                                    .start = (mw_start_kind)start,
                                    .index = index[start],
                                    .counters = 1};
        mw_counters counters;
        mw_error error;
        expect_ok(mw_locate_batch(mw_editor_locator(editor), q, QUERIES, 2, &options, at, &counters,
                                  &error),
                  "batch", &error);
        mean[start] = (double)counters.triangles_visited / (double)counters.queries;
    }
    free(at);
}

/* Beside indices built anew, of those that follow edits: a quarter and one triangle more is what
 * growth to nearly twice as many vertices makes. From the guide it may be `guide` times as many
 * and one: it bears more. */
static void expect_near(mw_editor *editor, const mw_index *const *index, double guide,
                        uint64_t *random)
{
    double *q = queries_at(editor, random), kept[MW_START_COUNT], anew[MW_START_COUNT];
    measure(editor, index, q, kept);
    assert_int_equal(mw_editor_compact(editor, NULL, NULL, NULL), MW_OK);
    measure(editor, index, q, anew);
    free(q);
    for (int start = 0; start < MW_START_COUNT; start++) {
        if (start != MW_START_SAMPLE && start != MW_START_AUTO && !index[start]) continue;
        printf("  %s %.2f, anew %.2f", mw_start_name((mw_start_kind)start), kept[start],
               anew[start]);
        if (start == MW_START_CURVE || start == MW_START_SAMPLE) continue;
        if (start == MW_START_BUCKETS || start == MW_START_TRIANGLE_BUCKETS ||
            start == MW_START_KD_TREE || start == MW_START_CHAINS)
            continue;
        if (kept[start] > (start == MW_START_AUTO ? guide : 1.25) * anew[start] + 1)
            fail_msg("%s leads too far", mw_start_name((mw_start_kind)start));
    }
    printf("\n");
}

typedef bool editing(mw_editor *editor, int kind, uint64_t *random);

static bool steady(mw_editor *editor, int kind, uint64_t *random)
{
    return random_edit(editor, kind, 4, random);
}

static bool growing(mw_editor *editor, int kind, uint64_t *random)
{
    return random_edit(editor, kind, 7, random);
}

static bool shrinking(mw_editor *editor, int kind, uint64_t *random)
{
    return random_edit(editor, kind, 1, random);
}

static bool moving(mw_editor *editor, int kind, uint64_t *random)
{
    return move_somewhere(editor, kind, random) == MW_OK;
}

/* Numbers that are taken back are given out again elsewhere. */
static bool inserting(mw_editor *editor, int kind, uint64_t *random)
{
    double p[2];
    do random_place(kind, random, p);
    while (fabs(p[0] - 8) > 8 || fabs(p[1] - 8) > 8);
    return mw_edit_insert(editor, p[0], p[1], NULL, NULL) == MW_OK;
}

static bool undoing(mw_editor *editor, int kind, uint64_t *random)
{
    if (mw__random_below(random, 8) < 3) return mw_edit_undo(editor, NULL, NULL) == MW_OK;
    return random_edit(editor, kind, 4, random);
}

static void test_kept_near(void **state)
{
    (void)state;
    enum { VERTICES = 10000, EDITS = 20000 };
    uint64_t seed = 704, random = seed;
    printf("seed %llu\n", (unsigned long long)seed);
    static editing *const ways[] = {steady, growing, shrinking, moving, undoing, inserting};
    static const char *const names[] = {"steady", "growing", "shrinking",
                                        "moving", "undoing", "inserting"};
    for (int way = 0; way < 6; way++) {
        mw_editor *editor =
            make_editor(UNIFORM, VERTICES, (mw_editor_options){.undo = 10}, &random);
        const mw_index *index[MW_START_COUNT] = {NULL};
        mw_error error;
        for (int start = 0; start < MW_START_COUNT; start++)
            if (mw_start_has_index((mw_start_kind)start))
                expect_ok(
                    mw_editor_index(editor, (mw_start_kind)start, NULL, &index[start], &error),
                    "index", &error);
        for (int i = 0; i < EDITS; i++) ways[way](editor, UNIFORM, &random);
        mw_editor_info info;
        mw_editor_describe(editor, &info);
        printf("%s, %u vertices, %llu refreshes:\n", names[way], info.vertices,
               (unsigned long long)info.refreshes);
        expect_near(editor, index, ways[way] == inserting ? 2 : 1.25, &random);
        mw_editor_destroy(editor);
    }
}

/* --- what the guide is ------------------------------------------------------------------------ */

/* None of whose vertices lies outside of the square. */
static mw_mesh *make_square(int kind, uint32_t n, uint64_t *random)
{
    double *points = malloc(2 * n * sizeof *points);
    for (uint32_t i = 0; i < n; i++) {
        double *p = points + 2 * i;
        do random_place(kind, random, p);
        while (fabs(p[0] - 8) > 8 || fabs(p[1] - 8) > 8);
    }
    mw_mesh *mesh = mesh_delaunay(points, n);
    free(points);
    return mesh;
}

/* A grid, of finer cells where most of them would be empty; where vertices are more crowded than
 * that one of two levels. Where memory fails while it is made there is no editor, or its cells
 * stay as they are. */
static void test_guides(void **state)
{
    (void)state;
    uint64_t random = 706;
    enum { VERTICES = 4000 };
    static const struct {
        int kind;
        mw_start_kind start;
    } expected[] = {
        {UNIFORM, MW_START_GRID}, {PATCHES, MW_START_GRID}, {CLUSTERS, MW_START_TWO_LEVEL_GRID}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        mw_mesh *mesh = make_square(expected[i].kind, VERTICES, &random);
        mw_editor *editor = NULL;
        long failures = 0, made = 0;
        for (bool failed = true; failed; failures += failed, made++) {
            mw_editor_destroy(editor);
            allocations_left = failures;
            mw_status status = mw_editor_create(mesh, NULL, &editor, NULL);
            failed = allocations_left < 0;
            allocations_left = -1;
            assert_int_equal(status, editor ? MW_OK : MW_ERROR_MEMORY);
            if (!editor) made--;
        }
        assert_true(failures > 10);
        /* without finer cells, for want of two arrays */
        assert_int_equal(made, expected[i].kind == PATCHES ? 3 : 1);
        const mw_index *guide = &editor->locator.guide;
        assert_int_equal(guide->start, expected[i].start);
        if (guide->start == MW_START_GRID) {
            const uint32_t cells = mw__lattice_cells(&guide->grid.lattice);
            assert_true(expected[i].kind == PATCHES ? cells > VERTICES : cells < VERTICES);
            for (uint32_t c = 0; c < cells; c++)
                assert_true(mw_editor_triangle(editor, guide->grid.tile[c], (uint32_t[3]){0}));
        }
        mw_editor_destroy(editor);
        mw_mesh_destroy(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sessions),  cmocka_unit_test(test_layers_follow),
        cmocka_unit_test(test_memory),    cmocka_unit_test(test_cursors_recover),
        cmocka_unit_test(test_kept_near), cmocka_unit_test(test_guides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
