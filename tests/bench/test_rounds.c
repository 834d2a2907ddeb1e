/* test_rounds.c - the loop of interleaved rounds (bench/core): who runs when, which figures count,
 * medians and minima. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "bench/core/query_rounds.h"
#include "bench/core/rounds.h"

#include <math.h>
#include <string.h>

/* What ran, in order: entries as letters, a blank after each turn. */
typedef struct runs_seen {
    char order[256];
    size_t length, entries, turns;
    size_t fails_at; /* the run that fails; 0: none */
} runs_seen;

static double figure_of(size_t entry, size_t round, size_t figure)
{
    static const double by_round[] = {5, 1, 4, 2, 3};
    return 100 * (double)entry + 10 * (double)figure + by_round[round];
}

static int note_run(void *self, size_t entry, size_t round, double *figures)
{
    runs_seen *seen = self;
    seen->order[seen->length++] = (char)('a' + entry);
    if (seen->fails_at && ++seen->turns == seen->fails_at) return 7;
    if ((seen->length + 1) % (seen->entries + 1) == 0) seen->order[seen->length++] = ' ';
    for (size_t f = 0; f < 2; f++)
        figures[f] = round == ROUNDS_WARMUP ? -1e9 : figure_of(entry, round, f);
    return 0;
}

static void test_order(void **state)
{
    (void)state;
    rounds_results results;
    runs_seen seen = {.entries = 3};
    rounds_plan plan = {.entries = 3, .figures = 2, .warmups = 1, .rounds = 3};
    assert_int_equal(rounds_measure(&plan, note_run, &seen, &results), 0);
    assert_string_equal(seen.order, "abc bca cab abc ");
    rounds_release(&results);
}

/* Leaders keep their places, the others take turns. */
static void test_leaders(void **state)
{
    (void)state;
    for (size_t leaders = 1; leaders <= 3; leaders++) {
        static const char *const orders[] = {"abc acb abc acb ", "abc abc abc abc ",
                                             "abc abc abc abc "};
        rounds_results results;
        runs_seen seen = {.entries = 3};
        rounds_plan plan = {.entries = 3, .leaders = leaders, .figures = 2, .rounds = 4};
        assert_int_equal(rounds_measure(&plan, note_run, &seen, &results), 0);
        assert_string_equal(seen.order, orders[leaders - 1]);
        rounds_release(&results);
    }
}

/* Those of the warm-up rounds count for nothing. */
static void test_figures(void **state)
{
    (void)state;
    for (size_t rounds = 1; rounds <= 5; rounds++) {
        static const double medians[] = {5, 3, 4, 3, 3}, minima[] = {5, 1, 1, 1, 1};
        rounds_results results;
        runs_seen seen = {.entries = 2};
        rounds_plan plan = {.entries = 2, .figures = 2, .warmups = 2, .rounds = rounds};
        assert_int_equal(rounds_measure(&plan, note_run, &seen, &results), 0);
        for (size_t entry = 0; entry < 2; entry++)
            for (size_t f = 0; f < 2; f++) {
                double base = figure_of(entry, 0, f) - 5;
                assert_true(rounds_median(&results, entry, f) == base + medians[rounds - 1]);
                assert_true(rounds_minimum(&results, entry, f) == base + minima[rounds - 1]);
                for (size_t round = 0; round < rounds; round++)
                    assert_true(results.values[(2 * entry + f) * rounds + round] ==
                                figure_of(entry, round, f));
            }
        rounds_release(&results);
    }
}

static void test_failure(void **state)
{
    (void)state;
    rounds_results results;
    runs_seen seen = {.entries = 3, .fails_at = 5};
    rounds_plan plan = {.entries = 3, .figures = 2, .rounds = 3};
    assert_int_equal(rounds_measure(&plan, note_run, &seen, &results), 7);
    assert_string_equal(seen.order, "abc bc");
    rounds_release(&results);
    assert_null(results.values);
}

static int no_figure(void *self, size_t entry, size_t round, double *figures)
{
    (void)self;
    *figures = entry == 0 || round == 1 ? NAN : (double)round;
    return 0;
}

/* An entry without figures, and one that has some, which come first. */
static void test_missing(void **state)
{
    (void)state;
    rounds_results results;
    rounds_plan plan = {.entries = 2, .figures = 1, .rounds = 3};
    assert_int_equal(rounds_measure(&plan, no_figure, NULL, &results), 0);
    assert_true(isnan(rounds_median(&results, 0, 0)));
    assert_true(rounds_median(&results, 1, 0) == 2);
    assert_true(rounds_minimum(&results, 1, 0) == 0);
    rounds_release(&results);
}

typedef struct shares_seen {
    size_t begin[2][TIMED_ROUNDS + 1], runs[2];
} shares_seen;

static int note_share(void *self, size_t entry, size_t begin, size_t count, double *microseconds)
{
    shares_seen *seen = self;
    assert_int_equal(count, 3);
    seen->begin[entry][seen->runs[entry]++] = begin;
    *microseconds = (double)begin + (double)entry;
    return 0;
}

/* The warm-up takes the first share, round k share k. */
static void test_query_rounds(void **state)
{
    (void)state;
    double medians[2];
    shares_seen seen = {0};
    static const size_t begin[TIMED_ROUNDS + 1] = {0, 0, 3, 6, 9, 12};
    assert_int_equal(query_rounds_measure(2, 3, note_share, &seen, medians), 0);
    for (size_t entry = 0; entry < 2; entry++) {
        assert_memory_equal(seen.begin[entry], begin, sizeof begin);
        assert_true(medians[entry] == 6 + (double)entry);
    }
    assert_int_equal(query_rounds_share(3), 1);
    assert_int_equal(query_rounds_share(100), 20);
    assert_int_equal(query_rounds_share(UINT64_MAX), TIMED_QUERIES / TIMED_ROUNDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),   cmocka_unit_test(test_leaders),
        cmocka_unit_test(test_figures), cmocka_unit_test(test_failure),
        cmocka_unit_test(test_missing), cmocka_unit_test(test_query_rounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
