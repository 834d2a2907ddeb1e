/* star_oracle.h - the facet that a ray from a centre meets, by brute force in exact rationals
 * (GMP), and where the ray meets it. */
#ifndef MW_TESTS_ORACLE_STAR_ORACLE_H
#define MW_TESTS_ORACLE_STAR_ORACLE_H

#include <meshwalk/meshwalk.h>
#include <stdint.h>

/* The lowest-numbered of `count` triangles (three vertices each) that the ray from c through q
 * meets, with the place on it and rounded weights; triangle MW_NONE if there is none. Triangles
 * without an area seen from c are never met. points: x y z each. */
mw_location star_oracle_locate(const double *points, const uint32_t *triangles, uint32_t count,
                               const double c[3], const double q[3]);

/* Are the coordinates those of the point where the ray from c through q meets the plane of triangle
 * t, each rounded to the nearest double, of two as near to the even one? */
int star_oracle_is_meeting(const double *points, const uint32_t *t, const double c[3],
                           const double q[3], const double meeting[3]);

#endif
