/* Certain probes: what the boxes find is what all triangles, one by one, would say; on lattices,
 * soups, surfaces that move, and at the ends of the range of doubles. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/touch_oracle.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/make_prober.h"
#include "support/shapes.h"
#include "probe/prober.h"

static uint64_t new_seed(const char *name)
{
    return environment_print_seed(name, 20240611);
}

static mw_line line_of(const double query[6])
{
    return (mw_line){{query[0], query[1], query[2]}, {query[3], query[4], query[5]}, {0}};
}

/* --- brute force ------------------------------------------------------------------------------ */

/* The best triangle by the exact functions; *some is one that is touched in reach, chosen at
 * random. */
static uint32_t brute_force(const mw_surface *surface, const mw_line *line, double d,
                            uint32_t *some, uint64_t *random)
{
    uint32_t best = MW_NONE, found = 0;
    *some = MW_NONE;
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (!mw__line_touches(surface, line, t) ||
            !mw__touch_in_reach(surface, line, t, d > 0 ? d : INFINITY))
            continue;
        if (mw__random_below(random, ++found) == 0) *some = t;
        if (best == MW_NONE || mw__touch_is_better(surface, line, t, best)) best = t;
    }
    return best;
}

/* With and without a seed. Returns the answer. */
static uint32_t check(const mw_prober *prober, const mw_line *line, double d, uint64_t *random)
{
    uint32_t some, best = brute_force(prober->surface, line, d, &some, random);
    assert_int_equal(mw__probe_certain(prober, line, d, MW_NONE, NULL), best);
    if (some != MW_NONE) assert_int_equal(mw__probe_certain(prober, line, d, some, NULL), best);
    return best;
}

/* No limit, the distance of the answer exactly as rounded and its neighbours, and some length.
 * Returns whether there is one. */
static int check_reaches(const mw_prober *prober, const mw_line *line, uint64_t *random)
{
    uint32_t best = check(prober, line, 0, random);
    check(prober, line, 4 * random_unit(random), random);
    if (best == MW_NONE) return 0;
    const mw_corners c = {mw__surface_corner(prober->surface, best, 0),
                          mw__surface_corner(prober->surface, best, 1),
                          mw__surface_corner(prober->surface, best, 2)};
    double d = fabs(mw__hit_distance(line, c));
    if (!(d > 0) || isinf(d)) return 1;
    const double reach[5] = {d, nextafter(d, 0), nextafter(d, INFINITY), d * (1 - 0x1p-30),
                             d * (1 + 0x1p-30)};
    for (int i = 0; i < 5; i++)
        if (reach[i] > 0) check(prober, line, reach[i], random);
    return 1;
}

/* By rationals, which know nothing of the library. */
static void check_oracle(const mw_prober *prober, const shape *s, const double query[6], double d)
{
    mw_line line = line_of(query);
    touch_oracle o = touch_oracle_make(s, query);
    assert_int_equal(mw__probe_certain(prober, &line, d, MW_NONE, NULL), touch_oracle_best(&o, d));
    touch_oracle_free(&o);
}

/* Ask a surface n queries, the first few also of the oracle. Returns how many touch something. */
static int check_shape(const shape *s, size_t n, uint64_t *random)
{
    mw_surface *surface = shape_surface(s, (mw_surface_options){.tolerant = 1});
    mw_prober *prober = prober_with_boxes(surface);
    double *queries = shape_queries(s, n, random);
    int hits = 0;
    for (size_t i = 0; i < n; i++) {
        mw_line line = line_of(queries + 6 * i);
        if (!mw__is_finite3(line.q) || !mw__is_finite3(line.m)) continue;
        hits += check_reaches(prober, &line, random);
        if (i < n / 20) check_oracle(prober, s, queries + 6 * i, i % 2 ? 0 : 2);
    }
    free(queries);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    return hits;
}

/* --- lattices and soups ----------------------------------------------------------------------- */

static void test_lattices(void **state)
{
    (void)state;
    uint64_t random = new_seed("lattices");
    for (int round = 0; round < 3; round++) {
        shape shapes[4] = {shape_ball(6, 12, 0.3, &random), shape_torus(16, 12, 3),
                           shape_patch(12, 4, &random),
                           shape_join(shape_patch(8, 2, &random), shape_patch(8, 2, &random), 16)};
        for (int i = 0; i < 4; i++) {
            if (round % 2) shape_clash(&shapes[i], 0.3, &random);
            if (round % 3 == 1) shape_flatten(&shapes[i], 0.05, &random);
            if (round % 3 == 2) shape_shuffle(&shapes[i], &random);
            assert_true(check_shape(&shapes[i], 100, &random) > 20);
            shape_free(&shapes[i]);
        }
    }
}

static void test_soups(void **state)
{
    (void)state;
    uint64_t random = new_seed("soups");
    for (uint32_t n = 1; n < 700; n += 1 + n / 3) {
        shape s = shape_soup(3 + n / 2, n, &random);
        check_shape(&s, 60, &random);
        for (uint32_t i = 0; i < 3 * s.point_count; i++) s.points[i] += random_unit(&random);
        check_shape(&s, 60, &random);
        shape_free(&s);
    }
}

/* All triangles are there twice, and once more beyond the centre: the lowest number wins. */
static void test_ties(void **state)
{
    (void)state;
    uint64_t random = new_seed("ties");
    int twins = 0;
    for (int round = 0; round < 12; round++) {
        shape half = shape_soup(40, 60, &random), s = shape_make(80, 180);
        for (uint32_t i = 0; i < 40; i++)
            shape_point(&s, half.points[3 * i], half.points[3 * i + 1], half.points[3 * i + 2]);
        for (uint32_t i = 0; i < 40; i++)
            shape_point(&s, -half.points[3 * i], -half.points[3 * i + 1], -half.points[3 * i + 2]);
        for (uint32_t copy = 0; copy < 3; copy++)
            for (uint32_t t = 0; t < 60; t++) {
                const uint32_t *v = half.triangles + 3 * (size_t)t;
                uint32_t add = copy == 1 ? 40 : 0;
                shape_triangle(&s, v[0] + add, v[1] + add, v[2] + add);
            }
        shape_shuffle(&s, &random);
        mw_surface *surface = shape_surface(&s, (mw_surface_options){.tolerant = 1});
        mw_prober *prober = prober_with_boxes(surface);
        for (int i = 0; i < 50; i++) {
            mw_line line = {{0, 0, 0}, {1, 0, 0}, {0}};
            for (int k = 0; k < 3; k++) line.m[k] += mw__random_below(&random, 9) - 4.0;
            if (line.m[0] == 0 && line.m[1] == 0 && line.m[2] == 0) line.m[2] = 1;
            twins += check_reaches(prober, &line, &random);
        }
        mw_prober_destroy(prober);
        mw_surface_destroy(surface);
        shape_free(&half);
        shape_free(&s);
    }
    assert_true(twins > 100);
}

/* --- magnitudes ------------------------------------------------------------------------------- */

static void check_scaled(const shape *s, double scale, double shift, double m_scale,
                         uint64_t *random)
{
    enum { QUERIES = 8 };
    double *queries = shape_queries(s, QUERIES, random);
    shape copy = shape_scaled(s, scale, shift);
    mw_surface *surface = shape_surface(&copy, (mw_surface_options){.tolerant = 1});
    mw_prober *prober = prober_with_boxes(surface);
    for (size_t i = 0; i < QUERIES; i++) {
        mw_line line = line_of(queries + 6 * i);
        for (int k = 0; k < 3; k++) {
            line.q[k] = line.q[k] * scale + shift;
            line.m[k] *= k == (int)(i % 4) ? 1 : m_scale; /* also of very different components */
        }
        if (!mw__is_finite3(line.q) || !mw__is_finite3(line.m)) continue;
        if (line.m[0] == 0 && line.m[1] == 0 && line.m[2] == 0) continue;
        check_reaches(prober, &line, random);
        check(prober, &line, scale * random_unit(random), random);
    }
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&copy);
    free(queries);
}

/* Of many equal triangles the lowest is the answer. If vertices may have moved, all are looked at,
 * and the others take no exact test. */
static void test_equal_triangles(void **state)
{
    (void)state;
    enum { N = 3000 };
    static uint32_t corner[3 * N];
    static double point[9 * N];
    static const double one[9] = {0, 0, 1, 4, 0, 2, 0, 4, 3};
    for (uint32_t i = 0; i < 9 * N; i++) point[i] = one[i % 9] + (i < 9 ? 0.25 : 0);
    for (uint32_t i = 0; i < 3 * N; i++) corner[i] = i;
    mw_arrays view = {
        .points = point, .point_count = 3 * N, .triangles = corner, .triangle_count = N};
    mw_surface *surface;
    assert_int_equal(mw_surface_create(&view, NULL, &surface, NULL), MW_OK);
    mw_prober *prober = prober_with_boxes(surface);
    prober->slack = 0x1p-40;
    const mw_line down = {{1, 1, 0}, {0, 0, -1}, {0}}, edge = {{2, 0, 0}, {0, 0, -1}, {0}};
    mw_probe_counters counters = {0};
    assert_int_equal(mw__probe_certain(prober, &down, 0, MW_NONE, &counters), 1);
    assert_int_equal(mw__probe_certain(prober, &edge, 0, MW_NONE, &counters), 1);
    assert_true(counters.box_triangles >= N);
    assert_true(counters.intersections < 2 * 64);
    assert_int_equal(mw__probe_certain(prober, &down, 0, N - 1, NULL), 1);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
}

static void test_magnitudes(void **state)
{
    (void)state;
    uint64_t random = new_seed("magnitudes");
    static const double scale[] = {0x1p-1074, 0x1p-1070, 1e-300, 1e-200, 1e-20,   1,
                                   1e20,      1e38,      1e200,  1e300,  0x1p1019};
    static const double m_scale[] = {0x1p-1060, 1e-300, 1e-30, 1, 1e30, 1e300};
    shape shapes[2] = {shape_torus(12, 9, 2), shape_soup(60, 90, &random)};
    for (size_t i = 0; i < sizeof scale / sizeof *scale; i++)
        for (size_t j = 0; j < sizeof m_scale / sizeof *m_scale; j++)
            for (int k = 0; k < 2; k++) check_scaled(&shapes[k], scale[i], 0, m_scale[j], &random);
    for (double shift = 1; shift < 1e16; shift *= 1000)
        for (int k = 0; k < 2; k++) check_scaled(&shapes[k], 1, shift, 1, &random);
    for (int k = 0; k < 2; k++) shape_free(&shapes[k]);
}

/* Vertices far beyond all others, and points far from the surface. */
static void test_strays(void **state)
{
    (void)state;
    uint64_t random = new_seed("strays");
    static const double far[] = {1e6, 1e15, 1e30, 1e38, 1e50, 1e150, 1e308};
    for (size_t f = 0; f < sizeof far / sizeof *far; f++)
        for (int scaled = 0; scaled < 2; scaled++) {
            shape s = shape_torus(20, 12, 3);
            double scale = scaled ? 1e-300 : 1;
            for (uint32_t i = 0; i < 3 * s.point_count; i++) s.points[i] *= scale;
            for (int i = 0; i < 4; i++)
                s.points[mw__random_below(&random, 3 * s.point_count)] =
                    far[f] * (2 * random_unit(&random) - 1);
            mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
            mw_prober *prober = prober_with_boxes(surface);
            double *queries = shape_queries(&s, 60, &random);
            for (size_t i = 0; i < 60; i++) {
                mw_line line = line_of(queries + 6 * i);
                double away = i % 3 ? 0 : far[f] * (random_unit(&random) - 0.5);
                for (int k = 0; k < 3; k++) line.q[k] += away * line.m[k];
                if (!mw__is_finite3(line.q) || !mw__is_finite3(line.m)) continue;
                check_reaches(prober, &line, &random);
            }
            free(queries);
            mw_prober_destroy(prober);
            mw_surface_destroy(surface);
            shape_free(&s);
        }
}

/* --- surfaces that move ----------------------------------------------------------------------- */

static void move(mw_surface *surface, double by, uint64_t *random)
{
    double *points = mw_surface_points(surface);
    for (uint32_t i = 0; i < mw_surface_vertex_count(surface); i++)
        for (int k = 0; k < 3; k++)
            points[3 * (size_t)i + (size_t)k] += by * (2 * random_unit(random) - 1);
}

/* Probes from a vertex as it is now, across the surface there. */
static int check_near(const mw_prober *prober, double d, uint64_t *random)
{
    int hits = 0;
    for (int i = 0; i < 40; i++) {
        const double *at = mw__surface_point(
            prober->surface, mw__random_below(random, prober->surface->point_count));
        mw_line line = {{0}, {0}, {0}};
        for (int k = 0; k < 3; k++) {
            line.m[k] = random_unit(random) - 0.5;
            line.q[k] = at[k] + d * (random_unit(random) - 0.5);
        }
        if (mw__is_finite3(line.q)) hits += check(prober, &line, d, random) != MW_NONE;
    }
    return hits;
}

static void test_known_motion(void **state)
{
    (void)state;
    uint64_t random = new_seed("known motion");
    shape s = shape_torus(60, 40, 10);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    double step = prober->slack_limit / 8;
    assert_true(step > 0);
    int hits = 0;
    uint64_t frames = 0;
    for (; prober->fits < 4; frames++) {
        uint64_t before = prober->fits;
        mw_surface_begin_update(surface);
        move(surface, step, &random);
        mw_prober_update(prober, 1.75 * step, 2); /* more than sqrt(3) */
        mw_surface_end_update(surface);
        assert_true(prober->fits == before ? prober->slack > 0 : prober->slack == 0);
        hits += check_near(prober, step, &random);
    }
    assert_in_range(frames, 9, 30); /* fitted anew now and then, not always */
    assert_true(hits > 100);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* A flat patch rises by less than what makes the boxes be fitted: they are widened, or this is
 * missed. */
static void test_slack(void **state)
{
    (void)state;
    uint64_t random = new_seed("slack");
    shape s = shape_patch(30, 0, &random);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    double rise = prober->slack_limit / 2;
    mw_surface_begin_update(surface);
    for (uint32_t i = 0; i < s.point_count; i++)
        mw_surface_points(surface)[3 * (size_t)i + 2] += rise;
    mw_prober_update(prober, rise, 1);
    mw_surface_end_update(surface);
    assert_int_equal(prober->fits, 1);
    mw_line line = {{61.5, 58.25, rise}, {0, 0, -1}, {0}};
    assert_int_not_equal(check(prober, &line, rise / 1000, &random), MW_NONE);
    assert_int_equal(mw__probe_certain(prober, &line, 0, MW_NONE, NULL),
                     mw__probe_certain(prober, &line, 1, MW_NONE, NULL));
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* Anything may move anywhere, become NaN and finite again, edges may flip. */
static void test_unknown_motion(void **state)
{
    (void)state;
    uint64_t random = new_seed("unknown motion");
    static const double unknown[4] = {NAN, -1, INFINITY, -INFINITY};
    shape s = shape_ball(8, 20, 0.2, &random);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    for (int frame = 0; frame < 24; frame++) {
        mw_surface_begin_update(surface);
        double *points = mw_surface_points(surface);
        memcpy(points, s.points, 3 * s.point_count * sizeof *points);
        move(surface, frame, &random);
        for (int i = 0; i < frame; i++)
            points[mw__random_below(&random, 3 * s.point_count)] = i % 2 ? NAN : INFINITY;
        for (int i = 0; i < 5; i++)
            mw_surface_flip(surface, mw__random_below(&random, s.triangle_count), 0, NULL);
        mw_prober_update(prober, unknown[frame % 4], (uint32_t)frame % 3);
        mw_surface_end_update(surface);
        assert_int_equal(prober->fits, frame + 2);
        assert_true(prober->slack == 0);
        check_near(prober, 5, &random);
        check_near(prober, 0, &random);
    }
    /* an update of which the prober was not told */
    mw_surface_begin_update(surface);
    mw_surface_end_update(surface);
    mw_surface_begin_update(surface);
    mw_prober_update(prober, 0, 1);
    mw_surface_end_update(surface);
    assert_int_equal(prober->fits, 26);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

static void test_not_finite(void **state)
{
    (void)state;
    uint64_t random = new_seed("not finite");
    shape s = shape_soup(30, 100, &random);
    for (uint32_t i = 0; i < 30; i++) s.points[3 * i + i % 3] = i % 2 ? NAN : -INFINITY;
    assert_int_equal(check_shape(&s, 20, &random), 0); /* nothing is left */
    for (uint32_t i = 0; i < 12; i++) s.points[3 * i + i % 3] = i;
    check_shape(&s, 200, &random);
    shape_free(&s);
}

/* --- the prober ------------------------------------------------------------------------------- */

/* Neither the order of the file nor threads nor vectors change an answer; the boxes are the same
 * for any number of threads. */
static void test_order(void **state)
{
    (void)state;
    uint64_t random = new_seed("order");
    shape s = shape_torus(200, 100, 40);
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        if (shuffled) shape_shuffle(&s, &random);
        mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
        mw_prober *prober = prober_with_boxes(surface);
        prober->portable = shuffled;
        mw_prober_info info;
        mw_prober_describe(prober, &info);
        assert_int_equal(info.fits, 1);
        assert_true(info.fit_seconds >= 0);
        assert_true(info.box_bytes <= s.triangle_count * 80u);
        assert_int_equal(info.bytes, info.box_bytes + sizeof *prober);

        double *queries = shape_queries(&s, 60, &random);
        mw_probe_counters counters = {0};
        for (size_t i = 0; i < 60; i++) {
            mw_line line = line_of(queries + 6 * i);
            check(prober, &line, 0, &random);
            check(prober, &line, 5, &random);
            mw__probe_certain(prober, &line, 5, MW_NONE, &counters);
        }
        assert_true(counters.boxes > 60);
        assert_true(counters.box_triangles >= counters.intersections);
        /* most boxes are passed by */
        assert_true(counters.box_triangles < 60 * s.triangle_count / 100);

        mw_bvh_node *nodes = malloc(info.box_bytes);
        memcpy(nodes, prober->bvh.node, info.box_bytes);
        for (uint32_t threads = 0; threads < 5; threads++) {
            for (uint32_t i = 0; i < prober->bvh.node_count; i++)
                memset(&prober->bvh.node[i], 0, offsetof(mw_bvh_node, child));
            mw_prober_update(prober, NAN, threads);
            assert_memory_equal(prober->bvh.node, nodes, info.box_bytes);
            mw_prober *other;
            assert_int_equal(mw_prober_create(surface,
                                              &(mw_prober_options){.boxes = 1, .threads = threads},
                                              &other, NULL),
                             MW_OK);
            assert_int_equal(other->bvh.node_count, prober->bvh.node_count);
            assert_memory_equal(other->bvh.node, nodes, info.box_bytes);
            mw_prober_destroy(other);
        }
        free(nodes);
        free(queries);
        mw_prober_destroy(prober);
        mw_surface_destroy(surface);
    }
    shape_free(&s);
}

static void test_create(void **state)
{
    (void)state;
    uint64_t random = new_seed("create");
    shape s = shape_patch(4, 1, &random), empty = shape_make(1, 1);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_surface *nothing = shape_surface(&empty, (mw_surface_options){0});
    mw_prober *prober;
    mw_error error;
    assert_int_equal(mw_prober_create(NULL, NULL, &prober, &error), MW_ERROR_ARGUMENT);
    assert_null(prober);
    assert_int_equal(mw_prober_create(surface, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_prober_create(nothing, NULL, &prober, &error), MW_ERROR_INPUT);
    assert_null(prober);

    assert_int_equal(mw_prober_create(surface, NULL, &prober, &error), MW_OK);
    mw_prober_update(prober, NAN, 1);
    mw_prober_info info;
    mw_prober_describe(prober, &info);
    assert_int_equal(info.box_bytes, 0);
    assert_int_equal(info.fits, 0);
    mw_prober_destroy(prober);
    mw_prober_destroy(NULL);

    mw_status status = MW_ERROR_MEMORY;
    long failures = -1;
    for (; status; failures++) {
        allocations_left = failures + 1;
        status = mw_prober_create(surface, &(mw_prober_options){.boxes = 1}, &prober, &error);
        allocations_left = -1;
        assert_true(status == MW_OK || (status == MW_ERROR_MEMORY && !prober));
    }
    assert_int_equal(failures, 8);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    mw_surface_destroy(nothing);
    shape_free(&s);
    shape_free(&empty);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lattices),   cmocka_unit_test(test_soups),
        cmocka_unit_test(test_ties),       cmocka_unit_test(test_magnitudes),
        cmocka_unit_test(test_strays),     cmocka_unit_test(test_known_motion),
        cmocka_unit_test(test_slack),      cmocka_unit_test(test_unknown_motion),
        cmocka_unit_test(test_not_finite), cmocka_unit_test(test_order),
        cmocka_unit_test(test_create),     cmocka_unit_test(test_equal_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
