/* place.c - places by an open hash table, at most half full. */
#include "mesh/place.h"
#include "base/coordinates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct place_table {
    uint32_t *slot; /* a vertex, or MW_NONE */
    uint64_t mask;
    uint64_t seed; /* results do not depend on it */
} place_table;

/* The lowest vertex at the place of vertex v; v itself, which is entered, where none came before it. */
static uint32_t find(place_table *table, const double *point, uint32_t v)
{
    const double *p = point + 3 * (size_t)v;
    for (uint64_t i = mw__coordinates_hash(table->seed, p);; i++) {
        uint32_t *slot = &table->slot[i & table->mask];
        if (*slot == MW_NONE) return *slot = v;
        const double *q = point + 3 * (size_t)*slot;
        if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) return *slot;
    }
}

uint32_t *mw__places_create(const double *point, uint32_t count)
{
    size_t size = 2;
    while (size < 2 * (size_t)count) size *= 2;
    uint32_t *place = mw__alloc(count, sizeof *place);
    place_table table = {.slot = mw__alloc(size, sizeof *table.slot), .mask = size - 1};
    if (!place || !table.slot) {
        free(place);
        free(table.slot);
        return NULL;
    }
    memset(table.slot, 0xff, size * sizeof *table.slot);
    table.seed = mw__coordinates_seed(table.slot);
    for (uint32_t v = 0; v < count; v++) {
        const double *p = point + 3 * (size_t)v;
        bool finite = isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
        place[v] = finite ? find(&table, point, v) : v;
    }
    free(table.slot);
    return place;
}
