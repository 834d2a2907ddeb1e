/* test_line_walks.c - the cheap walks along a line, normal-straight, also begun by a turn, and
 * hybrid: what they count, where they start, and where doubles are not enough. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "base/random.h"
#include "oracle/location_oracle.h"
#include "support/meshes.h"

static const mw_walk_kind line_walks[] = {MW_WALK_NORMAL_STRAIGHT, MW_WALK_NORMAL_STRAIGHT_TURN,
                                          MW_WALK_HYBRID};
enum { WALKS = sizeof line_walks / sizeof *line_walks };

typedef struct line_field {
    mw_mesh *mesh;
    mw_locator *locator;
} line_field;

/* A mesh whose tiles have the numbers of its triangles. */
static line_field field_of(mw_mesh *mesh)
{
    return (line_field){.mesh = mesh, .locator = mesh_locator(mesh, (mw_locator_options){0})};
}

static line_field field_of_arrays(const arrays *a)
{
    return field_of(arrays_mesh(a, (mw_mesh_options){0}));
}

static void field_free(line_field *f)
{
    mw_locator_destroy(f->locator);
    mw_mesh_destroy(f->mesh);
}

/* A Delaunay mesh of n x n jittered points of the unit square. */
static line_field delaunay_field(uint32_t n, uint64_t *random)
{
    double *points = malloc(2 * sizeof(double) * n * n);
    for (uint32_t i = 0; i < n * n; i++) {
        points[2 * i] = (i % n + random_unit(random)) / n;
        points[2 * i + 1] = (i / n + random_unit(random)) / n;
    }
    mw_mesh *mesh = mesh_delaunay(points, n * n);
    free(points);
    return field_of(mesh);
}

/* One query from triangle t; its counters. */
static mw_counters count_from(const line_field *f, const mw_query_options *options, uint32_t t,
                              const double q[2], mw_location *at)
{
    mw_cursor cursor;
    assert_int_equal(mw_cursor_init(f->locator, options, &cursor, NULL), MW_OK);
    cursor.last = t;
    *at = mw_locate(f->locator, &cursor, q[0], q[1]);
    return cursor.counters;
}

/* From a tile of the middle to points of the middle, no walk meets the hull: what each tile costs
 * is known. */
static void test_tests_per_triangle(void **state)
{
    (void)state;
    uint64_t random = 1;
    line_field f = delaunay_field(50, &random);
    uint64_t triangles[MW_WALK_COUNT] = {0};
    for (int i = 0; i < 4000; i++) {
        const double from[2] = {0.2 + 0.6 * random_unit(&random), 0.2 + 0.6 * random_unit(&random)};
        const double q[2] = {0.2 + 0.6 * random_unit(&random), 0.2 + 0.6 * random_unit(&random)};
        mw_query_options options = {
            .start = MW_START_LAST, .walk = MW_WALK_STRAIGHT, .counters = 1};
        mw_location first, at;
        count_from(&f, &options, 0, from, &first);
        mw_counters straight = count_from(&f, &options, first.triangle, q, &at);

        options.walk = MW_WALK_NORMAL_STRAIGHT;
        mw_counters normal = count_from(&f, &options, first.triangle, q, &at);
        uint64_t n = normal.triangles;
        assert_int_equal(normal.implicit, n == 1 ? 3 : 2 * n);
        assert_int_equal(
            normal.comparisons + normal.orient_init + normal.orient + normal.triangles_init, 0);
        assert_int_equal(normal.triangles_visited, n + normal.triangles_final - 1);
        assert_true(normal.orient_final >= 3);

        options.walk = MW_WALK_NORMAL_STRAIGHT_TURN;
        mw_counters turn = count_from(&f, &options, first.triangle, q, &at);
        assert_int_equal(turn.triangles_init, straight.triangles_init);
        assert_int_equal(turn.orient_init, straight.orient_init);
        assert_int_equal(turn.implicit, turn.triangles > 1 ? 2 * turn.triangles : 3);
        assert_int_equal(turn.comparisons + turn.orient, 0);
        assert_int_equal(turn.triangles_visited,
                         turn.triangles_init + turn.triangles + turn.triangles_final - 2);
        assert_int_equal(turn.handovers, 0);
        triangles[MW_WALK_NORMAL_STRAIGHT_TURN] += turn.triangles_init + turn.triangles - 1;

        options.walk = MW_WALK_HYBRID;
        mw_counters hybrid = count_from(&f, &options, first.triangle, q, &at);
        uint64_t turned = hybrid.triangles_init, followed = hybrid.triangles;
        uint64_t walk = followed > 1 ? 2 * followed - 2 : 1;
        assert_int_equal(turned, straight.triangles_init);
        /* the first tile has one or two */
        assert_in_range(hybrid.comparisons, turned + walk, turned + walk + 1);
        assert_int_equal(hybrid.implicit + hybrid.orient_init + hybrid.orient, 0);
        assert_int_equal(hybrid.triangles_visited, turned + followed + hybrid.triangles_final - 2);
        assert_int_equal(straight.handovers + normal.handovers + hybrid.handovers, 0);

        triangles[MW_WALK_STRAIGHT] += straight.triangles_visited;
        triangles[MW_WALK_NORMAL_STRAIGHT] += normal.triangles;
        triangles[MW_WALK_HYBRID] += turned + followed - 1;
    }
    for (int i = 0; i < WALKS; i++) {
        double ratio = (double)triangles[line_walks[i]] / (double)triangles[MW_WALK_STRAIGHT];
        if (!(fabs(ratio - 1) < 0.03)) fail_msg("%s: %g", mw_walk_name(line_walks[i]), ratio);
    }
    field_free(&f);
}

/* q lies behind the long edge of a flat first triangle, whose blunt corner is the vertex nearest
 * to q. */
static void test_flat_first_triangle(void **state)
{
    (void)state;
    const double p[5][2] = {{-10, 0}, {10, 0}, {0, 1}, {0, -20}, {0, 50}};
    const uint32_t rest[3][3] = {{1, 0, 3}, {2, 1, 4}, {0, 2, 4}};
    for (uint32_t turn = 0; turn < 4; turn++)
        for (uint32_t first = 0; first < 3; first++) {
            const double c = turn == 0   ? 1
                             : turn == 2 ? -1
                                         : 0,
                         s = turn == 1   ? 1
                             : turn == 3 ? -1
                                         : 0;
            arrays a = arrays_make(5, 4);
            for (int i = 0; i < 5; i++)
                arrays_point(&a, c * p[i][0] - s * p[i][1], s * p[i][0] + c * p[i][1]);
            arrays_triangle(&a, first, (first + 1) % 3, (first + 2) % 3);
            for (int i = 0; i < 3; i++) arrays_triangle(&a, rest[i][0], rest[i][1], rest[i][2]);
            line_field f = field_of_arrays(&a);
            const double q[2] = {3 * s + 0.5 * c, -3 * c + 0.5 * s};
            mw_query_options options = {
                .start = MW_START_LAST, .walk = MW_WALK_NORMAL_STRAIGHT, .counters = 1};
            mw_location at;
            mw_counters counters = count_from(&f, &options, 0, q, &at);
            assert_int_equal(at.triangle, 1);
            assert_int_equal(counters.triangles_visited, 2);
            assert_int_equal(counters.triangles, 2);
            assert_int_equal(counters.implicit, 4);
            field_free(&f);
            arrays_free(&a);
        }
}

/* q lies in a lone flat triangle, where the line leaves the hull behind it: that does not make q
 * lie outside. */
static void test_hull_behind(void **state)
{
    (void)state;
    arrays a = arrays_make(3, 1);
    arrays_point(&a, -10, 0);
    arrays_point(&a, 10, 0);
    arrays_point(&a, 0, 1);
    arrays_triangle(&a, 0, 1, 2);
    line_field f = field_of_arrays(&a);
    for (int walk = 0; walk < WALKS; walk++)
        for (int i = -9; i < 10; i++) {
            const double q[2] = {i, 0.0625};
            mw_query_options options = {.start = MW_START_LAST, .walk = line_walks[walk]};
            mw_location at;
            count_from(&f, &options, 0, q, &at);
            assert_int_equal(at.where, MW_INSIDE);
        }
    field_free(&f);
    arrays_free(&a);
}

/* q is where the line would begin: there is none, and nothing to compare. */
static void test_no_line(void **state)
{
    (void)state;
    arrays a = arrays_make(4, 2);
    arrays_point(&a, -4, 0);
    arrays_point(&a, 4, 0);
    arrays_point(&a, 0, 1);
    arrays_point(&a, 0, -9);
    arrays_triangle(&a, 0, 1, 2);
    arrays_triangle(&a, 1, 0, 3);
    line_field f = field_of_arrays(&a);
    const double middle[2] = {0, 0};
    mw_query_options options = {
        .start = MW_START_LAST, .walk = MW_WALK_NORMAL_STRAIGHT, .counters = 1};
    mw_location at;
    mw_counters counters = count_from(&f, &options, 0, middle, &at);
    assert_int_equal(at.where, MW_ON_EDGE);
    assert_int_equal(counters.implicit, 0);
    assert_int_equal(counters.triangles, 1);
    assert_int_equal(counters.triangles_visited, 1);
    options.walk = MW_WALK_HYBRID;
    counters = count_from(&f, &options, 0, a.points, &at);
    assert_int_equal(at.where, MW_ON_VERTEX);
    assert_int_equal(counters.comparisons, 0);
    assert_int_equal(counters.triangles_init, 1);
    assert_int_equal(counters.triangles, 0);
    assert_int_equal(counters.triangles_visited, 1);
    field_free(&f);
    arrays_free(&a);
}

/* A vertex that is too far from q for doubles, across a line along an axis: whether it is past the
 * normal is not a number. The walk takes that for yes and stops, where the exact walk goes on. */
static void test_past_any_number(void **state)
{
    (void)state;
    arrays a = arrays_make(5, 4);
    uint32_t s = arrays_point(&a, 1, -8.5), l = arrays_point(&a, 0, -7),
             r = arrays_point(&a, 0, -9);
    uint32_t far = arrays_point(&a, 1, 15), end = arrays_point(&a, 15, -8);
    arrays_triangle(&a, s, l, r);
    arrays_triangle(&a, l, s, far);
    arrays_triangle(&a, s, end, far);
    arrays_triangle(&a, r, end, s);
    const double unit = 0x1p1020, q[2] = {2 * unit, -8 * unit};
    arrays_transform(&a, unit, 0, 0);
    line_field f = field_of_arrays(&a);
    mw_query_options options = {
        .start = MW_START_LAST, .walk = MW_WALK_NORMAL_STRAIGHT, .counters = 1};
    mw_location at;
    mw_counters counters = count_from(&f, &options, 0, q, &at);
    assert_int_equal(at.triangle, 2);
    assert_int_equal(counters.triangles, 2);
    assert_int_equal(counters.triangles_visited, 3);
    field_free(&f);
    arrays_free(&a);
}

/* All queries from all tiles, both arithmetics, against the oracle; none runs out of steps. */
static void from_everywhere(const arrays *a, const double *q, size_t n)
{
    line_field f = field_of_arrays(a);
    for (size_t i = 0; i < n; i++) {
        location_answer want =
            location_oracle_locate(a->points, a->triangles, a->triangle_count, q + 2 * i);
        for (int walk = 0; walk < WALKS; walk++)
            for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
                mw_query_options options = {.walk = line_walks[walk],
                                            .start = MW_START_LAST,
                                            .arithmetic = (mw_arithmetic)arithmetic,
                                            .finish = MW_WALK_STOCHASTIC,
                                            .counters = 1};
                for (uint32_t t = 0; t < a->triangle_count; t++) {
                    mw_location at;
                    mw_counters counters = count_from(&f, &options, t, q + 2 * i, &at);
                    if (at.triangle != want.triangle || at.where != want.where ||
                        at.local != want.local)
                        fail_msg("%s: (%.17g, %.17g) from %u: triangle %u where %d, not %u %d",
                                 mw_walk_name(line_walks[walk]), q[2 * i], q[2 * i + 1], t,
                                 at.triangle, at.where, want.triangle, want.where);
                    assert_int_equal(counters.cycles, 0);
                    if (arithmetic == MW_EXACT) assert_int_equal(counters.handovers, 0);
                }
            }
    }
    field_free(&f);
}

/* A grid on integers: queries at vertices, on edges, on lines along edges and through vertices, on
 * the hull and outside it; each vertex of the hull is a p. Moved away, where the grid is a few
 * roundings wide. */
static void test_on_lines(void **state)
{
    (void)state;
    enum { N = 4, SIDE = 2 * N + 5 };
    const double to[][2] = {{0, 0}, {5e6, -5e6}, {1e15, 1e15}, {-1e15, 3}};
    for (size_t k = 0; k < sizeof to / sizeof *to; k++)
        for (uint64_t random = 1; random < 4; random++) {
            uint64_t state_of = random;
            arrays a = arrays_grid(N, 0, &state_of);
            arrays_transform(&a, 1, to[k][0], to[k][1]);
            double q[2 * SIDE * SIDE];
            for (int i = 0; i < SIDE * SIDE; i++) {
                q[2 * i] = (i % SIDE) / 2.0 - 1 + to[k][0];
                q[2 * i + 1] = (i / SIDE) / 2.0 - 1 + to[k][1];
            }
            from_everywhere(&a, q, SIDE * SIDE);
            arrays_free(&a);
        }
}

/* Vertices that are jittered in units of the last place, 0.125 here, where the middle of an edge
 * is off it when rounded. */
static void test_a_few_roundings_wide(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int round = 0; round < 40; round++) {
        arrays a = arrays_grid(4, 0, &random);
        for (uint32_t v = 0; v < a.point_count; v++)
            for (uint32_t c = 0; c < 2; c++) {
                double *x = &a.points[2 * v + c];
                *x =
                    0.5 * *x + (*x > 0 && *x < 4 ? 0.125 * mw__random_below(&random, 2) : 0) + 1e15;
            }
        size_t n;
        double *q = arrays_queries(&a, 2, &n, &random);
        from_everywhere(&a, q, n);
        free(q);
        arrays_free(&a);
    }
}

static double wild(uint64_t *random)
{
    double magnitude = pow(10, 600 * random_unit(random) - 300);
    return mw__random(random) >> 63 ? magnitude : -magnitude;
}

/* Directions, products and squares over- and underflow: that costs steps only. */
static void test_wild_magnitudes(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int round = 0; round < 12; round++) {
        enum { N = 24, QUERIES = 12 };
        double points[2 * N], q[2 * QUERIES];
        for (int i = 0; i < 2 * N; i++) points[i] = wild(&random);
        for (int i = 0; i < 8; i++)
            points[i] =
                (i == 0 || i == 1 || i == 3 || i == 4 ? -1 : 1) * (round % 2 ? 1e308 : 1e300);
        for (int i = 0; i < 2 * QUERIES; i++) q[i] = i % 4 == 3 ? 0 : wild(&random);
        mw_mesh *mesh = mesh_delaunay(points, N);
        arrays a = arrays_of_mesh(mesh);
        mw_mesh_destroy(mesh);
        from_everywhere(&a, q, QUERIES);
        arrays_free(&a);
    }
}

/* A mesh of any size is walked in like that of size 1: the walks do not give up where squares
 * over- or underflow. */
static void test_any_scale(void **state)
{
    (void)state;
    uint64_t random = 8;
    enum { N = 100 };
    double q[2 * N];
    for (int i = 0; i < 2 * N; i++) q[i] = 14 * random_unit(&random) - 1;
    for (int walk = 0; walk < WALKS; walk++) {
        mw_query_options options = {.walk = line_walks[walk],
                                    .start = MW_START_RANDOM,
                                    .finish = MW_WALK_STOCHASTIC,
                                    .counters = 1};
        mw_counters want = {0};
        for (int k = 0; k < 6; k++) {
            const int exponent = (int[]){0, 300, 900, -300, -900, -1040}[k];
            uint64_t same = 7;
            arrays scaled = arrays_grid(12, 0.4, &same);
            mw_counters got;
            mw_location at[N];
            double to[2 * N];
            arrays_transform(&scaled, ldexp(1, exponent), 0, 0);
            for (int i = 0; i < 2 * N; i++) to[i] = ldexp(q[i], exponent);
            line_field f = field_of_arrays(&scaled);
            assert_int_equal(mw_locate_batch(f.locator, to, N, 2, &options, at, &got, NULL), MW_OK);
            if (k == 0) want = got;
            /* rounding may choose another start */
            double ratio = (double)got.triangles / (double)want.triangles;
            assert_true(fabs(ratio - 1) < 0.05);
            assert_in_range(got.triangles_final, 0, want.triangles_final + 5);
            field_free(&f);
            arrays_free(&scaled);
        }
    }
}

/* On a Delaunay mesh of spread points neither walk ever runs out of steps, whatever finishes it. */
static void test_no_handovers(void **state)
{
    (void)state;
    uint64_t random = 5;
    line_field f = delaunay_field(60, &random);
    enum { N = 20000 };
    double *q = malloc(2 * N * sizeof *q);
    for (int i = 0; i < 2 * N; i++) q[i] = 1.2 * random_unit(&random) - 0.1;
    mw_location *want = malloc(N * sizeof *want), *got = malloc(N * sizeof *got);
    mw_query_options options = {.walk = MW_WALK_STRAIGHT, .start = MW_START_RANDOM, .counters = 1};
    assert_int_equal(mw_locate_batch(f.locator, q, N, 2, &options, want, NULL, NULL), MW_OK);
    const mw_walk_kind finishes[2] = {MW_WALK_REMEMBERING, MW_WALK_STOCHASTIC};
    for (int i = 0; i < 2 * WALKS; i++) {
        mw_counters counters;
        options.walk = line_walks[i / 2];
        options.finish = finishes[i % 2];
        assert_int_equal(mw_locate_batch(f.locator, q, N, 2, &options, got, &counters, NULL),
                         MW_OK);
        assert_int_equal(counters.handovers + counters.cycles, 0);
        for (int j = 0; j < N; j++)
            assert_true(got[j].triangle == want[j].triangle && got[j].where == want[j].where &&
                        got[j].local == want[j].local);
    }
    free(q);
    free(want);
    free(got);
    field_free(&f);
}

/* On a mesh that traps walks every query ends, with the right answer. */
static void test_trap_ends(void **state)
{
    (void)state;
    uint64_t random = 6;
    arrays a = arrays_trap();
    size_t n;
    double *q = arrays_queries(&a, 25, &n, &random);
    location_answer *want = malloc(n * sizeof *want);
    mw_location *at = malloc(n * sizeof *at);
    for (size_t i = 0; i < n; i++)
        want[i] = location_oracle_locate(a.points, a.triangles, a.triangle_count, q + 2 * i);
    line_field f = field_of_arrays(&a);
    for (int walk = 0; walk < WALKS; walk++)
        for (uint64_t seed = 0; seed < 20; seed++) {
            mw_query_options options = {.walk = line_walks[walk],
                                        .start = MW_START_RANDOM,
                                        .arithmetic = (mw_arithmetic)(seed % 2),
                                        .finish =
                                            seed % 3 ? MW_WALK_REMEMBERING : MW_WALK_STOCHASTIC,
                                        .seed = seed};
            assert_int_equal(mw_locate_batch(f.locator, q, n, 2, &options, at, NULL, NULL), MW_OK);
            for (size_t i = 0; i < n; i++) {
                /* the oracle knows no holes */
                int where = at[i].where == MW_IN_HOLE ? MW_OUTSIDE : at[i].where;
                assert_true(at[i].triangle == want[i].triangle && where == want[i].where &&
                            at[i].local == want[i].local);
            }
        }
    field_free(&f);
    free(q);
    free(want);
    free(at);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tests_per_triangle), cmocka_unit_test(test_flat_first_triangle),
        cmocka_unit_test(test_hull_behind),        cmocka_unit_test(test_no_line),
        cmocka_unit_test(test_on_lines),           cmocka_unit_test(test_a_few_roundings_wide),
        cmocka_unit_test(test_wild_magnitudes),    cmocka_unit_test(test_no_handovers),
        cmocka_unit_test(test_any_scale),          cmocka_unit_test(test_trap_ends),
        cmocka_unit_test(test_past_any_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
