/* clip_oracle.h - what a triangle and a convex polygon have in common, in exact rationals (GMP):
 * clipped by one edge after the other. */
#ifndef MW_TESTS_ORACLE_CLIP_ORACLE_H
#define MW_TESTS_ORACLE_CLIP_ORACLE_H

#include <stdint.h>

/* Integrals over the common part, each rounded once. */
typedef struct clip_sums {
    double area, x, y;   /* of 1, x and y */
    double above, below; /* of f - g where f > g, and of g - f where f < g */
} clip_sums;

/* The integrals over what the triangle p (x y each) and the polygon q of m corners have in common.
 * f is linear, f[i] at corner i of p; g is linear, g[0], g[1] and g[2] at corners 0, 1 and m - 1 of
 * q. NULL: 0 everywhere. Both are counter-clockwise. */
clip_sums clip_oracle_sums(const double *p, const double *f, const double *q, uint32_t m,
                           const double *g);

#endif
