/* sight_oracle.h - lines of sight by brute force over all triangles, in exact rationals (GMP). */
#ifndef MW_TESTS_ORACLE_SIGHT_SIGHT_ORACLE_H
#define MW_TESTS_ORACLE_SIGHT_SIGHT_ORACLE_H

#include <meshwalk/sight.h>

/* Triangles with heights, which may be NaN. */
typedef struct sight_terrain {
    const double *points, *heights;
    const uint32_t *triangles;
    uint32_t count;
} sight_terrain;

/* Is there ground at an end, and is the end at or above it? -1: there is none, 0: below, 1. */
int sight_oracle_end(const sight_terrain *terrain, const mw_sight_end *end);

/* What a line between two ends is, neither of which lies below the ground: one that is not absolute
 * has some. */
mw_sight_state sight_oracle(const sight_terrain *terrain, const mw_sight_end *from,
                            const mw_sight_end *to);

#endif
