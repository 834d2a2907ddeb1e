#include "bench/data/dataset_random.h"

/* splitmix64 [Steele, Lea, Flood 2014]. */
uint64_t dataset_bits(uint64_t *random)
{
    uint64_t z = *random += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

double dataset_unit(uint64_t *random)
{
    return (double)(dataset_bits(random) >> 11) * 0x1p-53;
}
