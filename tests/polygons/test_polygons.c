/* Point in polygon: every answer, and every polygon said to cross itself, is held against brute
 * force in rationals. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/location_oracle.h"
#include "support/allocations.h"
#include "support/environment.h"

enum { MAX_POINTS = 3000, MAX_QUERIES = 4000, MAX_HITS = 400 };

/* --- scenes --- */

typedef struct ring_scene {
    double point[2 * MAX_POINTS], query[2 * MAX_QUERIES];
    uint32_t segment[2 * MAX_POINTS], polygon[MAX_POINTS];
    uint32_t points, segments, polygons, queries;
    uint64_t random;
} ring_scene;

static ring_scene scene; /* large: not on the stack */

static void scene_begin(uint64_t seed)
{
    scene = (ring_scene){.random = seed};
}

static double scene_unit(void)
{
    return (double)(mw__random(&scene.random) >> 11) * 0x1p-53;
}

static void scene_point(double x, double y)
{
    assert_true(scene.points < MAX_POINTS);
    scene.point[2 * scene.points] = x;
    scene.point[2 * scene.points++ + 1] = y;
}

static void scene_segment(uint32_t a, uint32_t b, uint32_t polygon)
{
    assert_true(scene.segments < MAX_POINTS);
    scene.segment[2 * scene.segments] = a;
    scene.segment[2 * scene.segments + 1] = b;
    scene.polygon[scene.segments++] = polygon;
}

/* Close the ring of the points from `first` on. */
static void scene_ring(uint32_t first, uint32_t polygon)
{
    for (uint32_t i = first; i < scene.points; i++)
        scene_segment(i, i + 1 < scene.points ? i + 1 : first, polygon);
    if (polygon >= scene.polygons) scene.polygons = polygon + 1;
}

static void scene_box(double x, double y, double width, double height, uint32_t polygon)
{
    uint32_t first = scene.points;
    scene_point(x, y);
    scene_point(x + width, y);
    scene_point(x + width, y + height);
    scene_point(x, y + height);
    scene_ring(first, polygon);
}

static void scene_query(double x, double y)
{
    if (scene.queries == MAX_QUERIES) return;
    scene.query[2 * scene.queries] = x;
    scene.query[2 * scene.queries++ + 1] = y;
}

static void scene_query_random(uint32_t count, double low, double high)
{
    for (uint32_t i = 0; i < count; i++) {
        double x = low + (high - low) * scene_unit();
        scene_query(x, low + (high - low) * scene_unit());
    }
}

/* All vertices, middles of segments, and doubles next to where segments cross. */
static void scene_query_near(void)
{
    for (uint32_t i = 0; i < scene.points; i++)
        scene_query(scene.point[2 * i], scene.point[2 * i + 1]);
    for (uint32_t i = 0; i < scene.segments; i++) {
        const double *a = scene.point + 2 * (size_t)scene.segment[2 * i];
        const double *b = scene.point + 2 * (size_t)scene.segment[2 * i + 1];
        double share = scene_unit(), x = a[0] + share * (b[0] - a[0]),
               y = a[1] + share * (b[1] - a[1]);
        scene_query(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]));
        scene_query(x, y);
        scene_query(nextafter(x, INFINITY), y);
    }
}

static void scene_query_crossings(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t s = mw__random_below(&scene.random, scene.segments);
        uint32_t t = mw__random_below(&scene.random, scene.segments);
        const double *a = scene.point + 2 * (size_t)scene.segment[2 * s];
        const double *b = scene.point + 2 * (size_t)scene.segment[2 * s + 1];
        const double *c = scene.point + 2 * (size_t)scene.segment[2 * t];
        const double *d = scene.point + 2 * (size_t)scene.segment[2 * t + 1];
        double far = mw_orient2d(c, d, b), near = mw_orient2d(c, d, a), share = near / (near - far);
        if (!(share > 0 && share < 1)) continue;
        double x = a[0] + share * (b[0] - a[0]), y = a[1] + share * (b[1] - a[1]);
        scene_query(x, y);
        scene_query(nextafter(x, -INFINITY), nextafter(y, INFINITY));
    }
}

static mw_constraints scene_rings(void)
{
    return (mw_constraints){.points = scene.point,
                            .point_count = scene.points,
                            .segments = scene.segment,
                            .segment_count = scene.segments,
                            .polygon = scene.polygon};
}

/* --- comparison --- */

static void point_compare(const mw_polygons *polygons, const mw_constraints *rings,
                          const double q[2], const mw_location *at)
{
    mw_polygon_hit hits[MAX_HITS];
    size_t count = mw_polygons_at(polygons, q, at, hits, MAX_HITS), i = 0;
    assert_true(count <= MAX_HITS);
    for (uint32_t polygon = 0; polygon < scene.polygons; polygon++) {
        polygon_side side = location_oracle_polygon(rings, polygon, q);
        bool hit = i < count && hits[i].polygon == polygon;
        if (hit != (side != POLYGON_OUTSIDE) || (hit && hits[i].border != (side == POLYGON_BORDER)))
            fail_msg("%.17g %.17g, polygon %u: %s, expected %d", q[0], q[1], polygon,
                     !hit             ? "outside"
                     : hits[i].border ? "border"
                                      : "inside",
                     (int)side);
        i += hit;
    }
    assert_int_equal(i, count);
}

static void crossing_compare(const mw_polygons *polygons, const mw_constraints *rings)
{
    uint32_t found[MAX_POINTS];
    size_t count = mw_polygons_crossing(polygons, found, MAX_POINTS), i = 0;
    for (uint32_t polygon = 0; polygon < scene.polygons; polygon++)
        if (location_oracle_crosses(rings, polygon)) {
            assert_true(i < count);
            assert_int_equal(found[i++], polygon);
        }
    assert_int_equal(i, count);
}

/* Returns how many segments stayed whole. */
static size_t scene_check(void)
{
    mw_error error;
    mw_polygons *polygons;
    mw_locator *locator;
    mw_polygons_info info;
    mw_location *at = malloc(MAX_QUERIES * sizeof *at);
    mw_constraints rings = scene_rings();
    assert_int_equal(mw_polygons_create(&rings, NULL, &polygons, &error), MW_OK);
    assert_int_equal(mw_locator_create(mw_polygons_mesh(polygons), NULL, &locator, &error), MW_OK);
    assert_int_equal(
        mw_locate_batch(locator, scene.query, scene.queries, 2, NULL, at, NULL, &error), MW_OK);
    for (uint32_t i = 0; i < scene.queries; i++)
        point_compare(polygons, &rings, scene.query + 2 * (size_t)i, &at[i]);
    crossing_compare(polygons, &rings);
    mw_polygons_describe(polygons, &info);
    free(at);
    mw_locator_destroy(locator);
    mw_polygons_destroy(polygons);
    return info.crossing_segments;
}

/* --- tests --- */

/* Random rings on a small lattice: they cross, touch, overlap, repeat, and run back on themselves.
 */
static void scene_make_lattice(uint64_t seed)
{
    enum { SIDE = 6 };
    scene_begin(seed);
    uint32_t rings = 1 + mw__random_below(&scene.random, 8),
             polygons = 1 + mw__random_below(&scene.random, 4);
    scene_point(0, 0), scene_point(SIDE, 0), scene_point(0, SIDE);
    for (uint32_t r = 0; r < rings; r++) {
        uint32_t first = scene.points, corners = 3 + mw__random_below(&scene.random, 6);
        for (uint32_t i = 0; i < corners; i++) {
            double x = mw__random_below(&scene.random, SIDE + 1);
            scene_point(x, mw__random_below(&scene.random, SIDE + 1));
        }
        scene_ring(first, mw__random_below(&scene.random, polygons));
    }
    for (uint32_t i = 0; i < 3; i++) /* lines, which bound nothing */
        scene_segment(mw__random_below(&scene.random, scene.points),
                      mw__random_below(&scene.random, scene.points), MW_NONE);
    for (int x = -1; x <= 2 * SIDE + 1; x++)
        for (int y = -1; y <= 2 * SIDE + 1; y++) scene_query(0.5 * x, 0.5 * y);
    scene_query_near();
    scene_query_crossings(20);
}

static void lattice_rings_are_exact(void **state)
{
    (void)state;
    uint64_t seed = environment_print_seed("lattice_rings_are_exact", 1);
    size_t whole = 0;
    for (int k = 0; k < (environment_is_long() ? 20000 : 120); k++) {
        scene_make_lattice(seed * 100003 + (uint64_t)k);
        whole += scene_check();
    }
    assert_true(whole > 0);
}

/* Long segments in general position that all cross: most of them stay whole. */
static void crossing_stars_are_exact(void **state)
{
    (void)state;
    uint64_t seed = environment_print_seed("crossing_stars_are_exact", 2);
    for (int k = 0; k < 12; k++) {
        double far = k % 3 == 0 ? 0 : k % 3 == 1 ? 1e6 : 0x1p40;
        scene_begin(seed + 1000 * (uint64_t)k);
        for (uint32_t polygon = 0; polygon < 4; polygon++) {
            uint32_t first = scene.points;
            for (int i = 0; i < 9; i++) {
                double x = far + scene_unit();
                scene_point(x, far + scene_unit());
            }
            scene_ring(first, polygon);
        }
        scene_query_near();
        scene_query_crossings(200);
        scene_query_random(100, far - 0.1, far + 1.1);
        assert_true(scene_check() > 0);
    }
}

/* Parcels share borders and corners: a point there belongs to all of them. Every third has a hole
 * with an island. */
static void parcels_share_borders(void **state)
{
    (void)state;
    enum { SIDE = 7 };
    scene_begin(environment_print_seed("parcels_share_borders", 3));
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        double x = i % SIDE, y = i / SIDE;
        scene_box(x, y, 1, 1, i);
        if (i % 3) continue;
        scene_box(x + 0.25, y + 0.25, 0.5, 0.5, i);
        scene_box(x + 0.375, y + 0.375, 0.25, 0.25, i);
    }
    scene_query_near();
    scene_query_random(500, -1, SIDE + 1);
    for (int x = 0; x <= 8 * SIDE; x++) scene_query(0.125 * x, 2.375);
    assert_int_equal(scene_check(), 0);
}

/* Each ring is in all those around it; numbers of polygons need not count from 0. */
static void nested_rings_are_listed(void **state)
{
    (void)state;
    enum { DEPTH = 200 };
    scene_begin(environment_print_seed("nested_rings_are_listed", 4));
    for (uint32_t i = 0; i < DEPTH; i++) scene_box(i, i, 2 * (DEPTH - i), 2 * (DEPTH - i), i);
    scene_query_near();
    scene_query_random(200, 0, 2 * DEPTH);
    scene_check();
}

/* No place at all is inside. */
static void a_ring_given_twice_encloses_nothing(void **state)
{
    (void)state;
    scene_begin(1);
    for (int i = 0; i < 2; i++) scene_box(0, 0, 2, 2, 0);
    scene_query_near();
    scene_query_random(20, -1, 3);
    scene_check();
}

/* A bow tie whose segments cross in a vertex of another polygon. */
static void a_crossing_in_a_vertex_is_noticed(void **state)
{
    (void)state;
    scene_begin(1);
    scene_box(2, -4, 1, 1, 0);
    scene_box(2, 2, 4, 1, 1);
    uint32_t first = scene.points;
    scene_point(0, 0), scene_point(4, 4), scene_point(4, 0), scene_point(0, 4);
    scene_ring(first, 2);
    scene_query_near();
    scene_query_random(50, -1, 5);
    scene_check();
    mw_constraints rings = scene_rings();
    assert_true(location_oracle_crosses(&rings, 2));
}

/* Coordinates at the ends of the doubles. */
static void extreme_coordinates_are_exact(void **state)
{
    (void)state;
    static const double scales[] = {0x1p-1074, 1e-300, 1e300};
    for (size_t k = 0; k < sizeof scales / sizeof *scales; k++) {
        scene_make_lattice(environment_print_seed("extreme_coordinates_are_exact", 5) + k);
        for (uint32_t i = 0; i < 2 * scene.points; i++) scene.point[i] *= scales[k];
        for (uint32_t i = 0; i < 2 * scene.queries; i++) scene.query[i] *= scales[k];
        scene_check();
    }
}

static void numbers_need_not_be_dense(void **state)
{
    (void)state;
    mw_error error;
    mw_polygons *polygons;
    mw_locator *locator;
    mw_cursor cursor = {0};
    mw_polygon_hit hits[2];
    scene_begin(1);
    scene_box(0, 0, 4, 4, 0);
    scene_box(1, 1, 2, 2, 0);
    for (uint32_t i = 0; i < 4; i++) scene.polygon[i] = 4000000000u, scene.polygon[4 + i] = 17;
    mw_constraints rings = scene_rings();
    assert_int_equal(mw_polygons_create(&rings, NULL, &polygons, &error), MW_OK);
    assert_int_equal(mw_locator_create(mw_polygons_mesh(polygons), NULL, &locator, &error), MW_OK);
    const double q[2] = {2, 2}, far[2] = {9, 9}, lost[2] = {NAN, 0};
    mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
    assert_int_equal(mw_polygons_at(polygons, q, &at, hits, 2), 2);
    assert_int_equal(hits[0].polygon, 17);
    assert_int_equal(hits[1].polygon, 4000000000u);
    assert_int_equal(mw_polygons_at(polygons, q, &at, NULL, 0), 2);
    hits[1].polygon = 0;
    assert_int_equal(mw_polygons_at(polygons, q, &at, hits, 1), 2);
    assert_int_equal(hits[1].polygon, 0);
    at = mw_locate(locator, &cursor, far[0], far[1]);
    assert_int_equal(mw_polygons_at(polygons, far, &at, hits, 2), 0);
    at = mw_locate(locator, &cursor, lost[0], lost[1]);
    assert_int_equal(mw_polygons_at(polygons, lost, &at, hits, 2), 0);
    mw_locator_destroy(locator);
    mw_polygons_destroy(polygons);
    mw_polygons_destroy(NULL);
}

static void expect_refused(mw_constraints rings, mw_status status, const char *message)
{
    mw_error error;
    mw_polygons *polygons = (mw_polygons *)&error;
    assert_int_equal(mw_polygons_create(&rings, NULL, &polygons, &error), status);
    assert_null(polygons);
    assert_non_null(strstr(error.message, message));
}

static void what_is_no_polygon_is_refused(void **state)
{
    (void)state;
    mw_error error;
    mw_polygons *polygons;
    scene_begin(1);
    scene_box(0, 0, 1, 1, 3);
    mw_constraints rings = scene_rings(), open = rings, none = rings, unnumbered = rings,
                   seeded = rings, flat = rings;
    open.segment_count = 3;
    expect_refused(open, MW_ERROR_INPUT, "polygon 3 is not closed");
    none.segment_count = 0;
    expect_refused(none, MW_ERROR_INPUT, "there are no polygons");
    unnumbered.polygon = NULL;
    expect_refused(unnumbered, MW_ERROR_ARGUMENT, "the polygon of each segment");
    seeded.hole_seeds = scene.point;
    seeded.hole_seed_count = 1;
    expect_refused(seeded, MW_ERROR_ARGUMENT, "seed points");
    const double line[] = {0, 0, 1, 1, 2, 2, 3, 3};
    flat.points = line;
    expect_refused(flat, MW_ERROR_INPUT, "line");
    scene.point[1] = NAN;
    expect_refused(rings, MW_ERROR_INPUT, "finite");
    assert_int_equal(mw_polygons_create(NULL, NULL, &polygons, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_polygons_create(&rings, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    mw_polygons_options options = {.reserved = {1}};
    assert_int_equal(mw_polygons_create(&rings, &options, &polygons, &error), MW_ERROR_ARGUMENT);
}

/* Every allocation fails once. */
static void failing_allocations_are_reported(void **state)
{
    (void)state;
    mw_error error;
    scene_begin(1);
    for (uint32_t i = 0; i < 6; i++) scene_box(i, 0.5 * i, 3, 2, i / 2);
    mw_constraints rings = scene_rings();
    mw_polygons_options options = {.threads = 1};
    for (long k = 0;; k++) {
        mw_polygons *polygons;
        allocations_left = k;
        mw_status status = mw_polygons_create(&rings, &options, &polygons, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
        assert_true(failed == !polygons);
        mw_polygons_destroy(polygons);
        if (!failed) break;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattice_rings_are_exact),
        cmocka_unit_test(a_crossing_in_a_vertex_is_noticed),
        cmocka_unit_test(crossing_stars_are_exact),
        cmocka_unit_test(parcels_share_borders),
        cmocka_unit_test(nested_rings_are_listed),
        cmocka_unit_test(a_ring_given_twice_encloses_nothing),
        cmocka_unit_test(extreme_coordinates_are_exact),
        cmocka_unit_test(numbers_need_not_be_dense),
        cmocka_unit_test(what_is_no_polygon_is_refused),
        cmocka_unit_test(failing_allocations_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
