/* test_star.c - rays from the centre of star-shaped polyhedra, against exact rationals; and what
 * is no such polyhedron. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/star_oracle.h"
#include "support/meshes.h"
#include "support/star_shapes.h"

typedef struct star_world {
    mw_surface *surface;
    mw_star *star;
} star_world;

static star_world make_world(const star_shape *p, mw_surface_options how, mw_star_options options)
{
    star_world w;
    mw_error error;
    mw_arrays view = star_shape_arrays(p);
    expect_ok(mw_surface_create(&view, &how, &w.surface, &error), "surface", &error);
    expect_ok(mw_star_create(w.surface, &options, &w.star, &error), "star", &error);
    return w;
}

static void release_world(star_world *w)
{
    mw_star_destroy(w->star);
    mw_surface_destroy(w->surface);
}

/* A ray of some kind: anywhere, through a lattice point, through a vertex, an edge, a facet, or to
 * no point. */
static void draw(const star_shape *p, const double c[3], double scale, uint64_t *seed, double q[3])
{
    uint32_t kind = mw__random_below(seed, 6), t = mw__random_below(seed, p->triangles);
    uint32_t one = mw__random_below(seed, 3), two = mw__random_below(seed, 3);
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t *v = p->corner + 3 * (size_t)t;
        double a = p->point[3 * v[one] + k], b = p->point[3 * v[two] + k];
        if (kind == 0) q[k] = c[k] + scale * (random_unit(seed) - 0.5);
        if (kind == 1) q[k] = c[k] + scale * ((double)mw__random_below(seed, 9) - 4);
        if (kind == 2) q[k] = a;
        if (kind == 3) q[k] = a + b - c[k];
        if (kind == 4)
            q[k] = p->point[3 * v[0] + k] / 2 + p->point[3 * v[1] + k] / 4 +
                   p->point[3 * v[2] + k] / 4;
        if (kind == 5) q[k] = c[k] - (a - c[k]);
    }
}

static void expect_location(const mw_location *found, const mw_location *expected,
                            const double q[3])
{
    if (found->triangle != expected->triangle || found->where != expected->where ||
        found->local != expected->local)
        fail_msg("ray through %a %a %a: facet %u %s %u, not %u %s %u", q[0], q[1], q[2],
                 found->triangle, mw_where_name(found->where), found->local, expected->triangle,
                 mw_where_name(expected->where), expected->local);
    for (int k = 0; k < 3 && found->triangle != MW_NONE; k++) {
        assert_true(fabs(found->weight[k] - expected->weight[k]) <= 0x1p-34);
        assert_true((found->weight[k] == 0) == (expected->weight[k] == 0));
        assert_true(found->weight[k] >= 0);
    }
}

static const mw_star_start_kind borrowed_starts[] = {MW_STAR_START_AUTO, MW_STAR_START_RANDOM,
                                                     MW_STAR_START_LAST};

/* Stars on the surface's own records, checked or not, give the same answer bit for bit. */
static void expect_borrowed(mw_star *const borrowed[2], const double q[3],
                            const mw_location *expected, uint64_t seed)
{
    for (int i = 0; i < 6; i++) {
        mw_star_query_options options = {.start = borrowed_starts[i / 2], .seed = seed};
        mw_star_cursor cursor;
        expect_ok(mw_star_cursor_init(borrowed[i % 2], &options, &cursor, NULL), "cursor", NULL);
        mw_location found = mw_star_locate(borrowed[i % 2], &cursor, q);
        assert_memory_equal(&found, expected, sizeof found);
    }
}

/* Every walk from every start against the oracle. */
static void check_rays(const star_shape *p, mw_surface_options how, const double c[3], double scale,
                       int rays, uint64_t *seed)
{
    star_world w = make_world(p, how, (mw_star_options){.centre = {c[0], c[1], c[2]}, .angles = 1});
    mw_star *borrowed[2];
    for (int i = 0; i < 2; i++) {
        mw_star_options options = {.centre = {c[0], c[1], c[2]}, .borrow = 1, .unchecked = i};
        expect_ok(mw_star_create(w.surface, &options, &borrowed[i], NULL), "borrowed star", NULL);
    }
    for (int i = 0; i < rays; i++) {
        double q[3];
        draw(p, c, scale, seed, q);
        mw_location expected = star_oracle_locate(p->point, p->corner, p->triangles, c, q);
        bool bad = q[0] == c[0] && q[1] == c[1] && q[2] == c[2];
        assert_true(bad || expected.triangle != MW_NONE);
        if (bad) expected = (mw_location){.triangle = MW_NONE, .where = MW_BAD, .local = 255};
        for (int walk = 0; walk < MW_STAR_WALK_COUNT; walk++)
            for (int start = 0; start <= MW_STAR_START_SORTED; start++) {
                mw_star_query_options options = {.walk = (mw_star_walk_kind)walk,
                                                 .start = (mw_star_start_kind)start,
                                                 .finish = i % 2 ? MW_STAR_WALK_FORGETFUL
                                                                 : MW_STAR_WALK_STOCHASTIC,
                                                 .seed = (uint64_t)i};
                mw_star_cursor cursor;
                expect_ok(mw_star_cursor_init(w.star, &options, &cursor, NULL), "cursor", NULL);
                mw_location found = mw_star_locate(w.star, &cursor, q);
                expect_location(&found, &expected, q);
                if (walk + start == 0) expect_borrowed(borrowed, q, &found, (uint64_t)i);
            }
    }
    for (int i = 0; i < 2; i++) mw_star_destroy(borrowed[i]);
    release_world(&w);
}

static void test_lattice_stars(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 15; round++) {
        uint64_t seed = 1000 + round;
        star_shape p = star_shape_octahedron((unsigned)(round % 3));
        if (round % 4) star_shape_stretch(&p, 4, &seed);
        star_shape_shuffle(&p, &seed);
        print_message("seed %d\n", 1000 + (int)round);
        check_rays(&p, (mw_surface_options){.weld = round % 2 == 0}, (double[3]){0, 0, 0}, 1, 40,
                   &seed);
        star_shape_free(&p);
    }
}

/* The centre need not be the origin, nor coordinates be of moderate size. */
static void test_places_and_sizes(void **state)
{
    static const double size[] = {1, 0x1p-1060, 0x1p-700, 0x1p400, 0x1p1010},
                        place[] = {0, 3, 0x1p30};
    (void)state;
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 3; j++) {
            uint64_t seed = (uint64_t)(7 + i + 10 * j);
            star_shape p = star_shape_octahedron(2);
            double c[3] = {place[j] * size[i], -place[j] * size[i], 2 * place[j] * size[i]};
            if (!isfinite(c[2] * 2)) {
                star_shape_free(&p);
                continue;
            }
            star_shape_stretch(&p, 3, &seed);
            for (uint32_t v = 0; v < p.points; v++)
                for (uint32_t k = 0; k < 3; k++)
                    p.point[3 * v + k] = p.point[3 * v + k] * size[i] + c[k];
            check_rays(&p, (mw_surface_options){0}, c, size[i], 60, &seed);
            star_shape_free(&p);
        }
}

static void test_facets_without_area(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 18; round++) {
        uint64_t seed = 500 + round;
        star_shape p = star_shape_octahedron(1 + (unsigned)(round % 2));
        for (uint32_t i = 0; i < 3 * p.points; i++) p.point[i] *= 16;
        for (uint32_t i = 0; i < 1 + round % 6; i++)
            star_shape_add_flat(&p, mw__random_below(&seed, p.triangles),
                                mw__random_below(&seed, 3));
        if (round % 2) star_shape_shuffle(&p, &seed);
        print_message("seed %d\n", 500 + (int)round);
        check_rays(&p, (mw_surface_options){0}, (double[3]){0, 0, 0}, 1, 60, &seed);
        star_shape_free(&p);
    }
}

/* Rays through edges and vertices of facets that look small from the centre, where areas are taken
 * from what is left of the corners once their common part is subtracted. */
static void test_edges_of_small_facets(void **state)
{
    (void)state;
    star_shape p = star_shape_octahedron(6);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){0});
    mw_star_cursor cursor = {0};
    for (uint32_t t = 0, tried = 0; t < p.triangles && tried < 300; t++) {
        const uint32_t *v = p.corner + 3 * (size_t)t;
        const double *a = p.point + 3 * (size_t)v[0];
        if (fabs(a[0]) < 58 && fabs(a[1]) < 58 && fabs(a[2]) < 58) continue;
        tried++;
        for (uint32_t k = 0; k < 3; k++) {
            const double *b = p.point + 3 * (size_t)v[k], *c = p.point + 3 * (size_t)v[(k + 1) % 3];
            uint32_t found[3];
            mw_location at = mw_star_locate(w.star, &cursor, b);
            assert_int_equal(at.where, MW_ON_VERTEX);
            mw_surface_triangle(w.surface, at.triangle, found);
            assert_int_equal(found[at.local], v[k]);
            at =
                mw_star_locate(w.star, &cursor, (double[3]){b[0] + c[0], b[1] + c[1], b[2] + c[2]});
            assert_int_equal(at.where, MW_ON_EDGE);
            mw_surface_triangle(w.surface, at.triangle, found);
            uint32_t from = found[at.local], to = found[(at.local + 1) % 3];
            assert_true((from == v[k] && to == v[(k + 1) % 3]) ||
                        (to == v[k] && from == v[(k + 1) % 3]));
            assert_true(at.weight[(at.local + 2) % 3] == 0);
        }
    }
    release_world(&w);
    star_shape_free(&p);
}

/* Each facet has vertices of its own; and a row of vertices at one place makes facets that vanish.
 */
static void test_welded(void **state)
{
    (void)state;
    uint64_t seed = 3;
    star_shape p = star_shape_octahedron(2);
    star_shape_stretch(&p, 3, &seed);
    star_shape_tear(&p);
    uint32_t a = p.corner[0],
             same = star_shape_point(&p, p.point[3 * a], p.point[3 * a + 1], p.point[3 * a + 2]);
    star_shape_triangle(&p, a, same, p.corner[1]);
    check_rays(&p, (mw_surface_options){.weld = 1}, (double[3]){0, 0, 0}, 1, 300, &seed);
    star_shape_free(&p);
}

static void test_indices_and_batches(void **state)
{
    (void)state;
    uint64_t seed = 11;
    star_shape p = star_shape_octahedron(4);
    star_shape_stretch(&p, 2, &seed);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){.angles = 1});
    enum { N = 12000 };
    double *q = malloc(sizeof *q * 3 * N);
    mw_location *first = malloc(sizeof *first * N), *found = malloc(sizeof *found * N);
    assert_true(q && first && found);
    for (size_t i = 0; i < N; i++) draw(&p, (double[3]){0, 0, 0}, 1, &seed, q + 3 * i);
    q[0] = NAN;
    q[3] = INFINITY;
    expect_ok(mw_star_locate_batch(w.star, q, N, 0, NULL, first, NULL, NULL), "batch", NULL);
    assert_int_equal(first[0].where, MW_BAD);
    assert_int_equal(first[1].where, MW_BAD);
    for (int start = 0; start < MW_STAR_START_COUNT; start++)
        for (int walk = 1; walk < MW_STAR_WALK_COUNT; walk++)
            for (uint32_t threads = 1; threads <= 3; threads += 2) {
                mw_star_index *index = NULL;
                mw_error error;
                if (mw_star_start_has_index((mw_star_start_kind)start))
                    expect_ok(mw_star_index_create(w.star, (mw_star_start_kind)start, NULL, &index,
                                                   &error),
                              "index", &error);
                mw_star_query_options options = {.walk = (mw_star_walk_kind)walk,
                                                 .start = (mw_star_start_kind)start,
                                                 .threads = threads,
                                                 .counters = 1,
                                                 .index = index};
                mw_counters counters;
                memset(found, 0xff, sizeof *found * N);
                expect_ok(mw_star_locate_batch(w.star, q, N, 0, &options, found, &counters, &error),
                          "batch", &error);
                assert_memory_equal(found, first, sizeof *found * N);
                uint64_t answered = 0;
                for (size_t i = 0; i < N; i++) answered += first[i].where != MW_BAD;
                assert_int_equal(counters.queries, answered);
                assert_true(counters.triangles_visited >= answered);
                options.counters = 0; /* then many walks are in flight */
                memset(found, 0xff, sizeof *found * N);
                expect_ok(mw_star_locate_batch(w.star, q, N, 0, &options, found, NULL, &error),
                          "batch", &error);
                assert_memory_equal(found, first, sizeof *found * N);
                mw_star_index_destroy(index);
            }
    free(q);
    free(first);
    free(found);
    release_world(&w);
    star_shape_free(&p);
}

/* A batch of few queries walks little, wherever in memory facets were given. */
static void test_short_walks(void **state)
{
    (void)state;
    uint64_t seed = 31;
    star_shape p = star_shape_octahedron(6);
    star_shape_shuffle(&p, &seed);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){0});
    enum { N = 3000 };
    double q[3 * N];
    mw_location location[N];
    for (size_t i = 0; i < 3 * N; i++) q[i] = random_unit(&seed) - 0.5;
    for (uint32_t n = N / 8; n <= N; n *= 2) {
        mw_star_query_options options = {.counters = 1};
        mw_counters counters;
        assert_true(n < p.triangles);
        expect_ok(mw_star_locate_batch(w.star, q, n, 0, &options, location, &counters, NULL),
                  "batch", NULL);
        assert_int_equal(counters.queries, n);
        assert_true(counters.triangles_visited < 4 * n);
    }
    release_world(&w);
    star_shape_free(&p);
}

/* Two poles over a ring of m vertices at all heights. Coordinates are integers. */
static star_shape make_poles(uint32_t m, uint64_t *seed)
{
    star_shape p = {0};
    for (uint32_t i = 0; i < m; i++) {
        double angle = 2 * 3.14159265358979 * i / m;
        star_shape_point(&p, rint(0x1p24 * cos(angle)), rint(0x1p24 * sin(angle)),
                         (double)mw__random_below(seed, 1 << 22) - (1 << 21));
    }
    uint32_t north = star_shape_point(&p, 0, 0, 0x1p23), south = star_shape_point(&p, 0, 0, -1000);
    for (uint32_t i = 0; i < m; i++) {
        star_shape_triangle(&p, i, (i + 1) % m, north);
        star_shape_triangle(&p, (i + 1) % m, i, south);
    }
    star_shape_shuffle(&p, seed);
    return p;
}

/* Vertices of very many facets: answers, also where each facet has vertices of its own, and that no
 * walk goes round such a vertex facet by facet. */
static void test_poles(void **state)
{
    (void)state;
    uint64_t seed = 47;
    static const double origin[3] = {0, 0, 0};
    for (uint32_t m = 60; m <= 240; m += 60) {
        star_shape p = make_poles(m, &seed);
        check_rays(&p, (mw_surface_options){0}, origin, 0x1p24, 25, &seed);
        star_shape_tear(&p);
        check_rays(&p, (mw_surface_options){.weld = 1}, origin, 0x1p24, 10, &seed);
        star_shape_free(&p);
    }
    star_shape p = make_poles(40000, &seed);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){0});
    enum { N = 2000 };
    double q[3 * N];
    mw_location location[N];
    mw_star_query_options options = {.counters = 1};
    mw_star_cursor cursor;
    mw_counters counters;
    for (size_t i = 0; i < N; i++) draw(&p, origin, 0x1p24, &seed, q + 3 * i);
    expect_ok(mw_star_locate_batch(w.star, q, N, 0, &options, location, &counters, NULL), "batch",
              NULL);
    expect_ok(mw_star_cursor_init(w.star, &options, &cursor, NULL), "cursor", NULL);
    for (size_t i = 0; i < N; i++) {
        mw_location alone = mw_star_locate(w.star, &cursor, q + 3 * i);
        expect_location(&alone, &location[i], q + 3 * i);
    }
    assert_true(counters.triangles_max < 64 && cursor.counters.triangles_max < 64);
    assert_int_equal(counters.handovers + cursor.counters.handovers, 0);
    release_world(&w);
    star_shape_free(&p);
}

/* Single queries begin near their end, in any order: at the last facet, or where the curve
 * leads. */
static void test_single_queries(void **state)
{
    (void)state;
    uint64_t seed = 53;
    star_shape p = star_shape_octahedron(6);
    star_shape_shuffle(&p, &seed);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){0});
    enum { N = 2000 };
    for (int along = 0; along < 2; along++) {
        mw_star_cursor cursor;
        mw_star_query_options options = {.counters = 1};
        expect_ok(mw_star_cursor_init(w.star, &options, &cursor, NULL), "cursor", NULL);
        for (int i = 0; i < N; i++) {
            double angle = 6.28 * i / N, q[3] = {cos(angle), sin(angle), sin(5 * angle) / 2};
            for (int k = 0; k < 3 && !along; k++) q[k] = random_unit(&seed) - 0.5;
            mw_star_locate(w.star, &cursor, q);
        }
        assert_true(cursor.counters.triangles_visited < (along ? 3 : 4) * N);
    }
    release_world(&w);
    star_shape_free(&p);
}

/* A path begins at the first facet, crosses edges, and ends where the ray is; it is as long as the
 * counters say. */
static void test_paths(void **state)
{
    (void)state;
    uint64_t seed = 21;
    star_shape p = star_shape_octahedron(4);
    star_shape_stretch(&p, 2, &seed);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){.angles = 1});
    for (int walk = 0; walk < MW_STAR_WALK_COUNT; walk++)
        for (int i = 0; i < 300; i++) {
            mw_star_query_options options = {.walk = (mw_star_walk_kind)walk,
                                             .start = MW_STAR_START_FRONT,
                                             .seed = (uint64_t)i,
                                             .counters = 1};
            mw_star_cursor cursor;
            mw_location location;
            uint32_t facet[4096];
            double q[3];
            for (int k = 0; k < 3; k++) q[k] = random_unit(&seed) - 0.5;
            expect_ok(mw_star_cursor_init(w.star, &options, &cursor, NULL), "cursor", NULL);
            size_t count = mw_star_path(w.star, &cursor, q, facet, 4096, &location);
            assert_true(count >= 1 && count <= 4096);
            assert_int_equal(count, cursor.counters.triangles_visited);
            assert_int_equal(facet[count - 1], location.triangle);
            for (size_t j = 1; j < count; j++) {
                bool linked = false;
                for (unsigned k = 0; k < 3; k++)
                    linked = linked ||
                             mw_surface_neighbour(w.surface, facet[j - 1], k, NULL) == facet[j];
                assert_true(linked);
            }
            size_t again = mw_star_path(w.star, &cursor, q, facet, 1, NULL);
            assert_true(again >= 1);
        }
    release_world(&w);
    star_shape_free(&p);
}

static star_shape from_lists(const double *point, uint32_t points, const uint32_t *corner,
                             uint32_t triangles)
{
    star_shape p = {0};
    for (uint32_t v = 0; v < points; v++)
        star_shape_point(&p, point[3 * v], point[3 * v + 1], point[3 * v + 2]);
    for (uint32_t t = 0; t < triangles; t++)
        star_shape_triangle(&p, corner[3 * t], corner[3 * t + 1], corner[3 * t + 2]);
    return p;
}

/* Facets without area that share more than one edge: a spike folded onto an edge, with two
 * vertices at one place; and a pillow of two that has nothing to do with the rest. */
static void test_folded_facets(void **state)
{
    static const uint32_t spike[] = {1, 0, 7, 0, 1, 2, 0, 2, 3, 6, 3, 4, 6, 4, 1, 5, 2, 1,
                                     5, 3, 2, 5, 4, 3, 5, 1, 4, 6, 1, 7, 0, 6, 7, 6, 0, 3};
    static const double place[] = {0, 0,  1, 1, 0, 0,  0, 1, 0, -1, 0, 0,
                                   0, -1, 0, 0, 0, -1, 0, 0, 1, 2,  0, -1};
    (void)state;
    uint64_t seed = 9;
    star_shape p = from_lists(place, 8, spike, 12);
    check_rays(&p, (mw_surface_options){0}, (double[3]){0, 0, 0}, 1, 200, &seed);
    star_shape_free(&p);
    p = star_shape_octahedron(1);
    uint32_t a = star_shape_point(&p, 5, 0, 0), b = star_shape_point(&p, 6, 1, 0),
             c = star_shape_point(&p, 7, 2, 0);
    star_shape_triangle(&p, a, b, c);
    star_shape_triangle(&p, c, b, a);
    check_rays(&p, (mw_surface_options){0}, (double[3]){0, 0, 0}, 1, 200, &seed);
    star_shape_free(&p);
}

/* A fan of facets without area, in either order. */
static void test_flat_fan(void **state)
{
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        enum { N = 300 };
        uint64_t seed = 13;
        star_shape p = star_shape_octahedron(0);
        for (uint32_t i = 0; i < 3 * p.points; i++) p.point[i] *= 2 * N;
        uint32_t *first = p.corner, o = first[0], end = first[1], apex = MW_NONE;
        for (uint32_t t = 1; t < p.triangles; t++) /* the facet across the edge between the two */
            for (uint32_t k = 0; k < 3; k++)
                if (p.corner[3 * t + k] == end && p.corner[3 * t + (k + 1) % 3] == o) {
                    apex = p.corner[3 * t + (k + 2) % 3];
                    p.corner[3 * t + k] = end; /* end, the last of the row, apex: filled in below */
                    p.corner[3 * t + (k + 1) % 3] = p.points + N - 1;
                }
        assert_true(apex != MW_NONE);
        uint32_t row = p.points;
        for (uint32_t i = 0; i < N; i++) {
            double x[3];
            for (int k = 0; k < 3; k++)
                x[k] = p.point[3 * o + (uint32_t)k] +
                       (i + 1) * ((p.point[3 * end + (uint32_t)k] - p.point[3 * o + (uint32_t)k]) /
                                  (2 * N));
            star_shape_point(&p, x[0], x[1], x[2]);
        }
        star_shape_triangle(&p, row, o, apex);
        for (uint32_t i = 0; i + 1 < N; i++) star_shape_triangle(&p, row + i + 1, row + i, apex);
        for (uint32_t j = 0; j < N;
             j++) { /* o, point i, point i + 1: all on one line; the last with `end` */
            uint32_t i = turned ? N - 1 - j : j;
            star_shape_triangle(&p, o, row + i, i + 1 < N ? row + i + 1 : end);
        }
        check_rays(&p, (mw_surface_options){0}, (double[3]){0, 0, 0}, 1, 30, &seed);
        star_shape_free(&p);
    }
}

/* --- what is no star-shaped polyhedron -------------------------------------------------------- */

static void expect_refused(const star_shape *p, mw_star_options options, mw_defect_kind kind,
                           uint32_t triangle)
{
    mw_surface *surface;
    mw_star *star;
    mw_error error;
    mw_check check;
    mw_arrays view = star_shape_arrays(p);
    expect_ok(mw_surface_create(&view, NULL, &surface, &error), "surface", &error);
    assert_int_equal(mw_star_create(surface, &options, &star, &error), MW_ERROR_INPUT);
    assert_null(star);
    if (triangle != MW_NONE) assert_int_equal(error.triangle, triangle);
    mw_star_options borrow = options;
    mw_error same;
    borrow.borrow = 1;
    assert_int_equal(mw_star_create(surface, &borrow, &star, &same), MW_ERROR_INPUT);
    assert_null(star);
    assert_string_equal(same.message, error.message);
    expect_ok(mw_star_check_arrays(&view, 0, &options, &check, &error), "check", &error);
    assert_false(check.valid);
    bool found = false;
    for (size_t i = 0; i < check.defect_count; i++)
        found = found || (check.defects[i].kind == kind &&
                          (triangle == MW_NONE || check.defects[i].triangle == triangle));
    assert_true(found);
    mw_check_release(&check);
    mw_surface_destroy(surface);
}

static void test_refused(void **state)
{
    (void)state;
    star_shape p = star_shape_octahedron(1);
    uint64_t seed = 5;
    for (int i = 0; i < 2; i++) {
        star_shape open = star_shape_octahedron(1);
        if (i) star_shape_shuffle(&open, &seed);
        open.triangles--;
        expect_refused(&open, (mw_star_options){0}, MW_DEFECT_OPEN_EDGE, MW_NONE);
        star_shape_free(&open);
    }
    /* on the surface */
    expect_refused(&p, (mw_star_options){.centre = {2, 0, 0}}, MW_DEFECT_THROUGH_CENTRE, MW_NONE);
    /* outside */
    expect_refused(&p, (mw_star_options){.centre = {1.5, 1.5, 0}}, MW_DEFECT_BACK_FACING, MW_NONE);
    star_shape_free(&p);
}

/* One vertex is pulled through the centre: the facets round it turn away, and are named, whatever
 * their orientation. */
static void test_turned_facet(void **state)
{
    (void)state;
    for (uint64_t round = 0; round < 20; round++) {
        uint64_t seed = round;
        star_shape p = star_shape_octahedron(3);
        if (round % 2) star_shape_shuffle(&p, &seed);
        uint32_t t = mw__random_below(&seed, p.triangles), v = p.corner[3 * t];
        for (uint32_t k = 0; k < 3; k++) p.point[3 * v + k] *= -0.125;
        mw_arrays view = star_shape_arrays(&p);
        mw_check check;
        expect_ok(mw_star_check_arrays(&view, 0, NULL, &check, NULL), "check", NULL);
        assert_false(check.valid);
        uint32_t named = 0, round_v = 0;
        for (size_t i = 0; i < check.defect_count; i++) {
            assert_int_equal(check.defects[i].kind, MW_DEFECT_BACK_FACING);
            const uint32_t *c = p.corner + 3 * (size_t)check.defects[i].triangle;
            assert_true(c[0] == v || c[1] == v || c[2] == v);
            named++;
        }
        for (uint32_t i = 0; i < 3 * p.triangles; i++) round_v += p.corner[i] == v;
        assert_int_equal(named, round_v);
        mw_check_release(&check);
        star_shape_free(&p);
    }
}

/* Closed, and all facets face outwards, but rays meet two: one octahedron in another; two sheets
 * wound about a slit, whose two ends they share. */
static void test_covered_twice(void **state)
{
    (void)state;
    star_shape p = star_shape_octahedron(1), inner = star_shape_octahedron(1);
    uint32_t points = p.points, triangles = p.triangles;
    for (uint32_t v = 0; v < points; v++)
        star_shape_point(&p, inner.point[3 * v] / 2, inner.point[3 * v + 1] / 2,
                         inner.point[3 * v + 2] / 2);
    for (uint32_t t = 0; t < triangles; t++)
        star_shape_triangle(&p, inner.corner[3 * t] + points, inner.corner[3 * t + 1] + points,
                            inner.corner[3 * t + 2] + points);
    expect_refused(&p, (mw_star_options){0}, MW_DEFECT_COVERED, MW_NONE);
    star_shape_free(&inner);
    star_shape_free(&p);

    /* The slit goes from x = 2 over the middle (1, 1, 0) to y = 2; above and below it lie z > 0
     * and z < 0. */
    star_shape two = {0}, one = star_shape_octahedron(1);
    for (int sheet = 0; sheet < 2; sheet++)
        for (uint32_t v = 0; v < one.points; v++)
            star_shape_point(&two, one.point[3 * v], one.point[3 * v + 1], one.point[3 * v + 2]);
    for (uint32_t sheet = 0; sheet < 2; sheet++)
        for (uint32_t t = 0; t < one.triangles; t++) {
            uint32_t v[3];
            bool above = false;
            for (uint32_t k = 0; k < 3; k++)
                above = above || one.point[3 * one.corner[3 * t + k] + 2] > 0;
            for (uint32_t k = 0; k < 3; k++) {
                const double *x = one.point + 3 * (size_t)one.corner[3 * t + k];
                bool end = x[0] == 2 || x[1] == 2, middle = x[0] == 1 && x[1] == 1;
                uint32_t of = end ? 0 : middle ? (sheet ^ above) : sheet;
                v[k] = one.corner[3 * t + k] + of * one.points;
            }
            star_shape_triangle(&two, v[0], v[1], v[2]);
        }
    expect_refused(&two, (mw_star_options){0}, MW_DEFECT_COVERED, MW_NONE);
    star_shape_free(&one);
    star_shape_free(&two);
}

static void test_arguments(void **state)
{
    (void)state;
    star_shape p = star_shape_octahedron(1);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){0});
    mw_star *star;
    mw_star_cursor cursor;
    mw_error error;
    assert_int_equal(mw_star_create(NULL, NULL, &star, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_create(w.surface, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    mw_star_options nowhere = {.centre = {0, NAN, 0}};
    assert_int_equal(mw_star_create(w.surface, &nowhere, &star, &error), MW_ERROR_ARGUMENT);
    mw_star_query_options options = {.walk = MW_STAR_WALK_COUNT};
    assert_int_equal(mw_star_cursor_init(w.star, &options, &cursor, &error), MW_ERROR_ARGUMENT);
    options = (mw_star_query_options){.start = MW_STAR_START_COUNT};
    assert_int_equal(mw_star_cursor_init(w.star, &options, &cursor, &error), MW_ERROR_ARGUMENT);
    for (int finish = 0; finish <= MW_STAR_WALK_COUNT + 256; finish++) {
        bool known =
            finish == 0 || finish == MW_STAR_WALK_STOCHASTIC || finish == MW_STAR_WALK_FORGETFUL;
        options = (mw_star_query_options){.finish = (mw_star_walk_kind)finish};
        assert_int_equal(mw_star_cursor_init(w.star, &options, &cursor, &error),
                         known ? MW_OK : MW_ERROR_ARGUMENT);
    }
    options = (mw_star_query_options){.start = MW_STAR_START_GRID};
    assert_int_equal(mw_star_cursor_init(w.star, &options, &cursor, &error), MW_ERROR_ARGUMENT);
    options = (mw_star_query_options){.walk = MW_STAR_WALK_ORTHOGONAL};
    assert_int_equal(mw_star_cursor_init(w.star, &options, &cursor, &error), MW_ERROR_ARGUMENT);
    release_world(&w);
    star_shape_free(&p);
}

/* --- change ----------------------------------------------------------------------------------- */

static void test_update(void **state)
{
    (void)state;
    uint64_t seed = 77;
    star_shape p = star_shape_octahedron(2);
    star_world w = make_world(&p, (mw_surface_options){0}, (mw_star_options){.angles = 1});
    mw_star_cursor cursor;
    mw_star_query_options options = {.walk = MW_STAR_WALK_ORTHOGONAL};
    expect_ok(mw_star_cursor_init(w.star, &options, &cursor, NULL), "cursor", NULL);
    for (int round = 0; round < 20; round++) {
        double q[3], *points = mw_surface_points(w.surface);
        bool broken = round % 4 == 3;
        mw_surface_begin_update(w.surface);
        star_shape_stretch(&p, 2, &seed);
        memcpy(points, p.point, sizeof *points * 3 * p.points);
        if (broken) points[0] = points[1] = points[2] = 0;
        mw_error error;
        draw(&p, (double[3]){0, 0, 0}, 1, &seed, q);
        assert_int_equal(mw_star_locate(w.star, &cursor, q).where,
                         MW_BAD); /* it has changed, and the star does not know */
        assert_int_equal(mw_star_update(w.star, NULL, &error), broken ? MW_ERROR_INPUT : MW_OK);
        mw_surface_end_update(w.surface);
        for (int i = 0; i < 50; i++) {
            draw(&p, (double[3]){0, 0, 0}, 1, &seed, q);
            mw_location found = mw_star_locate(w.star, &cursor, q);
            mw_location expected =
                star_oracle_locate(p.point, p.corner, p.triangles, (double[3]){0, 0, 0}, q);
            if (broken)
                expected = (mw_location){.triangle = MW_NONE, .where = MW_BAD, .local = 255};
            expect_location(&found, &expected, q);
        }
    }
    release_world(&w);
    star_shape_free(&p);
}

/* Vertices that were made one stay one: moved apart they leave a gap; moved onto others, facets
 * vanish. */
static void test_welded_update(void **state)
{
    (void)state;
    star_shape p = star_shape_octahedron(1);
    uint64_t seed = 31;
    star_shape_tear(&p);
    star_world w = make_world(&p, (mw_surface_options){.weld = 1}, (mw_star_options){0});
    double *points = mw_surface_points(w.surface);
    mw_error error;
    mw_surface_begin_update(w.surface);
    points[0] *= 1.5;
    points[1] *= 1.5;
    points[2] *= 1.5;
    assert_int_equal(mw_star_update(w.star, NULL, &error), MW_ERROR_INPUT);
    mw_surface_end_update(w.surface);
    release_world(&w);
    star_shape_free(&p);

    p = star_shape_octahedron(0); /* facet 0 in three, by a vertex that then moves onto a corner */
    uint32_t a = p.corner[0], b = p.corner[1], c = p.corner[2], v = star_shape_point(&p, 0, 0, 0);
    for (uint32_t k = 0; k < 3; k++)
        p.point[3 * v + k] = (p.point[3 * a + k] + p.point[3 * b + k] + p.point[3 * c + k]) / 2;
    p.corner[2] = v;
    star_shape_triangle(&p, b, c, v);
    star_shape_triangle(&p, c, a, v);
    for (int weld = 0; weld < 2; weld++) {
        w = make_world(&p, (mw_surface_options){.weld = weld}, (mw_star_options){0});
        points = mw_surface_points(w.surface);
        mw_surface_begin_update(w.surface);
        for (uint32_t k = 0; k < 3; k++) points[3 * v + k] = p.point[3 * a + k];
        expect_ok(mw_star_update(w.star, NULL, &error), "update", &error);
        mw_surface_end_update(w.surface);
        for (int i = 0; i < 200; i++) {
            double q[3], origin[3] = {0, 0, 0};
            mw_star_cursor cursor;
            draw(&p, origin, 1, &seed, q);
            if (q[0] == 0 && q[1] == 0 && q[2] == 0) continue;
            expect_ok(mw_star_cursor_init(w.star, NULL, &cursor, NULL), "cursor", NULL);
            mw_location found = mw_star_locate(w.star, &cursor, q);
            mw_location expected = star_oracle_locate(points, p.corner, p.triangles, origin, q);
            expect_location(&found, &expected, q);
        }
        release_world(&w);
    }
    star_shape_free(&p);
}

/* All defects are found beside others: a facet without area, an open edge. */
static void test_defects_beside_others(void **state)
{
    (void)state;
    for (int open = 0; open < 2; open++) {
        star_shape p = star_shape_octahedron(0);
        for (uint32_t i = 0; i < 3 * p.points; i++) p.point[i] *= 4;
        assert_true(open || star_shape_add_flat(&p, 0, 0));
        p.triangles -= (uint32_t)open;
        mw_star_options outside = {.centre = {9, 9, 8}};
        mw_arrays view = star_shape_arrays(&p);
        mw_check check;
        expect_ok(mw_star_check_arrays(&view, 0, &outside, &check, NULL), "check", NULL);
        assert_false(check.valid);
        uint32_t count[MW_DEFECT_COUNT] = {0};
        for (size_t i = 0; i < check.defect_count; i++) count[check.defects[i].kind]++;
        assert_int_equal(count[MW_DEFECT_OPEN_EDGE], open ? 3 : 0);
        assert_int_equal(count[MW_DEFECT_FLAT], !open);
        assert_true(count[MW_DEFECT_BACK_FACING] > 0);
        mw_check_release(&check);
        star_shape_free(&p);
    }
}

/* What has no facet with an area is no polyhedron, for mw_star_check_arrays either. */
static void test_nothing(void **state)
{
    (void)state;
    static const double line[] = {1, 0, 0, 2, 0, 0, 3, 0, 0};
    static const uint32_t pillow[] = {0, 1, 2, 2, 1, 0};
    for (uint32_t triangles = 0; triangles <= 2; triangles += 2) {
        star_shape p = from_lists(line, 3, pillow, triangles);
        mw_arrays view = star_shape_arrays(&p);
        mw_check check;
        expect_ok(mw_star_check_arrays(&view, 0, NULL, &check, NULL), "check", NULL);
        assert_false(check.valid);
        mw_check_release(&check);
        star_shape_free(&p);
    }
    mw_check check;
    mw_star_options nowhere = {.centre = {NAN, 0, 0}};
    mw_arrays none = {0};
    memset(&check, 0x5a, sizeof check);
    assert_int_equal(mw_star_check_arrays(&none, 0, &nowhere, &check, NULL), MW_ERROR_ARGUMENT);
    mw_check_release(&check);
    assert_int_equal(mw_star_update(NULL, NULL, NULL), MW_ERROR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lattice_stars),
        cmocka_unit_test(test_places_and_sizes),
        cmocka_unit_test(test_facets_without_area),
        cmocka_unit_test(test_edges_of_small_facets),
        cmocka_unit_test(test_welded),
        cmocka_unit_test(test_indices_and_batches),
        cmocka_unit_test(test_short_walks),
        cmocka_unit_test(test_poles),
        cmocka_unit_test(test_single_queries),
        cmocka_unit_test(test_paths),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_turned_facet),
        cmocka_unit_test(test_covered_twice),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_update),
        cmocka_unit_test(test_folded_facets),
        cmocka_unit_test(test_flat_fan),
        cmocka_unit_test(test_welded_update),
        cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_defects_beside_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
