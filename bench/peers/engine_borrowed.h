/* engine_borrowed.h - location in arrays that stay the caller's, as an engine; see engine.h. */
#ifndef MW_BENCH_PEERS_ENGINE_BORROWED_H
#define MW_BENCH_PEERS_ENGINE_BORROWED_H

#include "bench/peers/engine.h"

/* Neighbours are what the caller has: finding them is no part of the seconds, their check is. */
double engine_borrowed_build(const engine_mesh *mesh, unsigned threads, void **self);
/* what the view takes; the arrays are the caller's */
size_t engine_borrowed_bytes(const void *self);
void engine_borrowed_destroy(void *self);

double engine_borrowed_locate(void *self, const double *queries, size_t n, unsigned threads,
                              uint64_t *answers);
double engine_borrowed_locate_single(void *self, const double *queries, size_t n, unsigned threads,
                                     uint64_t *answers);

#endif
