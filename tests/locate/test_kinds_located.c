/* test_kinds_located.c - every walk on every kind of triangulation, and on constrained ones, in
 * both arithmetics, ended by either walk: the answer is that of brute force. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/location_oracle.h"
#include "support/meshes.h"

#include <stdlib.h>

enum { POINTS = 70, QUERIES = 40 };

/* Points of even density, in clusters, or on a few places of a grid, where many are collinear and
 * cocircular. */
static void draw_points(int round, double *p, uint64_t *random)
{
    for (int i = 0; i < 2 * POINTS; i++) {
        double u = random_unit(random);
        p[i] = round % 3 == 0   ? u
               : round % 3 == 1 ? (i / 2 % 4) + 0.05 * u * u * u
                                : (double)(int)(6 * u);
    }
}

static void expect_all_walks(mw_mesh *mesh, const char *kind, uint64_t *random)
{
    static const mw_walk_kind finishes[] = {MW_WALK_REMEMBERING, MW_WALK_STOCHASTIC};
    arrays a = arrays_of_mesh(mesh);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.areas = 1});
    size_t n;
    double *q = arrays_queries(&a, QUERIES / 8 + 1, &n, random);
    for (size_t i = 0; i < n; i++) {
        location_answer want =
            location_oracle_locate(a.points, a.triangles, a.triangle_count, q + 2 * i);
        for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
            for (int way = 0; way < 4; way++) {
                mw_query_options options = {.walk = (mw_walk_kind)walk,
                                            .start = MW_START_RANDOM,
                                            .arithmetic = (mw_arithmetic)(way % 2),
                                            .finish = finishes[way / 2],
                                            .seed = i};
                mw_cursor cursor;
                assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
                mw_location at = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
                /* the oracle knows no holes */
                int where = at.where == MW_IN_HOLE ? MW_OUTSIDE : at.where;
                if (at.triangle != want.triangle || where != want.where || at.local != want.local)
                    fail_msg("%s, %s, way %d: (%.17g, %.17g) in triangle %u, not %u", kind,
                             mw_walk_name(options.walk), way, q[2 * i], q[2 * i + 1], at.triangle,
                             want.triangle);
            }
    }
    free(q);
    mw_locator_destroy(locator);
    arrays_free(&a);
}

static void test_kinds(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 3; round++)
        for (int kind = 0; kind < MW_KIND_COUNT; kind++) {
            double points[2 * POINTS];
            mw_mesh *mesh;
            mw_error error;
            draw_points(round, points, &random);
            expect_ok(mw_triangulate((mw_triangulation_kind)kind, points, POINTS, 2, NULL, NULL,
                                     NULL, &mesh, &error),
                      mw_kind_name((mw_triangulation_kind)kind), &error);
            expect_all_walks(mesh, mw_kind_name((mw_triangulation_kind)kind), &random);
            mw_mesh_destroy(mesh);
        }
}

/* Regular triangulations whose points have weights: most are not Delaunay, and some points are
 * hidden. */
static void test_regular(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int round = 0; round < 3; round++) {
        double points[2 * POINTS], weights[POINTS];
        mw_mesh *mesh;
        mw_error error;
        mw_kind_options options = {.weights = weights};
        draw_points(round, points, &random);
        for (int i = 0; i < POINTS; i++) weights[i] = (round ? 0.3 : 0.02) * random_unit(&random);
        expect_ok(
            mw_triangulate(MW_KIND_REGULAR, points, POINTS, 2, &options, NULL, NULL, &mesh, &error),
            "regular", &error);
        expect_all_walks(mesh, "regular, weighted", &random);
        mw_mesh_destroy(mesh);
    }
}

/* A star of long segments, which no Delaunay triangulation of the points has. */
static void test_constrained(void **state)
{
    (void)state;
    enum { RAYS = 12 };
    uint64_t random = 2;
    for (int round = 0; round < 3; round++) {
        double points[2 * POINTS];
        uint32_t segments[2 * RAYS];
        mw_mesh *mesh;
        mw_error error;
        for (int i = 0; i < 2 * POINTS; i++) points[i] = random_unit(&random);
        points[0] = points[1] = 0.5;
        for (uint32_t i = 0; i < RAYS; i++) {
            segments[2 * i] = 0;
            segments[2 * i + 1] = i + 1;
        }
        mw_constraints constraints = {
            .points = points, .point_count = POINTS, .segments = segments, .segment_count = RAYS};
        mw_constrain_options options = {.split = 1};
        expect_ok(mw_constrained_delaunay(&constraints, &options, NULL, NULL, NULL, &mesh, &error),
                  "constrained", &error);
        expect_all_walks(mesh, "constrained", &random);
        mw_mesh_destroy(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_kinds), cmocka_unit_test(test_regular),
                                       cmocka_unit_test(test_constrained)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
