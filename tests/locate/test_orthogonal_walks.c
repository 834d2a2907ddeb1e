/* test_orthogonal_walks.c - the walks along the axes: directions, vertices on their lines, hulls
 * that they leave, what they count. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/location_oracle.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static const mw_walk_kind walks[] = {MW_WALK_ORTHOGONAL, MW_WALK_IMPROVED_ORTHOGONAL,
                                     MW_WALK_IMPROVED_ORTHOGONAL_VERTEX};
enum { WALKS = sizeof walks / sizeof *walks };

typedef struct axis_field {
    arrays a;
    mw_mesh *mesh;
    mw_locator *locator;
} axis_field;

/* A mesh whose tiles have the numbers of its triangles; takes the arrays over. */
static axis_field field_of(arrays a)
{
    axis_field f = {.a = a};
    mw_arrays view = arrays_view(&a);
    mw_error error;
    if (mw_mesh_create(&view, NULL, &f.mesh, &error)) fail_msg("mesh: %s", error.message);
    if (mw_locator_create(f.mesh, NULL, &f.locator, &error)) fail_msg("locator: %s", error.message);
    return f;
}

static void field_free(axis_field *f)
{
    mw_locator_destroy(f->locator);
    mw_mesh_destroy(f->mesh);
    arrays_free(&f->a);
}

/* The Delaunay triangulation of n points. */
static axis_field delaunay_field(const double *points, uint32_t n)
{
    mw_mesh *mesh;
    mw_error error;
    if (mw_delaunay(points, n, 2, NULL, NULL, NULL, &mesh, &error))
        fail_msg("delaunay: %s", error.message);
    uint32_t count = mw_mesh_triangle_count(mesh), t[3];
    arrays a = arrays_make(n, count);
    for (uint32_t i = 0; i < n; i++) arrays_point(&a, points[2 * i], points[2 * i + 1]);
    for (uint32_t i = 0; i < count; i++) {
        mw_mesh_triangle(mesh, i, t);
        arrays_triangle(&a, t[0], t[1], t[2]);
    }
    mw_mesh_destroy(mesh);
    return field_of(a);
}

/* One query from triangle t. */
static mw_location locate_from(const axis_field *f, mw_walk_kind walk, mw_arithmetic arithmetic,
                               uint32_t t, const double q[2], mw_counters *counters)
{
    mw_cursor cursor;
    mw_query_options options = {.start = MW_START_LAST,
                                .walk = walk,
                                .arithmetic = arithmetic,
                                .finish = MW_WALK_STOCHASTIC,
                                .seed = t,
                                .counters = 1};
    assert_int_equal(mw_cursor_init(f->locator, &options, &cursor, NULL), MW_OK);
    cursor.last = t;
    mw_location at = mw_locate(f->locator, &cursor, q[0], q[1]);
    if (counters) *counters = cursor.counters;
    return at;
}

static void compare(const mw_location *got, const location_answer *want, const double q[2],
                    mw_walk_kind walk, uint32_t t)
{
    if (got->triangle == want->triangle && got->where == want->where && got->local == want->local)
        return;
    fail_msg("%s from %u: (%.17g, %.17g): triangle %u where %d local %d, not %u %d %d",
             mw_walk_name(walk), t, q[0], q[1], got->triangle, got->where, got->local,
             want->triangle, want->where, want->local);
}

/* All walks in both arithmetics from triangle t against brute force; true if each ended its walk
 * without handing over. */
static bool agree_from(const axis_field *f, uint32_t t, const double q[2],
                       const location_answer *want)
{
    bool alone = true;
    for (int i = 0; i < WALKS; i++)
        for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
            mw_counters counters;
            mw_location at = locate_from(f, walks[i], (mw_arithmetic)arithmetic, t, q, &counters);
            compare(&at, want, q, walks[i], t);
            if (arithmetic == MW_EXACT) alone &= counters.handovers == 0;
        }
    return alone;
}

static location_answer truth(const axis_field *f, const double q[2])
{
    return location_oracle_locate(f->a.points, f->a.triangles, f->a.triangle_count, q);
}

/* From one triangle in the middle to points all round it: in its rows and columns, at its corners,
 * and between. In the middle of a mesh no walk meets the hull: then the orthogonal walk knows the
 * answer, and every orientation test it made was for a or for q. */
static void test_directions(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 40; round++) {
        axis_field f = field_of(arrays_grid(15, round % 4 ? 0.5 : 0, &random));
        const double middle[2] = {7.3, 7.6};
        uint32_t t = truth(&f, middle).triangle;
        double x[6] = {3.1, 11.7, middle[0]}, y[6] = {2.9, 11.2, middle[1]};
        for (uint32_t k = 0; k < 3; k++) {
            x[3 + k] = f.a.points[2 * f.a.triangles[3 * t + k]];
            y[3 + k] = f.a.points[2 * f.a.triangles[3 * t + k] + 1];
        }
        for (int i = 0; i < 36; i++) {
            const double q[2] = {x[i % 6], y[i / 6]};
            location_answer want = truth(&f, q);
            assert_true(agree_from(&f, t, q, &want));
            mw_counters counters;
            locate_from(&f, MW_WALK_ORTHOGONAL, MW_EXACT, t, q, &counters);
            assert_int_equal(counters.triangles_final + counters.orient_final, 0);
            assert_in_range(counters.orient, 0, 12);
        }
        field_free(&f);
    }
}

/* Vertices on every line: the points of a grid and those between, from every triangle. */
static void test_vertices_on_the_lines(void **state)
{
    (void)state;
    uint64_t random = 2;
    enum { N = 4 };
    for (int round = 0; round < 6; round++) {
        arrays a = arrays_grid(N, 0, &random);
        arrays_scramble(&a, 0, &random);
        axis_field f = field_of(a);
        for (int i = 0; i < (2 * N + 1) * (2 * N + 1); i++) {
            const double q[2] = {0.5 * (i % (2 * N + 1)), 0.5 * (double)(i / (2 * N + 1))};
            location_answer want = truth(&f, q);
            for (uint32_t t = 0; t < f.a.triangle_count; t++)
                assert_true(agree_from(&f, t, q, &want));
        }
        field_free(&f);
    }
}

/* Outside on all sides, near and far. The orthogonal walk sees it by itself where it leaves over
 * an edge that q lies beyond. */
static void test_outside(void **state)
{
    (void)state;
    uint64_t random = 3;
    axis_field f = field_of(arrays_grid(6, 0.7, &random));
    const double at[7] = {-1e300, -2, nextafter(0, -1), 3, nextafter(6, 7), 9, 1e300};
    int by_itself = 0;
    for (int i = 0; i < 49; i++) {
        const double q[2] = {at[i % 7], at[i / 7]};
        location_answer want = truth(&f, q);
        assert_true((want.triangle == MW_NONE) == (i != 24));
        for (uint32_t t = 0; t < f.a.triangle_count; t++) {
            assert_true(agree_from(&f, t, q, &want));
            mw_counters counters;
            locate_from(&f, MW_WALK_ORTHOGONAL, MW_EXACT, t, q, &counters);
            by_itself += counters.triangles_final == 0;
        }
    }
    assert_true(by_itself > 49 * (int)f.a.triangle_count * 9 / 10);
    field_free(&f);
}

/* Rectangles askew to the axes, from wide to thin as a needle, and one whose hull is a triangle:
 * most walks leave. */
static void test_askew_hulls(void **state)
{
    (void)state;
    uint64_t random = 4;
    const double widths[] = {1, 0.1, 1e-2, 1e-4, 1e-9};
    for (size_t shape = 0; shape < 4 * sizeof widths / sizeof *widths; shape++) {
        enum { N = 150 };
        double points[2 * N], angle = 0.5 + (double)(shape % 4) * 1.5707963267948966;
        for (int i = 0; i < N; i++) {
            double u = 2 * random_unit(&random) - 1,
                   v = (random_unit(&random) - 0.5) * widths[shape / 4];
            points[2 * i] = cos(angle) * u - sin(angle) * v;
            points[2 * i + 1] = sin(angle) * u + cos(angle) * v;
        }
        axis_field f = delaunay_field(points, N);
        for (int i = 0; i < 120; i++) {
            const uint32_t *corners =
                f.a.triangles + 3 * (size_t)mw__random_below(&random, f.a.triangle_count);
            const double *u = points + 2 * corners[0], *v = points + 2 * corners[i % 3];
            const double q[2] = {u[0] / 2 + v[0] / 2, u[1] / 2 + v[1] / 2};
            location_answer want = truth(&f, q);
            assert_true(agree_from(&f, mw__random_below(&random, f.a.triangle_count), q, &want));
        }
        field_free(&f);
    }
}

/* A double of nearly any magnitude. */
static double wild(uint64_t *random)
{
    double sign = mw__random(random) >> 63 ? -1 : 1;
    return sign * ldexp(1 + random_unit(random), (int)mw__random_below(random, 2000) - 1000);
}

static void test_wild_magnitudes(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int round = 0; round < 30; round++) {
        enum { N = 40 };
        double points[2 * N];
        for (int i = 0; i < 2 * N; i++) points[i] = i % 7 == 0 ? points[i / 2] : wild(&random);
        axis_field f = delaunay_field(points, N);
        for (int i = 0; i < 40; i++) {
            double q[2] = {wild(&random), wild(&random)};
            for (int k = 0; k < 2; k++)
                if (i % 3 != k) q[k] = points[2 * (uint32_t)i + (uint32_t)k];
            location_answer want = truth(&f, q);
            agree_from(&f, mw__random_below(&random, f.a.triangle_count), q, &want);
        }
        field_free(&f);
    }
}

/* In units of the smallest double, where the centroid of a triangle is rounded beside it. */
static void test_smallest_doubles(void **state)
{
    (void)state;
    uint64_t random = 8;
    arrays a = arrays_grid(5, 0, &random);
    arrays_transform(&a, 0x1p-1074, 0, 0);
    axis_field f = field_of(a);
    for (int i = 0; i < 49; i++) {
        const double q[2] = {(i % 7 - 1) * 0x1p-1074, (double)(i / 7 - 1) * 0x1p-1074};
        location_answer want = truth(&f, q);
        for (uint32_t t = 0; t < f.a.triangle_count; t++) assert_true(agree_from(&f, t, q, &want));
    }
    field_free(&f);
}

/* As published: three comparisons a triangle and about 3.5 orientation tests a query, two
 * comparisons and none. On uniform points enclosed by corners the ways are 4/3 over 0.5214 times
 * as long as straight, less a triangle a turn. */
static void test_counts(void **state)
{
    (void)state;
    uint64_t random = 6;
    enum { N = 10000, QUERIES = 20000 };
    double *points = malloc(2 * N * sizeof *points), *q = malloc(2 * QUERIES * sizeof *q);
    mw_location *at = malloc(QUERIES * sizeof *at);
    for (int i = 0; i < 2 * N; i++)
        points[i] = i < 8 ? (double)((0xb4 >> i) & 1) : random_unit(&random);
    for (int i = 0; i < 2 * QUERIES; i++) q[i] = random_unit(&random);
    axis_field f = delaunay_field(points, N);
    double triangles[WALKS + 1];
    for (int i = 0; i <= WALKS; i++) {
        mw_counters c;
        mw_query_options options = {.walk = i < WALKS ? walks[i] : MW_WALK_STRAIGHT,
                                    .start = MW_START_RANDOM,
                                    .finish = MW_WALK_STOCHASTIC,
                                    .seed = 7,
                                    .counters = 1};
        assert_int_equal(mw_locate_batch(f.locator, q, QUERIES, 2, &options, at, &c, NULL), MW_OK);
        assert_int_equal(c.handovers + c.cycles, 0);
        triangles[i] = (double)(c.triangles_init + c.triangles);
        double comparisons = (double)c.comparisons / triangles[i],
               tests = (double)c.orient / QUERIES;
        if (i == 0) {
            assert_true(fabs(comparisons - 3) < 0.05 && tests > 3 && tests < 4);
            assert_int_equal(c.triangles_final, 0);
        } else if (i < WALKS) {
            assert_true(fabs(comparisons - 2) < 0.1);
            assert_int_equal(c.triangles_init + c.orient_init + c.orient, 0);
            assert_true((double)c.triangles_final / QUERIES < 2 &&
                        (double)c.orient_final / QUERIES < 4.1);
        }
        /* Every stage counts the triangle it begins in; a few walks run again, from a corner along
         * the upper side. */
        uint64_t again =
            c.triangles_init + c.triangles + c.triangles_final - c.triangles_visited - QUERIES;
        assert_in_range(again, 0, i == 0 ? QUERIES / 500 : 0);
    }
    for (int i = 0; i < WALKS; i++)
        if (!(fabs(triangles[i] / triangles[WALKS] - 1.26) < 0.04))
            fail_msg("ratio %g", triangles[i] / triangles[WALKS]);
    free(points);
    free(q);
    free(at);
    field_free(&f);
}

/* The improved walk compares coordinates only: it goes the same way in both arithmetics, until the
 * final location. */
static void test_improved_walk_is_not_rounded(void **state)
{
    (void)state;
    uint64_t random = 7;
    arrays a = arrays_grid(12, 0, &random);
    arrays_transform(&a, 0x1p-30, 0.1, 5e6); /* flat in the end: the last digits of y are gone */
    for (uint32_t i = 0; i < a.point_count; i++) a.points[2 * i + 1] += 3 * (a.points[2 * i] - 0.1);
    mw_mesh *mesh;
    axis_field f = {.a = a};
    assert_int_equal(mw_delaunay(a.points, a.point_count, 2, NULL, NULL, NULL, &mesh, NULL), MW_OK);
    f.mesh = mesh;
    assert_int_equal(mw_locator_create(mesh, NULL, &f.locator, NULL), MW_OK);
    for (uint32_t i = 0; i < a.point_count; i++)
        for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t += 7) {
            mw_counters exact, rounded;
            locate_from(&f, MW_WALK_IMPROVED_ORTHOGONAL, MW_EXACT, t, a.points + 2 * (size_t)i,
                        &exact);
            locate_from(&f, MW_WALK_IMPROVED_ORTHOGONAL, MW_DOUBLE, t, a.points + 2 * (size_t)i,
                        &rounded);
            assert_int_equal(exact.triangles, rounded.triangles);
            assert_int_equal(exact.comparisons, rounded.comparisons);
        }
    field_free(&f);
}

/* In a turned rectangle, whose sides the horizontal leg often meets, the two ways to go on from
 * there take other ways, and both find the point. */
static void test_leaves_at_vertex(void **state)
{
    (void)state;
    uint64_t random = 9;
    enum { N = 3000, QUERIES = 4000 };
    double *points = malloc(2 * N * sizeof *points), *q = malloc(2 * QUERIES * sizeof *q);
    mw_location *at = malloc(QUERIES * sizeof *at);
    for (int i = 0; i < N; i++) {
        double u = 2 * random_unit(&random), v = random_unit(&random), c = cos(0.5235987755982988),
               s = 0.5;
        points[2 * i] = c * u - s * v;
        points[2 * i + 1] = s * u + c * v;
    }
    for (int i = 0; i < QUERIES; i++) /* the middle of some of them */
        for (int k = 0; k < 2; k++)
            q[2 * i + k] = points[2 * (i % N) + k] / 2 + points[2 * (i * 7 % N) + k] / 2;
    axis_field f = delaunay_field(points, N);
    mw_counters to_centroid, to_vertex;
    mw_query_options options = {
        .walk = MW_WALK_IMPROVED_ORTHOGONAL, .start = MW_START_RANDOM, .counters = 1};
    assert_int_equal(mw_locate_batch(f.locator, q, QUERIES, 2, &options, at, &to_centroid, NULL),
                     MW_OK);
    options.walk = MW_WALK_IMPROVED_ORTHOGONAL_VERTEX;
    assert_int_equal(mw_locate_batch(f.locator, q, QUERIES, 2, &options, at, &to_vertex, NULL),
                     MW_OK);
    assert_int_equal(to_vertex.orient + to_vertex.handovers, 0);
    assert_true(to_vertex.triangles != to_centroid.triangles);
    assert_true(to_vertex.triangles_final > 3 * QUERIES); /* long, for the legs end far from q */
    for (int i = 0; i < QUERIES; i += 40) {
        location_answer want = truth(&f, q + 2 * i);
        compare(&at[i], &want, q + 2 * i, options.walk, 0);
    }
    free(points);
    free(q);
    free(at);
    field_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_directions),
        cmocka_unit_test(test_vertices_on_the_lines),
        cmocka_unit_test(test_outside),
        cmocka_unit_test(test_askew_hulls),
        cmocka_unit_test(test_wild_magnitudes),
        cmocka_unit_test(test_smallest_doubles),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_improved_walk_is_not_rounded),
        cmocka_unit_test(test_leaves_at_vertex),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
