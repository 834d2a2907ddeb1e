/* coordinates.h - equal coordinates of points in space, for tables of them. Private. */
#ifndef MW_SRC_BASE_COORDINATES_H
#define MW_SRC_BASE_COORDINATES_H

#include "base/posix.h"
#include "base/random.h"

#include <string.h>

/* Differs from run to run, and from table to table, so that no points can be made to collide. */
static inline uint64_t mw__coordinates_seed(const void *table)
{
    struct timespec time;
    clock_gettime(CLOCK_REALTIME, &time);
    return mw__mix((uint64_t)time.tv_nsec ^ (uintptr_t)table);
}

/* The bits of a coordinate, with those of 0.0 for -0.0. */
static MW_INLINE uint64_t mw__coordinate_bits(double x)
{
    uint64_t bits;
    x += 0.0;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static MW_INLINE uint64_t mw__coordinates_hash(uint64_t seed, const double xyz[3])
{
    uint64_t h = seed;
    for (int k = 0; k < 3; k++) h = mw__mix(h ^ mw__coordinate_bits(xyz[k]));
    return h;
}

#endif
