/* test_operator_groups.c - fields one after another of scattered rows and columns, in groups: the
 * bits of sums written down here, of any size, width, type, stride and number of threads; the
 * memory that calls leave to the operator; calls at the same time; calls without memory. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "support/allocations.h"

#include <meshwalk/operator.h>

enum { WIDEST = 7, LEAST = 4096 /* columns of operators that are applied in groups */ };

static uint32_t next_number(uint64_t *state, uint32_t below)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 33) % below);
}

/* Rows of 0 to `width` entries, most of them of `width`; columns anywhere. */
static mw_operator *make_scattered(uint32_t rows, uint32_t columns, uint32_t width)
{
    uint64_t seed = rows + width;
    const size_t most = (size_t)rows * width;
    uint32_t *row = malloc(most * sizeof *row), *column = malloc(most * sizeof *column);
    double *weight = malloc(most * sizeof *weight);
    mw_operator *made;
    mw_operator_entries entries = {
        .row = row, .column = column, .weight = weight, .rows = rows, .columns = columns};
    assert_true(row && column && weight);
    for (uint32_t i = 0; i < rows; i++) {
        const uint32_t count = i % 5 ? width : next_number(&seed, width + 1);
        for (uint32_t k = 0; k < count; k++, entries.count++) {
            row[entries.count] = i;
            column[entries.count] = next_number(&seed, columns);
            weight[entries.count] = (next_number(&seed, 2000) - 999.5) / 999;
        }
    }
    assert_int_equal(mw_operator_create_from_entries(&entries, NULL, &made, NULL), MW_OK);
    free(row);
    free(column);
    free(weight);
    return made;
}

/* The rows of an operator, and a table of fields. */
typedef struct fields {
    mw_operator_info info;
    uint64_t *first;
    uint32_t *column;
    double *weight;
    mw_value_table table;
    size_t size;
    char *values;
} fields;

static double value_load(const fields *f, const void *values, size_t i)
{
    return f->size == sizeof(float) ? (double)((const float *)values)[i]
                                    : ((const double *)values)[i];
}

static fields fields_make(const mw_operator *o, mw_value_type type, size_t count, size_t stride)
{
    fields f = {.size = type == MW_FLOAT32 ? sizeof(float) : sizeof(double)};
    uint64_t seed = count;
    mw_operator_describe(o, &f.info);
    const size_t step = f.info.columns * stride + 3, n = step * count;
    f.first = malloc((f.info.rows + (size_t)1) * sizeof *f.first);
    f.column = malloc((f.info.entries + 1) * sizeof *f.column);
    f.weight = malloc((f.info.entries + 1) * sizeof *f.weight);
    f.values = malloc(n * f.size);
    assert_true(f.first && f.column && f.weight && f.values);
    mw_operator_copy(o, f.first, f.column, f.weight);
    for (size_t i = 0; i < n; i++)
        if (type == MW_FLOAT32)
            ((float *)(void *)f.values)[i] = (float)next_number(&seed, 1 << 20) / 7;
        else
            ((double *)(void *)f.values)[i] = next_number(&seed, 1 << 20) / 7.0;
    f.table = (mw_value_table){f.values, type, count, stride, step};
    return f;
}

static void fields_release(fields *f)
{
    free(f->first);
    free(f->column);
    free(f->weight);
    free(f->values);
}

/* Does result i of field k have the bits of the sum of its row? */
static bool result_is_right(const fields *f, const void *result, size_t i, size_t k)
{
    double sum = f->first[i] < f->first[i + 1] ? 0 : NAN;
    for (uint64_t e = f->first[i]; e < f->first[i + 1]; e++)
        sum += f->weight[e] *
               value_load(f, f->values, k * f->table.step + f->column[e] * f->table.stride);
    const double got = value_load(f, result, k * f->info.rows + i);
    if (f->size == sizeof(float)) sum = (double)(float)sum;
    return isnan(sum) ? isnan(got) : memcmp(&sum, &got, sizeof sum) == 0;
}

static bool results_are_right(const fields *f, const void *result)
{
    for (size_t k = 0; k < f->table.count; k++)
        for (size_t i = 0; i < f->info.rows; i++)
            if (!result_is_right(f, result, i, k)) return false;
    return true;
}

/* The results begin at any address. */
static bool apply_is_right(const mw_operator *o, const fields *f, uint32_t threads)
{
    const mw_operator_apply_options options = {.threads = threads};
    const size_t bytes = (f->info.rows * f->table.count + 1) * f->size;
    char *result = malloc(bytes);
    if (!result) return false;
    memset(result, 0x55, bytes);
    const bool right = mw_operator_apply(o, &f->table, &options, result + f->size, NULL) == MW_OK &&
                       results_are_right(f, result + f->size);
    free(result);
    return right;
}

static void expect_right(const mw_operator *o, mw_value_type type, size_t count, size_t stride)
{
    static const uint32_t threads[] = {1, 2, 3, 7};
    fields f = fields_make(o, type, count, stride);
    for (int i = 0; i < 4; i++) assert_true(apply_is_right(o, &f, threads[i]));
    fields_release(&f);
}

static size_t bytes_of(const mw_operator *o)
{
    mw_operator_info info;
    mw_operator_describe(o, &info);
    return info.bytes;
}

/* Rows and columns at the edges of ranges, of runs of 64 rows, and of groups. */
static void test_sizes(void **state)
{
    static const uint32_t rows[] = {LEAST - 1,  LEAST, LEAST + 1, LEAST + 63,
                                    LEAST + 65, 16383, 16384,     16385};
    (void)state;
    for (uint32_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (uint32_t width = 3; width <= WIDEST; width += 4) {
            mw_operator *o = make_scattered(rows[i], 2 * rows[i] - i % 4, width);
            const size_t before = bytes_of(o);
            expect_right(o, i % 2 ? MW_FLOAT32 : MW_FLOAT64, 9, 1);
            assert_true(bytes_of(o) > before); /* it was a group */
            mw_operator_destroy(o);
        }
}

/* Fewer fields than a group has, more, and parts of groups; fields whose values lie apart. */
static void test_counts(void **state)
{
    static const size_t count[] = {3, 4, 7, 8, 15, 16, 17, 25};
    mw_operator *o = make_scattered(5000, 6001, 3);
    (void)state;
    for (size_t i = 0; i < sizeof count / sizeof *count; i++) {
        expect_right(o, MW_FLOAT64, count[i], 1);
        expect_right(o, MW_FLOAT32, count[i], 1);
        expect_right(o, MW_FLOAT64, count[i], 3);
        expect_right(o, MW_FLOAT32, count[i], 2);
    }
    mw_operator_destroy(o);
}

/* Rows of different widths, columns that no row uses, and the order of rows of another operator. */
static void test_transposed(void **state)
{
    mw_operator *o = make_scattered(9001, 10007, 3), *turned;
    (void)state;
    assert_int_equal(mw_operator_transpose(o, NULL, &turned, NULL), MW_OK);
    const size_t before = bytes_of(turned);
    expect_right(turned, MW_FLOAT64, 10, 1);
    expect_right(turned, MW_FLOAT32, 10, 1);
    assert_true(bytes_of(turned) > before);
    mw_operator_destroy(turned);
    mw_operator_destroy(o);
}

/* What calls leave to the operator is counted, once, and serves any number and type of fields. */
static void test_kept_memory(void **state)
{
    enum { ROWS = 5000, COLUMNS = 6000 };
    mw_operator *o = make_scattered(ROWS, COLUMNS, 3);
    const size_t before = bytes_of(o), kept = 64 * (ROWS + COLUMNS) + 4 * (COLUMNS + 3 * ROWS);
    (void)state;
    expect_right(o, MW_FLOAT64, 3, 1);
    assert_int_equal(bytes_of(o), before);
    expect_right(o, MW_FLOAT64, 9, 1);
    assert_int_equal(bytes_of(o), before + kept);
    expect_right(o, MW_FLOAT32, 33, 1);
    assert_int_equal(bytes_of(o), before + kept);
    mw_operator_destroy(o);
}

/* --- at the same time, and without memory ----------------------------------------------------- */

enum { CALLERS = 4 };

typedef struct caller {
    const mw_operator *o;
    const fields *f;
    bool right;
} caller;

static void *caller_run(void *argument)
{
    caller *c = argument;
    c->right = true;
    for (uint32_t i = 0; i < 4; i++) c->right = apply_is_right(c->o, c->f, 1 + i % 2) && c->right;
    return NULL;
}

static void test_at_the_same_time(void **state)
{
    mw_operator *o = make_scattered(4500, 5000, 3);
    fields f = fields_make(o, MW_FLOAT64, 10, 1);
    caller callers[CALLERS];
    pthread_t thread[CALLERS];
    const size_t before = bytes_of(o);
    (void)state;
    for (int i = 0; i < CALLERS; i++) {
        callers[i] = (caller){o, &f, false};
        assert_int_equal(pthread_create(&thread[i], NULL, caller_run, &callers[i]), 0);
    }
    for (int i = 0; i < CALLERS; i++) assert_int_equal(pthread_join(thread[i], NULL), 0);
    for (int i = 0; i < CALLERS; i++) assert_true(callers[i].right);
    assert_int_equal(bytes_of(o), before + 64 * (4500 + 5000) + 4 * (5000 + 3 * 4500));
    fields_release(&f);
    mw_operator_destroy(o);
}

static void test_without_memory(void **state)
{
    const mw_operator_apply_options alone = {.threads = 1};
    mw_operator *o = make_scattered(4500, 5000, 3);
    fields f = fields_make(o, MW_FLOAT64, 10, 1);
    double *result = malloc(4500 * 10 * sizeof *result);
    const size_t before = bytes_of(o);
    (void)state;
    assert_non_null(result);
    for (long k = 0; k < 4; k++) {
        memset(result, 0x55, 4500 * 10 * sizeof *result);
        allocations_left = k;
        const mw_status status = mw_operator_apply(o, &f.table, &alone, result, NULL);
        allocations_left = -1;
        assert_int_equal(status, MW_OK);
        assert_true(results_are_right(&f, result));
        assert_int_equal(bytes_of(o) > before, k > 0);
    }
    free(result);
    fields_release(&f);
    mw_operator_destroy(o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sizes),
                                       cmocka_unit_test(test_counts),
                                       cmocka_unit_test(test_transposed),
                                       cmocka_unit_test(test_kept_memory),
                                       cmocka_unit_test(test_at_the_same_time),
                                       cmocka_unit_test(test_without_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
