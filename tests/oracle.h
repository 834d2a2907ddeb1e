/* oracle.h - point location by brute force in exact rationals (GMP): what every walk is held against. */
#ifndef MW_TEST_ORACLE_H
#define MW_TEST_ORACLE_H

#include <gmp.h>
#include <math.h>
#include <meshwalk/meshwalk.h>

/* Sign of the area of abc, in rationals. */
static inline int oracle_orient(const double a[2], const double b[2], const double c[2])
{
    mpq_t v[6], left, right;
    const double *from[6] = {&a[0], &a[1], &b[0], &b[1], &c[0], &c[1]};
    for (int i = 0; i < 6; i++) {
        mpq_init(v[i]);
        mpq_set_d(v[i], *from[i]);
    }
    mpq_init(left);
    mpq_init(right);
    for (int i = 0; i < 4; i++) mpq_sub(v[i], v[i], v[4 + i % 2]);
    mpq_mul(left, v[0], v[3]);
    mpq_mul(right, v[1], v[2]);
    int sign = mpq_cmp(left, right);
    for (int i = 0; i < 6; i++) mpq_clear(v[i]);
    mpq_clear(left);
    mpq_clear(right);
    return (sign > 0) - (sign < 0);
}

typedef struct oracle_answer {
    uint32_t triangle;
    uint8_t where, local;
} oracle_answer;

/* Is q in triangle t? Fills in the answer then. A flat triangle contains nothing. */
static inline int oracle_contains(const double *points, const uint32_t *t, const double q[2], oracle_answer *answer)
{
    const double *p[3] = {points + 2 * (size_t)t[0], points + 2 * (size_t)t[1], points + 2 * (size_t)t[2]};
    int turn = oracle_orient(p[0], p[1], p[2]), zeros = 0, edge = 0, off = 0;
    if (turn == 0) return 0;
    for (int k = 0; k < 3; k++) {
        int side = oracle_orient(p[k], p[(k + 1) % 3], q) * turn;
        if (side < 0) return 0;
        if (side == 0) {
            zeros++;
            edge = k;
        } else {
            off = k;
        }
    }
    answer->where = zeros == 0 ? MW_INSIDE : zeros == 1 ? MW_ON_EDGE : MW_ON_VERTEX;
    answer->local = (uint8_t)(zeros == 0 ? 255 : zeros == 1 ? edge : (off + 2) % 3);
    return 1;
}

/* The lowest-numbered triangle that contains q; MW_OUTSIDE where there is none (holes are not told apart). */
static inline oracle_answer oracle_locate(const double *points, const uint32_t *triangles, uint32_t count,
                                          const double q[2])
{
    oracle_answer answer = {MW_NONE, MW_OUTSIDE, 255};
    if (!isfinite(q[0]) || !isfinite(q[1])) return (oracle_answer){MW_NONE, MW_BAD, 255};
    for (uint32_t t = 0; t < count; t++)
        if (oracle_contains(points, triangles + 3 * (size_t)t, q, &answer)) {
            answer.triangle = t;
            break;
        }
    return answer;
}

#endif
