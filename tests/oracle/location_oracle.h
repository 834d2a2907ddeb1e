/* location_oracle.h - point location by brute force in exact rationals (GMP): what every walk is
 * held against. */
#ifndef MW_TESTS_ORACLE_LOCATION_ORACLE_H
#define MW_TESTS_ORACLE_LOCATION_ORACLE_H

#include <stdbool.h>
#include <stdint.h>

/* As in mw_location: the triangle, where in it (mw_where), the local edge or vertex, 255 for
 * neither. */
typedef struct location_answer {
    uint32_t triangle;
    uint8_t where, local;
} location_answer;

/* The sign of the area of the triangle abc: 1 if it turns left. */
int location_oracle_orient(const double a[2], const double b[2], const double c[2]);

/* Is q in the triangle whose vertices are t[0..3)? A flat triangle contains nothing. If it is,
 * writes `where` and `local` of the answer. points: x y each. */
bool location_oracle_contains(const double *points, const uint32_t *t, const double q[2], location_answer *answer);

/* The lowest-numbered of `count` triangles (three vertices each) that contains q; MW_NONE and
 * MW_OUTSIDE where there is none (holes are not told apart), MW_BAD where q is not finite. */
location_answer location_oracle_locate(const double *points, const uint32_t *triangles, uint32_t count,
                                       const double q[2]);

#endif
