/* test_value_table.c - tables of values: each value has the bits that mw_interpolate gives it alone. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <string.h>

enum { POINTS = 60, MOST = 9, STRIDE = 11, VERTICES = 25 };

/* A grid of 25 vertices, points inside, on edges, at vertices and outside, and values with NaN. */
typedef struct table_case {
    arrays plane;
    mw_mesh *mesh;
    mw_location at[POINTS];
    double wide[VERTICES * STRIDE];
    float narrow[VERTICES * STRIDE];
} table_case;

static void case_locate(table_case *c, uint64_t *random)
{
    mw_locator *locator = mesh_locator(c->mesh, (mw_locator_options){0});
    mw_error error;
    double xy[2 * POINTS];
    for (int i = 0; i < 2 * POINTS; i++) {
        *random = *random * 6364136223846793005u + 1442695040888963407u;
        xy[i] = (double)(*random >> 60) / 3 - 0.5; /* many on lines of the grid */
    }
    xy[0] = NAN;
    assert_int_equal(mw_locate_batch(locator, xy, POINTS, 0, NULL, c->at, NULL, &error), MW_OK);
    mw_locator_destroy(locator);
}

static table_case case_create(void)
{
    uint64_t random = environment_seed(29);
    table_case c = {.plane = arrays_grid(4, 0, &random)};
    c.mesh = arrays_mesh(&c.plane, (mw_mesh_options){0});
    assert_int_equal(mw_mesh_vertex_count(c.mesh), VERTICES);
    case_locate(&c, &random);
    for (size_t i = 0; i < VERTICES * STRIDE; i++) {
        c.narrow[i] = i % 13 ? (float)sin((double)i) : NAN;
        c.wide[i] = i % 13 ? cos((double)i) : NAN;
    }
    return c;
}

static void case_release(table_case *c)
{
    mw_mesh_destroy(c->mesh);
    arrays_free(&c->plane);
}

/* Value k of all vertices by itself. */
static void case_one(const table_case *c, bool narrow, size_t stride, size_t k, double result[POINTS])
{
    double values[VERTICES];
    for (size_t v = 0; v < VERTICES; v++)
        values[v] = narrow ? (double)c->narrow[v * stride + k] : c->wide[v * stride + k];
    mw_interpolate(c->mesh, values, c->at, POINTS, result);
}

static bool same_double(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static void test_values_are_those_of_one(void **state)
{
    (void)state;
    table_case c = case_create();
    mw_error error;
    double wide[POINTS * MOST], one[POINTS];
    float narrow[POINTS * MOST];
    for (size_t count = 0; count <= MOST; count++)
        for (size_t stride = 0; stride <= STRIDE; stride += STRIDE) {
            mw_value_table table = {.values = c.wide, .count = count, .stride = stride};
            assert_int_equal(mw_interpolate_table(c.mesh, &table, c.at, POINTS, wide, &error), MW_OK);
            table.values = c.narrow;
            table.type = MW_FLOAT32;
            assert_int_equal(mw_interpolate_table(c.mesh, &table, c.at, POINTS, narrow, &error), MW_OK);
            for (size_t k = 0; k < count; k++) {
                case_one(&c, false, stride ? stride : count, k, one);
                for (size_t i = 0; i < POINTS; i++) assert_true(same_double(one[i], wide[i * count + k]));
                case_one(&c, true, stride ? stride : count, k, one);
                for (size_t i = 0; i < POINTS; i++)
                    assert_true(same_double((double)(float)one[i], (double)narrow[i * count + k]));
            }
        }
    case_release(&c);
}

static void test_arguments(void **state)
{
    (void)state;
    table_case c = case_create();
    mw_error error;
    double result[POINTS];
    mw_value_table good = {.values = c.wide, .count = 1}, unknown = good, tight = good, none = {.count = 1};
    unknown.type = (mw_value_type)2;
    tight.count = 3;
    tight.stride = 2;
    assert_int_equal(mw_interpolate_table(c.mesh, &good, c.at, POINTS, result, &error), MW_OK);
    assert_int_equal(mw_interpolate_table(c.mesh, &good, NULL, 0, NULL, &error), MW_OK);
    assert_int_equal(mw_interpolate_table(NULL, &good, c.at, POINTS, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, NULL, c.at, POINTS, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &good, NULL, POINTS, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &good, c.at, POINTS, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &none, c.at, POINTS, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &unknown, c.at, POINTS, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &tight, c.at, POINTS, result, &error), MW_ERROR_ARGUMENT);
    assert_string_equal(error.message, "a stride of 2 for 3 values");
    case_release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_are_those_of_one),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
