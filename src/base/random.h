/* random.h - small random numbers: splitmix64 [Steele, Lea, Flood 2014]; a coin for walks.
 * Private. */
#ifndef MW_SRC_BASE_RANDOM_H
#define MW_SRC_BASE_RANDOM_H

#include "base/base.h"

static MW_INLINE uint64_t mw__mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static MW_INLINE uint64_t mw__random(uint64_t *state)
{
    return mw__mix(*state += UINT64_C(0x9e3779b97f4a7c15));
}

/* The state for query number `index` of a batch: the same whatever thread runs it. */
static MW_INLINE uint64_t mw__random_seed(uint64_t seed, uint64_t index)
{
    return mw__mix(seed + UINT64_C(0x9e3779b97f4a7c15) * (index + 1));
}

/* A number below n (n > 0), from the upper bits [Lemire 2019, without the rejection: bias below n /
 * 2^32]. */
static MW_INLINE uint32_t mw__random_below(uint64_t *state, uint32_t n)
{
    return (uint32_t)(((mw__random(state) >> 32) * n) >> 32);
}

/* A coin of 32 bits, by xorshift64 [Marsaglia 2003]: the state is never 0, the upper bits are the
 * good ones. */
static MW_INLINE uint64_t mw__toss(uint64_t *state)
{
    uint64_t x = *state | 1u << 7;
    x ^= x << 13;
    x ^= x >> 7;
    x ^= x << 17;
    *state = x;
    return x >> 32;
}

#endif
