/* test_path.c - the triangles that a query visits: each walk's path is that of its query, goes
 * over edges, passes over ghosts, and ends in the answer. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/location_oracle.h"
#include "support/meshes.h"
#include "support/start_list.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROOM = 20000 };

/* What is tried: a mesh, its locator, and whether there may be ghosts or open borders on the way.
 */
typedef struct path_trial {
    const arrays *a;
    const mw_mesh *mesh;
    const mw_locator *locator;
    bool *border; /* per vertex: on the border? */
    bool whole;   /* convex: no ghosts, nothing open */
    uint32_t path[ROOM], short_path[ROOM];
} path_trial;

static bool are_neighbours(const mw_mesh *mesh, uint32_t s, uint32_t t)
{
    for (unsigned k = 0; k < 3; k++)
        if (mw_mesh_neighbour(mesh, s, k, NULL) == t) return true;
    return false;
}

static bool *find_border(const arrays *a, const mw_mesh *mesh)
{
    bool *border = calloc(a->point_count, sizeof *border);
    for (uint32_t t = 0; t < a->triangle_count; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (mw_mesh_neighbour(mesh, t, k, NULL) == MW_NONE)
                border[a->triangles[3 * t + k]] = border[a->triangles[3 * t + (k + 1) % 3]] = true;
    return border;
}

static bool is_at_border(const path_trial *r, uint32_t t)
{
    const uint32_t *v = r->a->triangles + 3 * (size_t)t;
    return r->border[v[0]] || r->border[v[1]] || r->border[v[2]];
}

/* Each triangle is across an edge of the one before; ghosts, and ways along a border, are between
 * triangles at borders. */
static void check_steps(const path_trial *r, size_t n)
{
    for (size_t i = 0; i + 1 < n; i++) {
        uint32_t s = r->path[i], t = r->path[i + 1];
        bool gap = !r->whole && is_at_border(r, s) && is_at_border(r, t);
        if (!gap && !are_neighbours(r->mesh, s, t))
            fail_msg("step %zu: triangles %u and %u share no edge", i, s, t);
    }
}

static void check_end(const path_trial *r, size_t n, const mw_location *at, const double q[2])
{
    location_answer in;
    if (at->triangle == MW_NONE) return;
    /* the walk may end in a ghost beside the triangle */
    if (!r->whole && at->where != MW_INSIDE) return;
    assert_true(n > 0);
    const uint32_t last = r->path[n - 1];
    if (at->where == MW_INSIDE) assert_int_equal(last, at->triangle);
    assert_true(location_oracle_contains(r->a->points, r->a->triangles + 3 * (size_t)last, q, &in));
}

static bool same(const mw_location *a, const mw_location *b)
{
    return memcmp(a->weight, b->weight, sizeof a->weight) == 0 && a->triangle == b->triangle &&
           a->hole == b->hole && a->where == b->where && a->local == b->local;
}

/* A query, and its path by a cursor in the same state: what they do and leave behind is the same.
 */
static void try_query(path_trial *r, mw_cursor *cursor, const double q[2])
{
    mw_cursor written = *cursor, cut = *cursor, uncounted = *cursor;
    mw_counters before = cursor->counters;
    mw_location want = mw_locate(r->locator, cursor, q[0], q[1]), at;
    size_t n = mw_walk_path(r->locator, &written, q[0], q[1], r->path, ROOM, &at);
    uint64_t visited = cursor->counters.triangles_visited - before.triangles_visited;
    uint64_t returns = cursor->counters.border_runs - before.border_runs;
    assert_true(n <= ROOM && same(&at, &want));
    assert_memory_equal(&written, cursor, sizeof written);
    if (r->whole && !cursor->index)
        assert_int_equal(n, visited);
    else
        assert_true(n <= visited + returns || cursor->counters.handovers > before.handovers);
    check_steps(r, n);
    check_end(r, n, &at, q);

    assert_int_equal(mw_walk_path(r->locator, &cut, q[0], q[1], r->short_path, n / 2, NULL), n);
    assert_memory_equal(r->short_path, r->path, n / 2 * sizeof *r->path);
    uncounted.count = 0;
    assert_int_equal(mw_walk_path(r->locator, &uncounted, q[0], q[1], NULL, 7, NULL), n);
    assert_true(uncounted.last == cursor->last && uncounted.random == cursor->random);
}

static void try_walk(path_trial *r, mw_query_options options, uint32_t fuel, const double *q,
                     size_t n)
{
    mw_cursor cursor;
    options.counters = 1;
    assert_int_equal(mw_cursor_init(r->locator, &options, &cursor, NULL), MW_OK);
    /* walks run dry: the celestial one, or that along all the border, takes over */
    if (fuel) cursor.fuel = fuel;
    for (size_t i = 0; i < n; i++) try_query(r, &cursor, q + 2 * i);
}

static path_trial *open_trial(const arrays *a, bool whole, mw_locator_options options)
{
    path_trial *r = malloc(sizeof *r);
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    *r = (path_trial){.a = a, .mesh = mesh, .locator = mesh_locator(mesh, options), .whole = whole};
    r->border = find_border(a, mesh);
    return r;
}

static void close_trial(path_trial *r)
{
    mw_locator_destroy((mw_locator *)r->locator);
    mw_mesh_destroy((mw_mesh *)r->mesh);
    free(r->border);
    free(r);
}

/* All walks, all starts. */
static void try_filled(const arrays *a, bool whole, uint64_t *random)
{
    size_t n;
    double *q = arrays_queries(a, 12, &n, random);
    path_trial *r = open_trial(
        a, whole,
        (mw_locator_options){.fill = MW_FILL_YES, .areas = (int)(mw__random(random) >> 63)});
    mw_index *index[MW_START_COUNT];
    starts_open(r->locator, index);
    for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
        for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
            mw_query_options options = {.walk = (mw_walk_kind)walk,
                                        .start = (mw_start_kind)start,
                                        .seed = mw__random(random),
                                        .index = index[start]};
            try_walk(r, options, 0, q, n);
            try_walk(r, options, 1 + mw__random_below(random, 4), q, n);
        }
    starts_close(index);
    close_trial(r);
    free(q);
}

static void try_open(const arrays *a, uint64_t *random)
{
    size_t n;
    double *q = arrays_queries(a, 40, &n, random);
    path_trial *r = open_trial(a, false, (mw_locator_options){.fill = MW_FILL_NO});
    for (int start = MW_START_RANDOM; start <= MW_START_LAST; start++)
        for (uint32_t fuel = 0; fuel < 40; fuel += 7)
            try_walk(r,
                     (mw_query_options){.start = (mw_start_kind)start, .seed = mw__random(random)},
                     fuel, q, n);
    close_trial(r);
    free(q);
}

static uint64_t seed(void)
{
    uint64_t random = (uint64_t)time(NULL);
    print_message("seed %llu\n", (unsigned long long)random);
    return random;
}

static void test_convex(void **state)
{
    (void)state;
    uint64_t random = seed();
    for (int i = 0; i < 3; i++) {
        arrays a = i == 2 ? arrays_fan(200) : arrays_grid(9, 0.4 * i, &random);
        arrays_scramble(&a, 1, &random);
        try_filled(&a, i < 2, &random);
        arrays_free(&a);
    }
}

static void test_holes(void **state)
{
    (void)state;
    uint64_t random = seed();
    for (int i = 0; i < 3; i++) {
        arrays a = arrays_grid(10, 0.4, &random);
        arrays_punch(&a, 0.1 + 0.25 * i, &random);
        arrays_scramble(&a, 1, &random);
        try_filled(&a, false, &random);
        try_open(&a, &random);
        arrays_free(&a);
    }
}

/* A row of 4 x 1 cells: with the number of the triangles from left to right the path is known. */
static arrays strip(void)
{
    arrays a = arrays_make(10, 8);
    for (uint32_t x = 0; x <= 4; x++) {
        arrays_point(&a, x, 0);
        arrays_point(&a, x, 1);
    }
    for (uint32_t x = 0; x < 4; x++) {
        arrays_triangle(&a, 2 * x, 2 * x + 2, 2 * x + 1);
        arrays_triangle(&a, 2 * x + 2, 2 * x + 3, 2 * x + 1);
    }
    return a;
}

static size_t path_from(const path_trial *r, mw_query_options options, const double from[2],
                        const double to[2], uint32_t *path)
{
    mw_cursor cursor;
    options.start = MW_START_LAST;
    assert_int_equal(mw_cursor_init(r->locator, &options, &cursor, NULL), MW_OK);
    mw_locate(r->locator, &cursor, from[0], from[1]);
    return mw_walk_path(r->locator, &cursor, to[0], to[1], path, ROOM, NULL);
}

/* From where the query before ended, whatever the walk and the arithmetic; and back. */
static void test_strip(void **state)
{
    (void)state;
    static const uint32_t there[] = {0, 1, 2, 3, 4, 5, 6, 7}, back[] = {7, 6, 5, 4, 3, 2, 1, 0};
    static const double left[2] = {0.1, 0.2}, right[2] = {3.9, 0.8};
    arrays a = strip();
    path_trial *r = open_trial(&a, true, (mw_locator_options){0});
    for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
        for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
            mw_query_options options = {.walk = (mw_walk_kind)walk,
                                        .arithmetic = (mw_arithmetic)arithmetic};
            if (walk == MW_WALK_FAST_STOCHASTIC) options.steps = 1;
            size_t n = path_from(r, options, left, right, r->path);
            assert_true(n >= 8 && r->path[0] == 0 && r->path[n - 1] == 7);
            if (n == 8) assert_memory_equal(r->path, there, sizeof there);
            n = path_from(r, options, right, left, r->path);
            assert_true(n >= 8 && r->path[0] == 7 && r->path[n - 1] == 0);
            if (n == 8) assert_memory_equal(r->path, back, sizeof back);
        }
    size_t n = path_from(r, (mw_query_options){.walk = MW_WALK_REMEMBERING}, left, right, r->path);
    assert_int_equal(n, 8); /* nothing but the row itself */
    assert_int_equal(path_from(r, (mw_query_options){0}, left, (double[2]){0.2, 0.1}, r->path), 1);
    close_trial(r);
    arrays_free(&a);
}

/* A hole is crossed without a triangle, and gone round where it is open. */
static void test_gap(void **state)
{
    (void)state;
    static const double left[2] = {0.2, 1.4}, right[2] = {2.9, 1.6};
    uint64_t random = 5;
    arrays a = arrays_grid(3, 0, &random);
    /* without the middle cell */
    memmove(a.triangles + 24, a.triangles + 30, 24 * sizeof *a.triangles);
    a.triangle_count -= 2;
    path_trial *filled = open_trial(&a, false, (mw_locator_options){.fill = MW_FILL_YES});
    size_t n =
        path_from(filled, (mw_query_options){.walk = MW_WALK_STRAIGHT}, left, right, filled->path);
    check_steps(filled, n);
    bool gap = false;
    for (size_t i = 0; i + 1 < n; i++)
        gap |= !are_neighbours(filled->mesh, filled->path[i], filled->path[i + 1]);
    assert_true(gap);
    path_trial *open = open_trial(&a, false, (mw_locator_options){.fill = MW_FILL_NO});
    size_t round = path_from(open, (mw_query_options){0}, left, right, open->path);
    check_steps(open, round);
    for (size_t i = 0; i + 1 < round; i++)
        assert_true(are_neighbours(open->mesh, open->path[i], open->path[i + 1]));
    assert_true(round > n && open->path[round - 1] == filled->path[n - 1]);
    close_trial(filled);
    close_trial(open);
    arrays_free(&a);
}

/* Does the line from a to b pass triangle t, up to rounding of its ends? */
static bool is_on_line(const path_trial *r, uint32_t t, const double a[2], const double b[2])
{
    double least = INFINITY, most = -INFINITY;
    for (size_t k = 0; k < 3; k++) {
        double side =
            mw_orient2d(a, b, r->a->points + 2 * (size_t)r->a->triangles[3 * (size_t)t + k]);
        least = fmin(least, side);
        most = fmax(most, side);
    }
    return least <= 1e-9 && most >= -1e-9;
}

static bool is_corner(const path_trial *r, uint32_t t, const double at[2])
{
    for (size_t k = 0; k < 3; k++)
        if (memcmp(r->a->points + 2 * (size_t)r->a->triangles[3 * (size_t)t + k], at,
                   2 * sizeof *at) == 0)
            return true;
    return false;
}

/* The stages are as long as the counters say; a stage that follows another counts the triangle
 * that it begins in again. */
static void check_stages(const uint8_t *stages, size_t n, const mw_counters *c)
{
    uint64_t of[4] = {0};
    for (size_t i = 0; i < n; i++) of[stages[i]]++;
    assert_int_equal(of[MW_WALK_STAGE_INIT], c->triangles_init);
    assert_int_equal(of[MW_WALK_STAGE_WALK] + (of[MW_WALK_STAGE_INIT] > 0), c->triangles);
    assert_int_equal(of[MW_WALK_STAGE_FINAL] + (c->triangles_final > 0), c->triangles_final);
    assert_int_equal(of[MW_WALK_STAGE_BORDER], 0);
}

/* The walks along a line pass the triangles that it meets, from where they say that it begins. */
static void check_line(const path_trial *r, const uint8_t *stages, size_t n, const mw_walk_way *way,
                       mw_walk_kind walk, const double q[2])
{
    bool vertex =
        walk == MW_WALK_STRAIGHT || walk == MW_WALK_HYBRID || walk == MW_WALK_NORMAL_STRAIGHT_TURN;
    bool line = vertex || walk == MW_WALK_NORMAL_STRAIGHT || (walk == MW_WALK_BORDER && n > 1);
    bool legs = walk == MW_WALK_ORTHOGONAL || walk == MW_WALK_IMPROVED_ORTHOGONAL ||
                walk == MW_WALK_IMPROVED_ORTHOGONAL_VERTEX;
    assert_int_equal(way->line_points, line ? 2 : legs ? 3 : 0);
    if (!way->line_points) return;
    assert_memory_equal(way->line[way->line_points - 1], q, 2 * sizeof *q);
    if (vertex || walk == MW_WALK_ORTHOGONAL) assert_true(is_corner(r, r->path[0], way->line[0]));
    for (size_t i = 0; i < n; i++)
        if (stages[i] == MW_WALK_STAGE_WALK)
            assert_true(is_on_line(r, r->path[i], way->line[0], way->line[1]) ||
                        (legs && is_on_line(r, r->path[i], way->line[1], way->line[2])));
}

/* In the middle of a mesh, where no walk meets the hull. */
static void test_stages_and_lines(void **state)
{
    (void)state;
    enum { N = 24 };
    uint64_t random = 6;
    arrays a = arrays_grid(N, 0.5, &random);
    path_trial *r = open_trial(&a, true, (mw_locator_options){0});
    uint8_t stages[1000];
    for (int walk = MW_WALK_AUTO + 1; walk < MW_WALK_COUNT; walk++)
        for (int i = 0; i < 200; i++) {
            double at[4];
            for (int k = 0; k < 4; k++) at[k] = N * (0.25 + 0.5 * random_unit(&random));
            mw_query_options options = {.walk = (mw_walk_kind)walk,
                                        .start = MW_START_LAST,
                                        .counters = 1,
                                        .finish = MW_WALK_STOCHASTIC};
            mw_cursor cursor, again;
            assert_int_equal(mw_cursor_init(r->locator, &options, &cursor, NULL), MW_OK);
            mw_locate(r->locator, &cursor, at[0], at[1]);
            cursor.counters = (mw_counters){0};
            again = cursor;
            mw_walk_way way = {.triangles = r->path, .stages = stages, .capacity = sizeof stages};
            size_t n = mw_walk_follow(r->locator, &cursor, at[2], at[3], &way, NULL);
            assert_true(n < sizeof stages);
            assert_int_equal(
                mw_walk_path(r->locator, &again, at[2], at[3], r->short_path, ROOM, NULL), n);
            assert_memory_equal(r->path, r->short_path, n * sizeof *r->path);
            check_stages(stages, n, &cursor.counters);
            check_line(r, stages, n, &way, (mw_walk_kind)walk, at + 2);
        }
    close_trial(r);
    arrays_free(&a);
}

static void test_no_point(void **state)
{
    (void)state;
    arrays a = strip();
    path_trial *r = open_trial(&a, true, (mw_locator_options){0});
    mw_cursor cursor, before;
    mw_location at;
    assert_int_equal(mw_cursor_init(r->locator, NULL, &cursor, NULL), MW_OK);
    before = cursor;
    assert_int_equal(mw_walk_path(r->locator, &cursor, NAN, 0, r->path, ROOM, &at), 0);
    assert_int_equal(at.where, MW_BAD);
    assert_int_equal(mw_walk_path(r->locator, &cursor, 0, -INFINITY, r->path, ROOM, NULL), 0);
    assert_memory_equal(&cursor, &before, sizeof cursor);
    assert_true(mw_walk_path(r->locator, &cursor, 9, 9, r->path, ROOM, &at) > 0);
    assert_int_equal(at.where, MW_OUTSIDE);
    close_trial(r);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_convex),   cmocka_unit_test(test_holes),
        cmocka_unit_test(test_strip),    cmocka_unit_test(test_gap),
        cmocka_unit_test(test_no_point), cmocka_unit_test(test_stages_and_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
