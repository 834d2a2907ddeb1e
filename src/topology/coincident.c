/* coincident.c - finds coincident vertices by an open hash table, at most half full. */
#include "topology/coincident.h"
#include "base/coordinates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct coincident_table {
    uint32_t *vertex; /* per entry a vertex, or MW_NONE */
    uint64_t mask;
    uint64_t seed; /* does not change the result */
} coincident_table;

/* The lowest vertex that coincides with vertex v. If there is none before v, enters v and returns
 * it. */
static uint32_t coincident_find_lowest(coincident_table *table, const double *point, uint32_t v)
{
    const double *p = point + 3 * (size_t)v;
    for (uint64_t i = mw__coordinates_hash(table->seed, p);; i++) {
        uint32_t *vertex = &table->vertex[i & table->mask];
        if (*vertex == MW_NONE) return *vertex = v;
        const double *q = point + 3 * (size_t)*vertex;
        if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) return *vertex;
    }
}

uint32_t *mw__coincident_create(const double *point, uint32_t count)
{
    size_t size = 2;
    while (size < 2 * (size_t)count) size *= 2;
    uint32_t *representative = mw__alloc(count, sizeof *representative);
    coincident_table table = {.vertex = mw__alloc(size, sizeof *table.vertex), .mask = size - 1};
    if (!representative || !table.vertex) {
        free(representative);
        free(table.vertex);
        return NULL;
    }
    memset(table.vertex, 0xff, size * sizeof *table.vertex);
    table.seed = mw__coordinates_seed(table.vertex);
    for (uint32_t v = 0; v < count; v++) {
        const double *p = point + 3 * (size_t)v;
        bool finite = isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
        representative[v] = finite ? coincident_find_lowest(&table, point, v) : v;
    }
    free(table.vertex);
    return representative;
}
