/* test_border_walk.c - the border walk in meshes with pockets, holes and pieces, left open: the
 * same answers as in the filled mesh, holes included, and those of brute force in rationals. */
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
#include <stdio.h>
#include <stdlib.h>

static mw_locator *locator_of(const mw_mesh *mesh, mw_fill_mode fill)
{
    return mesh_locator(mesh, (mw_locator_options){.fill = fill});
}

static bool same(const mw_location *a, const mw_location *b)
{
    return a->where == b->where && a->triangle == b->triangle && a->hole == b->hole &&
           a->local == b->local;
}

static void compare(const mw_location *got, const mw_location *want, const double q[2],
                    const char *how)
{
    if (same(got, want)) return;
    fail_msg("%s: (%.17g, %.17g): %s triangle %d hole %d, not %s %d %d", how, q[0], q[1],
             mw_where_name((mw_where)got->where), (int)got->triangle, (int)got->hole,
             mw_where_name((mw_where)want->where), (int)want->triangle, (int)want->hole);
}

static bool is_refused(const arrays *a)
{
    mw_arrays view = arrays_view(a);
    mw_check check;
    assert_int_equal(mw_check_arrays(&view, NULL, &check, NULL), MW_OK);
    bool refused = !check.valid;
    mw_check_release(&check);
    return refused;
}

/* Answers in the filled mesh; of the first `exact` queries compared with brute force. */
static mw_location *expect(const arrays *a, const mw_mesh *mesh, const double *q, size_t n,
                           size_t exact)
{
    mw_locator *filled = locator_of(mesh, MW_FILL_YES);
    mw_location *want = malloc(n * sizeof *want);
    assert_int_equal(mw_locate_batch(filled, q, n, 2, NULL, want, NULL, NULL), MW_OK);
    for (size_t i = 0; i < n && i < exact; i++) {
        location_answer answer =
            location_oracle_locate(a->points, a->triangles, a->triangle_count, q + 2 * i);
        assert_int_equal(want[i].triangle, answer.triangle);
        assert_int_equal(want[i].local, answer.local);
    }
    mw_locator_destroy(filled);
    return want;
}

static void try_singles(const mw_locator *open, const mw_query_options *options, const double *q,
                        const mw_location *want, size_t n, const char *how)
{
    mw_cursor cursor;
    assert_int_equal(mw_cursor_init(open, options, &cursor, NULL), MW_OK);
    for (size_t i = 0; i < n; i++) {
        mw_location at = mw_locate(open, &cursor, q[2 * i], q[2 * i + 1]);
        compare(&at, &want[i], q + 2 * i, how);
    }
}

static void try_batch(const mw_locator *open, const mw_query_options *options, const double *q,
                      const mw_location *want, size_t n, const char *how)
{
    mw_location *at = malloc(n * sizeof *at);
    assert_int_equal(mw_locate_batch(open, q, n, 2, options, at, NULL, NULL), MW_OK);
    for (size_t i = 0; i < n; i++) compare(&at[i], &want[i], q + 2 * i, how);
    free(at);
}

/* All starts and both arithmetics, single and in batches, in both layouts. */
static void try_open(const arrays *a, const double *q, const mw_location *want, size_t n,
                     uint64_t *random)
{
    for (mw_mesh_layout layout = MW_LAYOUT_HILBERT; layout <= MW_LAYOUT_AS_GIVEN; layout++) {
        mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){.layout = layout});
        mw_locator *open = locator_of(mesh, MW_FILL_NO);
        mw_index *index[MW_START_COUNT];
        starts_open(open, index);
        for (int start = MW_START_AUTO; start < MW_START_COUNT; start++)
            for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
                char how[80];
                snprintf(how, sizeof how, "from %s, arithmetic %d, layout %d",
                         mw_start_name((mw_start_kind)start), arithmetic, layout);
                mw_query_options options = {.start = (mw_start_kind)start,
                                            .arithmetic = (mw_arithmetic)arithmetic,
                                            .seed = mw__random(random),
                                            .counters = start % 2,
                                            .index = index[start]};
                try_singles(open, &options, q, want, n, how);
                options.lanes = 1 + mw__random_below(random, 40);
                options.threads = 1 + mw__random_below(random, 3);
                try_batch(open, &options, q, want, n, how);
            }
        starts_close(index);
        mw_locator_destroy(open);
        mw_mesh_destroy(mesh);
    }
}

static void try_mesh(const arrays *a, size_t queries, size_t exact, uint64_t *random)
{
    size_t n;
    double *q = arrays_queries(a, queries, &n, random);
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    mw_location *want = expect(a, mesh, q, n, exact);
    try_open(a, q, want, n, random);
    free(want);
    mw_mesh_destroy(mesh);
    free(q);
}

/* --- meshes ----------------------------------------------------------------------------------- */

/* Give triangles vertices of their own, each corner with this chance: pieces that touch along
 * edges and in vertices, by equal coordinates only. */
static arrays tear(const arrays *a, double chance, uint64_t *random)
{
    arrays torn = arrays_make(a->point_count + 3 * a->triangle_count, a->triangle_count);
    for (uint32_t v = 0; v < a->point_count; v++)
        arrays_point(&torn, a->points[2 * v], a->points[2 * v + 1]);
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        uint32_t v[3];
        for (uint32_t k = 0; k < 3; k++) {
            v[k] = a->triangles[3 * t + k];
            if (random_unit(random) < chance)
                v[k] = arrays_point(&torn, a->points[2 * v[k]], a->points[2 * v[k] + 1]);
        }
        arrays_triangle(&torn, v[0], v[1], v[2]);
    }
    return torn;
}

/* A band along a curve: left and right points in turn, two triangles between each pair and the
 * next. */
static arrays band(uint32_t n, void (*at)(uint32_t i, uint32_t n, double left[2], double right[2]))
{
    arrays a = arrays_make(2 * n, 2 * n);
    for (uint32_t i = 0; i < n; i++) {
        double left[2], right[2];
        at(i, n, left, right);
        arrays_point(&a, left[0], left[1]);
        arrays_point(&a, right[0], right[1]);
        if (i == 0) continue;
        arrays_triangle(&a, 2 * i - 2, 2 * i - 1, 2 * i);
        arrays_triangle(&a, 2 * i - 1, 2 * i + 1, 2 * i);
    }
    return a;
}

static void spiral(uint32_t i, uint32_t n, double left[2], double right[2])
{
    double angle = 40.0 * i / n, radius = 1 + angle;
    left[0] = radius * cos(angle);
    left[1] = radius * sin(angle);
    right[0] = (radius + 3) * cos(angle);
    right[1] = (radius + 3) * sin(angle);
}

/* The same, mirrored: the border runs the other way round, and from each way out nearly all of it
 * comes before the way in that is next on the line. */
static void mirrored_spiral(uint32_t i, uint32_t n, double left[2], double right[2])
{
    spiral(i, n, right, left);
    left[1] = -left[1];
    right[1] = -right[1];
}

/* Teeth of height 100 on a back: the line to a point in the next tooth leaves and comes back over
 * and over. */
static arrays comb(uint32_t teeth)
{
    arrays a = arrays_make(5 * teeth, 3 * teeth);
    for (uint32_t i = 0; i < teeth; i++) {
        uint32_t p = arrays_point(&a, 2 * i, 0), q = arrays_point(&a, 2 * i + 1, 0);
        uint32_t r = arrays_point(&a, 2 * i, 100), s = arrays_point(&a, 2 * i + 1, 100);
        arrays_triangle(&a, p, q, s);
        arrays_triangle(&a, p, s, r);
    }
    for (uint32_t i = 0; i + 1 < teeth; i++) { /* the back: thin triangles below */
        uint32_t q = 4 * i + 1, next = 4 * i + 4;
        uint32_t low = arrays_point(&a, 2 * i + 1.5, -1);
        arrays_triangle(&a, low, next, q);
    }
    return a;
}

/* Blades that hang together in the middle only: every vertex there is pinched. */
static arrays blades(uint32_t n)
{
    arrays a = arrays_make(2 * n + 1, n);
    uint32_t hub = arrays_point(&a, 0, 0);
    for (uint32_t i = 0; i < n; i++) {
        double from = 2 * 3.14159265358979 * i / n, to = 2 * 3.14159265358979 * (i + 0.5) / n;
        uint32_t p = arrays_point(&a, cos(from), sin(from)), q = arrays_point(&a, cos(to), sin(to));
        arrays_triangle(&a, hub, p, q);
    }
    return a;
}

/* Square rings in one another, with room between them: holes in pieces in holes. */
static arrays nested(uint32_t rings)
{
    arrays a = arrays_make(8 * rings, 8 * rings);
    for (uint32_t i = 0; i < rings; i++) {
        double out = 4.0 * i + 3, in = 4.0 * i + 1;
        uint32_t first = a.point_count;
        for (int k = 0; k < 8; k++) {
            double r = k < 4 ? out : in;
            arrays_point(&a, k % 4 == 0 || k % 4 == 3 ? -r : r, k % 4 < 2 ? -r : r);
        }
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t l = (k + 1) % 4;
            arrays_triangle(&a, first + k, first + l, first + 4 + k);
            arrays_triangle(&a, first + l, first + 4 + l, first + 4 + k);
        }
    }
    return a;
}

/* --- tests ------------------------------------------------------------------------------------ */

/* Grids with triangles taken out: lines along border edges and through border vertices, holes that
 * share a vertex, pinched pieces, islands. */
static void test_punched(void **state)
{
    (void)state;
    uint64_t random = 21;
    for (int i = 0; i < 60; i++) {
        arrays a = arrays_grid(1 + (uint32_t)i / 8, i % 2 ? 0.4 : 0, &random);
        arrays_punch(&a, 0.1 + 0.1 * (i % 8), &random);
        arrays_scramble(&a, i % 3 == 0, &random);
        try_mesh(&a, 6, i < 40 ? 24 : 0, &random);
        arrays_free(&a);
    }
}

static void test_torn(void **state)
{
    (void)state;
    uint64_t random = 22;
    for (int i = 0; i < 40; i++) {
        arrays a = arrays_grid(2 + (uint32_t)i / 8, i % 2 ? 0.4 : 0, &random);
        arrays_punch(&a, 0.1 * (i % 8), &random);
        arrays torn = tear(&a, 0.2 + 0.2 * (i % 5), &random);
        arrays_scramble(&torn, i % 3 == 0, &random);
        if (!is_refused(&torn)) try_mesh(&torn, 6, 24, &random);
        arrays_free(&torn);
        arrays_free(&a);
    }
}

static void test_shapes(void **state)
{
    (void)state;
    uint64_t random = 23;
    arrays shapes[] = {band(400, spiral), comb(30), blades(9), blades(64), nested(1), nested(6)};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        arrays_scramble(&shapes[i], 1, &random);
        try_mesh(&shapes[i], 12, 24, &random);
        arrays_free(&shapes[i]);
    }
}

/* Far from the origin the middle of an edge is rounded off it. */
static void test_offset_and_scale(void **state)
{
    (void)state;
    uint64_t random = 24;
    const double to[][3] = {
        {1, 5e6, 5e6}, {1e-9, 1, 1}, {1e-300, 0, 0}, {1e300, 0, 0}, {0x1p-1060, 0, 0}};
    for (size_t i = 0; i < sizeof to / sizeof *to; i++) {
        arrays a = arrays_grid(5, i < 2 ? 0.3 : 0, &random);
        arrays_punch(&a, 0.3, &random);
        arrays_scramble(&a, 1, &random);
        arrays_transform(&a, to[i][0], to[i][1], to[i][2]);
        if (!is_refused(&a)) try_mesh(&a, 8, 32, &random);
        arrays_free(&a);
    }
}

static void test_slivers(void **state)
{
    (void)state;
    uint64_t random = 25;
    int tried = 0;
    for (int i = 0; i < 12; i++) {
        arrays a = arrays_grid(6, 0.3, &random);
        arrays_punch(&a, 0.3, &random);
        for (uint32_t v = 0; v < a.point_count; v++)
            a.points[2 * v + 1] = a.points[2 * v + 1] * 0x1p-40 + 3 * a.points[2 * v];
        arrays_scramble(&a, i % 2, &random);
        if (!is_refused(&a)) { /* rounding may have folded it */
            try_mesh(&a, 8, 16, &random);
            tried++;
        }
        arrays_free(&a);
    }
    assert_true(tried > 0);
}

/* Flat triangles that join what lies on both sides of them. */
static void test_flat(void **state)
{
    (void)state;
    uint64_t random = 26;
    for (int i = 0; i < 10; i++) {
        arrays a = arrays_make(40, 60);
        for (uint32_t x = 0; x < 6;
             x++) { /* a row below, with vertices inside the long edge above it */
            arrays_point(&a, x, 0);
            arrays_point(&a, x, -1);
        }
        uint32_t top = arrays_point(&a, 2.5, 4);
        for (uint32_t x = 0; x < 5; x++) {
            if (random_unit(&random) < 0.8) arrays_triangle(&a, 2 * x + 1, 2 * x + 3, 2 * x + 2);
            if (random_unit(&random) < 0.8) arrays_triangle(&a, 2 * x + 1, 2 * x + 2, 2 * x);
            if (x > 0) arrays_triangle(&a, 0, 2 * x, 2 * x + 2); /* flat */
        }
        arrays_triangle(&a, 0, 10, top);
        arrays_scramble(&a, i % 2, &random);
        if (!is_refused(&a)) try_mesh(&a, 8, 64, &random);
        arrays_free(&a);
    }
}

/* A locator that is left open has no ghosts and, where the mesh allows it, no copy; only the
 * border walk takes it. */
static void test_options(void **state)
{
    (void)state;
    uint64_t random = 27;
    arrays a = nested(3);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *open = locator_of(mesh, MW_FILL_NO), *filled = locator_of(mesh, MW_FILL_YES);
    mw_locator_info info;
    mw_locator_describe(open, &info);
    assert_int_equal(info.unfilled, 1);
    assert_int_equal(info.copied, 0);
    assert_int_equal(info.ghost_triangles, 0);
    assert_int_equal(info.fill_bytes, 0);
    assert_int_equal(info.holes, 3);
    assert_int_equal(info.components, 3);
    size_t bytes = info.bytes;
    mw_locator_describe(filled, &info);
    assert_int_equal(info.unfilled, 0);
    assert_int_equal(info.holes, 3);
    assert_true(info.fill_bytes > 0 && info.bytes >= info.fill_bytes && info.bytes > bytes);
    mw_cursor cursor;
    for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++) {
        mw_query_options options = {.walk = (mw_walk_kind)walk};
        bool taken = walk == MW_WALK_AUTO || walk == MW_WALK_BORDER;
        assert_int_equal(mw_cursor_init(open, &options, &cursor, NULL),
                         taken ? MW_OK : MW_ERROR_ARGUMENT);
        assert_int_equal(mw_cursor_init(filled, &options, &cursor, NULL), MW_OK);
    }
    mw_locator_destroy(open);
    mw_locator_destroy(filled);
    mw_locator_options wrong = {.fill = (mw_fill_mode)3};
    assert_int_equal(mw_locator_create(mesh, &wrong, &open, NULL), MW_ERROR_ARGUMENT);
    mw_mesh_destroy(mesh);
    arrays_free(&a);

    a = arrays_grid(40, 0.3, &random);
    arrays_punch(&a, 0.1, &random);
    mesh = arrays_mesh(&a, (mw_mesh_options){0});
    for (int many = 0; many < 2; many++) { /* what few queries do not pay for */
        mw_locator *chosen =
            mesh_locator(mesh, (mw_locator_options){.queries = many ? 1000000 : 10});
        mw_locator_describe(chosen, &info);
        assert_int_equal(info.unfilled, !many);
        mw_locator_destroy(chosen);
    }
    mw_mesh_destroy(mesh);
    arrays_free(&a);

    a = arrays_grid(4, 0, &random); /* convex: there is nothing to fill */
    mesh = arrays_mesh(&a, (mw_mesh_options){0});
    open = locator_of(mesh, MW_FILL_NO);
    mw_locator_describe(open, &info);
    assert_int_equal(info.unfilled, 0);
    mw_locator_destroy(open);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* The counters add up, and do not depend on the threads. */
static void test_counters(void **state)
{
    (void)state;
    enum { N = 40000 };
    uint64_t random = 28;
    arrays a = arrays_grid(60, 0.4, &random);
    arrays_punch(&a, 0.15, &random);
    arrays_scramble(&a, 1, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *open = locator_of(mesh, MW_FILL_NO);
    double *q = malloc(2 * N * sizeof *q);
    mw_location *at = malloc(N * sizeof *at);
    for (int i = 0; i < 2 * N; i++) q[i] = 64 * random_unit(&random) - 2;
    mw_counters one, more;
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        mw_query_options options = {.start = MW_START_RANDOM, .counters = 1, .threads = threads};
        assert_int_equal(
            mw_locate_batch(open, q, N, 2, &options, at, threads == 1 ? &one : &more, NULL), MW_OK);
    }
    assert_memory_equal(&one, &more, sizeof one);
    uint64_t outside = 0;
    for (int i = 0; i < N; i++) outside += at[i].triangle == MW_NONE;
    assert_int_equal(one.queries, N);
    assert_true(outside > 0 && outside < N);
    assert_true(one.walk_runs >= N && one.border_runs >= outside);
    assert_true(one.border_runs - outside <= one.walk_runs - N + outside);
    assert_int_equal(one.cycles + one.handovers, 0);
    assert_true(one.triangles_border_max <= one.triangles_border &&
                one.triangles_walk_max <= one.triangles);
    assert_true(one.border_edges <= one.orient_border && one.border_edges_max <= one.border_edges);
    assert_true(one.triangles > 0 && one.orient > one.triangles);
    mw_locator_destroy(open);
    mw_mesh_destroy(mesh);
    free(at);
    free(q);
    arrays_free(&a);
}

/* --- the length of the way along borders ------------------------------------------------------ */

/* Two triangles for each '#', the last row on top. */
static arrays cells_mesh(const char *const *row, uint32_t rows, uint32_t columns)
{
    arrays a = arrays_make((rows + 1) * (columns + 1), 2 * rows * columns);
    for (uint32_t y = 0; y <= rows; y++)
        for (uint32_t x = 0; x <= columns; x++) arrays_point(&a, x, y);
    for (uint32_t y = 0; y < rows; y++)
        for (uint32_t x = 0; x < columns; x++) {
            uint32_t p = y * (columns + 1) + x, q = p + columns + 1;
            if (row[y][x] != '#') continue;
            arrays_triangle(&a, p, p + 1, q + 1);
            arrays_triangle(&a, p, q + 1, q);
        }
    return a;
}

/* The most edges of the border that a walk from any triangle to one of these points tests: inside,
 * outside, as shares of all border edges. */
static void longest(const arrays *a, const double *q, size_t n, double most[2])
{
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    mw_locator *open = locator_of(mesh, MW_FILL_NO);
    mw_mesh_info info;
    assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
    mw_query_options options = {.start = MW_START_LAST, .counters = 1};
    most[0] = most[1] = 0;
    for (uint32_t t = 0; t < a->triangle_count; t++)
        for (size_t i = 0; i < n; i++) {
            mw_cursor cursor;
            assert_int_equal(mw_cursor_init(open, &options, &cursor, NULL), MW_OK);
            cursor.last = t;
            mw_location at = mw_locate(open, &cursor, q[2 * i], q[2 * i + 1]);
            double share = (double)cursor.counters.border_edges / info.border_edges;
            bool outside = at.triangle == MW_NONE;
            assert_int_equal(cursor.counters.cycles, 0);
            assert_true(cursor.counters.border_runs <= cursor.counters.walk_runs);
            if (share > most[outside]) most[outside] = share;
        }
    mw_locator_destroy(open);
    mw_mesh_destroy(mesh);
}

/* The thesis says that a walk visits at most all border edges once if the point is inside, twice
 * if it is outside. So it does in combs, fans, and spirals of one hand; but not in those of the
 * other, nor in some small polyominoes. */
static void test_published_bound(void **state)
{
    (void)state;
    static const char *const folded[2][6] = {
        {".#...#", ".###.#", "...#.#", "####.#", "...###", "...#.#"},
        {".#..#.", ".#####", "....#.", ".#.###", "####.#", ".#.#.#"}};
    uint64_t random = 29;
    enum { N = 200, COMB = 1, MIRRORED = 3, FOLDED = 4, SHAPES = 6 };
    double q[2 * N], most[2];
    arrays fan = arrays_fan(12);
    fan.triangle_count = 9; /* three quarters of it */
    arrays shapes[SHAPES] = {band(60, spiral),
                             comb(12),
                             fan,
                             band(200, mirrored_spiral),
                             cells_mesh(folded[0], 6, 6),
                             cells_mesh(folded[1], 6, 6)};
    for (size_t i = 0; i < SHAPES; i++) {
        const double size[SHAPES] = {45, 24, 1, 45, 6, 6};
        for (int k = 0; k < N; k++) {
            bool centred = i == 0 || i == 2 || i == MIRRORED;
            q[2 * k] = size[i] * (centred ? 2 * random_unit(&random) - 1 : random_unit(&random));
            q[2 * k + 1] = (i == COMB ? 100 : size[i]) *
                           (centred ? 2 * random_unit(&random) - 1 : random_unit(&random));
        }
        longest(&shapes[i], q, N, most);
        if (i < MIRRORED) assert_true(most[0] <= 1 && most[1] <= 2 && most[1] > 0.5);
        if (i == MIRRORED) assert_true(most[0] > 2 && most[1] > 2);
        if (i == FOLDED) assert_true(most[0] > 1.5);
        if (i == FOLDED + 1) assert_true(most[1] > 2);
        arrays_free(&shapes[i]);
    }
}

/* There is no bound in terms of the border alone; so walks that go on too long hand over to one
 * that goes along no border more than twice. */
static void long_spiral(uint32_t i, uint32_t n, double left[2], double right[2])
{
    double angle = 400.0 * i / n, radius = 1 + angle;
    left[0] = (radius + 3) * cos(angle);
    left[1] = -(radius + 3) * sin(angle);
    right[0] = radius * cos(angle);
    right[1] = -radius * sin(angle);
}

static void test_long_ways(void **state)
{
    (void)state;
    enum { N = 400, POINTS = 8000 };
    uint64_t random = 30;
    double q[2 * N];
    arrays a = band(POINTS, long_spiral);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *open = locator_of(mesh, MW_FILL_NO);
    mw_mesh_info info;
    assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
    for (int i = 0; i < 2 * N; i++) q[i] = 800 * random_unit(&random) - 400;
    mw_location *want = expect(&a, mesh, q, N, 0);
    for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
        mw_query_options options = {.start = MW_START_RANDOM,
                                    .arithmetic = (mw_arithmetic)arithmetic,
                                    .counters = 1,
                                    .seed = 3};
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(open, &options, &cursor, NULL), MW_OK);
        for (int i = 0; i < N; i++) {
            mw_location at = mw_locate(open, &cursor, q[2 * i], q[2 * i + 1]);
            compare(&at, &want[i], q + 2 * i, "long spiral");
        }
        assert_true(cursor.counters.cycles > 0 && cursor.counters.handovers > 0);
        /* four times the border before handing over, with what a walk may take; twice it then, of
         * triangles too */
        assert_true(cursor.counters.border_edges_max < 5 * (uint64_t)info.border_edges);
        assert_true(cursor.counters.triangles_max < 40 * (uint64_t)info.triangles);
    }
    free(want);
    mw_locator_destroy(open);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Outside all boxes nothing is walked to; in a mesh that fills its hull no border is gone round. */
static void test_short_ways(void **state)
{
    (void)state;
    uint64_t random = 31;
    arrays pieces = nested(3), convex = arrays_grid(20, 0.5, &random);
    arrays_transform(&pieces, 0.5, 0, 0);
    for (int i = 0; i < 2; i++) {
        mw_mesh *mesh = arrays_mesh(i == 0 ? &pieces : &convex, (mw_mesh_options){0});
        mw_locator *open = locator_of(mesh, MW_FILL_NO);
        mw_query_options options = {
            .walk = MW_WALK_BORDER, .start = MW_START_RANDOM, .counters = 1};
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(open, &options, &cursor, NULL), MW_OK);
        for (int k = 0; k < 50; k++) {
            mw_location at =
                mw_locate(open, &cursor, 30 + 20 * random_unit(&random), 50 * random_unit(&random));
            assert_int_equal(at.where, MW_OUTSIDE);
        }
        assert_int_equal(cursor.counters.queries, 50);
        assert_int_equal(cursor.counters.border_edges, 0);
        if (i == 0) assert_int_equal(cursor.counters.triangles_visited, 50);
        mw_locator_destroy(open);
        mw_mesh_destroy(mesh);
    }
    arrays_free(&pieces);
    arrays_free(&convex);
}

/* The start `centre` is where the middle lies, whatever borders are on the way. */
static void test_centre(void **state)
{
    (void)state;
    uint64_t random = 32;
    for (int i = 0; i < 10; i++) {
        arrays a = arrays_grid(31, 0.3, &random);
        arrays_punch(&a, 0.1, &random);
        arrays_scramble(&a, 0, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *open = locator_of(mesh, MW_FILL_NO);
        mw_query_options options = {.start = MW_START_CENTRE, .counters = 1};
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(open, &options, &cursor, NULL), MW_OK);
        mw_location at = mw_locate(open, &cursor, 15.5, 15.5);
        if (at.where == MW_INSIDE) assert_int_equal(cursor.counters.triangles_visited, 1);
        mw_locator_destroy(open);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_punched),         cmocka_unit_test(test_torn),
        cmocka_unit_test(test_shapes),          cmocka_unit_test(test_offset_and_scale),
        cmocka_unit_test(test_slivers),         cmocka_unit_test(test_flat),
        cmocka_unit_test(test_options),         cmocka_unit_test(test_counters),
        cmocka_unit_test(test_published_bound), cmocka_unit_test(test_long_ways),
        cmocka_unit_test(test_short_ways),      cmocka_unit_test(test_centre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
