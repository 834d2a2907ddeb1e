/* orient3d.c - the exact stage of orient3d: the determinant of the rows d - a, d - b, d - c. */
#include "predicates/big.h"
#include "predicates/expansion.h"

/* Expansions are exact for nonzero coordinates of magnitude 2^-306 to 2^339: products of three
 * differences are multiples of 2^(3 * (-306 - 52)) = 2^-1074, and six of them are at most 6 * 2^(3
 * * 340) < 2^1023. */
#define LOW 0x1p-306
#define HIGH 0x1p339

/* A term of a determinant has 16 * 2 * 2 = 64 parts, and takes room for a cross product and twice
 * its own. */
#define TERM_PARTS 64
#define TERM_ROOM (MW_CROSS_ROOM + 2 * TERM_PARTS)

/* v: a, b, c, d, three coordinates each. */
static double orient3d_with_expansions(const double v[12])
{
    double room[18 + 3 * TERM_ROOM + 5 * TERM_PARTS];
    mw_arena arena = {room};
    mw_expansion row[3][3], term[3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            row[i][k] = mw__expansion_difference(&arena, v[9 + k], v[3 * i + k]);
    }
    for (int i = 0; i < 3; i++) {
        const mw_expansion *p = row[(i + 1) % 3], *q = row[(i + 2) % 3];
        mw_expansion minor = mw__expansion_cross(&arena, p[0], p[1], q[0], q[1]);
        term[i] = mw__expansion_multiply(&arena, minor, row[i][2]);
    }
    mw_expansion sum = mw__expansion_add(&arena, term[0], term[1]);
    return mw__expansion_estimate(mw__expansion_add(&arena, sum, term[2]));
}

static double orient3d_with_integers(const double v[12])
{
    mw_big row[3][3], minor, term, sum = {0};
    int base = mw__big_base(v, 12);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) mw__big_difference(&row[i][k], v[9 + k], v[3 * i + k], base);
    }
    for (int i = 0; i < 3; i++) {
        const mw_big *p = row[(i + 1) % 3], *q = row[(i + 2) % 3];
        mw__big_cross(&minor, &p[0], &p[1], &q[0], &q[1]);
        mw__big_multiply(&term, &minor, &row[i][2]);
        mw__big_add(&sum, &sum, &term);
    }
    return mw__big_double(&sum, 3 * base);
}

double mw__orient3d_exact(const double a[3], const double b[3], const double c[3],
                          const double d[3])
{
    const double v[12] = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]};
    if (MW_LIKELY(mw__within(v, 12, LOW, HIGH))) return orient3d_with_expansions(v);
    return mw__all_finite(v, 12) ? orient3d_with_integers(v) : 0;
}

double mw_orient3d(const double a[3], const double b[3], const double c[3], const double d[3])
{
    return mw__orient3d(a, b, c, d);
}
