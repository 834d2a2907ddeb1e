/* test_sight.c - lines of sight, held against brute force in rationals: lines that touch the
 * terrain or run on it, over holes and missing heights, between ends on vertices and edges, above
 * the ground and at given heights, in coordinates of any size. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/sight/sight_oracle.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How many lines were seen to be what: every kind has to occur. */
static size_t seen[3], buried, groundless;

static mw_sight_end random_end(const arrays *m, const double *queries, size_t count, double rise,
                               uint64_t *random)
{
    static const double heights[] = {0, 0, 1, 2, 0.5};
    size_t i = mw__random(random) % count;
    mw_sight_end end = {.x = queries[2 * i],
                        .y = queries[2 * i + 1],
                        .height = rise * heights[mw__random(random) % 5],
                        .absolute = mw__random(random) % 3 == 0};
    if (mw__random(random) % 3 == 0 || !isfinite(end.x) || !isfinite(end.y)) {
        size_t v = mw__random(random) % m->point_count;
        end.x = m->points[2 * v];
        end.y = m->points[2 * v + 1];
    }
    return end;
}

static void expect_lines(const mw_locator *locator, const sight_terrain *terrain,
                         const mw_sight_end *from, const mw_sight_end *ends, size_t count)
{
    mw_viewpoint view;
    mw_error error;
    int place = sight_oracle_end(terrain, from);
    mw_status status = mw_viewpoint_init(locator, terrain->heights, from, &view, &error);
    bool refused = place == 0 || (place < 0 && !from->absolute);
    assert_int_equal(status, refused ? MW_ERROR_INPUT : MW_OK);
    buried += place == 0;
    groundless += place < 0;
    for (size_t i = 0; !refused && i < count; i++) {
        mw_sight sight = mw_sight_to(&view, &ends[i]);
        int there = sight_oracle_end(terrain, &ends[i]);
        mw_sight_state state = there < 0 && !ends[i].absolute ? MW_SIGHT_UNKNOWN
                               : there == 0                   ? MW_SIGHT_HIDDEN
                                            : sight_oracle(terrain, from, &ends[i]);
        if (sight.state != state)
            fprintf(stderr, "from %.17g,%.17g,%.17g%s to %.17g,%.17g,%.17g%s\n", from->x, from->y,
                    from->height, from->absolute ? "" : " above ground", ends[i].x, ends[i].y,
                    ends[i].height, ends[i].absolute ? "" : " above ground");
        assert_int_equal(sight.state, state);
        assert_int_equal(sight.triangle != MW_NONE, state == MW_SIGHT_HIDDEN);
        assert_true(sight.at >= 0 && sight.at <= 1);
        seen[state]++;
    }
}

/* Heights: whole numbers of few values, so that much is flat and lines touch; a plane; any. */
static double random_height(int kind, const double *p, uint64_t *random)
{
    if (kind == 0) return (double)(mw__random(random) % 3);
    if (kind == 1) return 2 * p[0] + p[1];
    return 3 * random_unit(random);
}

static void test_brute_force(void **state)
{
    (void)state;
    static const double scales[] = {1, 1, 0x1p300, 0x1p-280, 1e-3};
    uint64_t random = environment_seed(26);
    size_t rounds = environment_is_long() ? 4000 : 240;
    for (size_t round = 0; round < rounds; round++) {
        double scale = scales[mw__random(&random) % 5];
        size_t count;
        arrays m = arrays_grid(2 + mw__random(&random) % 4, round % 3 ? 0 : 0.5, &random);
        double *height = malloc(m.point_count * sizeof *height);
        assert_non_null(height);
        for (uint32_t v = 0; v < m.point_count; v++) {
            height[v] = scale * random_height((int)(round / 2 % 3), m.points + 2 * v, &random);
            if (round % 5 == 4 && mw__random(&random) % 8 == 0) height[v] = NAN;
        }
        arrays_transform(&m, scale, 0, 0);
        arrays_scramble(&m, 1, &random);
        if (round % 4 == 3) arrays_punch(&m, 0.25, &random);
        double *queries = arrays_queries(&m, 4, &count, &random);
        mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        sight_terrain terrain = {m.points, height, m.triangles, m.triangle_count};
        for (int k = 0; k < 3; k++) {
            mw_sight_end ends[8], from = random_end(&m, queries, count, scale, &random);
            for (int i = 0; i < 8; i++) ends[i] = random_end(&m, queries, count, scale, &random);
            expect_lines(locator, &terrain, &from, ends, 8);
        }
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        free(queries);
        free(height);
        arrays_free(&m);
    }
    for (int i = 0; i < 3; i++) assert_true(seen[i] > 20);
    assert_true(buried > 0 && groundless > 0);
}

/* On a plane all ends on the ground see one another, whatever its slope and wherever they are. */
static void test_plane(void **state)
{
    (void)state;
    uint64_t random = environment_seed(27);
    arrays m = arrays_grid(12, 0.4, &random);
    double *height = malloc(m.point_count * sizeof *height);
    assert_non_null(height);
    for (uint32_t v = 0; v < m.point_count; v++) {
        /* coordinates of few bits: the heights are exactly those of a plane */
        for (int k = 0; k < 2; k++)
            m.points[2 * v + (uint32_t)k] = rint(m.points[2 * v + (uint32_t)k] * 1024) / 1024;
        height[v] = 0.75 * m.points[2 * v] - 1.125 * m.points[2 * v + 1];
    }
    mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    for (int i = 0; i < 300; i++) {
        mw_viewpoint view;
        mw_error error;
        mw_sight_end from = {.x = 12 * random_unit(&random), .y = 12 * random_unit(&random)},
                     to = {.x = 12 * random_unit(&random), .y = 12 * random_unit(&random)};
        expect_ok(mw_viewpoint_init(locator, height, &from, &view, &error), "a viewpoint", &error);
        assert_int_equal(mw_sight_to(&view, &to).state, MW_SIGHT_VISIBLE);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(height);
    arrays_free(&m);
}

static void test_arguments(void **state)
{
    (void)state;
    uint64_t random = environment_seed(28);
    arrays m = arrays_grid(2, 0, &random);
    const double height[9] = {0};
    mw_mesh *mesh = arrays_mesh(&m, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_viewpoint view;
    mw_error error;
    mw_sight_end from = {.x = 1, .y = 1, .height = 1}, below = {.x = 1, .y = 1, .height = -1},
                 far = {.x = 9, .y = 1}, wrong = {.x = NAN};
    assert_int_equal(mw_viewpoint_init(NULL, height, &from, &view, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_viewpoint_init(locator, NULL, &from, &view, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_viewpoint_init(locator, height, &far, &view, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "above no ground"));
    assert_int_equal(mw_viewpoint_init(locator, height, &below, &view, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "below the ground"));
    assert_int_equal(mw_viewpoint_init(locator, height, &wrong, &view, &error), MW_ERROR_INPUT);
    assert_int_equal(mw_viewpoint_init(locator, height, &from, &view, &error), MW_OK);
    assert_int_equal(mw_sight_to(&view, &from).state, MW_SIGHT_VISIBLE);
    assert_int_equal(mw_sight_to(&view, &below).state, MW_SIGHT_HIDDEN);
    assert_int_equal(mw_sight_to(&view, &far).state, MW_SIGHT_UNKNOWN);
    assert_int_equal(mw_sight_to(&view, &wrong).state, MW_SIGHT_UNKNOWN);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_brute_force),
        cmocka_unit_test(test_plane),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
