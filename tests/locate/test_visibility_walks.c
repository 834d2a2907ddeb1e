/* test_visibility_walks.c - what is special about the fast stochastic, forgetful, barycentric and
 * direct walks: what they count, the way they take, and that rounding leads none of them round in
 * a cycle. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "locate/query.h"
#include "oracle/location_oracle.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* A Delaunay mesh of jittered points in the square from 0 to n, its triangles in random order,
 * begun at any corner and every second one clockwise. */
static mw_mesh *jittered(uint32_t n, uint64_t *random)
{
    arrays a = arrays_grid(n, 0.9, random);
    mw_mesh *delaunay = mesh_delaunay(a.points, a.point_count);
    assert_int_equal(mw_mesh_triangle_count(delaunay), a.triangle_count);
    for (uint32_t t = 0; t < a.triangle_count; t++)
        mw_mesh_triangle(delaunay, t, a.triangles + 3 * (size_t)t);
    arrays_scramble(&a, 1, random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_mesh_destroy(delaunay);
    arrays_free(&a);
    return mesh;
}

static mw_counters count(const mw_locator *locator, mw_query_options options, const double *q,
                         size_t n)
{
    mw_location *at = malloc(n * sizeof *at);
    mw_counters counters;
    options.counters = 1;
    assert_int_equal(mw_locate_batch(locator, q, n, 2, &options, at, &counters, NULL), MW_OK);
    free(at);
    return counters;
}

/* Tests for n tiles: 3n barycentric, n + 1 direct with stored areas, 2n + 1 without. Final
 * locations count apart. */
static void test_tests_per_triangle(void **state)
{
    (void)state;
    enum { N = 40, QUERIES = 2000 };
    uint64_t random = 1;
    mw_mesh *mesh = jittered(N, &random);
    double q[2 * QUERIES];
    for (int i = 0; i < 2 * QUERIES; i++) q[i] = 1 + (N - 2) * random_unit(&random);
    for (int areas = 0; areas < 2; areas++) {
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = areas});
        for (int i = 0; i < 8; i++) {
            mw_query_options options = {.walk = i & 1 ? MW_WALK_DIRECT : MW_WALK_BARYCENTRIC,
                                        .start = MW_START_RANDOM,
                                        .arithmetic = i & 2 ? MW_DOUBLE : MW_EXACT,
                                        .lanes = i & 4 ? 16 : 1,
                                        .seed = 3};
            mw_counters c = count(locator, options, q, QUERIES);
            uint64_t want = !(i & 1) ? 3 * c.triangles : (areas ? 1 : 2) * c.triangles + QUERIES;
            assert_int_equal(c.orient, want);
            assert_int_equal(c.orient_init + c.triangles_init + c.implicit + c.comparisons, 0);
            assert_true(c.triangles > 10 * QUERIES && c.triangles_final == QUERIES);
            assert_int_equal(c.cycles, 0);
        }
        mw_locator_destroy(locator);
    }
    mw_mesh_destroy(mesh);
}

/* The next tile of a walk, or MW_NONE at its end. */
static uint32_t follow(const mw_kernels *kernels, mw_walk *walk, bool exact)
{
    walk->fuel = 1;
    return kernels->run[exact][false](walk) == MW_VERDICT_OUT_OF_FUEL ? walk->t : MW_NONE;
}

/* The direct walk goes the way of the barycentric one, with stored areas or without, and out of
 * the hull too. */
static void test_same_way(void **state)
{
    (void)state;
    enum { N = 50 };
    uint64_t random = 2;
    mw_mesh *mesh = jittered(N, &random);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = 1});
    const mw_tiling *tiling = &locator->tiling;
    uint64_t steps = 0;
    for (int i = 0; i < 4000; i++) {
        mw_point q = {(N + 2) * random_unit(&random) - 1, (N + 2) * random_unit(&random) - 1};
        uint32_t t = mw__random_below(&random, tiling->tri_count);
        mw_walk barycentric = mw__walk_begin(tiling, q, t, 0, 0, NULL), direct = barycentric,
                stored = barycentric;
        for (uint32_t next = t; next != MW_NONE; steps++) {
            next = follow(&mw__barycentric, &barycentric, i % 2);
            assert_int_equal(follow(&mw__direct, &direct, i % 2), next);
            assert_int_equal(follow(&mw__direct_stored, &stored, i % 2), next);
        }
    }
    assert_true(steps > 100000);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

static void test_fast_saves_tests(void **state)
{
    (void)state;
    enum { N = 60, QUERIES = 2000 };
    uint64_t random = 3;
    mw_mesh *mesh = jittered(N, &random);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    double q[2 * QUERIES];
    for (int i = 0; i < 2 * QUERIES; i++) q[i] = 1 + (N - 2) * random_unit(&random);
    mw_query_options options = {.walk = MW_WALK_STOCHASTIC, .start = MW_START_RANDOM, .seed = 4};
    mw_counters slow = count(locator, options, q, QUERIES);
    options.walk = MW_WALK_FAST_STOCHASTIC;
    options.finish = MW_WALK_STOCHASTIC;
    mw_counters fast = count(locator, options, q, QUERIES);
    options.steps = 5;
    mw_counters five = count(locator, options, q, QUERIES);
    uint64_t slow_tests = slow.orient, fast_tests = fast.orient + fast.orient_final;
    double per_slow = (double)slow_tests / (double)slow.triangles_visited,
           per_fast = (double)fast_tests / (double)fast.triangles_visited;
    assert_true(per_slow > 1.2 && per_fast < 1.1);
    assert_true(fast_tests < five.orient + five.orient_final &&
                five.orient + five.orient_final < slow_tests);
    assert_true((double)fast.triangles_visited < 1.05 * (double)slow.triangles_visited);
    /* one test a step, but where the hull ends it */
    assert_in_range(five.orient, 5 * QUERIES * 99 / 100, 5 * QUERIES);
    assert_int_equal(fast.cycles + fast.handovers, 0);
    options.steps = 0;
    options.finish = MW_WALK_REMEMBERING;
    mw_counters remembering = count(locator, options, q, QUERIES);
    assert_true(remembering.orient == fast.orient && remembering.orient_final != fast.orient_final);
    options.finish = MW_WALK_AUTO; /* on a Delaunay mesh that one [thesis App. E, sec. 5.3] */
    mw_counters by_itself = count(locator, options, q, QUERIES);
    assert_memory_equal(&by_itself, &remembering, sizeof remembering);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

/* The walk without memory goes about as far as the one that remembers, and tests more; on a mesh
 * that traps walks without coins both end by themselves. */
static void test_forgetful(void **state)
{
    (void)state;
    enum { N = 60, QUERIES = 2000 };
    uint64_t random = 3;
    mw_mesh *mesh = jittered(N, &random);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    double q[2 * QUERIES];
    for (int i = 0; i < 2 * QUERIES; i++) q[i] = 1 + (N - 2) * random_unit(&random);
    mw_query_options options = {.walk = MW_WALK_STOCHASTIC, .start = MW_START_RANDOM, .seed = 4};
    mw_counters remembering = count(locator, options, q, QUERIES);
    options.walk = MW_WALK_FORGETFUL;
    mw_counters forgetful = count(locator, options, q, QUERIES);
    double longer = (double)forgetful.triangles / (double)remembering.triangles;
    assert_true(longer > 0.97 && longer < 1.03);
    assert_true((double)forgetful.orient > 1.2 * (double)remembering.orient);
    assert_int_equal(forgetful.cycles + forgetful.handovers + forgetful.triangles_final, 0);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays trap = arrays_trap();
    mesh = arrays_mesh(&trap, (mw_mesh_options){0});
    locator = mesh_locator(mesh, (mw_locator_options){0});
    const double inside[2] = {.551665, .106155};
    for (options.seed = 0; options.seed < 200; options.seed++)
        assert_int_equal(count(locator, options, inside, 1).cycles, 0);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&trap);
}

/* One step, so many that the walk goes round q for long, and the estimate: the same answers,
 * outside too. */
static void test_any_steps_same_answers(void **state)
{
    (void)state;
    static const uint32_t steps[] = {0, 1, 2, 17, 1000000};
    uint64_t random = 4;
    arrays a = arrays_grid(12, 0.6, &random);
    arrays_punch(&a, 0.2, &random);
    arrays_scramble(&a, 1, &random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    size_t n;
    double *q = arrays_queries(&a, 3, &n, &random);
    for (size_t i = 0; i < n; i++) {
        location_answer want =
            location_oracle_locate(a.points, a.triangles, a.triangle_count, q + 2 * i);
        for (size_t k = 0; k < sizeof steps / sizeof *steps; k++)
            for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
                mw_query_options options = {.walk = MW_WALK_FAST_STOCHASTIC,
                                            .start = MW_START_RANDOM,
                                            .arithmetic = (mw_arithmetic)arithmetic,
                                            .steps = steps[k],
                                            .seed = i};
                mw_cursor cursor;
                assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
                mw_location at = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
                assert_int_equal(at.triangle, want.triangle);
            }
    }
    free(q);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Steps come on top of the fuel, which does not overflow; the estimate is the walk's length where
 * points are spread. */
static void test_steps_and_fuel(void **state)
{
    (void)state;
    enum { N = 60 };
    uint64_t random = 5;
    mw_mesh *mesh = jittered(N, &random);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_query_options options = {.walk = MW_WALK_FAST_STOCHASTIC, .start = MW_START_CENTRE};
    mw_cursor cursor;
    assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
    mw_walk walk =
        mw__query_begin(locator, &cursor, cursor.last, (mw_point){N - 1, N - 1}, &random, NULL);
    /* 2.16 a unit of length */
    assert_true(walk.steps > 1.7 * N / 2 * sqrt(2) && walk.steps < 2.5 * N / 2 * sqrt(2));
    assert_int_equal(walk.fuel, cursor.fuel + walk.steps);
    walk = mw__query_begin(locator, &cursor, cursor.last, (mw_point){1e308, -1e308}, &random, NULL);
    assert_int_equal(walk.steps, cursor.fuel);
    cursor.steps = UINT32_MAX;
    walk = mw__query_begin(locator, &cursor, cursor.last, (mw_point){1, 1}, &random, NULL);
    assert_true(walk.steps == cursor.fuel && walk.fuel == 2 * cursor.fuel);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

/* Round the hub of a fan of slivers every area is a difference of large numbers, and each tile
 * passes its errors on. Plain doubles go round in cycles there; exact arithmetic does not. */
static void test_no_cycles_by_rounding(void **state)
{
    (void)state;
    enum { SPOKES = 200, QUERIES = 2000 };
    uint64_t random = 6;
    arrays a = arrays_fan(SPOKES);
    arrays_scramble(&a, 1, &random);
    arrays_transform(&a, 1, 1, 1.0 / 3);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    double q[2 * QUERIES];
    for (int i = 0; i < 2 * QUERIES; i++)
        q[i] = a.points[i % 2] +
               ldexp(random_unit(&random) - 0.5, -25 - (int)mw__random_below(&random, 30));
    uint64_t cycles[2] = {0, 0};
    for (int i = 0; i < 8; i++) {
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = i & 1});
        mw_query_options options = {.walk = i & 2 ? MW_WALK_DIRECT : MW_WALK_BARYCENTRIC,
                                    .start = MW_START_RANDOM,
                                    .arithmetic = i & 4 ? MW_DOUBLE : MW_EXACT};
        cycles[i >> 2] += count(locator, options, q, QUERIES).cycles;
        mw_locator_destroy(locator);
    }
    assert_int_equal(cycles[0], 0);
    assert_true(cycles[1] > 0);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Is q strictly beyond edge e of tile t? */
static bool parts(const mw_walk *walk, uint32_t t, uint32_t e)
{
    const uint32_t *v = walk->tri[t].v;
    mw_point a = walk->point[v[e]], b = walk->point[v[e + 1]];
    return location_oracle_orient((double[2]){a.x, a.y}, (double[2]){b.x, b.y},
                                  (double[2]){walk->q.x, walk->q.y}) < 0;
}

/* Walk to q from tile t in exact arithmetic: q must lie strictly beyond every edge crossed, one of
 * the hull at last included. Adds the number of edges to *crossed. */
static void expect_sure(const mw_kernels *kernels, const mw_tiling *tiling, uint32_t t,
                        const double q[2], int *crossed)
{
    enum { STEPS = 300 };
    mw_walk walk = mw__walk_begin(tiling, (mw_point){q[0], q[1]}, t, 0, 0, NULL);
    mw_verdict verdict = MW_VERDICT_OUT_OF_FUEL;
    for (int i = 0; i < STEPS && verdict == MW_VERDICT_OUT_OF_FUEL; i++) {
        walk.fuel = 1;
        t = walk.t;
        verdict = kernels->run[true][false](&walk);
        bool sure = verdict == MW_VERDICT_UNSURE;
        for (uint32_t e = 0; e < 3; e++) {
            uint32_t link = walk.tri[t].link[e];
            bool left = verdict == MW_VERDICT_LEFT && link == MW_NONE;
            bool crossed_here = verdict == MW_VERDICT_OUT_OF_FUEL && link == 4 * walk.t + walk.e;
            sure |= (left || crossed_here) && parts(&walk, t, e);
        }
        if (!sure)
            fail_msg("from tile %u: (%a, %a) is not beyond the edge that was crossed", t, q[0],
                     q[1]);
        *crossed += verdict != MW_VERDICT_UNSURE;
    }
}

static void expect_all_sure(const mw_tiling *tiling, uint32_t t, const double q[2], int *crossed)
{
    expect_sure(&mw__barycentric, tiling, t, q, crossed);
    expect_sure(&mw__direct, tiling, t, q, crossed);
    expect_sure(&mw__direct_stored, tiling, t, q, crossed);
}

/* Points about a line, many of them close together: needles of all shapes. */
static mw_mesh *needles(uint32_t n, double offset, double height, uint64_t *random)
{
    double *points = malloc(2 * n * sizeof *points), slope = 2 * random_unit(random) - 1, x = 0;
    for (uint32_t i = 0; i < n; i++) {
        double near = ldexp(random_unit(random) - 0.5, -(int)mw__random_below(random, 30));
        double y = height * (random_unit(random) - 0.5);
        x = i % 3 == 0 ? random_unit(random) : x + near;
        points[2 * i] = offset + x - slope * y;
        points[2 * i + 1] = -offset / 3 + slope * x + y;
    }
    mw_mesh *mesh = NULL; /* where all points are rounded onto one line */
    mw_delaunay(points, n, 2, NULL, NULL, NULL, &mesh, NULL);
    free(points);
    return mesh;
}

/* In needles an area is the small difference of large products, whatever the walks derive from it
 * is off by their errors, and the bounds on these decide. */
static void test_sure_in_needles(void **state)
{
    (void)state;
    uint64_t seed = 9, random = seed;
    int crossed = 0;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int i = 0; i < 62; i++) {
        mw_mesh *mesh = needles(30, i % 2 ? 5e6 : 0, ldexp(1, -i), &random);
        if (!mesh) continue;
        arrays a = arrays_of_mesh(mesh);
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = 1});
        size_t n;
        double *q = arrays_queries(&a, 4, &n, &random);
        for (size_t k = 0; k < n; k++)
            expect_all_sure(&locator->tiling, mw__random_below(&random, locator->tiling.tri_count),
                            q + 2 * k, &crossed);
        free(q);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
    assert_true(crossed > 10000);
}

/* A stored area may be off by more than the tests in its tile. Two needles share the edge ab from
 * a short side to the far vertex b; at v, or next to it, in the second, the tests are between
 * points close together, but the area is not. */
static void test_sure_by_stored_areas(void **state)
{
    (void)state;
    uint64_t seed = 10, random = seed;
    int crossed = 0;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int i = 0; i < 10000; i++) {
        arrays m = arrays_make(4, 2);
        double *a = m.points, *b = a + 2, *v = a + 4, *w = a + 6, side = ldexp(1, -5 - i % 5);
        m.point_count = 4;
        for (int c = 0; c < 2; c++) {
            a[c] = random_unit(&random);
            b[c] = a[c] + random_unit(&random) - 0.5;
            v[c] = a[c] + side * (random_unit(&random) - 0.5);
            w[c] = a[c] - side * (random_unit(&random) - 0.5);
        }
        bool left = mw_orient2d(a, b, v) > 0;
        bool apart = left == (mw_orient2d(a, b, w) < 0);
        for (int c = 0; c < 2 && !apart; c++) w[c] = 2 * a[c] - v[c];
        arrays_triangle(&m, left ? 2 : 0, left ? 0 : 2, 1);
        arrays_triangle(&m, left ? 0 : 3, left ? 3 : 0, 1);
        mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = 1});
        for (int k = 0; k < 4; k++) {
            double q[2] = {nextafter(v[0], k % 2 ? b[0] : v[0]),
                           nextafter(v[1], k / 2 ? b[1] : v[1])};
            expect_sure(&mw__direct_stored, &locator->tiling, 1, q, &crossed);
        }
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&m);
    }
    assert_true(crossed > 10000);
}

/* Found by search: all roundings conspire, in the areas, which are off by more than what makes
 * their signs sure, and in the sums. Without a bound on the latter the walk would leave over the
 * edge that q is (all but) on. */
static void test_sure_in_sums(void **state)
{
    (void)state;
    static const double p[][4][2] = {
        {{0x1.38df64a3bc73p-6, -0x1.3a561bb87f2cap-1},
         {0x1.a873f8c14e79p+0, -0x1.64b7ac9ec3f8bp-1},
         {-0x1.11f14424ce64bp-3, 0x1.e5ec91855d134p+0},
         {0x1.ce2a65aa07d5fp-6, -0x1.3a926e0fe03c6p-1}},
        {{-0x1.59c6642468012p+0, 0x1.b0a1c7bc504d8p-1},
         {-0x1.6dded4630f1c8p+0, -0x1.8460922eb6d6dp+0},
         {-0x1.165b2242b5dcep-2, 0x1.2a0840a42f7dbp+0},
         {-0x1.5ded5149e8937p+0, 0x1.6d815b8f03dc2p-2}},
    };
    int crossed = 0;
    for (size_t i = 0; i < sizeof p / sizeof *p; i++)
        for (uint32_t first = 0; first < 3; first++) {
            arrays a = arrays_make(3, 1);
            for (int k = 0; k < 3; k++) arrays_point(&a, p[i][k][0], p[i][k][1]);
            arrays_triangle(&a, first, (first + 1) % 3, (first + 2) % 3);
            mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
            mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = 1});
            expect_all_sure(&locator->tiling, 0, p[i][3], &crossed);
            mw_locator_destroy(locator);
            mw_mesh_destroy(mesh);
            arrays_free(&a);
        }
}

/* Stored areas of slivers are as good as those of other triangles; beyond the doubles they are
 * infinite. */
static void test_stored_areas(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int i = 0; i < 500; i++) {
        double x = random_unit(&random),
               height = ldexp(1 + random_unit(&random), -(int)mw__random_below(&random, 50));
        double scale = ldexp(1, i % 5 ? 0 : 600), points[6] = {0, 0, 1 + x, 1 + x, x, x + height};
        for (int k = 0; k < 6; k++) points[k] = scale * points[k];
        const uint32_t corners[3] = {0, 1, 2};
        mw_arrays view = {
            .points = points, .point_count = 3, .triangles = corners, .triangle_count = 1};
        mw_mesh *mesh;
        assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = 1});
        /* all but exact: x + height lies near x */
        double want = (points[2] - points[0]) * (points[5] - points[4]);
        double area = locator->tiling.area[0];
        assert_true(isinf(want) ? isinf(area) : fabs(area - want) <= 0x1p-42 * want);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
}

/* Meshes that fold over and have flat triangles: nothing is promised but an end. */
static void test_any_mesh(void **state)
{
    (void)state;
    enum { V = 7, T = 8 };
    static const mw_walk_kind walks[] = {MW_WALK_FAST_STOCHASTIC, MW_WALK_BARYCENTRIC,
                                         MW_WALK_DIRECT};
    uint64_t random = 8;
    for (int round = 0; round < 2000; round++) {
        arrays a = arrays_make(V, T);
        for (int i = 0; i < V; i++)
            arrays_point(&a, mw__random_below(&random, 3), mw__random_below(&random, 3));
        for (int i = 0; i < T; i++) {
            uint32_t u = mw__random_below(&random, V),
                     v = (u + 1 + mw__random_below(&random, V - 1)) % V, w = u;
            while (w == u || w == v) w = mw__random_below(&random, V);
            arrays_triangle(&a, u, v, w);
        }
        mw_arrays view = arrays_view(&a);
        mw_mesh *mesh;
        mw_locator *locator = NULL;
        assert_int_equal(mw_mesh_create(&view, &(mw_mesh_options){.tolerant = 1}, &mesh, NULL),
                         MW_OK);
        mw_status status = mw_locator_create(
            mesh, &(mw_locator_options){.any = 1, .areas = round % 2}, &locator, NULL);
        for (int i = 0; status == MW_OK && i < 12; i++) {
            mw_query_options options = {.walk = walks[i % 3],
                                        .start = MW_START_RANDOM,
                                        .arithmetic = i % 2 ? MW_EXACT : MW_DOUBLE,
                                        .steps = i < 6 ? 0 : 50,
                                        .seed = (uint64_t)i};
            mw_cursor cursor;
            assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
            double q[2] = {mw__random_below(&random, 9) / 4.0, mw__random_below(&random, 9) / 4.0};
            mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
            location_answer answer;
            if (at.triangle != MW_NONE)
                assert_true(location_oracle_contains(
                    a.points, a.triangles + 3 * (size_t)at.triangle, q, &answer));
        }
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tests_per_triangle), cmocka_unit_test(test_same_way),
        cmocka_unit_test(test_fast_saves_tests),   cmocka_unit_test(test_any_steps_same_answers),
        cmocka_unit_test(test_steps_and_fuel),     cmocka_unit_test(test_no_cycles_by_rounding),
        cmocka_unit_test(test_sure_in_needles),    cmocka_unit_test(test_sure_by_stored_areas),
        cmocka_unit_test(test_sure_in_sums),       cmocka_unit_test(test_stored_areas),
        cmocka_unit_test(test_any_mesh),           cmocka_unit_test(test_forgetful),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
