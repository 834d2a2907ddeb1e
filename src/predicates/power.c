/* power.c - the exact stage of the power test: the determinant of the rows x, y, x^2 + y^2 - w of
 * a - d, b - d, c - d; and the same on a line. */
#include "predicates/power.h"

#include "predicates/big.h"
#include "predicates/expansion.h"

/* Expansions are exact for nonzero coordinates as for incircle, and for weights whose differences
 * are within the range of squares of these: multiples of 2^(-432 - 52), at most 2^508. */
#define LOW 0x1p-216
#define HIGH 0x1p253
#define WEIGHT_LOW 0x1p-432
#define WEIGHT_HIGH 0x1p507

/* A lift has 8 + 8 + 2 parts; times a minor of 16, twice that and as much room again. */
#define LIFT_PARTS 18
#define LIFT_ROOM (2 * 16 + 16 + 2 + LIFT_PARTS)
#define POWER_PARTS (2 * LIFT_PARTS * 16)
#define POWER_ROOM (LIFT_ROOM + MW_CROSS_ROOM + 2 * POWER_PARTS)

typedef struct power_row {
    mw_expansion x, y, lift;
} power_row;

static power_row power_row_make(mw_arena *arena, const mw_weighted_point *a,
                                const mw_weighted_point *d)
{
    power_row row;
    row.x = mw__expansion_difference(arena, a->at.x, d->at.x);
    row.y = mw__expansion_difference(arena, a->at.y, d->at.y);
    mw_expansion x = mw__expansion_multiply(arena, row.x, row.x),
                 y = mw__expansion_multiply(arena, row.y, row.y);
    mw_expansion weight = mw__expansion_difference(arena, d->weight, a->weight);
    row.lift = mw__expansion_add(arena, mw__expansion_add(arena, x, y), weight);
    return row;
}

static double power_with_expansions(const mw_weighted_point p[4])
{
    double room[3 * (4 + POWER_ROOM) + 5 * POWER_PARTS];
    mw_arena arena = {room};
    power_row row[3];
    mw_expansion term[3];
    for (int i = 0; i < 3; i++) row[i] = power_row_make(&arena, &p[i], &p[3]);
    for (int i = 0; i < 3; i++) {
        const power_row *q = &row[(i + 1) % 3], *r = &row[(i + 2) % 3];
        term[i] = mw__expansion_multiply(&arena, row[i].lift,
                                         mw__expansion_cross(&arena, q->x, q->y, r->x, r->y));
    }
    mw_expansion sum = mw__expansion_add(&arena, term[0], term[1]);
    return mw__expansion_estimate(mw__expansion_add(&arena, sum, term[2]));
}

/* --- integers --- */

typedef struct power_big {
    mw_big x, y, lift;
} power_big;

/* Coordinates as integers times 2^*base, with weights as integers times 2^(2 *base). */
static int power_base(const mw_weighted_point *p, int n)
{
    double at[8], weight[4];
    bool zero = true;
    for (int i = 0; i < n; i++) {
        at[2 * i] = p[i].at.x;
        at[2 * i + 1] = p[i].at.y;
        weight[i] = p[i].weight;
        zero = zero && weight[i] == 0;
    }
    int base = mw__big_base(at, 2 * n), half = mw__big_base(weight, n);
    half = (half - (half & 1)) / 2; /* rounded down */
    return zero || base < half ? base : half;
}

static void power_big_make(power_big *row, const mw_weighted_point *a, const mw_weighted_point *d,
                           int base)
{
    mw_big square;
    mw__big_difference(&row->x, a->at.x, d->at.x, base);
    mw__big_difference(&row->y, a->at.y, d->at.y, base);
    mw__big_difference(&row->lift, d->weight, a->weight, 2 * base);
    mw__big_multiply(&square, &row->x, &row->x);
    mw__big_add(&row->lift, &row->lift, &square);
    mw__big_multiply(&square, &row->y, &row->y);
    mw__big_add(&row->lift, &row->lift, &square);
}

static double power_with_integers(const mw_weighted_point p[4])
{
    power_big row[3];
    mw_big minor, term, sum = {0};
    int base = power_base(p, 4);
    for (int i = 0; i < 3; i++) power_big_make(&row[i], &p[i], &p[3], base);
    for (int i = 0; i < 3; i++) {
        const power_big *q = &row[(i + 1) % 3], *r = &row[(i + 2) % 3];
        mw__big_cross(&minor, &q->x, &q->y, &r->x, &r->y);
        mw__big_multiply(&term, &row[i].lift, &minor);
        mw__big_add(&sum, &sum, &term);
    }
    return sum.sign;
}

static bool power_has_expansions(const mw_weighted_point *p, int n)
{
    for (int i = 0; i < n; i++) {
        double at[2] = {p[i].at.x, p[i].at.y};
        if (!mw__within(at, 2, LOW, HIGH) || !mw__within(&p[i].weight, 1, WEIGHT_LOW, WEIGHT_HIGH))
            return false;
    }
    return true;
}

double mw__power_exact(const mw_weighted_point p[4])
{
    return MW_LIKELY(power_has_expansions(p, 4)) ? power_with_expansions(p)
                                                 : power_with_integers(p);
}

/* The line through (ta, la) and (tb, lb) passes d, where t is 0, at the height (la tb - lb ta) /
 * (tb - ta); d itself has the height 0. t is x or, on a vertical line, y. */
int mw__power_on_line(const mw_weighted_point p[3])
{
    power_big row[2];
    mw_big left, right;
    int base = power_base(p, 3);
    bool vertical = p[0].at.x == p[1].at.x;
    for (int i = 0; i < 2; i++) power_big_make(&row[i], &p[i], &p[2], base);
    const mw_big *ta = vertical ? &row[0].y : &row[0].x, *tb = vertical ? &row[1].y : &row[1].x;
    mw__big_multiply(&left, &row[0].lift, tb);
    mw__big_multiply(&right, &row[1].lift, ta);
    mw__big_subtract(&left, &left, &right);
    mw__big_subtract(&right, tb, ta);
    return left.sign * right.sign;
}
