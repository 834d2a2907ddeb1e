/* point_sets.h - sets of points that are hard to triangulate. */
#ifndef MW_TESTS_SUPPORT_POINT_SETS_H
#define MW_TESTS_SUPPORT_POINT_SETS_H

#include <stddef.h>
#include <stdint.h>

#include "mesh/mesh.h"

typedef struct point_set {
    const char *name;
    mw_point (*point)(uint64_t *random, uint32_t i, uint32_t n); /* point i of n */
    uint32_t largest; /* number of points to try; less where the exact stage decides everything */
    uint32_t visits;  /* bound for the triangles visited per point; more where no curve helps */
} point_set;

enum { POINT_SETS = 28 };

/* All sets; the first are uniform points of the unit square. */
extern const point_set point_sets[POINT_SETS];

/* The n points of the set that the seed gives. */
void point_set_fill(const point_set *s, uint64_t seed, mw_point *points, uint32_t n);

#endif
