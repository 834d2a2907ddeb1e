/* greedy_heap.h - edges that wait, the shortest first. Private. */
#ifndef MW_SRC_TRIANGULATE_KINDS_GREEDY_HEAP_H
#define MW_SRC_TRIANGULATE_KINDS_GREEDY_HEAP_H

#include "predicates/predicates.h"

typedef struct mw_greedy_edge {
    double square; /* of its length, rounded */
    uint32_t low, high;
} mw_greedy_edge;

/* All zero except for `point`: empty. Release `item` with free(). An edge may wait twice. */
typedef struct mw_greedy_heap {
    const mw_point *point;
    mw_greedy_edge *item;
    size_t count, capacity;
} mw_greedy_heap;

/* Add the edge between two vertices; false when out of memory. */
bool mw__greedy_push(mw_greedy_heap *heap, uint32_t a, uint32_t b);

/* Take out the shortest edge, compared exactly; of equal ones that with the lowest numbers, the
 * lower one of its ends first. The heap is not empty. */
mw_greedy_edge mw__greedy_pop(mw_greedy_heap *heap);

#endif
