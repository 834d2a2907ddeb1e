/* test_value_table.c - tables of values: each value has the bits that mw_interpolate gives it
 * alone. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>
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
static void case_one(const table_case *c, bool narrow, size_t stride, size_t k,
                     double result[POINTS])
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
            assert_int_equal(mw_interpolate_table(c.mesh, &table, c.at, POINTS, NULL, wide, &error),
                             MW_OK);
            table.values = c.narrow;
            table.type = MW_FLOAT32;
            assert_int_equal(
                mw_interpolate_table(c.mesh, &table, c.at, POINTS, NULL, narrow, &error), MW_OK);
            for (size_t k = 0; k < count; k++) {
                case_one(&c, false, stride ? stride : count, k, one);
                for (size_t i = 0; i < POINTS; i++)
                    assert_true(same_double(one[i], wide[i * count + k]));
                case_one(&c, true, stride ? stride : count, k, one);
                for (size_t i = 0; i < POINTS; i++)
                    assert_true(same_double((double)(float)one[i], (double)narrow[i * count + k]));
            }
        }
    case_release(&c);
}

/* Many points in a mesh whose vertices and triangles have other places in memory than their
 * numbers: values side by side and field by field, in one type and the other, by any number of
 * threads. */
typedef struct large_case {
    mw_mesh *mesh;
    mw_location *at;
    size_t n, vertices, count;
    double *one; /* mw_interpolate of each field, field by field */
} large_case;

static large_case large_create(size_t count)
{
    enum { N = 40000, CELLS = 90 };
    uint64_t random = environment_seed(30);
    arrays a = arrays_grid(CELLS, 0.4, &random);
    arrays_scramble(&a, 1, &random);
    large_case c = {.mesh = arrays_mesh(&a, (mw_mesh_options){0}),
                    .n = N,
                    .vertices = a.point_count,
                    .count = count};
    mw_locator *locator = mesh_locator(c.mesh, (mw_locator_options){0});
    double *q = malloc(2 * sizeof *q * N);
    c.at = malloc(N * sizeof *c.at);
    c.one = malloc(N * count * sizeof *c.one);
    for (size_t i = 0; i < 2 * N; i++) q[i] = (CELLS + 4) * random_unit(&random) - 2;
    memcpy(q, a.points, 2 * sizeof *q * a.point_count); /* at vertices, too */
    assert_int_equal(mw_locate_batch(locator, q, N, 2, NULL, c.at, NULL, NULL), MW_OK);
    free(q);
    mw_locator_destroy(locator);
    arrays_free(&a);
    return c;
}

static void large_expect(const large_case *c, const mw_value_table *table, const void *result,
                         const char *how)
{
    for (size_t i = 0; i < c->n; i++)
        for (size_t k = 0; k < c->count; k++) {
            size_t at = table->step > 1 ? k * c->n + i : i * c->count + k;
            bool narrow = table->type == MW_FLOAT32;
            double got =
                narrow ? (double)((const float *)result)[at] : ((const double *)result)[at];
            double want = narrow ? (double)(float)c->one[k * c->n + i] : c->one[k * c->n + i];
            if (!same_double(want, got))
                fail_msg("%s: value %zu of point %zu is %g, not %g", how, k, i, got, want);
        }
}

static void large_try(large_case *c, mw_value_type type)
{
    size_t all = c->vertices * c->count, size = type == MW_FLOAT32 ? sizeof(float) : sizeof(double);
    void *rows = malloc(all * size), *fields = malloc(all * size),
         *result = malloc(c->n * c->count * size);
    double *field = malloc(c->vertices * sizeof *field);
    for (size_t k = 0; k < c->count; k++) {
        for (size_t v = 0; v < c->vertices; v++) {
            float value = v % 97 ? (float)sin((double)(v + 31 * k)) : NAN;
            field[v] = (double)value;
            size_t row = v * c->count + k, place = k * c->vertices + v;
            if (type == MW_FLOAT32)
                ((float *)rows)[row] = ((float *)fields)[place] = value;
            else
                ((double *)rows)[row] = ((double *)fields)[place] = field[v];
        }
        mw_interpolate(c->mesh, field, c->at, c->n, c->one + k * c->n);
    }
    const mw_value_table side_by_side = {.values = rows, .type = type, .count = c->count},
                         by_field = {.values = fields,
                                     .type = type,
                                     .count = c->count,
                                     .step = c->vertices};
    for (uint32_t threads = 1; threads < 4; threads++) {
        mw_interpolate_options options = {.threads = threads};
        assert_int_equal(
            mw_interpolate_table(c->mesh, &side_by_side, c->at, c->n, &options, result, NULL),
            MW_OK);
        large_expect(c, &side_by_side, result, "side by side");
        assert_int_equal(
            mw_interpolate_table(c->mesh, &by_field, c->at, c->n, &options, result, NULL), MW_OK);
        large_expect(c, &by_field, result, "field by field");
    }
    free(rows);
    free(fields);
    free(result);
    free(field);
}

static void test_many_points_by_threads(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 13};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        large_case c = large_create(counts[i]);
        large_try(&c, MW_FLOAT64);
        large_try(&c, MW_FLOAT32);
        mw_mesh_destroy(c.mesh);
        free(c.at);
        free(c.one);
    }
}

static void test_arguments(void **state)
{
    (void)state;
    table_case c = case_create();
    mw_error error;
    double result[POINTS];
    mw_value_table good = {.values = c.wide, .count = 1}, unknown = good, tight = good,
                   none = {.count = 1};
    unknown.type = (mw_value_type)2;
    tight.count = 3;
    tight.stride = 2;
    assert_int_equal(mw_interpolate_table(c.mesh, &good, c.at, POINTS, NULL, result, &error),
                     MW_OK);
    assert_int_equal(mw_interpolate_table(c.mesh, &good, NULL, 0, NULL, NULL, &error), MW_OK);
    assert_int_equal(mw_interpolate_table(NULL, &good, c.at, POINTS, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, NULL, c.at, POINTS, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &good, NULL, POINTS, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &good, c.at, POINTS, NULL, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &none, c.at, POINTS, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &unknown, c.at, POINTS, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_interpolate_table(c.mesh, &tight, c.at, POINTS, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_string_equal(error.message, "the stride 2 is less than the 3 values of a vertex");
    tight.step = 1;
    assert_int_equal(mw_interpolate_table(c.mesh, &tight, c.at, POINTS, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    tight.step = 8; /* values may be anywhere then */
    assert_int_equal(mw_interpolate_table(c.mesh, &tight, c.at, 1, NULL, result, &error), MW_OK);
    case_release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_are_those_of_one),
        cmocka_unit_test(test_many_points_by_threads),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
