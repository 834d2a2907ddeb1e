/* length.c - the exact stage of the comparison of two lengths: the sign of |b - a|^2 - |d -
 * c|^2. */
#include "predicates/big.h"
#include "predicates/expansion.h"

/* Expansions are exact for nonzero coordinates of magnitude 2^-485 to 2^509: as in orient2d.c, but
 * that there are four products, together at most 2^1022. */
#define LOW 0x1p-485
#define HIGH 0x1p509

/* A square has at most 8 parts and takes as many while it works; a squared length has 16. */
#define SQUARE_ROOM 16
#define LENGTH_ROOM (4 + 2 * SQUARE_ROOM + 16)

/* (v0 - v1)^2 + (v2 - v3)^2 */
static mw_expansion expansion_square(mw_arena *arena, const double v[4])
{
    mw_expansion x = mw__expansion_difference(arena, v[0], v[1]),
                 y = mw__expansion_difference(arena, v[2], v[3]);
    return mw__expansion_add(arena, mw__expansion_multiply(arena, x, x),
                             mw__expansion_multiply(arena, y, y));
}

static double length_with_expansions(const double v[8])
{
    double room[2 * LENGTH_ROOM + 32];
    mw_arena arena = {room};
    mw_expansion ab = expansion_square(&arena, v), cd = expansion_square(&arena, v + 4);
    return mw__expansion_estimate(mw__expansion_subtract(&arena, ab, cd));
}

/* r = ((v0 - v1)^2 + (v2 - v3)^2) / 2^(2 base) */
static void big_square(mw_big *r, const double v[4], int base)
{
    mw_big x, y, square;
    mw__big_difference(&x, v[0], v[1], base);
    mw__big_difference(&y, v[2], v[3], base);
    mw__big_multiply(r, &x, &x);
    mw__big_multiply(&square, &y, &y);
    mw__big_add(r, r, &square);
}

static int length_with_integers(const double v[8])
{
    mw_big ab, cd;
    int base = mw__big_base(v, 8);
    big_square(&ab, v, base);
    big_square(&cd, v + 4, base);
    mw__big_subtract(&ab, &ab, &cd);
    return ab.sign;
}

int mw__compare_length_exact(mw_point a, mw_point b, mw_point c, mw_point d)
{
    const double v[8] = {b.x, a.x, b.y, a.y, d.x, c.x, d.y, c.y};
    if (MW_LIKELY(mw__within(v, 8, LOW, HIGH))) {
        double difference = length_with_expansions(v);
        return (difference > 0) - (difference < 0);
    }
    return mw__all_finite(v, 8) ? length_with_integers(v) : 0;
}
