/* test_operator_space.c - operators on surfaces, from rays, probes and nearest points: the weights
 * are those of the answers, results are sums of weight times value bit for bit, and linear fields
 * have their own values. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/environment.h"
#include "support/make_prober.h"
#include "support/meshes.h"
#include "support/solids.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>
#include <string.h>

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

enum { QUERIES = 9000 };

/* A ball with answers of each kind: rays from its centre, probes of which some miss, nearest points
 * of which some are out of reach. */
typedef struct space_answers {
    solid ball;
    mw_surface *surface;
    mw_location rays[QUERIES];
    mw_touch touches[QUERIES];
    mw_nearest_surface_point nearest[QUERIES];
} space_answers;

static space_answers *answers_make(uint64_t seed)
{
    uint64_t random = environment_seed(seed);
    space_answers *s = calloc(1, sizeof *s);
    double *q = malloc(6 * QUERIES * sizeof *q);
    mw_star *star;
    mw_error error;
    s->ball = solid_sphere(4, &random);
    s->surface = solid_surface(&s->ball, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(s->surface);
    expect_ok(mw_star_create(s->surface, NULL, &star, &error), "star", &error);
    for (int i = 0; i < 6 * QUERIES; i++) q[i] = 3 * random_unit(&random) - 1.5;
    for (uint32_t i = 0; i < 60; i++) memcpy(q + 6 * i, s->ball.points + 3 * i, 3 * sizeof *q);
    for (size_t i = 0; i < 3; i++) q[6 * 70 + i] = 0; /* the centre: no ray */
    expect_ok(mw_star_locate_batch(star, q, QUERIES, 6, NULL, s->rays, NULL, &error), "rays",
              &error);
    mw_probe_options options = {.certain = 1};
    expect_ok(mw_probe_batch(prober, q, QUERIES, 6, &options, s->touches, NULL, &error), "probes",
              &error);
    for (size_t i = 0; i < QUERIES; i++)
        expect_ok(mw_nearest_on_surface(prober, q + 6 * i, 0.5, &s->nearest[i], &error), "nearest",
                  &error);
    mw_star_destroy(star);
    mw_prober_destroy(prober);
    free(q);
    return s;
}

static void answers_release(space_answers *s)
{
    mw_surface_destroy(s->surface);
    solid_free(&s->ball);
    free(s);
}

/* The answers by kind, and record i of them. */
static mw_hits hits_of(const space_answers *s, int kind)
{
    return kind == 0   ? mw_hits_of_locations(s->rays, QUERIES)
           : kind == 1 ? mw_hits_of_touches(s->touches, QUERIES)
                       : mw_hits_of_nearest(s->nearest, QUERIES);
}

static uint32_t answer_triangle(const space_answers *s, int kind, size_t i)
{
    return kind == 0   ? s->rays[i].triangle
           : kind == 1 ? s->touches[i].triangle
                       : s->nearest[i].triangle;
}

static const double *answer_weights(const space_answers *s, int kind, size_t i)
{
    return kind == 0 ? s->rays[i].weight : kind == 1 ? s->touches[i].weight : s->nearest[i].weight;
}

static double expected_value(const space_answers *s, int kind, size_t i, const double *values)
{
    const uint32_t t = answer_triangle(s, kind, i);
    const double *w = answer_weights(s, kind, i);
    double sum = 0;
    if (t == MW_NONE) return NAN;
    for (uint32_t k = 0; k < 3; k++)
        if (w[k] != 0) sum += w[k] * values[s->ball.triangles[3 * t + k]];
    return sum;
}

static void test_bits_of_sums(void **state)
{
    space_answers *s = answers_make(71);
    const uint32_t n = s->ball.point_count;
    double *values = malloc(n * sizeof *values), *got = malloc(QUERIES * sizeof *got),
           *plain = malloc(QUERIES * sizeof *plain);
    (void)state;
    for (uint32_t v = 0; v < n; v++) values[v] = v % 97 == 3 ? NAN : sin(v) * 1e3;
    for (int kind = 0; kind < 3; kind++) {
        const mw_hits hits = hits_of(s, kind);
        size_t without = 0;
        mw_operator *weights;
        mw_error error;
        mw_operator_info info;
        mw_surface_interpolate(s->surface, values, &hits, plain);
        for (uint32_t threads = 1; threads < 4; threads++) {
            mw_operator_options options = {.threads = threads};
            const mw_value_table table = {.values = values, .count = 1};
            expect_ok(mw_operator_create_on_surface(s->surface, &hits, &options, &weights, &error),
                      "operator", &error);
            expect_ok(mw_operator_apply(weights, &table, NULL, got, &error), "apply", &error);
            for (size_t i = 0; i < QUERIES; i++) {
                const double want = expected_value(s, kind, i, values);
                assert_true(same_bits(got[i], want) && same_bits(plain[i], want));
                without += answer_triangle(s, kind, i) == MW_NONE;
            }
            mw_operator_describe(weights, &info);
            assert_int_equal(info.rows, QUERIES);
            assert_int_equal(info.columns, n);
            assert_int_equal(info.empty_rows, without / threads);
            mw_operator_destroy(weights);
        }
        assert_true(without > 0);
    }
    free(values);
    free(got);
    free(plain);
    answers_release(s);
}

/* As compressed sparse rows: the weights and corners of each answer. */
static void test_rows(void **state)
{
    space_answers *s = answers_make(72);
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        const mw_hits hits = hits_of(s, kind);
        mw_operator *weights;
        mw_operator_info info;
        mw_error error;
        expect_ok(mw_operator_create_on_surface(s->surface, &hits, NULL, &weights, &error),
                  "operator", &error);
        mw_operator_describe(weights, &info);
        uint64_t *first = malloc((QUERIES + 1) * sizeof *first), e = 0;
        uint32_t *column = malloc(info.entries * sizeof *column);
        double *weight = malloc(info.entries * sizeof *weight);
        mw_operator_copy(weights, first, column, weight);
        for (size_t i = 0; i < QUERIES; i++) {
            const uint32_t t = answer_triangle(s, kind, i);
            assert_true(first[i] == e);
            for (uint32_t k = 0; k < 3 && t != MW_NONE; k++) {
                if (answer_weights(s, kind, i)[k] == 0) continue;
                assert_int_equal(column[e], s->ball.triangles[3 * t + k]);
                assert_true(weight[e++] == answer_weights(s, kind, i)[k]);
            }
        }
        assert_true(first[QUERIES] == e && e == info.entries);
        free(first);
        free(column);
        free(weight);
        mw_operator_destroy(weights);
    }
    answers_release(s);
}

/* A field that is linear in space has its value at the place found. */
static void test_linear_fields(void **state)
{
    space_answers *s = answers_make(73);
    double *values = malloc(s->ball.point_count * sizeof *values),
           *got = malloc(QUERIES * sizeof *got);
    (void)state;
    for (uint32_t v = 0; v < s->ball.point_count; v++) {
        const double *p = s->ball.points + 3 * (size_t)v;
        values[v] = 2 * p[0] - 3 * p[1] + 5 * p[2] + 7;
    }
    for (int kind = 0; kind < 3; kind++) {
        const mw_hits hits = hits_of(s, kind);
        mw_surface_interpolate(s->surface, values, &hits, got);
        for (size_t i = 0; i < QUERIES; i++) {
            const uint32_t t = answer_triangle(s, kind, i);
            double p[3] = {0};
            if (t == MW_NONE) continue;
            for (uint32_t k = 0; k < 3; k++)
                for (uint32_t j = 0; j < 3; j++)
                    p[j] += answer_weights(s, kind, i)[k] *
                            s->ball.points[3 * s->ball.triangles[3 * t + k] + j];
            if (kind == 2)
                for (int j = 0; j < 3; j++)
                    assert_true(fabs(p[j] - s->nearest[i].point[j]) < 1e-13);
            assert_true(fabs(got[i] - (2 * p[0] - 3 * p[1] + 5 * p[2] + 7)) < 1e-12);
        }
    }
    free(values);
    free(got);
    answers_release(s);
}

static void test_refused(void **state)
{
    space_answers *s = answers_make(74);
    mw_hits hits = hits_of(s, 1), none = mw_hits_of_nearest(NULL, 5), empty = {0};
    mw_operator *weights = (mw_operator *)s;
    mw_error error;
    (void)state;
    assert_int_equal(mw_operator_create_on_surface(NULL, &hits, NULL, &weights, NULL),
                     MW_ERROR_ARGUMENT);
    assert_null(weights);
    assert_int_equal(mw_operator_create_on_surface(s->surface, NULL, NULL, &weights, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create_on_surface(s->surface, &none, NULL, &weights, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_operator_create_on_surface(s->surface, &hits, NULL, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    expect_ok(mw_operator_create_on_surface(s->surface, &empty, NULL, &weights, &error), "nothing",
              &error);
    mw_operator_destroy(weights);
    s->touches[17].triangle = s->ball.triangle_count;
    assert_int_equal(mw_operator_create_on_surface(s->surface, &hits, NULL, &weights, &error),
                     MW_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "location 17"));
    s->touches[17].triangle = 0;
    s->touches[17].weight[2] = INFINITY;
    assert_int_equal(mw_operator_create_on_surface(s->surface, &hits, NULL, &weights, &error),
                     MW_ERROR_ARGUMENT);
    answers_release(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bits_of_sums),
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_linear_fields),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
