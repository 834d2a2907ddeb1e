/* test_operator.c - operators: from locations they give the bits of mw_interpolate, from entries
 * the sums of whole numbers, which are exact. */
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

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* --- from locations --------------------------------------------------------------------------- */

/* Points in a mesh whose vertices and triangles have other places in memory than their numbers:
 * inside, on edges, at vertices, outside, not finite. */
typedef struct located {
    mw_mesh *mesh;
    mw_location *at;
    size_t n, vertices;
    mw_operator *weights;
} located;

static located located_create(size_t n, bool sorted)
{
    enum { CELLS = 40 };
    uint64_t random = environment_seed(31);
    arrays a = arrays_grid(CELLS, sorted ? 0 : 0.4, &random);
    if (!sorted) arrays_scramble(&a, 1, &random);
    located c = {.mesh = arrays_mesh(&a, (mw_mesh_options){0}), .n = n, .vertices = a.point_count};
    mw_locator *locator = mesh_locator(c.mesh, (mw_locator_options){0});
    mw_error error;
    double *q = malloc(2 * n * sizeof *q);
    c.at = malloc(n * sizeof *c.at);
    for (size_t i = 0; i < 2 * n; i++) q[i] = (CELLS + 2) * random_unit(&random) - 1;
    memcpy(q, a.points, 2 * sizeof *q * (a.point_count < n ? a.point_count : n));
    for (size_t i = 0; sorted && i < n; i++) q[2 * i + 1] = (double)i / (double)n * CELLS;
    for (size_t i = 0; sorted && i < n; i += 5) q[2 * i + 1] = 3; /* on lines of the grid */
    q[2 * n - 1] = NAN;
    expect_ok(mw_locate_batch(locator, q, n, 2, NULL, c.at, NULL, &error), "a batch", &error);
    expect_ok(mw_operator_create(c.mesh, c.at, n, NULL, &c.weights, &error), "weights", &error);
    free(q);
    mw_locator_destroy(locator);
    arrays_free(&a);
    return c;
}

static void located_release(located *c)
{
    mw_operator_destroy(c->weights);
    mw_mesh_destroy(c->mesh);
    free(c->at);
}

static double test_value(size_t v, size_t k)
{
    if ((v + 3 * k) % 89 == 0) return NAN;
    if ((v + k) % 101 == 0) return INFINITY;
    return (double)(float)sin((double)(v + 31 * k));
}

/* Values and results in one type and one layout, with what mw_interpolate says. */
typedef struct table_trial {
    const located *at;
    mw_value_table table;
    void *values, *result;
} table_trial;

static table_trial trial_create(const located *c, size_t count, mw_value_type type, bool fields)
{
    const size_t size = type == MW_FLOAT32 ? sizeof(float) : sizeof(double);
    table_trial t = {.at = c,
                     .values = malloc(c->vertices * count * size + 1),
                     .result = malloc(c->n * count * size + 1)};
    t.table = (mw_value_table){
        .values = t.values, .type = type, .count = count, .step = fields ? c->vertices : 1};
    for (size_t k = 0; k < count; k++)
        for (size_t v = 0; v < c->vertices; v++) {
            const size_t i = fields ? k * c->vertices + v : v * count + k;
            if (type == MW_FLOAT32)
                ((float *)t.values)[i] = (float)test_value(v, k);
            else
                ((double *)t.values)[i] = test_value(v, k);
        }
    return t;
}

static void trial_release(table_trial *t)
{
    free(t->values);
    free(t->result);
}

static void trial_expect(const table_trial *t, uint32_t threads)
{
    const located *c = t->at;
    const bool narrow = t->table.type == MW_FLOAT32, fields = t->table.step > 1;
    double *field = malloc(c->vertices * sizeof *field), *one = malloc(c->n * sizeof *one);
    mw_error error;
    mw_operator_apply_options options = {.threads = threads};
    memset(t->result, 1, c->n * t->table.count * (narrow ? 4 : 8));
    expect_ok(mw_operator_apply(c->weights, &t->table, &options, t->result, &error), "apply",
              &error);
    for (size_t k = 0; k < t->table.count; k++) {
        for (size_t v = 0; v < c->vertices; v++) field[v] = test_value(v, k);
        mw_interpolate(c->mesh, field, c->at, c->n, one);
        for (size_t i = 0; i < c->n; i++) {
            const size_t at = fields ? k * c->n + i : i * t->table.count + k;
            const double got =
                narrow ? (double)((const float *)t->result)[at] : ((const double *)t->result)[at];
            const double want = narrow ? (double)(float)one[i] : one[i];
            if (!same_bits(got, want))
                fail_msg("value %zu of %zu of point %zu: %g, not %g", k, t->table.count, i, got,
                         want);
        }
    }
    free(field);
    free(one);
}

static void located_try(const located *c, size_t count, uint32_t threads)
{
    for (int fields = 0; fields < 2; fields++)
        for (int type = MW_FLOAT64; type <= MW_FLOAT32; type++) {
            table_trial t = trial_create(c, count, (mw_value_type)type, fields);
            trial_expect(&t, threads);
            trial_release(&t);
        }
}

static void test_bits_of_interpolation(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 3, 8, 13};
    for (int sorted = 0; sorted < 2; sorted++) {
        located c = located_create(20000, sorted);
        for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
            for (uint32_t threads = 1; threads < 4; threads++) located_try(&c, counts[i], threads);
        located_release(&c);
    }
}

/* Rows longer than a tile, results larger than caches, beginning at odd addresses. */
static void test_long_rows(void **state)
{
    (void)state;
    located c = located_create(8500, false);
    located_try(&c, 301, 2);
    located_try(&c, 512, 1);
    located_release(&c);
}

static void test_description_and_copy(void **state)
{
    (void)state;
    located c = located_create(5000, false);
    mw_operator_info info;
    mw_operator_describe(c.weights, &info);
    uint64_t *first = malloc((c.n + 1) * sizeof *first), entries = 0;
    uint32_t *column = malloc(info.entries * sizeof *column), empty = 0;
    double *weight = malloc(info.entries * sizeof *weight);
    mw_operator_copy(c.weights, first, NULL, NULL);
    mw_operator_copy(c.weights, first, column, weight);
    for (size_t i = 0; i < c.n; i++) {
        uint32_t v[3] = {0};
        assert_true(first[i] == entries);
        if (c.at[i].triangle == MW_NONE) empty++;
        if (c.at[i].triangle != MW_NONE) mw_mesh_triangle(c.mesh, c.at[i].triangle, v);
        for (int k = 0; k < 3 && c.at[i].triangle != MW_NONE; k++) {
            if (c.at[i].weight[k] == 0) continue;
            assert_int_equal(column[entries], v[k]);
            assert_true(weight[entries++] == c.at[i].weight[k]);
        }
    }
    assert_true(first[c.n] == entries && info.entries == entries);
    assert_int_equal(info.rows, c.n);
    assert_int_equal(info.columns, c.vertices);
    assert_int_equal(info.empty_rows, empty);
    assert_true(empty > 0);
    assert_int_equal(info.widest, 3);
    assert_true(info.bytes >= 36 * c.n && info.bytes <= 40 * c.n + 200);
    free(first);
    free(column);
    free(weight);
    located_release(&c);
}

/* --- from entries ----------------------------------------------------------------------------- */

enum { ROWS = 300, COLUMNS = 40, FIELDS = 5 };

/* Entries of whole numbers, as a full matrix too. */
typedef struct whole_entries {
    uint32_t *row, *column, count;
    double *weight, full[ROWS][COLUMNS], values[COLUMNS * FIELDS], points[ROWS * FIELDS];
} whole_entries;

static whole_entries entries_make(uint32_t count, uint32_t base)
{
    uint64_t random = environment_seed(32);
    whole_entries e = {.row = malloc(count * sizeof(uint32_t)),
                       .column = malloc(count * sizeof(uint32_t)),
                       .count = count,
                       .weight = malloc(count * sizeof(double))};
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t row = (uint32_t)(random_unit(&random) * (ROWS - 20)),
                       column = (uint32_t)(random_unit(&random) * (COLUMNS - 5));
        e.weight[i] = floor(random_unit(&random) * 9) - 4; /* some are 0 */
        e.full[row][column] += e.weight[i];
        e.row[i] = row + base;
        e.column[i] = column + base;
    }
    for (int i = 0; i < COLUMNS * FIELDS; i++) e.values[i] = floor(random_unit(&random) * 1000);
    for (int i = 0; i < ROWS * FIELDS; i++) e.points[i] = floor(random_unit(&random) * 1000);
    return e;
}

static void entries_free(whole_entries *e)
{
    free(e->row);
    free(e->column);
    free(e->weight);
}

static mw_operator_entries entries_view(const whole_entries *e, uint32_t base)
{
    return (mw_operator_entries){.row = e->row,
                                 .column = e->column,
                                 .weight = e->weight,
                                 .count = e->count,
                                 .rows = ROWS,
                                 .columns = COLUMNS,
                                 .base = base};
}

static bool row_has_entries(const whole_entries *e, uint32_t row)
{
    for (uint32_t i = 0; i < e->count; i++)
        if (e->row[i] == row && e->weight[i] != 0) return true;
    return false;
}

static bool column_has_entries(const whole_entries *e, uint32_t column)
{
    for (uint32_t i = 0; i < e->count; i++)
        if (e->column[i] == column && e->weight[i] != 0) return true;
    return false;
}

static void entries_expect(const whole_entries *e, const mw_operator *weights, bool fields,
                           bool zero)
{
    double result[ROWS * FIELDS];
    mw_error error;
    mw_value_table table = {.values = e->values, .count = FIELDS, .step = fields ? COLUMNS : 1};
    mw_operator_apply_options options = {.zero_empty = zero};
    expect_ok(mw_operator_apply(weights, &table, &options, result, &error), "apply", &error);
    for (uint32_t i = 0; i < ROWS; i++)
        for (uint32_t k = 0; k < FIELDS; k++) {
            double want = 0;
            for (uint32_t j = 0; j < COLUMNS; j++)
                want += e->full[i][j] * e->values[fields ? k * COLUMNS + j : j * FIELDS + k];
            if (!zero && !row_has_entries(e, i)) want = NAN;
            assert_true(same_bits(want, result[fields ? k * ROWS + i : i * FIELDS + k]));
        }
}

static void transpose_expect(const whole_entries *e, const mw_operator *weights, bool zero)
{
    double result[COLUMNS * FIELDS];
    mw_error error;
    mw_operator *turned;
    mw_value_table table = {.values = e->points, .count = FIELDS};
    mw_operator_apply_options options = {.zero_empty = zero};
    expect_ok(mw_operator_transpose(weights, NULL, &turned, &error), "a transpose", &error);
    expect_ok(mw_operator_apply(turned, &table, &options, result, &error), "apply", &error);
    for (uint32_t j = 0; j < COLUMNS; j++)
        for (uint32_t k = 0; k < FIELDS; k++) {
            double want = 0;
            for (uint32_t i = 0; i < ROWS; i++) want += e->full[i][j] * e->points[i * FIELDS + k];
            if (!zero && !column_has_entries(e, j)) want = NAN;
            assert_true(same_bits(want, result[j * FIELDS + k]));
        }
    mw_operator_destroy(turned);
}

/* Few entries a row, and many; rows and columns numbered from 0 and from 1. */
static void test_entries(void **state)
{
    (void)state;
    static const uint32_t counts[] = {0, 1, 150, 4000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        const uint32_t base = c % 2;
        whole_entries e = entries_make(counts[c], base);
        mw_operator_entries view = entries_view(&e, base);
        mw_operator *weights;
        mw_error error;
        expect_ok(mw_operator_create_from_entries(&view, NULL, &weights, &error), "weights",
                  &error);
        for (uint32_t i = 0; i < e.count; i++) {
            e.row[i] -= base;
            e.column[i] -= base;
        }
        for (int i = 0; i < 4; i++) entries_expect(&e, weights, i & 1, i & 2);
        transpose_expect(&e, weights, false);
        transpose_expect(&e, weights, true);
        mw_operator_destroy(weights);
        entries_free(&e);
    }
}

/* One row more than threads take at a time, and one less: each row is applied. */
static void test_many_rows(void **state)
{
    (void)state;
    for (uint32_t rows = 16383; rows <= 16385; rows++) {
        uint32_t *row = malloc(2 * rows * sizeof *row);
        double *weight = malloc(2 * (size_t)rows * sizeof *weight), *result = weight + rows;
        assert_true(row && weight);
        for (uint32_t i = 0; i < rows; i++) {
            row[i] = i;
            row[rows + i] = 0;
            weight[i] = i + 1;
            result[i] = -1;
        }
        mw_operator *weights;
        mw_error error;
        const mw_operator_entries entries = {.row = row,
                                             .column = row + rows,
                                             .weight = weight,
                                             .count = rows,
                                             .rows = rows,
                                             .columns = 1};
        expect_ok(mw_operator_create_from_entries(&entries, NULL, &weights, &error), "rows",
                  &error);
        const mw_value_table table = {.values = (double[]){2}, .count = 1};
        expect_ok(mw_operator_apply(weights, &table, NULL, result, &error), "apply", &error);
        for (uint32_t i = 0; i < rows; i++) assert_true(result[i] == 2.0 * (i + 1));
        mw_operator_destroy(weights);
        free(weight);
        free(row);
    }
}

static void test_bad_entries(void **state)
{
    (void)state;
    static const struct {
        uint32_t row, column, base;
        double weight;
        const char *message;
    } bad[] = {
        {3, 0, 0, 1, "entry 1: there is no row 3; there are 3, from 0"},
        {0, 1, 1, 1, "entry 1: there is no row 0; there are 3, from 1"},
        {4, 1, 1, 1, "entry 1: there is no row 4; there are 3, from 1"},
        {0, 2, 0, 1, "entry 1: there is no column 2; there are 2, from 0"},
        {1, 0, 1, 1, "entry 1: there is no column 0; there are 2, from 1"},
        {1, 1, 0, NAN, "entry 1: the weight nan is not finite"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const uint32_t row[2] = {1, bad[i].row}, column[2] = {1, bad[i].column};
        const double weight[2] = {1, bad[i].weight};
        mw_operator_entries entries = {row, column, weight, 2, 3, 2, bad[i].base};
        mw_operator *weights = (mw_operator *)1;
        mw_error error;
        assert_int_equal(mw_operator_create_from_entries(&entries, NULL, &weights, &error),
                         MW_ERROR_INPUT);
        assert_string_equal(error.message, bad[i].message);
        assert_null(weights);
    }
}

/* --- missing values --------------------------------------------------------------------------- */

static void test_missing(void **state)
{
    (void)state;
    const uint32_t row[] = {0, 0, 0, 1, 1, 3, 3}, column[] = {0, 1, 2, 1, 3, 0, 2};
    const double weight[] = {0.5, 0.25, 0.25, 0.5, 0.5, 0.75, 0.25},
                 values[] = {8, NAN, 4, NAN, 1, 2, 3, 4};
    mw_operator_entries entries = {row, column, weight, 7, 4, 4, 0};
    mw_operator *weights;
    mw_error error;
    expect_ok(mw_operator_create_from_entries(&entries, NULL, &weights, &error), "weights", &error);
    double result[8];
    mw_value_table one = {.values = values, .count = 1}, two = {.values = values, .count = 2};
    mw_operator_apply_options leave = {.missing = MW_MISSING_LEFT_OUT};
    expect_ok(mw_operator_apply(weights, &one, NULL, result, &error), "apply", &error);
    assert_true(isnan(result[0]) && isnan(result[1]) && isnan(result[2]) && result[3] == 7);
    expect_ok(mw_operator_apply(weights, &one, &leave, result, &error), "apply", &error);
    assert_true(result[0] == 5 / 0.75 && isnan(result[1]) && isnan(result[2]) && result[3] == 7);
    two.stride = 2;
    expect_ok(mw_operator_apply(weights, &two, &leave, result, &error), "apply", &error);
    assert_true(result[0] == 5.25 && result[1] == 2 && isnan(result[4]));
    assert_true(result[2] == 3.5 && result[3] == 4 && result[6] == 6.25 && result[7] == 2);
    mw_operator_destroy(weights);
}

/* --- arguments -------------------------------------------------------------------------------- */

static void test_arguments(void **state)
{
    (void)state;
    located c = located_create(100, false);
    mw_operator *out = NULL;
    mw_error error;
    double result[100] = {0}, *values = calloc(c.vertices, sizeof *values);
    mw_value_table good = {.values = values, .count = 1}, unknown = good, tight = good,
                   none = {.count = 1}, zero = {0};
    mw_location strange = c.at[0];
    unknown.type = (mw_value_type)2;
    tight.count = 3;
    tight.stride = 2;
    assert_int_equal(mw_operator_apply(c.weights, &zero, NULL, NULL, &error), MW_OK);
    assert_int_equal(mw_operator_apply(NULL, &good, NULL, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_apply(c.weights, NULL, NULL, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_apply(c.weights, &none, NULL, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_apply(c.weights, &good, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_apply(c.weights, &unknown, NULL, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_apply(c.weights, &tight, NULL, result, &error), MW_ERROR_ARGUMENT);
    tight.step = 1;
    assert_int_equal(mw_operator_apply(c.weights, &tight, NULL, result, &error), MW_ERROR_ARGUMENT);
    mw_operator_apply_options rule = {.missing = (mw_missing_rule)9}, reserved = {.reserved = {1}};
    assert_int_equal(mw_operator_apply(c.weights, &good, &rule, result, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_apply(c.weights, &good, &reserved, result, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create(c.mesh, c.at, 0, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create(c.mesh, NULL, 1, NULL, &out, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create(NULL, c.at, 1, NULL, &out, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create(c.mesh, c.at, MW_NONE, NULL, &out, &error), MW_ERROR_LIMIT);
    strange.triangle = mw_mesh_triangle_count(c.mesh);
    assert_int_equal(mw_operator_create(c.mesh, &strange, 1, NULL, &out, &error),
                     MW_ERROR_ARGUMENT);
    assert_null(out);
    assert_int_equal(mw_operator_transpose(NULL, NULL, &out, &error), MW_ERROR_ARGUMENT);
    mw_operator_entries tall = {.rows = MW_NONE}, third = {.base = 2}, absent = {.count = 1};
    assert_int_equal(mw_operator_create_from_entries(&tall, NULL, &out, &error), MW_ERROR_LIMIT);
    assert_int_equal(mw_operator_create_from_entries(&third, NULL, &out, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create_from_entries(&absent, NULL, &out, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create(c.mesh, c.at, 0, NULL, &out, &error), MW_OK);
    assert_int_equal(mw_operator_apply(out, &good, NULL, NULL, &error), MW_OK);
    mw_operator_destroy(out);
    free(values);
    located_release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bits_of_interpolation),
        cmocka_unit_test(test_long_rows),
        cmocka_unit_test(test_description_and_copy),
        cmocka_unit_test(test_entries),
        cmocka_unit_test(test_many_rows),
        cmocka_unit_test(test_bad_entries),
        cmocka_unit_test(test_missing),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
