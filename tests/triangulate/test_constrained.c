/* Constrained triangulations: every result is taken apart exactly. Its segments are chains of
 * edges, its other edges are locally Delaunay, it fills the hull once, and what is kept of it is
 * what brute force keeps. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/constrained/constrained_oracle.h"
#include "support/allocations.h"

/* Points of a small grid, on lines and circles, some at one place, with any segments that do not
 * cross. */
static void test_grids(void **state)
{
    (void)state;
    uint64_t seed = 11;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int round = 0; round < 700; round++) {
        constrained_scene *s = scene_new(seed + (uint64_t)round);
        static const double scales[] = {1, 1, 1e-3, 0x1p-1000, 1e-300, 0x1p1000, 1e300};
        double scale = scales[round % 7], offset = round % 7 == 1 ? 1e6 : 0;
        uint32_t grid = 3 + (uint32_t)scene_below(s, 9), n = 5 + (uint32_t)scene_below(s, 60);
        scene_add_point(s, offset, offset);
        scene_add_point(s, offset + scale * grid, offset);
        scene_add_point(s, offset, offset + scale * grid);
        for (uint32_t i = 0; i < n; i++)
            scene_add_point(s, offset + scale * scene_below(s, grid),
                            offset + scale * scene_below(s, grid));
        scene_add_random_segments(s, (uint32_t)scene_below(s, 4 * n));
        if (round % 3 == 0)
            scene_add_hole(s, offset + scale * scene_below(s, grid),
                           offset + scale * scene_below(s, grid));
        if (round % 3 == 1)
            scene_add_hole(s, offset + scale * grid * scene_uniform(s),
                           offset + scale * grid * scene_uniform(s));
        constrained_check(s);
    }
}

static void test_uniform(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 8; round++) {
        constrained_scene *s = scene_new(100 + round);
        double offset = round % 2 ? 1e6 : 0;
        for (int i = 0; i < 300; i++)
            scene_add_point(s, offset + scene_uniform(s), offset + scene_uniform(s));
        scene_add_random_segments(s, 600);
        constrained_check(s);
    }
}

/* Long segments through many points, and many that all lie along one line. */
static void test_long(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(3);
    uint32_t west = scene_add_point(s, -1, 0.5), east = scene_add_point(s, 2, 0.5 + 1e-9),
             low = scene_add_point(s, -1, -2);
    uint32_t high = scene_add_point(s, 2, 3);
    for (int i = 0; i < 2000; i++) scene_add_point(s, scene_uniform(s), scene_uniform(s));
    scene_add_segment(s, west, east, MW_NONE);
    scene_add_segment(s, low, east, MW_NONE);
    scene_add_segment(s, west, high, MW_NONE);
    constrained_check(s);
    s = scene_new(4);
    for (int i = 0; i < 40; i++) scene_add_point(s, i, i % 2);
    for (uint32_t i = 0; i < 38; i += 2)
        for (uint32_t j = i + 2; j < 40; j += 2) scene_add_segment(s, j, i, MW_NONE);
    constrained_check(s);
}

/* Fans of slivers: triangulations with vertices of a high degree, rims that run back along
 * themselves. */
static void test_fans(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(5);
    uint32_t left = scene_add_point(s, -1000, 0), right = scene_add_point(s, 1000, 0.5);
    for (int i = 0; i < 300; i++)
        scene_add_point(s, scene_uniform(s) - 0.5, i - 150 + scene_uniform(s) / 2);
    scene_add_segment(s, left, right, MW_NONE);
    for (uint32_t i = 2; i < 60; i++)
        if (!scene_crosses_any(s, left, i * 5)) scene_add_segment(s, left, i * 5, MW_NONE);
    for (uint32_t i = 2; i < 60; i++)
        if (!scene_crosses_any(s, right, i * 5 + 1))
            scene_add_segment(s, right, i * 5 + 1, MW_NONE);
    constrained_check(s);
}

static void test_polygons(void **state)
{
    (void)state;
    /* islands in holes, and a line in the hole; points everywhere */
    constrained_scene *s = scene_new(6);
    scene_add_box(s, 0, 0, 90, 90, 7);
    scene_add_box(s, 10, 10, 80, 80, 7);
    scene_add_box(s, 20, 20, 70, 70, 7);
    scene_add_box(s, 30, 30, 60, 60, 7);
    scene_add_line(s, 12, 15, 17, 75);
    for (int i = 0; i < 400; i++)
        scene_add_point(s, scene_below(s, 300) - 100, scene_below(s, 300) - 100);
    constrained_check(s);
    /* one inside another: their union; a box that shares a corner and a border; one given twice */
    s = scene_new(6);
    scene_add_box(s, 0, 0, 90, 90, 4000000000u);
    scene_add_box(s, 10, 10, 20, 20, 5);
    scene_add_box(s, 90, 90, 100, 100, 1);
    scene_add_box(s, 90, 30, 120, 60, 0);
    scene_add_box(s, 200, 200, 210, 210, 9);
    scene_add_box(s, 200, 200, 210, 210, 9);
    constrained_check(s);
}

/* Parcels: each shares its borders with its neighbours; some are left out, some drawn the other
 * way round. */
static void test_parcels(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 20; round++) {
        constrained_scene *s = scene_new(60 + round);
        enum { SIDE = 9 };
        for (int i = 0; i < SIDE * SIDE; i++)
            scene_add_point(s, i % SIDE + (round % 2 ? scene_uniform(s) / 3 : 0),
                            i / SIDE + (round % 2 ? scene_uniform(s) / 3 : 0));
        for (uint32_t i = 0; i < (SIDE - 1) * (SIDE - 1); i++) {
            uint32_t a = i / (SIDE - 1) * SIDE + i % (SIDE - 1),
                     ring[5] = {a, a + 1, a + 1 + SIDE, a + SIDE, a};
            if (scene_below(s, 4) == 0) continue;
            bool back = scene_below(s, 2) > 0;
            for (uint32_t k = 0; k < 4; k++)
                scene_add_segment(s, ring[back ? k + 1 : k], ring[back ? k : k + 1], i);
        }
        for (int i = 0; i < 100; i++)
            scene_add_point(s, SIDE * scene_uniform(s), SIDE * scene_uniform(s));
        constrained_check(s);
        scene_add_hole(s, SIDE * scene_uniform(s), SIDE * scene_uniform(s));
        scene_add_hole(s, s->point[0], s->point[1]);
        constrained_check(s);
    }
}

/* Rings that touch themselves and others in vertices, at a vertex inside an edge too. */
static void test_touching(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(8);
    /* a bow tie that meets in the middle */
    scene_add_ring(s, 6, (double[]){0, 0, 4, 4, 8, 0, 8, 8, 4, 4, 0, 8}, 0);
    constrained_check(s);
    s = scene_new(8);
    scene_add_box(s, 0, 0, 12, 12, 0);
    scene_add_ring(s, 3, (double[]){0, 6, 4, 4, 4, 8},
                   0); /* a hole touches the outline inside an edge */
    scene_add_ring(s, 3, (double[]){4, 4, 8, 2, 8, 4},
                   0); /* and another hole in a vertex              */
    scene_add_ring(s, 4, (double[]){6, 8, 10, 8, 10, 10, 6, 10}, 0);
    /* the hole of one is another polygon */
    scene_add_ring(s, 4, (double[]){6, 8, 10, 8, 10, 10, 6, 10}, 1);
    constrained_check(s);
}

/* Without polygons: what no segment parts from the outside goes, what holes reach too, and lines
 * that end anywhere part nothing. */
static void test_flood(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 6; round++) {
        constrained_scene *s = scene_new(80 + round);
        scene_add_box(s, 0, 0, 90, 90, MW_NONE);
        scene_add_box(s, 10, 10, 40, 40, MW_NONE);
        scene_add_box(s, 50, 50, 80, 80, MW_NONE);
        scene_add_line(s, 45, 5, 45, 85);
        for (int i = 0; i < 50; i++)
            scene_add_point(s, scene_below(s, 150) - 30, scene_below(s, 150) - 30);
        if (round & 1) scene_add_hole(s, 20, 20);
        if (round & 2) scene_add_hole(s, 1000, 5); /* outside: nothing */
        if (round & 4) scene_add_hole(s, 50, 60);  /* on a constraint: both sides of it */
        constrained_check(s);
    }
}

/* Of the triangles whose middle is not near a segment, those inside polygons are kept. */
static void assert_far_kept(const constrained_scene *s, const constrained_result *hull,
                            const constrained_result *r, double near)
{
    for (uint32_t t = 0; t < hull->count; t++) {
        mw_point q;
        if (!constrained_middle_of(hull, t, &q)) continue;
        bool far = true;
        for (uint32_t i = 0; i < s->segments; i++)
            far &= points_distance(scene_point(s, s->segment[2 * i]),
                                   scene_point(s, s->segment[2 * i + 1]), q) >= near;
        if (far)
            assert_int_equal(constrained_has_triangle(r, hull->tri[t]), scene_inside_any(s, q));
    }
}

/* Random triangles on a grid as polygons, that cross, overlap, coincide: split. Coordinates are
 * rounded, so brute force is asked only away from borders. */
static void test_union(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 60; round++) {
        constrained_scene *s = scene_new(200 + round);
        for (uint32_t i = 0; i < 12; i++) {
            double xy[6];
            for (int k = 0; k < 6; k++) xy[k] = scene_below(s, 40);
            scene_add_ring(s, 3, xy, i / 2);
        }
        constrained_result hull = constrained_run(s, MW_KEEP_HULL, 1),
                           r = constrained_run(s, MW_KEEP_INSIDE, 1);
        constrained_assert_sound(s, &hull);
        constrained_assert_sound(s, &r);
        assert_far_kept(s, &hull, &r, 1e-9);
        constrained_release(&hull);
        constrained_release(&r);
    }
}

static void test_crossing_is_told(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(0);
    scene_add_point(s, 5, 5);
    scene_add_line(s, 0, 0, 10, 9);
    scene_add_line(s, 0, 10, 10, 0);
    scene_add_segment(s, 0, 3, MW_NONE);
    constrained_result r = constrained_run(s, MW_KEEP_HULL, 0);
    assert_int_equal(r.status, MW_ERROR_INPUT);
    assert_int_equal(r.report.crossing_segments[0], 0);
    assert_int_equal(r.report.crossing_segments[1], 1);
    assert_string_equal(r.error.message, "segments 0 (from point 1 to 2) and 1 (from point 3 to 4) "
                                         "cross near 5.26315789 4.73684211");
    constrained_release(&r);
    assert_int_equal(constrained_check_split(s, 1e-12), 1);
}

/* In general position there is one new point for each pair that crosses. */
static void test_split_counts(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 40; round++) {
        constrained_scene *s = scene_new(300 + round);
        double offset = round % 2 ? 1e6 : 0;
        uint32_t n = 5 + (uint32_t)scene_below(s, 30), crossings = 0;
        for (uint32_t i = 0; i < n; i++) {
            uint32_t a = scene_add_point(s, offset + scene_uniform(s), offset + scene_uniform(s));
            uint32_t b = scene_add_point(s, offset + scene_uniform(s), offset + scene_uniform(s));
            for (uint32_t k = 0; k < s->segments; k++)
                crossings += points_cross(scene_point(s, a), scene_point(s, b),
                                          scene_point(s, s->segment[2 * k]),
                                          scene_point(s, s->segment[2 * k + 1]));
            scene_add_segment(s, a, b, MW_NONE);
        }
        for (int i = 0; i < 50; i++)
            scene_add_point(s, offset + scene_uniform(s), offset + scene_uniform(s));
        size_t added = constrained_check_split(s, offset > 0 ? 1e-8 : 1e-14);
        if (offset == 0) assert_int_equal(added, crossings);
    }
}

/* All cross one long segment; all cross in one place; a grid of lines. */
static void test_split_many(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(9);
    scene_add_line(s, -1, 0, 101, 0.3);
    for (int i = 0; i < 100; i++)
        scene_add_line(s, i + scene_uniform(s), -1, i + scene_uniform(s), 1);
    constrained_check_split(s, 1e-12);
    s = scene_new(9);
    for (int i = 0; i < 20; i++) {
        double angle = 0.157 * i + 0.05;
        scene_add_line(s, cos(angle), sin(angle), -cos(angle), -sin(angle));
    }
    constrained_check_split(s, 1e-14);
    s = scene_new(9);
    for (int i = 1; i < 20; i++) {
        scene_add_line(s, 0, i, 20, i);
        scene_add_line(s, i, 0, i, 20);
    }
    assert_int_equal(constrained_check_split(s, 0), 361);
}

/* Few segments among many points, many of which lie on them. */
static void test_split_among(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 10; round++) {
        constrained_scene *s = scene_new(600 + round);
        enum { SIDE = 40, LINES = 20 };
        for (int i = 0; i < SIDE * SIDE; i++) scene_add_point(s, i % SIDE, i / SIDE);
        for (int i = 0; i < LINES; i++) {
            uint32_t a = mw__random_below(&s->random, SIDE * SIDE),
                     b = mw__random_below(&s->random, SIDE * SIDE);
            scene_add_segment(s, a, b, MW_NONE);
        }
        scene_add_line(s, scene_uniform(s), 3 * scene_uniform(s), SIDE, SIDE * scene_uniform(s));
        constrained_check_split(s, 1e-12);
    }
}

/* Segments among few doubles: where they cross there is no double near, or an end. */
static void test_split_tight(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 400; round++) {
        constrained_scene *s = scene_new(400 + round);
        double unit = round % 2 ? 0x1p-52 : 0x1p-1074, base = round % 2 ? 1 : 0;
        uint32_t cells = 2 + (uint32_t)scene_below(s, 30), n = 3 + (uint32_t)scene_below(s, 25);
        scene_add_point(s, base, base);
        scene_add_point(s, base + unit * cells, base);
        scene_add_point(s, base, base + unit * cells);
        for (uint32_t i = 0; i < n; i++) {
            uint32_t a = scene_add_point(s, base + unit * scene_below(s, cells),
                                         base + unit * scene_below(s, cells));
            uint32_t b = scene_add_point(s, base + unit * scene_below(s, cells),
                                         base + unit * scene_below(s, cells));
            scene_add_segment(s, a, b, MW_NONE);
        }
        constrained_result r = constrained_run(s, MW_KEEP_HULL, 1);
        if (r.status) fprintf(stderr, "%s\n", r.error.message);
        constrained_assert_sound(s, &r);
        constrained_assert_fills_hull(s, &r);
        constrained_release(&r);
    }
}

/* Parallel lines that cross at tiny angles, far off. */
static void test_split_shallow(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 40; round++) {
        constrained_scene *s = scene_new(500 + round);
        double scale = round % 4 == 0 ? 1e300 : round % 4 == 1 ? 1e-300 : round % 4 == 2 ? 1e6 : 1;
        scene_add_point(s, 0, scale);
        for (int i = 0; i < 30; i++)
            scene_add_line(s, 0, scale * scene_uniform(s) * 1e-14, scale,
                           scale * scene_uniform(s) * 1e-14);
        constrained_result r = constrained_run(s, MW_KEEP_HULL, 1);
        if (r.status) fprintf(stderr, "%s\n", r.error.message);
        constrained_assert_sound(s, &r);
        constrained_assert_fills_hull(s, &r);
        constrained_release(&r);
    }
}

static void check_split_of(uint32_t n, const double *xy, uint32_t m, const uint32_t *segment,
                           double tolerance)
{
    constrained_scene *s = scene_new(0);
    for (uint32_t i = 0; i < n; i++) scene_add_point(s, xy[2 * i], xy[2 * i + 1]);
    for (uint32_t i = 0; i < m; i++)
        scene_add_segment(s, segment[2 * i], segment[2 * i + 1], MW_NONE);
    constrained_check_split(s, tolerance);
}

/* Long segments, nearly parallel: rounding moves each crossing past the next segment. */
static void test_split_close(void **state)
{
    (void)state;
    enum { Y = 5000000 };
    const double unit = 0x1p-30; /* the distance of doubles at Y */
    const double three[] = {1250816.0639249918, Y, 531171.4665219282,  Y + 4 * unit,
                            1303493.7280111513, Y, 816597.12245701486, Y + 6 * unit};
    check_split_of(4, three, 3, (const uint32_t[]){0, 3, 0, 1, 1, 2}, 4 * unit);
    const double others[] = {1238705.1289641492, Y,
                             1248737.949965422,  Y,
                             458771.71222629939, Y + 6 * unit,
                             609270.95347090648, Y + 14 * unit};
    check_split_of(4, others, 3, (const uint32_t[]){3, 0, 2, 0, 1, 2}, 4 * unit);
    const double many[] = {1283425.3194980419, Y,
                           1366677.5162477922, Y,
                           1030640.9006492354, 5266898.1642696485,
                           826911.96684861369, Y,
                           919228.86694196006, Y + 7 * unit,
                           911496.40165268898, Y,
                           477594.894757726,   Y,
                           471731.04780258331, Y,
                           931799.30658502644, Y + 23 * unit,
                           483990.44128173275, Y,
                           1166459.3102712967, Y + 3 * unit,
                           471082.46996141929, Y,
                           543830.71508661099, Y,
                           715319.25111099193, Y};
    const uint32_t segments[] = {13, 0, 10, 12, 6, 6,  9, 13, 11, 13, 8, 10, 9,
                                 5,  9, 10, 5,  8, 10, 3, 8,  12, 1,  4, 6,  2};
    check_split_of(14, many, 13, segments, 4 * unit);
}

/* Many sets of such segments: along the x axis, with some that lie across, and on a slope. */
static void test_split_nearly_parallel(void **state)
{
    (void)state;
    uint64_t seed = 700;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (uint64_t round = 0; round < 600; round++) {
        constrained_scene *s = scene_new(seed + round);
        uint32_t n = 4 + (uint32_t)scene_below(s, 20), units = 2 + (uint32_t)scene_below(s, 20),
                 m = 3 + (uint32_t)scene_below(s, 20);
        double slope = round % 3 == 2 ? scene_uniform(s) : 0;
        scene_add_point(s, 0, 0);
        for (uint32_t i = 0; i < n; i++) {
            double x = 4e5 + 1e6 * scene_uniform(s),
                   y = 5e6 + slope * x + 0x1p-30 * scene_below(s, units);
            scene_add_point(
                s, x, round % 3 == 1 && scene_below(s, 4) == 0 ? 5e6 + 1e6 * scene_uniform(s) : y);
        }
        for (uint32_t i = 0; i < m; i++)
            scene_add_segment(s, 1 + (uint32_t)scene_below(s, n), 1 + (uint32_t)scene_below(s, n),
                              MW_NONE);
        constrained_check_split(s, 8 * 0x1p-30);
    }
}

/* Triangles with one side along nearly the same line as those of the others: sides become one
 * chain, and what each of them bounds stays apart. */
static void test_union_close(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 100; round++) {
        constrained_scene *s = scene_new(1400 + round);
        for (uint32_t i = 0; i < 8; i++) {
            double xy[6];
            for (int k = 0; k < 6; k++)
                xy[k] = k % 2 == 0 ? 1e6 * scene_uniform(s)
                        : k < 5    ? 5e6 + 0x1p-30 * scene_below(s, 9)
                                   : 4e6 + 2e6 * scene_uniform(s);
            scene_add_ring(s, 3, xy, i / 2);
        }
        constrained_result hull = constrained_run(s, MW_KEEP_HULL, 1),
                           r = constrained_run(s, MW_KEEP_INSIDE, 1);
        constrained_assert_sound(s, &hull);
        constrained_assert_sound(s, &r);
        assert_far_kept(s, &hull, &r, 1e-7);
        constrained_release(&hull);
        constrained_release(&r);
    }
}

/* A segment is led through a vertex that another one was led through before: its pieces still
 * follow one another. */
static void test_split_directions(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(0);
    static const double cells[5][2] = {{0, 0}, {1, 0}, {2, 2}, {1, 2}, {0, 1}};
    for (int i = 0; i < 5; i++)
        scene_add_point(s, 1 + 0x1p-52 * cells[i][0], 1 + 0x1p-52 * cells[i][1]);
    scene_add_segment(s, 4, 1, MW_NONE);
    scene_add_segment(s, 3, 0, MW_NONE);
    scene_add_segment(s, 0, 2, MW_NONE);
    constrained_check_split(s, 0x1p-52);
    constrained_result r = constrained_run(s, MW_KEEP_HULL, 1);
    static const uint32_t pieces[2][2] = {{4, 0}, {0, 1}}; /* of the first segment */
    for (int i = 0; i < 2; i++) {
        const constrained_edge *e = constrained_find_edge(&r, pieces[i][0], pieces[i][1]);
        assert_non_null(e);
        assert_int_not_equal(e->piece, MW_NONE);
        assert_int_equal(r.pieces.segment[e->piece], 0);
        assert_int_equal(r.pieces.edge[2 * e->piece], pieces[i][0]);
    }
    constrained_release(&r);
}

static void expect(const constrained_scene *s, const mw_constraints *given,
                   mw_constrain_options options, mw_status status, const char *message)
{
    mw_constraints all = scene_view(s);
    mw_mesh *mesh;
    mw_error error;
    mw_constrained_edges pieces;
    assert_int_equal(
        mw_constrained_delaunay(given ? given : &all, &options, NULL, NULL, &pieces, &mesh, &error),
        status);
    assert_null(mesh);
    assert_null(pieces.edge);
    assert_string_equal(error.message, message);
}

/* What hole seeds remove too little, or too much. */
static void test_holes_are_named(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(0);
    const mw_constrain_options none = {0};
    mw_constrain_report report;
    mw_mesh *mesh;
    scene_add_box(s, 0, 0, 9, 9, MW_NONE);
    scene_add_line(s, 2, 2, 7, 2); /* two sides of a ring: it is open */
    scene_add_line(s, 7, 2, 7, 7);
    scene_add_hole(s, 20, 5);
    mw_constraints given = scene_view(s);
    assert_int_equal(mw_constrained_delaunay(&given, &none, NULL, &report, NULL, &mesh, NULL),
                     MW_OK);
    mw_mesh_destroy(mesh);
    assert_int_equal(report.idle_holes, 1);
    assert_int_equal(report.first_idle_hole, 0);
    scene_add_hole(s, 6, 3);
    expect(s, NULL, none, MW_ERROR_INPUT,
           "nothing is left: the point of hole 1 (6, 3) reaches all that was left: no closed ring "
           "is round it alone");
    s->holes = 0;
    scene_add_hole(s, 9, 4);
    expect(
        s, NULL, none, MW_ERROR_INPUT,
        "nothing is left: the point of hole 0 (9, 4) is on a segment or at a point, so all sides "
        "of it are removed");

    s = scene_new(0);
    scene_add_box(s, 0, 0, 9, 9, MW_NONE);
    scene_add_box(s, 3, 3, 6, 6, MW_NONE);
    scene_add_hole(s, 4, 4);
    given = scene_view(s);
    assert_int_equal(mw_constrained_delaunay(&given, &none, NULL, &report, NULL, &mesh, NULL),
                     MW_OK);
    mw_mesh_destroy(mesh);
    assert_int_equal(report.idle_holes, 0);
    assert_int_equal(report.first_idle_hole, MW_NONE);
}

static void test_wrong_arguments(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(0);
    mw_constrain_options none = {0}, inside_only = {.keep = MW_KEEP_INSIDE},
                         unknown = {.keep = (mw_keep)9};
    mw_error error;
    mw_mesh *mesh;
    assert_int_equal(mw_constrained_delaunay(NULL, NULL, NULL, NULL, NULL, &mesh, &error),
                     MW_ERROR_ARGUMENT);
    scene_add_box(s, 0, 0, 1, 1, MW_NONE);
    mw_constraints given = scene_view(s);
    assert_int_equal(mw_constrained_delaunay(&given, NULL, NULL, NULL, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    expect(s, NULL, unknown, MW_ERROR_ARGUMENT, "the option 'keep' has an unknown value");
    given.stride = 1;
    expect(s, &given, none, MW_ERROR_ARGUMENT, "the stride must be at least 2 (x and y), not 1");
    given = scene_view(s);
    given.segments = NULL;
    expect(s, &given, none, MW_ERROR_ARGUMENT, "the points or the segments are NULL");
    given = scene_view(s);
    given.point_count = 3;
    expect(s, &given, none, MW_ERROR_ARGUMENT, "segment 2: 3 is not a point; there are 3");
    given.segment_count = 2;
    given.point_count = 3;
    assert_int_equal(mw_constrained_delaunay(&given, &none, NULL, NULL, NULL, &mesh, &error),
                     MW_OK);
    mw_mesh_destroy(mesh);
    expect(s, &given, inside_only, MW_ERROR_INPUT,
           "nothing is left: all 1 triangles are outside: no ring of segments is closed");
    s->polygon[0] = s->polygon[1] = 6;
    expect(s, &given, inside_only, MW_ERROR_INPUT,
           "polygon 6 is not closed: a ring ends at point 0");
    scene_add_hole(s, NAN, 0);
    expect(s, NULL, none, MW_ERROR_ARGUMENT, "the point of hole 0 is not finite");
    s->holes = 0;
    s->point[3] = INFINITY;
    expect(s, NULL, none, MW_ERROR_INPUT, "point 1 is not finite");
    for (uint32_t i = 0; i < 4; i++) s->point[2 * i] = s->point[2 * i + 1] = i;
    expect(s, NULL, none, MW_ERROR_INPUT, "all 4 points lie on one line");
    mw_constrained_edges_release(NULL);
}

/* A stride, duplicates, and no segments at all. */
static void test_plain(void **state)
{
    (void)state;
    double points[] = {0, 0, 9, 1, 0, 9, 0, 0, 9, 1, 1, 9, 0, 1, 9};
    uint32_t segments[] = {3, 2, 2, 0}, duplicate_of[5];
    mw_constraints given = {
        .points = points, .point_count = 5, .stride = 3, .segments = segments, .segment_count = 2};
    mw_mesh *mesh;
    mw_constrain_report report;
    mw_constrained_edges pieces;
    assert_int_equal(
        mw_constrained_delaunay(&given, NULL, duplicate_of, &report, &pieces, &mesh, NULL), MW_OK);
    assert_int_equal(mw_mesh_triangle_count(mesh), 2);
    assert_int_equal(duplicate_of[2], 0);
    assert_int_equal(duplicate_of[3], MW_NONE);
    assert_int_equal(pieces.count, 1);
    assert_int_equal(pieces.edge[0], 3);
    assert_int_equal(pieces.edge[1], 0);
    assert_int_equal(report.delaunay.duplicates, 1);
    mw_constrained_edges_release(&pieces);
    mw_mesh_destroy(mesh);
    given.segment_count = 0;
    given.segments = NULL;
    assert_int_equal(mw_constrained_delaunay(&given, NULL, NULL, NULL, NULL, &mesh, NULL), MW_OK);
    mw_mesh_destroy(mesh);
}

/* The same in every run, and what is left out of the results makes no difference. */
static void test_repeatable(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(12);
    for (int i = 0; i < 60; i++)
        scene_add_line(s, scene_uniform(s), scene_uniform(s), scene_uniform(s), scene_uniform(s));
    constrained_result a = constrained_run(s, MW_KEEP_HULL, 1),
                       b = constrained_run(s, MW_KEEP_HULL, 1);
    assert_int_equal(a.count, b.count);
    assert_memory_equal(a.tri, b.tri, a.count * sizeof *a.tri);
    assert_memory_equal(a.point, b.point, a.n * sizeof *a.point);
    assert_memory_equal(a.pieces.edge, b.pieces.edge, 2 * a.pieces.count * sizeof *a.pieces.edge);
    constrained_release(&a);
    constrained_release(&b);
    a = constrained_run(s, MW_KEEP_HULL, 0);
    b = constrained_run(s, MW_KEEP_HULL, 0);
    assert_string_equal(a.error.message, b.error.message);
    constrained_release(&a);
    constrained_release(&b);
}

/* A long segment through n points crosses of the order of sqrt(n) triangles; it is not counted
 * twice, nor is the whole triangulation looked at. */
static void test_crossed(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(13);
    scene_add_line(s, -1, 0.5, 2, 0.5);
    for (int i = 0; i < 3900; i++) scene_add_point(s, scene_uniform(s), scene_uniform(s));
    constrained_result r = constrained_run(s, MW_KEEP_HULL, 0);
    assert_in_range(r.report.triangles_crossed, 60, 400);
    constrained_release(&r);
    /* what is crossed before the two are split counts, although nothing is in the end */
    s = scene_new(0);
    scene_add_line(s, 0, 0, 4, 4);
    scene_add_line(s, 0, 4, 4, 0);
    r = constrained_run(s, MW_KEEP_HULL, 1);
    assert_int_equal(r.report.triangles_crossed, 1);
    constrained_release(&r);
}

/* Every allocation fails once. */
static void test_memory(void **state)
{
    (void)state;
    constrained_scene *s = scene_new(14);
    scene_add_box(s, 0, 0, 9, 9, 3);
    scene_add_box(s, 1, 1, 4, 4, 3);
    scene_add_line(s, -1, 5, 12, 7);
    for (int i = 0; i < 4; i++) scene_add_line(s, -1 - i, 0, 10 + i, 0);
    for (int i = 0; i < 150; i++) scene_add_point(s, 10 * scene_uniform(s), 10 * scene_uniform(s));
    scene_add_hole(s, 8, 8);
    mw_constraints given = scene_view(s);
    mw_constrain_options options = {.keep = MW_KEEP_INSIDE, .split = 1};
    long k = 0;
    for (mw_status status = MW_ERROR_MEMORY; status != MW_OK; k++) {
        mw_mesh *mesh;
        mw_constrained_edges pieces;
        allocations_left = k;
        status = mw_constrained_delaunay(&given, &options, NULL, NULL, &pieces, &mesh, NULL);
        allocations_left = -1;
        if (status == MW_OK) {
            mw_constrained_edges_release(&pieces);
            mw_mesh_destroy(mesh);
        } else {
            assert_int_equal(status, MW_ERROR_MEMORY);
            assert_null(mesh);
            assert_null(pieces.edge);
        }
    }
    assert_true(k > 30);
}

/* --- real data --- */

static FILE *open_shared(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/domain/%s", MW_TEST_SHARED, name);
    return fopen(path, "r");
}

/* Two counts, points, pairs of their numbers. */
static bool read_pairs(constrained_scene *s, const char *name)
{
    FILE *file = open_shared(name);
    if (!file) return false;
    unsigned n, m;
    assert_int_equal(fscanf(file, "%u %u", &n, &m), 2);
    for (unsigned i = 0; i < n; i++) {
        double x, y;
        assert_int_equal(fscanf(file, "%lf %lf", &x, &y), 2);
        scene_add_point(s, x, y);
    }
    for (unsigned i = 0; i < m; i++) {
        unsigned a, b;
        assert_int_equal(fscanf(file, "%u %u", &a, &b), 2);
        scene_add_segment(s, a, b, MW_NONE);
    }
    fclose(file);
    return true;
}

/* One ring, a point per line. */
static bool read_ring(constrained_scene *s, const char *name)
{
    FILE *file = open_shared(name);
    if (!file) return false;
    for (double x, y; fscanf(file, "%lf %lf", &x, &y) == 2;) scene_add_point(s, x, y);
    for (uint32_t i = 0; i < s->points; i++) scene_add_segment(s, i, (i + 1) % s->points, 0);
    fclose(file);
    return true;
}

static void check_real(const constrained_scene *s, const char *name)
{
    bool crosses = false;
    for (uint32_t i = 0; i < s->segments && !crosses; i++)
        for (uint32_t k = 0; k < i && !crosses; k++)
            crosses = points_cross(
                scene_point(s, s->segment[2 * i]), scene_point(s, s->segment[2 * i + 1]),
                scene_point(s, s->segment[2 * k]), scene_point(s, s->segment[2 * k + 1]));
    print_message("%s: %u points, %u segments%s\n", name, s->points, s->segments,
                  crosses ? ", that cross" : "");
    if (!crosses) {
        constrained_check(s);
        return;
    }
    constrained_result r = constrained_run(s, MW_KEEP_HULL, 0);
    assert_int_equal(r.status, MW_ERROR_INPUT);
    assert_int_not_equal(r.report.crossing_segments[0], MW_NONE);
    constrained_release(&r);
    constrained_check_split(s, 1e-6);
}

static void test_real(void **state)
{
    (void)state;
    static const char *const pairs[] = {
        "capital_a", "cdt",    "cdt_duplicates", "corner_cases",  "gh_issue",          "guitar",
        "island",    "kidney", "letter_u",       "lake_superior", "sweden_constrained"};
    static const char *const rings[] = {"bird",         "dude",     "kzer-za", "nazca_heron",
                                        "nazca_monkey", "sketchup", "tank"};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s.cdt.txt", pairs[i]);
        constrained_scene *s = scene_new(1);
        if (read_pairs(s, name)) check_real(s, name);
    }
    for (size_t i = 0; i < sizeof rings / sizeof *rings; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s.dat", rings[i]);
        constrained_scene *s = scene_new(1);
        if (read_ring(s, name)) check_real(s, name);
    }
}

/* --- segments along one line ------------------------------------------------------------------ */

/* Segments between random points of a line, those of line y at y * (0, 1): many lie on one another.
 * Every edge along the line is owned by the lowest segment that covers it, in its direction. */
static void check_overlapping(uint32_t lines, uint32_t points, uint32_t per_line, double dx,
                              double dy, uint64_t *random)
{
    const uint32_t n = lines * points, segments = lines * per_line;
    double *p = malloc(2 * n * sizeof *p);
    uint32_t *s = malloc(2 * segments * sizeof *s), *lowest = malloc(n * sizeof *lowest);
    for (uint32_t i = 0; i < n; i++) {
        p[2 * i] = dx * (i % points);
        p[2 * i + 1] = dy * (i % points) + i / points;
        lowest[i] = MW_NONE;
    }
    for (uint32_t i = 0; i < segments; i++) {
        const uint32_t line = mw__random_below(random, lines);
        for (uint32_t k = 0; k < 2; k++)
            s[2 * i + k] = line * points + mw__random_below(random, points);
        const uint32_t a = s[2 * i], b = s[2 * i + 1];
        for (uint32_t v = a < b ? a : b; v < (a < b ? b : a) && points < 1000; v++)
            if (lowest[v] == MW_NONE) lowest[v] = i;
    }
    mw_constraints given = {
        .points = p, .point_count = n, .segments = s, .segment_count = segments};
    mw_constrained_edges edges;
    mw_mesh *mesh;
    mw_error error;
    if (mw_constrained_delaunay(&given, NULL, NULL, NULL, &edges, &mesh, &error))
        fail_msg("%s", error.message);
    for (size_t i = 0; i < edges.count && points < 1000; i++) {
        const uint32_t a = edges.edge[2 * i], b = edges.edge[2 * i + 1], low = a < b ? a : b,
                       *given_ends = &s[2 * edges.segment[i]];
        assert_int_equal(a < b ? b - a : a - b, 1);
        assert_int_equal(edges.segment[i], lowest[low]);
        assert_int_equal(a < b, given_ends[0] < given_ends[1]);
        lowest[low] = MW_NONE;
    }
    for (uint32_t v = 0; v < n && points < 1000; v++) assert_int_equal(lowest[v], MW_NONE);
    mw_constrained_edges_release(&edges);
    mw_mesh_destroy(mesh);
    free(p);
    free(s);
    free(lowest);
}

/* The last of them would list 10^9 pairs of a segment and an edge. */
static void test_overlapping(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int i = 0; i < 40; i++) {
        const double dx = mw__random_below(&random, 3) - 1.0, dy = 3 * dx;
        check_overlapping(2 + mw__random_below(&random, 3), 2 + mw__random_below(&random, 40),
                          mw__random_below(&random, 30), dx == 0 ? 1 : dx, dy, &random);
    }
    check_overlapping(2, 40000, 40000, 1, 1, &random);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grids),
        cmocka_unit_test(test_uniform),
        cmocka_unit_test(test_long),
        cmocka_unit_test(test_fans),
        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_parcels),
        cmocka_unit_test(test_touching),
        cmocka_unit_test(test_overlapping),
        cmocka_unit_test(test_flood),
        cmocka_unit_test(test_union),
        cmocka_unit_test(test_crossing_is_told),
        cmocka_unit_test(test_split_counts),
        cmocka_unit_test(test_split_many),
        cmocka_unit_test(test_split_among),
        cmocka_unit_test(test_split_tight),
        cmocka_unit_test(test_split_shallow),
        cmocka_unit_test(test_split_close),
        cmocka_unit_test(test_split_nearly_parallel),
        cmocka_unit_test(test_union_close),
        cmocka_unit_test(test_split_directions),
        cmocka_unit_test(test_holes_are_named),
        cmocka_unit_test(test_wrong_arguments),
        cmocka_unit_test(test_plain),
        cmocka_unit_test(test_repeatable),
        cmocka_unit_test(test_crossed),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_real),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
