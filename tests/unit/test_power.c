/* test_power.c - the power test, in its filter and both exact stages, against rationals. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "predicates/power.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <gmp.h>

/* x, y and lift of a point relative to another. */
typedef struct rational_row {
    mpq_t x, y, lift;
} rational_row;

static void row_set(rational_row *r, const mw_weighted_point *a, const mw_weighted_point *d)
{
    mpq_t t;
    mpq_init(t);
    mpq_inits(r->x, r->y, r->lift, NULL);
    mpq_set_d(r->x, a->at.x);
    mpq_set_d(t, d->at.x);
    mpq_sub(r->x, r->x, t);
    mpq_set_d(r->y, a->at.y);
    mpq_set_d(t, d->at.y);
    mpq_sub(r->y, r->y, t);
    mpq_set_d(r->lift, d->weight);
    mpq_set_d(t, a->weight);
    mpq_sub(r->lift, r->lift, t);
    mpq_mul(t, r->x, r->x);
    mpq_add(r->lift, r->lift, t);
    mpq_mul(t, r->y, r->y);
    mpq_add(r->lift, r->lift, t);
    mpq_clear(t);
}

static void row_clear(rational_row *r)
{
    mpq_clears(r->x, r->y, r->lift, NULL);
}

static int rational_power(const mw_weighted_point p[4])
{
    rational_row row[3];
    mpq_t sum, left, right;
    mpq_inits(sum, left, right, NULL);
    for (int i = 0; i < 3; i++) row_set(&row[i], &p[i], &p[3]);
    for (int i = 0; i < 3; i++) {
        const rational_row *q = &row[(i + 1) % 3], *r = &row[(i + 2) % 3];
        mpq_mul(left, q->x, r->y);
        mpq_mul(right, r->x, q->y);
        mpq_sub(left, left, right);
        mpq_mul(left, left, row[i].lift);
        mpq_add(sum, sum, left);
    }
    int sign = mpq_sgn(sum);
    for (int i = 0; i < 3; i++) row_clear(&row[i]);
    mpq_clears(sum, left, right, NULL);
    return sign;
}

/* By the height at d of the line through a and b, over x or, on a vertical line, over y. */
static int rational_power_on_line(const mw_weighted_point p[3])
{
    rational_row a, b;
    mpq_t slope, run;
    mpq_inits(slope, run, NULL);
    row_set(&a, &p[0], &p[2]);
    row_set(&b, &p[1], &p[2]);
    int vertical = mpq_equal(a.x, b.x);
    mpq_sub(run, vertical ? b.y : b.x, vertical ? a.y : a.x);
    mpq_sub(slope, b.lift, a.lift);
    mpq_div(slope, slope, run);
    mpq_mul(slope, slope, vertical ? a.y : a.x);
    mpq_sub(slope, a.lift, slope); /* the height at 0 */
    int sign = mpq_sgn(slope);
    row_clear(&a);
    row_clear(&b);
    mpq_clears(slope, run, NULL);
    return sign;
}

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* A number of one of the kinds: on a small grid, between 0 and 1, or of any size. */
static double draw_number(int kind, uint64_t *random)
{
    double u = random_unit(random);
    int exponent =
        kind < 4 ? 0
                 : (int)(random_unit(random) * (kind == 4 ? 400 : 2000)) - (kind == 4 ? 200 : 1000);
    return kind == 0   ? floor(5 * u)
           : kind == 1 ? u - 0.5
           : kind == 2 ? 1 + 0x1p-52 * floor(8 * u)
           : kind == 3 ? floor(1000 * u) * 0x1p-20
                       : ldexp(u - 0.5, exponent);
}

/* A weight that puts the point on the plane z = 0, nearly, or anywhere. */
static double draw_weight(int kind, mw_point p, uint64_t *random)
{
    double flat = p.x * p.x + p.y * p.y;
    switch ((int)(4 * random_unit(random))) {
    case 0: return isfinite(flat) ? flat : 0;
    case 1: return isfinite(flat) ? flat * (1 + 0x1p-52) : 1;
    case 2: return 0;
    default: return draw_number(kind, random);
    }
}

static void power_is_exact(void **state)
{
    const int rounds = environment_is_long() ? 1000000 : 12000;
    uint64_t random = environment_print_seed("power", 21);
    (void)state;
    for (int i = 0; i < rounds; i++) {
        mw_weighted_point p[4];
        int kind = i % 6;
        for (int k = 0; k < 4; k++) {
            p[k].at = (mw_point){draw_number(kind, &random), draw_number(kind, &random)};
            p[k].weight = draw_weight(kind, p[k].at, &random);
        }
        int want = rational_power(p);
        assert_int_equal(sign_of(mw__power_exact(p)), want);
        assert_int_equal(sign_of(mw__power(p)), want);
    }
}

/* With equal weights it is incircle. */
static void equal_weights_are_incircle(void **state)
{
    uint64_t random = environment_print_seed("power", 22);
    (void)state;
    for (int i = 0; i < 5000; i++) {
        mw_weighted_point p[4];
        double weight = draw_number(i % 4, &random);
        for (int k = 0; k < 4; k++)
            p[k] = (mw_weighted_point){{draw_number(i % 4, &random), draw_number(i % 4, &random)},
                                       weight};
        int want = sign_of(mw__incircle(p[0].at, p[1].at, p[2].at, p[3].at));
        assert_int_equal(sign_of(mw__power(p)), want);
    }
}

static void power_on_a_line_is_exact(void **state)
{
    uint64_t random = environment_print_seed("power", 23);
    (void)state;
    for (int i = 0; i < 4000; i++) {
        mw_weighted_point p[3];
        double size = ldexp(1, (int)(random_unit(&random) * 600) - 300),
               x = floor(5 * random_unit(&random)), y = floor(5 * random_unit(&random));
        if (x == 0 && y == 0) continue;
        for (int k = 0; k < 3; k++) {
            double t = floor(9 * random_unit(&random)) - 4;
            p[k].at = (mw_point){t * x * size, t * y * size};
            p[k].weight = draw_weight(i % 6, p[k].at, &random);
        }
        if (p[0].at.x == p[1].at.x && p[0].at.y == p[1].at.y) continue;
        assert_int_equal(mw__power_on_line(p), rational_power_on_line(p));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power_is_exact),
        cmocka_unit_test(equal_weights_are_incircle),
        cmocka_unit_test(power_on_a_line_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
