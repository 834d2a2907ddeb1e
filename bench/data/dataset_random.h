/* dataset_random.h - the random numbers that sets of points are made of. */
#ifndef MW_BENCH_DATA_DATASET_RANDOM_H
#define MW_BENCH_DATA_DATASET_RANDOM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* 64 random bits, or a number from 0 to below 1; *random is the seed first, and goes on from call
 * to call. */
uint64_t dataset_bits(uint64_t *random);
double dataset_unit(uint64_t *random);

#ifdef __cplusplus
}
#endif

#endif
