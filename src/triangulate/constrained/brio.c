/* brio.c - the random order in which segments are forced in one by one. Random rounds keep the
 * expected work small; within a round the caller's order stays, which keeps neighbours in the plane
 * near each other in memory. */
#include "triangulate/constrained/brio.h"

#include "base/random.h"

#include <stdlib.h>

enum { ROUNDS = 32 };

/* As many rounds before the last as a coin shows heads in a row. */
static uint32_t brio_draw_round(uint64_t *random)
{
    uint32_t heads = (uint32_t)mw__random(random);
    return ROUNDS - 1 - (uint32_t)__builtin_ctz(~heads | UINT32_C(1) << (ROUNDS - 1));
}

uint32_t *mw__brio_order(uint32_t n)
{
    const uint64_t seed = 1;
    uint32_t first[ROUNDS + 1] = {0}, *order = mw__alloc(n, sizeof *order);
    if (!order) return NULL;
    uint64_t random = seed;
    for (uint32_t i = 0; i < n; i++) first[brio_draw_round(&random) + 1]++;
    for (uint32_t round = 1; round < ROUNDS; round++) first[round] += first[round - 1];
    random = seed;
    for (uint32_t i = 0; i < n; i++) order[first[brio_draw_round(&random)]++] = i;
    return order;
}
