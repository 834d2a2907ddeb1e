/* location_oracle.h - point location by brute force in exact rationals (GMP): what every walk is
 * held against; and point in polygon, by all segments. */
#ifndef MW_TESTS_ORACLE_LOCATION_ORACLE_H
#define MW_TESTS_ORACLE_LOCATION_ORACLE_H

#include <meshwalk/triangulate.h>
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
bool location_oracle_contains(const double *points, const uint32_t *t, const double q[2],
                              location_answer *answer);

/* The lowest-numbered of `count` triangles (three vertices each) that contains q; MW_NONE and
 * MW_OUTSIDE where there is none (holes are not told apart), MW_BAD where q is not finite. */
location_answer location_oracle_locate(const double *points, const uint32_t *triangles,
                                       uint32_t count, const double q[2]);

typedef enum polygon_side { POLYGON_OUTSIDE, POLYGON_INSIDE, POLYGON_BORDER } polygon_side;

/* Where q lies by the segments of one polygon: on one of them, or inside where a ray to the right
 * crosses an odd number of them. Segments with equal ends do not count. Points are packed. */
polygon_side location_oracle_polygon(const mw_constraints *rings, uint32_t polygon,
                                     const double q[2]);

/* Do two segments of the polygon cross inside of both, or run along each other? */
bool location_oracle_crosses(const mw_constraints *rings, uint32_t polygon);

#endif
