/* test_index.c - the starts that build an index: answers do not depend on it, whatever mesh it was
 * made from; what it reports, refuses, and survives. Layers have more in test_layers.c. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "locate/index.h"
#include "locate/locator.h"
#include "support/allocations.h"
#include "support/meshes.h"
#include "support/start_list.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

static mw_index *index_of(const mw_locator *locator, mw_start_kind start, uint32_t cells)
{
    mw_index *index;
    mw_error error;
    mw_index_options options = {.cells = cells};
    if (mw_index_create(locator, start, &options, &index, &error))
        fail_msg("index: %s", error.message);
    return index;
}

static mw_counters answers(const mw_locator *locator, const mw_query_options *options,
                           const double *q, size_t n, mw_location *at)
{
    mw_counters counters;
    mw_error error;
    if (mw_locate_batch(locator, q, n, 2, options, at, &counters, &error))
        fail_msg("batch: %s", error.message);
    return counters;
}

static void expect_same(const mw_location *want, const mw_location *got, const double q[2],
                        const char *how)
{
    if (want->triangle == got->triangle && want->where == got->where && want->local == got->local)
        return;
    fail_msg("%s: (%.17g, %.17g): triangle %u where %d, not %u %d", how, q[0], q[1], got->triangle,
             got->where, want->triangle, want->where);
}

/* With the index as without, by all walks in both arithmetics, in batches and alone. */
static void expect_guide(const mw_locator *locator, const mw_index *index, const double *q,
                         size_t n)
{
    mw_location *want = malloc(n * sizeof *want), *at = malloc(n * sizeof *at);
    size_t points = 0;
    for (size_t i = 0; i < n; i++) points += isfinite(q[2 * i]) && isfinite(q[2 * i + 1]);
    answers(locator, &(mw_query_options){.walk = MW_WALK_CELESTIAL, .start = MW_START_RANDOM}, q, n,
            want);
    for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
        for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
            char how[80];
            snprintf(how, sizeof how, "%s from %s, arithmetic %d", mw_walk_name((mw_walk_kind)walk),
                     mw_start_name(index->start), arithmetic);
            mw_query_options options = {.walk = (mw_walk_kind)walk,
                                        .arithmetic = (mw_arithmetic)arithmetic,
                                        .index = index,
                                        .lanes = (uint32_t)(walk + arithmetic) % 9,
                                        .counters = 1};
            assert_int_equal(answers(locator, &options, q, n, at).queries, points);
            for (size_t i = 0; i < n; i++) expect_same(&want[i], &at[i], q + 2 * i, how);
            mw_cursor cursor;
            assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
            for (size_t i = 0; i < n; i += 3) {
                mw_location single = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
                expect_same(&want[i], &single, q + 2 * i, how);
            }
        }
    free(want);
    free(at);
}

/* Grids of few and of many cells, and of a number by default. */
static void expect_guides(const arrays *a, uint64_t *random)
{
    static const uint32_t cells[] = {0, 1, 2, 7, 1000};
    size_t n;
    double *q = arrays_queries(a, 10, &n, random);
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
        if (!mw_start_has_index((mw_start_kind)start)) continue;
        for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
            mw_index *index = index_of(locator, (mw_start_kind)start, cells[i]);
            expect_guide(locator, index, q, n);
            mw_index_destroy(index);
        }
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(q);
}

static arrays triangulated(const double *points, uint32_t n)
{
    mw_mesh *mesh;
    mw_error error;
    if (mw_delaunay(points, n, 2, NULL, NULL, NULL, &mesh, &error)) fail_msg("%s", error.message);
    arrays a = arrays_make(mw_mesh_vertex_count(mesh), mw_mesh_triangle_count(mesh));
    a.point_count = mw_mesh_vertex_count(mesh);
    a.triangle_count = mw_mesh_triangle_count(mesh);
    for (uint32_t v = 0; v < a.point_count; v++) mw_mesh_vertex(mesh, v, a.points + 2 * (size_t)v);
    for (uint32_t t = 0; t < a.triangle_count; t++)
        mw_mesh_triangle(mesh, t, a.triangles + 3 * (size_t)t);
    mw_mesh_destroy(mesh);
    return a;
}

/* Small dense clusters, and single points at most `far` away. */
static arrays clusters(uint32_t n, double far, uint64_t *random)
{
    double *points = malloc(2 * (size_t)n * sizeof *points);
    for (uint32_t i = 0; i < n; i++) {
        double centre = i % 4 * 0.25, size = i % 50 == 0 ? far : i % 4 == 0 ? 1e-9 : 1e-4;
        points[2 * i] = centre + size * random_unit(random);
        points[2 * i + 1] = centre * centre + size * random_unit(random);
    }
    arrays a = triangulated(points, n);
    free(points);
    return a;
}

static void test_grids(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (uint32_t n = 1; n <= 13; n += 4)
        for (int jitter = 0; jitter < 2; jitter++) {
            arrays a = arrays_grid(n, jitter ? 0.4 : 0, &random);
            arrays_scramble(&a, 1, &random);
            expect_guides(&a, &random);
            arrays_free(&a);
        }
}

static void test_clusters(void **state)
{
    (void)state;
    uint64_t random = 2;
    arrays a = clusters(600, 100, &random);
    expect_guides(&a, &random);
    arrays_free(&a);
}

/* So thin that the cells stand in one line, lying or upright; areas vanish to a rounding. */
static void test_slivers(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int upright = 0; upright < 2; upright++)
        for (int i = 0; i < 2; i++) {
            arrays a = arrays_grid(6, i ? 0.3 : 0, &random);
            for (uint32_t v = 0; v < a.point_count; v++) {
                double x = a.points[2 * v], y = a.points[2 * v + 1] * (i ? 0x1p-30 : 0x1p-1060);
                a.points[2 * v] = upright ? y : x;
                a.points[2 * v + 1] = upright ? x : y;
            }
            expect_guides(&a, &random);
            arrays_free(&a);
        }
}

static void test_holes(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int i = 0; i < 6; i++) {
        arrays a = arrays_grid(8, i % 2 ? 0.4 : 0, &random);
        arrays_punch(&a, 0.15 * (i + 1), &random);
        arrays_scramble(&a, i % 3 == 0, &random);
        expect_guides(&a, &random);
        arrays_free(&a);
    }
}

/* The differences of coordinates overflow, or their reciprocals do. */
static void test_scales(void **state)
{
    (void)state;
    uint64_t random = 5;
    const double to[][3] = {
        {-6, 0x1.4p1021, 0}, {0, 1e-9, 5e6}, {-6, 0x1p-1060, 0}, {0, 1e-300, 0}};
    for (size_t i = 0; i < sizeof to / sizeof *to; i++) {
        arrays a = arrays_grid(i == 1 ? 1 : 12, 0, &random);
        arrays_transform(&a, 1, to[i][0], to[i][0]);
        arrays_transform(&a, to[i][1], to[i][2], to[i][2]);
        expect_guides(&a, &random);
        arrays_free(&a);
    }
}

/* The middle cell of an extent of all doubles is in the middle of it. */
static void test_lattice(void **state)
{
    (void)state;
    const double low[2] = {-0x1p1023, -0x1.8p1023}, high[2] = {0x1.8p1023, 0x1p1023};
    mw_lattice lattice = mw__lattice(low, high, 25);
    assert_int_equal(lattice.columns, 5);
    assert_int_equal(lattice.rows, 5);
    assert_int_equal(mw__lattice_cell(&lattice, (mw_point){low[0], low[1]}), 0);
    assert_int_equal(mw__lattice_cell(&lattice, (mw_point){0x1p1021, -0x1p1021}), 12);
    assert_int_equal(mw__lattice_cell(&lattice, (mw_point){high[0], high[1]}), 24);
    assert_int_equal(mw__lattice_cell(&lattice, (mw_point){0x1.fp1023, -0x1.fp1023}), 4);
    assert_int_equal(mw__lattice_cell(&lattice, (mw_point){NAN, NAN}), 0);
    /* twice as wide as high; flat; a point */
    lattice = mw__lattice((double[2]){0, 0}, (double[2]){2, 1}, 50);
    assert_int_equal(lattice.columns, 10);
    assert_int_equal(lattice.rows, 5);
    lattice = mw__lattice((double[2]){0, 1}, (double[2]){2, 1}, 50);
    assert_int_equal(mw__lattice_cells(&lattice), 50);
    assert_int_equal(mw__lattice_cell(&lattice, (mw_point){1.99, 7}), 49);
    lattice = mw__lattice((double[2]){3, 1}, (double[2]){3, 1}, 50);
    assert_int_equal(mw__lattice_cell(&lattice, (mw_point){3, 1}), 0);
}

/* Each cell gets the entry of one in the first ring that has any. */
static void test_fill(void **state)
{
    (void)state;
    enum { COLUMNS = 37, ROWS = 23, CELLS = COLUMNS * ROWS };
    uint64_t random = 6;
    mw_lattice lattice = {.columns = COLUMNS, .rows = ROWS};
    for (uint32_t full = 1; full < 200; full += 33) {
        uint32_t entry[CELLS], queue[CELLS];
        bool given[CELLS] = {false};
        for (uint32_t c = 0; c < CELLS; c++) entry[c] = MW_NONE;
        for (uint32_t i = 0; i < full; i++) {
            uint32_t c = mw__random_below(&random, CELLS);
            entry[c] = c;
            given[c] = true;
        }
        mw__lattice_fill(&lattice, entry, queue);
        for (int c = 0; c < CELLS; c++) {
            int nearest = COLUMNS;
            for (int d = 0; d < CELLS; d++) {
                int dx = abs(c % COLUMNS - d % COLUMNS), dy = abs(c / COLUMNS - d / COLUMNS);
                int ring = dx > dy ? dx : dy;
                if (given[d] && ring < nearest) nearest = ring;
            }
            assert_true(entry[c] < CELLS && given[entry[c]]);
            int from = (int)entry[c], dx = abs(c % COLUMNS - from % COLUMNS),
                dy = abs(c / COLUMNS - from / COLUMNS);
            assert_int_equal(dx > dy ? dx : dy, nearest);
        }
    }
}

/* It keeps nothing of the mesh it was made from, and guides in another: fewer triangles, more,
 * elsewhere. */
static void test_other_mesh(void **state)
{
    (void)state;
    uint64_t random = 7;
    arrays mesh[4] = {arrays_grid(3, 0.4, &random), arrays_grid(20, 0.4, &random),
                      arrays_grid(10, 0.4, &random), clusters(300, 100, &random)};
    arrays_transform(&mesh[2], 1e6, -1e8, 1e9);
    for (int from = 0; from < 4; from++)
        for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
            if (!mw_start_has_index((mw_start_kind)start)) continue;
            mw_mesh *other = arrays_mesh(&mesh[from], (mw_mesh_options){0});
            mw_locator *made = mesh_locator(other, (mw_locator_options){0});
            mw_index *index = index_of(made, (mw_start_kind)start, 0);
            mw_locator_destroy(made);
            mw_mesh_destroy(other);
            for (int to = 0; to < 4; to++) {
                size_t n;
                double *q = arrays_queries(&mesh[to], 5, &n, &random);
                mw_mesh *here = arrays_mesh(&mesh[to], (mw_mesh_options){0});
                mw_locator *locator = mesh_locator(here, (mw_locator_options){0});
                expect_guide(locator, index, q, n);
                mw_locator_destroy(locator);
                mw_mesh_destroy(here);
                free(q);
            }
            mw_index_destroy(index);
        }
    for (int i = 0; i < 4; i++) arrays_free(&mesh[i]);
}

/* Walks from a grid are short: that is what it is for. */
static void test_guides_well(void **state)
{
    (void)state;
    enum { N = 5000 };
    uint64_t random = 8;
    for (int clustered = 0; clustered < 2; clustered++) {
        arrays a = clustered ? clusters(N, 1, &random) : arrays_grid(70, 0.4, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        double *q = malloc(2 * N * sizeof *q);
        mw_location *at = malloc(N * sizeof *at);
        for (size_t i = 0; i < N; i++) { /* where the triangles are */
            const uint32_t *t =
                a.triangles + 3 * (size_t)mw__random_below(&random, a.triangle_count);
            for (size_t k = 0; k < 2; k++)
                q[2 * i + k] =
                    (a.points[2 * t[0] + k] + a.points[2 * t[1] + k] + a.points[2 * t[2] + k]) / 3;
        }
        double visited[MW_START_COUNT] = {0};
        mw_index *index[MW_START_COUNT];
        starts_open(locator, index);
        for (int start = MW_START_RANDOM; start < MW_START_COUNT; start++) {
            mw_query_options options = {
                .start = (mw_start_kind)start, .index = index[start], .counters = 1};
            visited[start] = (double)answers(locator, &options, q, N, at).triangles_visited / N;
        }
        if (!clustered) assert_true(visited[MW_START_GRID] < 5);
        assert_true(visited[MW_START_TRIANGLE_BUCKETS] == 1); /* a test finds each */
        assert_true(visited[MW_START_KD_TREE] < 5);
        assert_true(clustered || visited[MW_START_BUCKETS] < 6);
        assert_true(visited[MW_START_TWO_LEVEL_GRID] < 5);
        assert_true(visited[MW_START_RANDOM] > 5 * visited[MW_START_TWO_LEVEL_GRID]);
        starts_close(index);
        free(at);
        free(q);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* Long thin triangles, askew: cells are so too. And a triangle along the hull, where a query
 * outside ended, is not near to what lies inside. */
static void test_stretched(void **state)
{
    (void)state;
    enum { N = 40000, ROWS = 9, QUERIES = 4000 };
    uint64_t random = 9;
    for (int stretched = 0; stretched < 2; stretched++) {
        double *p = malloc(2 * N * sizeof *p);
        for (size_t i = 0; i < N; i++) {
            double x = random_unit(&random);
            double y = stretched ? 0.1 * (double)(i % ROWS) + 1e-9 * random_unit(&random)
                                 : random_unit(&random);
            p[2 * i] = 0.8 * x - 0.6 * y;
            p[2 * i + 1] = 0.6 * x + 0.8 * y;
        }
        mw_mesh *mesh;
        mw_error error;
        if (mw_delaunay(p, N, 2, NULL, NULL, NULL, &mesh, &error)) fail_msg("%s", error.message);
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_query_options options = {.counters = 1};
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, &error), MW_OK);
        for (size_t i = 0; i < QUERIES; i++) {
            double x = random_unit(&random) + (i % 2 ? 0 : 1.5), y = 0.8 * random_unit(&random);
            mw_locate(locator, &cursor, 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y);
        }
        double visited = (double)cursor.counters.triangles_visited / QUERIES;
        printf("%s: %.1f triangles a query\n", stretched ? "slivers" : "uniform", visited);
        assert_true(visited < 25);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        free(p);
    }
}

/* Points in a square with its corners, in a disc, on a circle: few edges along the hull, more, as
 * many as points. */
static mw_mesh *hull_mesh(int kind, uint32_t n, uint64_t *random)
{
    double *p = malloc(2 * (size_t)n * sizeof *p);
    for (uint32_t i = 0; i < n; i++) {
        double x = i < 4 ? i & 1 : random_unit(random), y = i < 4 ? i >> 1 : random_unit(random);
        double angle = 6.28 * x, radius = kind == 1 ? sqrt(y) : 1;
        p[2 * i] = kind == 0 ? x : radius * cos(angle);
        p[2 * i + 1] = kind == 0 ? y : radius * sin(angle);
    }
    mw_mesh *mesh;
    mw_error error;
    if (mw_delaunay(p, n, 2, NULL, NULL, NULL, &mesh, &error)) fail_msg("%s", error.message);
    free(p);
    return mesh;
}

/* What lies outside of the extent is led to an edge of the hull that it lies beyond: by the guide,
 * and by a grid. */
static void test_outside(void **state)
{
    (void)state;
    enum { N = 20000, QUERIES = 4000 };
    uint64_t random = 13;
    static double q[2 * QUERIES];
    static mw_location at[QUERIES];
    for (int kind = 0; kind < 3; kind++) {
        mw_mesh *mesh = hull_mesh(kind, N, &random);
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_index *grid = index_of(locator, MW_START_GRID, 0);
        for (size_t i = 0; i < QUERIES;
             i++) { /* within sixteen times the extent, beyond one side or two */
            double out = (i & 1 ? 1 : -1) * (1.01 + 15 * random_unit(&random)),
                   along = 32 * random_unit(&random) - 16;
            q[2 * i] = i & 2 ? out : along;
            q[2 * i + 1] = i & 2 ? along : out;
        }
        for (int own = 0; own < 2; own++) {
            mw_query_options options = {.index = own ? grid : NULL, .counters = 1};
            mw_counters counters = answers(locator, &options, q, QUERIES, at);
            for (size_t k = 0; k < QUERIES; k++) assert_int_equal(at[k].where, MW_OUTSIDE);
            printf("outside, mesh %d: %.3f triangles a query\n", kind,
                   (double)counters.triangles_visited / QUERIES);
            assert_true((double)counters.triangles_visited / QUERIES < 1.5);
        }
        mw_index_destroy(grid);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
}

/* Small clusters, far apart: between them the guide is a grid, in them a sample along the curve. */
static void test_crowded(void **state)
{
    (void)state;
    enum { N = 100000, CLUSTERS = 50, QUERIES = 20000 };
    uint64_t random = 14;
    double *p = malloc(2 * N * sizeof *p), centre[2 * CLUSTERS];
    for (size_t i = 0; i < 2 * CLUSTERS; i++) centre[i] = random_unit(&random);
    for (size_t i = 0; i < N; i++) {
        const double *c = &centre[2 * mw__random_below(&random, CLUSTERS)];
        double radius = 0.002 * random_unit(&random), angle = 6.28 * random_unit(&random);
        p[2 * i] = c[0] + radius * cos(angle);
        p[2 * i + 1] = c[1] + radius * sin(angle);
    }
    mw_mesh *mesh;
    mw_error error;
    if (mw_delaunay(p, N, 2, NULL, NULL, NULL, &mesh, &error)) fail_msg("%s", error.message);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    double *q = malloc(2 * QUERIES * sizeof *q);
    mw_location *at = malloc(2 * QUERIES * sizeof *at), *want = at + QUERIES;
    for (int at_vertices = 0; at_vertices < 2; at_vertices++) {
        for (size_t i = 0; i < QUERIES; i++)
            for (size_t k = 0; k < 2; k++)
                q[2 * i + k] =
                    at_vertices ? p[2 * i + k] + 1e-6 * random_unit(&random) : random_unit(&random);
        mw_counters counters = answers(locator, &(mw_query_options){.counters = 1}, q, QUERIES, at);
        double visited = (double)counters.triangles_visited / QUERIES;
        printf("%s clusters: %.2f triangles a query\n", at_vertices ? "in" : "between", visited);
        assert_true(visited < 8);
        answers(locator, &(mw_query_options){.walk = MW_WALK_CELESTIAL, .start = MW_START_SORTED},
                q, QUERIES, want);
        for (size_t i = 0; i < QUERIES; i++) expect_same(&want[i], &at[i], q + 2 * i, "counted");
        answers(locator, NULL, q, QUERIES, at);
        for (size_t i = 0; i < QUERIES; i++) expect_same(&want[i], &at[i], q + 2 * i, "plain");
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(at);
    free(q);
    free(p);
}

static void test_describe(void **state)
{
    (void)state;
    uint64_t random = 9;
    arrays a = arrays_grid(100, 0.4, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    static const mw_start_kind starts[] = {MW_START_GRID, MW_START_BUCKETS,
                                           MW_START_TRIANGLE_BUCKETS, MW_START_TWO_LEVEL_GRID};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        mw_start_kind start = starts[i];
        mw_index_info info, wanted, one;
        mw_index *chosen = index_of(locator, start, 0), *given = index_of(locator, start, 900),
                 *least = index_of(locator, start, 1);
        mw_index_describe(chosen, &info);
        mw_index_describe(given, &wanted);
        mw_index_describe(least, &one);
        assert_int_equal(info.start, start);
        assert_int_equal(info.layers, 0);
        assert_true(info.seconds > 0 && info.seconds < 60);
        assert_true(info.cells > 10201 / 4 && info.cells <= 3 * 10201);
        assert_true(info.bytes >= 4 * (size_t)info.cells);
        if (start == MW_START_GRID) {
            assert_int_equal(wanted.cells, 32 * 32); /* 900, and the rim */
            assert_int_equal(one.cells, 1);
            assert_int_equal(info.bytes, sizeof *chosen + 4 * (size_t)info.cells);
        } else if (start == MW_START_BUCKETS || start == MW_START_TRIANGLE_BUCKETS) {
            assert_int_equal(wanted.cells, 30 * 30);
            assert_int_equal(one.cells, 1);
            if (start == MW_START_BUCKETS)
                assert_int_equal(info.bytes, sizeof *chosen + 4 * (size_t)info.cells);
        } else {
            assert_true(wanted.cells > 900 + 9000); /* all are crowded: 11 vertices each */
            assert_true(one.cells > 10000);         /* all are in one, which is a grid */
        }
        mw_index_destroy(chosen);
        mw_index_destroy(given);
        mw_index_destroy(least);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

static void test_refuses(void **state)
{
    (void)state;
    uint64_t random = 10;
    arrays a = arrays_grid(3, 0, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_index *grid = index_of(locator, MW_START_GRID, 0), *none = grid;
    mw_cursor cursor;
    mw_error error;
    assert_int_equal(mw_index_create(locator, MW_START_SAMPLE, NULL, &none, &error),
                     MW_ERROR_ARGUMENT);
    assert_null(none);
    assert_int_equal(mw_index_create(locator, MW_START_COUNT, NULL, &none, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_index_create(locator, MW_START_GRID, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_index_create(NULL, MW_START_GRID, NULL, &none, &error), MW_ERROR_ARGUMENT);
    const uint32_t too_many[] = {(1u << 30) + 1, 4000000000u, UINT32_MAX};
    for (int start = MW_START_GRID; start < MW_START_COUNT; start++)
        for (size_t i = 0; i < 3; i++) {
            mw_index_options options = {.cells = too_many[i]};
            none = grid;
            assert_int_equal(
                mw_index_create(locator, (mw_start_kind)start, &options, &none, &error),
                MW_ERROR_LIMIT);
            assert_int_equal(error.status, MW_ERROR_LIMIT);
            assert_null(none);
        }
    mw_index_destroy(NULL);
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
        mw_query_options options = {.start = (mw_start_kind)start};
        bool needs = mw_start_has_index((mw_start_kind)start);
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, &error),
                         needs ? MW_ERROR_ARGUMENT : MW_OK);
        options.index = grid;
        bool fits = start == MW_START_AUTO || start == MW_START_GRID;
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, &error),
                         fits ? MW_OK : MW_ERROR_ARGUMENT);
        if (fits) assert_int_equal(cursor.start, MW_START_GRID);
        mw_location at;
        assert_int_equal(
            mw_locate_batch(locator, (double[2]){1, 1}, 1, 2, &options, &at, NULL, &error),
            fits ? MW_OK : MW_ERROR_ARGUMENT);
    }
    mw_index_destroy(grid);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* The start `auto` with an index is the index's in batches too, however many queries. */
static void test_auto(void **state)
{
    (void)state;
    enum { N = 1000 };
    uint64_t random = 11;
    arrays a = arrays_grid(30, 0.4, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_index *index = index_of(locator, MW_START_GRID, 0);
    double q[2 * N];
    mw_location at[N];
    for (int i = 0; i < 2 * N; i++) q[i] = 30 * random_unit(&random);
    mw_query_options options = {.index = index, .counters = 1};
    mw_counters as_auto = answers(locator, &options, q, N, at);
    options.start = MW_START_GRID;
    options.lanes = 7; /* not chained: no difference */
    mw_counters as_named = answers(locator, &options, q, N, at);
    assert_memory_equal(&as_auto, &as_named, sizeof as_auto);
    mw_index_destroy(index);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* The vertices of the tile where a walk to q begins. */
static const uint32_t *first_tile(const mw_locator *locator, const mw_index *index, mw_point q)
{
    return locator->tiling.tri[mw__index_tile(&locator->tiling, index, q)].v;
}

static double off2(mw_point a, mw_point b)
{
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/* The tree leads to the nearest vertex, wherever the query is; and where doubles do not hold
 * distances, to any. */
static void test_nearest_vertex(void **state)
{
    (void)state;
    uint64_t random = 13;
    for (int round = 0; round < 6; round++) {
        arrays a = round % 3 == 2 ? clusters(700, 30, &random)
                                  : arrays_grid(round % 3 ? 1 : 25, round < 3 ? 0.5 : 0, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        const mw_tiling *tiling = &locator->tiling;
        mw_index *index = index_of(locator, MW_START_KD_TREE, 0);
        mw_index_info info;
        mw_index_describe(index, &info);
        assert_true(info.vertices[0] <= tiling->point_count &&
                    info.bytes > 20 * (size_t)info.vertices[0]); /* x, y, a number */
        for (int i = 0; i < 800; i++) {
            mw_point near = tiling->point[mw__random_below(&random, tiling->point_count)];
            double far = i % 4 ? 2 : 1e3;
            mw_point q = {near.x + far * (random_unit(&random) - 0.5),
                          near.y + far * (random_unit(&random) - 0.5)};
            if (i % 5 == 0) q = near;
            double least = INFINITY, reached = INFINITY;
            const uint32_t *v = first_tile(locator, index, q);
            for (uint32_t k = 0; k < tiling->point_count; k++)
                least = fmin(least, off2(tiling->point[k], q));
            for (int k = 0; k < 3; k++) reached = fmin(reached, off2(tiling->point[v[k]], q));
            assert_true(reached == least);
        }
        first_tile(locator, index, (mw_point){1e308, -1e308});
        mw_index_destroy(index);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

static bool in_cell(const mw_lattice *lattice, mw_point p, int64_t x, int64_t y)
{
    uint32_t cell = mw__lattice_cell(lattice, p);
    return cell % lattice->columns == x && cell / lattice->columns == y;
}

/* The tile of a bucket has a vertex in it; and of buckets that are empty, in one of the first ring
 * round it that has a vertex. */
static void test_spiral(void **state)
{
    (void)state;
    uint64_t random = 14;
    for (int round = 0; round < 4; round++) {
        arrays a = clusters(60, 3, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        const mw_tiling *tiling = &locator->tiling;
        mw_index *index = index_of(locator, MW_START_BUCKETS, 300);
        const mw_lattice *lattice = &index->vertex_buckets.lattice;
        for (uint32_t x = 0; x < lattice->columns; x++)
            for (uint32_t y = 0; y < lattice->rows; y++) {
                const uint32_t *v = first_tile(locator, index, mw__lattice_middle(lattice, x, y));
                int64_t least = INT64_MAX;
                for (uint32_t k = 0; k < tiling->point_count; k++) {
                    uint32_t cell = mw__lattice_cell(lattice, tiling->point[k]);
                    int64_t dx = llabs((int64_t)(cell % lattice->columns) - x);
                    int64_t dy = llabs((int64_t)(cell / lattice->columns) - y);
                    least = (dx > dy ? dx : dy) < least ? (dx > dy ? dx : dy) : least;
                }
                bool there = false;
                for (int64_t i = x - least; i <= x + least; i++)
                    for (int64_t j = y - least; j <= y + least; j++)
                        for (int k = 0; k < 3; k++)
                            there |= in_cell(lattice, tiling->point[v[k]], i, j);
                assert_true(there);
            }
        mw_index_destroy(index);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* A query tests triangles of its bucket, and begins in the one that has it; the tests are counted
 * alone and in batches. Slivers across the extent are in many buckets each: then these are fewer.
 */
static void test_triangle_buckets(void **state)
{
    (void)state;
    enum { N = 2000 };
    uint64_t random = 15;
    for (int slivers = 0; slivers < 2; slivers++) {
        arrays a = slivers ? arrays_fan(2000) : arrays_grid(40, 0.6, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_index *index = index_of(locator, MW_START_TRIANGLE_BUCKETS, 0);
        mw_index_info info;
        mw_index_describe(index, &info);
        assert_true(info.bytes < 80 * (size_t)locator->tiling.tri_count);
        double q[2 * N];
        mw_location at[N];
        for (int i = 0; i < N; i++) {
            const uint32_t *t =
                a.triangles + 3 * (size_t)mw__random_below(&random, a.triangle_count);
            for (int k = 0; k < 2; k++)
                q[2 * i + k] = 0.25 * a.points[2 * t[0] + (uint32_t)k] +
                               0.25 * a.points[2 * t[1] + (uint32_t)k] +
                               0.5 * a.points[2 * t[2] + (uint32_t)k];
        }
        mw_query_options options = {.index = index, .walk = MW_WALK_REMEMBERING, .counters = 1};
        mw_counters batch = answers(locator, &options, q, N, at);
        assert_true(batch.triangles_visited < N + N / 100);
        assert_true(batch.orient_init >= 3 * N); /* those of the triangle that has it at least */
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
        for (int i = 0; i < N; i++) mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        assert_int_equal(cursor.counters.orient_init, batch.orient_init);
        mw_index_destroy(index);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* Each allocation fails once: that is said, and nothing is left. */
static void test_memory(void **state)
{
    (void)state;
    uint64_t random = 12;
    arrays a = clusters(500, 1, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
        if (!mw_start_has_index((mw_start_kind)start)) continue;
        long failures = 0;
        for (bool failed = true; failed; failures++) {
            mw_error error = {0};
            mw_index *index;
            allocations_left = failures;
            mw_index_options options = {.corners = 1};
            mw_status status =
                mw_index_create(locator, (mw_start_kind)start, &options, &index, &error);
            failed = allocations_left < 0;
            allocations_left = -1;
            assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
            assert_int_equal(error.status, status);
            assert_true((index == NULL) == failed);
            mw_index_destroy(index);
        }
        assert_true(failures > 3);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* A grid that keeps corners takes four times the memory, and answers as any, also when it was made
 * from another mesh. */
static void test_corners(void **state)
{
    (void)state;
    uint64_t random = 31;
    for (uint32_t side = 1; side <= 21; side += 20) {
        arrays a = arrays_grid(side, 0.4, &random), b = arrays_grid(7, 0.4, &random);
        arrays_scramble(&a, 1, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0}),
                *other = arrays_mesh(&b, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0}),
                   *at_other = mesh_locator(other, (mw_locator_options){0});
        mw_index *plain = index_of(locator, MW_START_GRID, 0), *index;
        mw_index_info info[2];
        mw_error error;
        expect_ok(mw_index_create(locator, MW_START_GRID, &(mw_index_options){.corners = 1}, &index,
                                  &error),
                  "index", &error);
        mw_index_describe(plain, &info[0]);
        mw_index_describe(index, &info[1]);
        assert_int_equal(info[1].bytes - sizeof(mw_index), 4 * (info[0].bytes - sizeof(mw_index)));
        size_t n;
        double *q = arrays_queries(&a, 40, &n, &random);
        expect_guide(locator, index, q, n);
        expect_guide(at_other, index, q, n);
        mw_index_destroy(plain);
        mw_index_destroy(index);
        mw_locator_destroy(locator);
        mw_locator_destroy(at_other);
        mw_mesh_destroy(mesh);
        mw_mesh_destroy(other);
        free(q);
        arrays_free(&a);
        arrays_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grids),
        cmocka_unit_test(test_clusters),
        cmocka_unit_test(test_slivers),
        cmocka_unit_test(test_holes),
        cmocka_unit_test(test_scales),
        cmocka_unit_test(test_lattice),
        cmocka_unit_test(test_fill),
        cmocka_unit_test(test_other_mesh),
        cmocka_unit_test(test_guides_well),
        cmocka_unit_test(test_describe),
        cmocka_unit_test(test_refuses),
        cmocka_unit_test(test_auto),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_stretched),
        cmocka_unit_test(test_outside),
        cmocka_unit_test(test_crowded),
        cmocka_unit_test(test_nearest_vertex),
        cmocka_unit_test(test_spiral),
        cmocka_unit_test(test_triangle_buckets),
        cmocka_unit_test(test_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
