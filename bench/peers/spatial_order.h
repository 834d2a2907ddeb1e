/* spatial_order.h - the sort of the library's own batches, for peers that take queries in a good
 * order. */
#ifndef MW_BENCH_PEERS_SPATIAL_ORDER_H
#define MW_BENCH_PEERS_SPATIAL_ORDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Numbers of the n points along a Hilbert curve. Returns false when memory runs out. */
bool spatial_order(const double *points, size_t n, uint32_t *order);

#ifdef __cplusplus
}
#endif

#endif
