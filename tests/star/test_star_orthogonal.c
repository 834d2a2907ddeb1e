/* test_star_orthogonal.c - the orthogonal walk on spheres: its seam, its way, what it counts, and
 * that it ends near. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "star/star.h"
#include "support/meshes.h"
#include "support/star_shapes.h"

#define PI 3.14159265358979323846

typedef struct orthogonal_sphere {
    star_shape p;
    mw_surface *surface;
    mw_star *star;
} orthogonal_sphere;

static orthogonal_sphere make_sphere(star_shape p, double turn, int weld)
{
    orthogonal_sphere s = {.p = p};
    for (uint32_t v = 0; v < p.points; v++) {
        double *d = p.point + 3 * (size_t)v, x = d[0] * cos(turn) - d[1] * sin(turn),
               y = d[0] * sin(turn) + d[1] * cos(turn);
        d[0] = x;
        d[1] = y * cos(turn) - d[2] * sin(turn);
        d[2] = y * sin(turn) + d[2] * cos(turn);
        double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 0; k < 3; k++) d[k] /= length;
    }
    mw_arrays view = star_shape_arrays(&p);
    mw_error error;
    expect_ok(mw_surface_create(&view, &(mw_surface_options){.weld = weld}, &s.surface, &error),
              "surface", &error);
    expect_ok(mw_star_create(s.surface, &(mw_star_options){.angles = 1}, &s.star, &error), "star",
              &error);
    return s;
}

static void release_sphere(orthogonal_sphere *s)
{
    mw_star_destroy(s->star);
    mw_surface_destroy(s->surface);
    star_shape_free(&s->p);
}

/* Meridians and parallels every 180 / n degrees, each quadrangle cut in two. One vertex at each
 * pole, none twice. */
static star_shape globe(uint32_t n)
{
    star_shape p = {0};
    uint32_t north = star_shape_point(&p, 0, 0, 1), south = star_shape_point(&p, 0, 0, -1);
    for (uint32_t i = 1; i < n; i++)
        for (uint32_t j = 0; j < 2 * n; j++) {
            double d[3];
            mw_lonlat_to_direction(180.0 * j / n, 90 - 180.0 * i / n, d);
            star_shape_point(&p, d[0], d[1], d[2]);
        }
    for (uint32_t j = 0; j < 2 * n; j++) {
        uint32_t next = (j + 1) % (2 * n), low = 2 + (n - 2) * 2 * n;
        star_shape_triangle(&p, north, 2 + j, 2 + next);
        star_shape_triangle(&p, south, low + next, low + j);
        for (uint32_t i = 0; i + 2 < n; i++) {
            uint32_t a = 2 + i * 2 * n, b = a + 2 * n;
            star_shape_triangle(&p, a + j, b + j, b + next);
            star_shape_triangle(&p, a + j, b + next, a + next);
        }
    }
    return p;
}

/* --- angles and seam -------------------------------------------------------------------------- */

static void expect_angles(double x, double y, double z, double phi, double theta)
{
    double got[2];
    mw__star_angles((double[3]){x, y, z}, &got[0], &got[1]);
    if (got[0] != phi || got[1] != theta)
        fail_msg("angles of %g %g %g: %.17g %.17g", x, y, z, got[0], got[1]);
}

static void test_angles(void **state)
{
    (void)state;
    expect_angles(2, 0, 0, 0, PI / 2);
    expect_angles(0, 3, 0, PI / 2, PI / 2);
    expect_angles(-1, 0, 0, PI, PI / 2);
    expect_angles(-1, -0.0, 0, PI, PI / 2);
    expect_angles(-1e-300, -1e-300, 0, -3 * PI / 4, PI / 2);
    expect_angles(0, 0, 5, 0, 0);
    expect_angles(-0.0, -0.0, 1e-310, 0, 0);
    expect_angles(-0.0, -0.0, -1, 0, PI);
    expect_angles(1e308, 0, 1e308, 0, PI / 4);
}

/* Where facets are small, the seam is those that have longitudes more than a half turn apart; so
 * have those with a pole. */
static void expect_seam(const mw_star *star)
{
    uint32_t marked = 0;
    for (uint32_t t = 0; t < star->tri_count; t++) {
        const mw_star_facet *facet = &star->facet[t];
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < 3; k++) {
            low = fmin(low, star->angle[2 * (size_t)facet->v[k]]);
            high = fmax(high, star->angle[2 * (size_t)facet->v[k]]);
        }
        bool want = high - low > PI;
        if (((facet->user & MW_SEAM) != 0) != want)
            fail_msg("facet %u: seam %d, not %d", t, !want, want);
        marked += want;
    }
    assert_in_range(marked, 2, star->tri_count / 2);
}

static void test_seam(void **state)
{
    (void)state;
    for (int i = 0; i < 5; i++) {
        orthogonal_sphere s = make_sphere(star_shape_octahedron(4), 0.1 + i, 0);
        expect_seam(s.star);
        release_sphere(&s);
    }
}

/* The middle vertex lies south of the arc between the others, but north of their chord in the
 * plane of the angles. */
static void test_seam_of_chords(void **state)
{
    static const double angles[3][2] = {{0, 0.5}, {1, 0.4}, {2, 0.5}};
    (void)state;
    double point[9], angle[6];
    for (int v = 0; v < 3; v++) {
        point[3 * v] = sin(angles[v][1]) * cos(angles[v][0]);
        point[3 * v + 1] = sin(angles[v][1]) * sin(angles[v][0]);
        point[3 * v + 2] = cos(angles[v][1]);
    }
    mw_surface surface = {.point = point, .point_count = 3};
    for (uint32_t turned = 0; turned < 2; turned++) {
        mw_star_facet facet = {.v = {0, 1 + turned, 2 - turned}};
        mw_star star = {.surface = &surface,
                        .facet = &facet,
                        .angle = angle,
                        .tri_count = 1,
                        .facet_count = 1,
                        .point_count = 3};
        mw__star_fill_angles(&star);
        assert_int_equal(facet.user, turned ? 0 : MW_SEAM);
    }
}

/* Facets of either orientation: marked alike. An update moves the seam. */
static void test_seam_again(void **state)
{
    (void)state;
    uint64_t random = 3;
    star_shape p = star_shape_octahedron(3);
    star_shape_shuffle(&p, &random);
    orthogonal_sphere s = make_sphere(p, 0.7, 0);
    expect_seam(s.star);
    mw_surface_begin_update(s.surface);
    double *point = mw_surface_points(s.surface);
    for (uint32_t v = 0; v < p.points; v++) {
        double x = point[3 * v];
        point[3 * v] = point[3 * v + 1];
        point[3 * v + 1] = -x;
    }
    mw_error error;
    expect_ok(mw_star_update(s.star, NULL, &error), "update", &error);
    mw_surface_end_update(s.surface);
    expect_seam(s.star);
    release_sphere(&s);
}

/* --- the walk --------------------------------------------------------------------------------- */

static mw_counters run(const mw_star *star, mw_star_query_options options, const double *q,
                       size_t n, mw_location *at)
{
    mw_counters counters;
    mw_error error;
    options.counters = 1;
    expect_ok(mw_star_locate_batch(star, q, n, 3, &options, at, &counters, &error), "batch",
              &error);
    return counters;
}

/* Two comparisons a facet, a short end, and the straight walk's answers. A facet of a globe may
 * end the walk far from q: near a pole, where the facets are long. */
static void expect_walks(const mw_star *star, const double *q, size_t n, double final)
{
    mw_location *want = malloc(n * sizeof *want), *at = malloc(n * sizeof *at);
    assert_true(want && at);
    run(star, (mw_star_query_options){.walk = MW_STAR_WALK_STRAIGHT}, q, n, want);
    for (int start = MW_STAR_START_RANDOM; start <= MW_STAR_START_SORTED; start++) {
        mw_star_query_options options = {.walk = MW_STAR_WALK_ORTHOGONAL,
                                         .start = (mw_star_start_kind)start};
        mw_counters counters = run(star, options, q, n, at);
        for (size_t i = 0; i < n; i++)
            if (memcmp(&at[i], &want[i], sizeof *at) != 0)
                fail_msg("%a %a %a: facet %u, not %u", q[3 * i], q[3 * i + 1], q[3 * i + 2],
                         at[i].triangle, want[i].triangle);
        assert_int_equal(counters.comparisons, 2 * counters.triangles);
        assert_int_equal(counters.orient, 0);
        assert_int_equal(counters.handovers, 0);
        double mean = (double)counters.triangles_final / (double)n;
        if (mean > final)
            fail_msg("start %s: %.2f facets at the end", mw_star_start_name(options.start), mean);
    }
    free(want);
    free(at);
}

static void test_spheres(void **state)
{
    enum { N = 4000 };
    double *q = malloc(3 * N * sizeof *q);
    uint64_t random = 4;
    (void)state;
    assert_non_null(q);
    for (int i = 0; i < 3 * N; i++) q[i] = random_unit(&random) - 0.5;
    for (unsigned levels = 0; levels < 6; levels++) {
        orthogonal_sphere s = make_sphere(star_shape_octahedron(levels), levels / 3.0, 0);
        expect_walks(s.star, q, N, 4);
        release_sphere(&s);
    }
    free(q);
}

/* Queries on meridians and parallels of vertices, at vertices, at the poles. No end but near a
 * pole is far. */
static void test_globe(void **state)
{
    enum { N = 24 };
    (void)state;
    double *q = malloc(3 * sizeof *q * (4 * N + 1) * (2 * N + 1));
    assert_non_null(q);
    size_t n = 0;
    for (int i = 0; i <= 2 * N; i++)
        for (int j = -2 * N; j <= 2 * N; j++)
            mw_lonlat_to_direction(90.0 * j / N, 90.0 * (N - i) / N, q + 3 * n++);
    for (double turn = 0; turn < 3; turn += 1.25) {
        orthogonal_sphere s = make_sphere(globe(N), turn, 0);
        expect_walks(s.star, q, n, 5);
        release_sphere(&s);
    }
    free(q);
}

/* The final location alone depends on its walk: the forgetful one makes more tests in as many
 * facets, or nearly. Other walks have none, and know nothing of it. */
static void expect_finishes(const mw_star *star, mw_star_query_options options, const double *q,
                            size_t n)
{
    mw_location *want = malloc(n * sizeof *want), *at = malloc(n * sizeof *at);
    assert_true(want && at);
    mw_counters automatic = run(star, options, q, n, want);
    options.finish = MW_STAR_WALK_STOCHASTIC;
    mw_counters stochastic = run(star, options, q, n, at);
    assert_memory_equal(at, want, n * sizeof *at);
    assert_memory_equal(&stochastic, &automatic, sizeof automatic);
    options.finish = MW_STAR_WALK_FORGETFUL;
    mw_counters forgetful = run(star, options, q, n, at);
    assert_memory_equal(at, want, n * sizeof *at);
    bool same = memcmp(&forgetful, &stochastic, sizeof forgetful) == 0;
    assert_int_equal(same, options.walk != MW_STAR_WALK_ORTHOGONAL);
    if (!same) {
        assert_int_equal(forgetful.triangles_init, stochastic.triangles_init);
        assert_true(10 * forgetful.orient_final > 11 * stochastic.orient_final);
        assert_in_range(20 * forgetful.triangles_final, 19 * stochastic.triangles_final,
                        21 * stochastic.triangles_final);
    }
    free(want);
    free(at);
}

static void test_finishes(void **state)
{
    enum { N = 3000 };
    static double q[3 * N];
    uint64_t random = 7;
    (void)state;
    for (int i = 0; i < 3 * N; i++) q[i] = random_unit(&random) - 0.5;
    orthogonal_sphere s = make_sphere(star_shape_octahedron(5), 0.3, 0);
    for (int start = 0; start < MW_STAR_START_COUNT; start++) {
        mw_star_query_options options = {.start = (mw_star_start_kind)start};
        mw_star_index *index = NULL;
        mw_error error;
        if (mw_star_start_has_index(options.start))
            expect_ok(mw_star_index_create(s.star, options.start, NULL, &index, &error), "index",
                      &error);
        options.index = index;
        for (int walk = 0; walk < MW_STAR_WALK_COUNT; walk++) {
            options.walk = (mw_star_walk_kind)walk;
            expect_finishes(s.star, options, q, N);
        }
        mw_star_index_destroy(index);
    }
    release_sphere(&s);
}

/* A path shows the final location, too. */
static void test_finish_of_path(void **state)
{
    (void)state;
    uint64_t random = 8;
    orthogonal_sphere s = make_sphere(star_shape_octahedron(4), 0.3, 0);
    uint64_t tests[2] = {0, 0};
    for (int i = 0; i < 1000; i++)
        for (int f = 0; f < 2; f++) {
            mw_star_query_options options = {.walk = MW_STAR_WALK_ORTHOGONAL,
                                             .start = MW_STAR_START_FRONT,
                                             .finish = f ? MW_STAR_WALK_FORGETFUL
                                                         : MW_STAR_WALK_STOCHASTIC,
                                             .seed = (uint64_t)i,
                                             .counters = 1};
            mw_star_cursor cursor;
            mw_error error;
            mw_location path, single;
            double q[3];
            for (int k = 0; k < 3; k++) q[k] = random_unit(&random) - 0.5;
            expect_ok(mw_star_cursor_init(s.star, &options, &cursor, &error), "cursor", &error);
            mw_star_path(s.star, &cursor, q, NULL, 0, &path);
            tests[f] += cursor.counters.orient_final;
            single = mw_star_locate(s.star, &cursor, q);
            assert_memory_equal(&path, &single, sizeof path);
        }
    assert_true(10 * tests[1] > 11 * tests[0]);
    release_sphere(&s);
}

/* Each facet with vertices of its own. */
static void test_welded(void **state)
{
    enum { N = 1000 };
    double q[3 * N];
    uint64_t random = 5;
    (void)state;
    for (int i = 0; i < 3 * N; i++) q[i] = random_unit(&random) - 0.5;
    star_shape p = globe(12);
    star_shape_tear(&p);
    orthogonal_sphere s = make_sphere(p, 0, 1);
    expect_walks(s.star, q, N, 4);
    release_sphere(&s);
}

/* A facet as stored, by the user's number. */
static const mw_star_facet *stored(const mw_star *star, uint32_t number)
{
    uint32_t t = 0;
    while ((star->facet[t].user & MW_USER_MASK) != number) t++;
    return &star->facet[t];
}

/* As triangles of the plane, facets of the first leg lie across the parallel of the first one's
 * centroid, those of the second across the meridian of q; and a leg ends in the first facet that
 * reaches past its end. */
static void test_legs(void **state)
{
    enum { ROOM = 1000 };
    (void)state;
    uint64_t random = 6;
    orthogonal_sphere s = make_sphere(star_shape_octahedron(5), 0.4, 0);
    const double *angle = s.star->angle;
    size_t turns = 0;
    for (int i = 0; i < 2000; i++) {
        mw_star_query_options options = {.walk = MW_STAR_WALK_ORTHOGONAL,
                                         .start = MW_STAR_START_FRONT,
                                         .seed = (uint64_t)i,
                                         .counters = 1};
        mw_star_cursor cursor;
        mw_error error;
        uint32_t facet[ROOM];
        double q[3], phi, theta, height = 0, middle = 0;
        for (int k = 0; k < 3; k++) q[k] = random_unit(&random) - 0.5;
        mw__star_angles(q, &phi, &theta);
        expect_ok(mw_star_cursor_init(s.star, &options, &cursor, &error), "cursor", &error);
        size_t count = mw_star_path(s.star, &cursor, q, facet, ROOM, NULL);
        size_t walked = (size_t)cursor.counters.triangles;
        assert_true(walked >= 1 && walked <= count && count <= ROOM);
        const mw_star_facet *begun = stored(s.star, facet[0]);
        for (int k = 0; k < 3; k++) {
            middle += angle[2 * (size_t)begun->v[k]] / 3;
            height += angle[2 * (size_t)begun->v[k] + 1] / 3;
        }
        bool upright = false;
        for (size_t j = 0; j < walked; j++) {
            const mw_star_facet *here = stored(s.star, facet[j]);
            double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
            for (int k = 0; k < 3; k++)
                for (int c = 0; c < 2; c++) {
                    double a = angle[2 * (size_t)here->v[k] + (size_t)c];
                    low[c] = fmin(low[c], a);
                    high[c] = fmax(high[c], a);
                }
            bool level = low[1] - 1e-9 <= height && height <= high[1] + 1e-9,
                 plumb = low[0] <= phi && phi <= high[0];
            bool seam = here->user & MW_SEAM, last = j + 1 == walked, right = upright || level;
            if (!upright && (phi < middle ? low[0] <= phi : high[0] >= phi)) {
                upright = true;
                turns++;
            }
            bool end = seam || (upright && (theta < height ? low[1] <= theta : high[1] >= theta));
            if (!right || (upright && !plumb && !seam) || end != last)
                fail_msg("%a %a %a: facet %zu of the walk is off its way", q[0], q[1], q[2], j);
        }
    }
    assert_true(turns > 1500);
    release_sphere(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_angles),         cmocka_unit_test(test_seam),
        cmocka_unit_test(test_seam_of_chords), cmocka_unit_test(test_seam_again),
        cmocka_unit_test(test_spheres),        cmocka_unit_test(test_globe),
        cmocka_unit_test(test_welded),         cmocka_unit_test(test_legs),
        cmocka_unit_test(test_finishes),       cmocka_unit_test(test_finish_of_path),
    };
    return cmocka_run_group_tests_name("star_orthogonal", tests, NULL, NULL);
}
