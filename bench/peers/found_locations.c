#include "bench/peers/found_locations.h"
#include "bench/peers/engine.h"

#include <stdlib.h>
#include <string.h>

bool found_locations_reserve(found_locations *found, size_t n)
{
    if (n <= found->room) return true;
    free(found->at);
    found->at = malloc(n * sizeof *found->at);
    found->room = found->at ? n : 0;
    if (found->at) memset(found->at, 0xff, n * sizeof *found->at);
    return found->at;
}

void found_locations_take(const found_locations *found, size_t n, uint64_t *answers)
{
    for (size_t i = 0; i < n; i++)
        answers[i] = found->at[i].triangle == MW_NONE ? ENGINE_NONE : found->at[i].triangle;
}
