/* test_operator_fields.c - many fields one after another, scattered rows and columns: the bits of
 * one field after the other, of doubles and floats, of narrow and wide rows, with missing values,
 * through windows that fit and that do not, and without memory. The same for values side by side,
 * in rows long enough to be written past the caches. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "support/allocations.h"

#include <meshwalk/operator.h>

/* Two whole groups of doubles, one of floats, and a rest; fields begin at any address. */
enum { ROWS = 70001, COLUMNS = 66003, FIELDS = 19, WIDEST = 5 };

static uint32_t next_number(uint64_t *state, uint32_t below)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 33) % below);
}

/* Rows of none to `width` entries, anywhere; or `near`: rows that follow each other read nearby
 * columns, and many in a row have `width` entries. */
static mw_operator *make_operator(uint32_t width, bool near, uint64_t seed)
{
    uint32_t *row = malloc(ROWS * WIDEST * sizeof *row), *column = malloc(ROWS * WIDEST * 4);
    double *weight = malloc(ROWS * WIDEST * sizeof *weight);
    mw_operator *made;
    mw_operator_entries entries = {
        .row = row, .column = column, .weight = weight, .rows = ROWS, .columns = COLUMNS};
    assert_true(row && column && weight);
    for (uint32_t i = 0; i < ROWS; i++) {
        const bool any = near ? i / 1000 % 3 == 0 && i % 100 == 0 : i % 7 == 0;
        const uint32_t count = any ? next_number(&seed, width + 1) : width;
        for (uint32_t k = 0; k < count; k++, entries.count++) {
            row[entries.count] = i;
            column[entries.count] =
                near ? i % (COLUMNS - 50) + next_number(&seed, 50) : next_number(&seed, COLUMNS);
            weight[entries.count] = (1 + next_number(&seed, 1000)) / 999.0;
        }
    }
    assert_int_equal(mw_operator_create_from_entries(&entries, NULL, &made, NULL), MW_OK);
    free(row);
    free(column);
    free(weight);
    return made;
}

/* Rows whose columns are `apart` from row to row, ascending if `leap` is 1; each tenth has two
 * entries alone. */
static mw_operator *make_spread_operator(uint32_t rows, uint32_t apart, uint32_t leap)
{
    uint32_t *row = malloc(3 * rows * sizeof *row), *column = malloc(3 * rows * sizeof *column);
    double *weight = malloc(3 * rows * sizeof *weight);
    mw_operator *made;
    mw_operator_entries entries = {
        .row = row, .column = column, .weight = weight, .rows = rows, .columns = rows * apart + 3};
    assert_true(row && column && weight);
    for (uint32_t i = 0; i < rows; i++)
        for (uint32_t k = 0; k < (i % 10 ? 3 : 2); k++, entries.count++) {
            row[entries.count] = i;
            column[entries.count] = (uint32_t)((uint64_t)i * leap % rows) * apart + k;
            weight[entries.count] = (1 + i % 7 + k) / 9.0;
        }
    assert_int_equal(mw_operator_create_from_entries(&entries, NULL, &made, NULL), MW_OK);
    free(row);
    free(column);
    free(weight);
    return made;
}

static void fill(void *values, mw_value_type type, size_t count)
{
    uint64_t seed = 5;
    for (size_t i = 0; i < count; i++) {
        const uint32_t number = next_number(&seed, 1000000);
        const double value = number % 97 == 0 ? NAN : number / 7.0;
        if (type == MW_FLOAT32)
            ((float *)values)[i] = (float)value;
        else
            ((double *)values)[i] = value;
    }
}

/* Round 1 has two threads, round 2 no memory. */
static void expect_equal(const mw_operator *weights, mw_value_type type, mw_missing_rule rule,
                         size_t fields, int rounds)
{
    mw_operator_info info;
    mw_operator_describe(weights, &info);
    const size_t size = type == MW_FLOAT32 ? 4 : 8, rows = info.rows, columns = info.columns;
    char *values = malloc(size * columns * fields), *all = malloc(size * rows * fields),
         *one = malloc(size * rows);
    const mw_value_table table = {values, type, fields, 0, columns};
    assert_true(values && all && one);
    fill(values, type, columns * fields);
    for (int round = 0; round < rounds; round++) {
        const mw_operator_apply_options options = {.threads = round == 1 ? 2 : 1, .missing = rule};
        memset(all, 0x55, size * rows * fields);
        allocations_left = round == 2 ? 0 : -1;
        assert_int_equal(mw_operator_apply(weights, &table, &options, all, NULL), MW_OK);
        allocations_left = -1;
        for (size_t k = 0; k < fields; k++) {
            const mw_value_table field = {values + k * columns * size, type, 1, 0, 0};
            assert_int_equal(mw_operator_apply(weights, &field, &options, one, NULL), MW_OK);
            assert_memory_equal(one, all + k * rows * size, rows * size);
        }
    }
    free(values);
    free(all);
    free(one);
}

static void test_fields(void **state)
{
    (void)state;
    for (uint32_t width = 3; width <= WIDEST; width += 2) {
        mw_operator *weights = make_operator(width, false, width);
        expect_equal(weights, MW_FLOAT64, MW_MISSING_SPREADS, FIELDS, 3);
        expect_equal(weights, MW_FLOAT32, MW_MISSING_SPREADS, FIELDS, 3);
        expect_equal(weights, MW_FLOAT64, MW_MISSING_LEFT_OUT, FIELDS, 3);
        mw_operator_destroy(weights);
    }
}

/* More results than are written into the caches, and fewer. */
static void test_near_fields(void **state)
{
    (void)state;
    for (uint32_t width = 3; width <= WIDEST; width += 2) {
        mw_operator *weights = make_operator(width, true, 2 * width);
        expect_equal(weights, MW_FLOAT64, MW_MISSING_SPREADS, 31, 3);
        expect_equal(weights, MW_FLOAT64, MW_MISSING_SPREADS, 10, 1);
        expect_equal(weights, MW_FLOAT32, MW_MISSING_SPREADS, 61, 3);
        expect_equal(weights, MW_FLOAT64, MW_MISSING_LEFT_OUT, 5, 1);
        mw_operator_destroy(weights);
    }
}

/* Windows that are full of lines before the rows end, at 3 columns a row; that do not repay, at 8;
 * that are full of pages, at 200. */
static void test_spread_fields(void **state)
{
    static const uint32_t apart[] = {3, 8, 200};
    (void)state;
    for (int i = 0; i < 3; i++) {
        mw_operator *weights = make_spread_operator(apart[i] == 200 ? 6001 : 20001, apart[i], 1);
        expect_equal(weights, MW_FLOAT64, MW_MISSING_SPREADS, 12, 2);
        expect_equal(weights, MW_FLOAT32, MW_MISSING_SPREADS, 9, 1);
        mw_operator_destroy(weights);
    }
}

/* So many scattered rows that their groups are written past the caches. */
static void test_scattered_groups(void **state)
{
    (void)state;
    mw_operator *weights = make_spread_operator(270001, 1, 7919);
    expect_equal(weights, MW_FLOAT64, MW_MISSING_SPREADS, 9, 2);
    expect_equal(weights, MW_FLOAT32, MW_MISSING_SPREADS, 17, 1);
    mw_operator_destroy(weights);
}

static void expect_rows_equal(const mw_operator *weights, mw_value_type type, size_t count)
{
    const size_t size = type == MW_FLOAT32 ? 4 : 8;
    char *values = malloc(size * COLUMNS * count), *all = malloc(size * (ROWS * count + 1)),
         *one = malloc(size * ROWS), *results = all + size; /* not at the begin of a line */
    const mw_value_table table = {values, type, count, 0, 1};
    assert_true(values && all && one);
    for (size_t i = 0; i < COLUMNS * count; i++)
        if (type == MW_FLOAT32)
            ((float *)(void *)values)[i] = (float)(i % 1000003) / 7;
        else
            ((double *)(void *)values)[i] = (double)(i % 1000003) / 7;
    assert_int_equal(mw_operator_apply(weights, &table, NULL, results, NULL), MW_OK);
    for (size_t k = 0; k < count; k += count / 3) {
        const mw_value_table field = {values + k * size, type, 1, count, 0};
        assert_int_equal(mw_operator_apply(weights, &field, NULL, one, NULL), MW_OK);
        for (size_t i = 0; i < ROWS; i++)
            assert_memory_equal(one + i * size, results + (i * count + k) * size, size);
    }
    free(values);
    free(all);
    free(one);
}

static void test_rows(void **state)
{
    (void)state;
    mw_operator *weights = make_operator(3, false, 11);
    expect_rows_equal(weights, MW_FLOAT64, 33);
    expect_rows_equal(weights, MW_FLOAT64, 5);
    expect_rows_equal(weights, MW_FLOAT32, 67);
    expect_rows_equal(weights, MW_FLOAT32, 64);
    mw_operator_destroy(weights);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fields), cmocka_unit_test(test_near_fields),
        cmocka_unit_test(test_spread_fields), cmocka_unit_test(test_scattered_groups),
        cmocka_unit_test(test_rows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
