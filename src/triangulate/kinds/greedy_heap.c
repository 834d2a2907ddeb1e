/* greedy_heap.c - a binary heap of edges, the shortest on top. */
#include "triangulate/kinds/greedy_heap.h"

/* The rounded squares decide nearly always. */
static bool heap_edge_precedes(const mw_greedy_heap *heap, const mw_greedy_edge *e,
                               const mw_greedy_edge *f)
{
    if (mw__surely_shorter(e->square, f->square)) return true;
    if (mw__surely_shorter(f->square, e->square)) return false;
    if (e->low != f->low || e->high != f->high) {
        const mw_point *p = heap->point;
        int order = mw__compare_length_exact(p[e->low], p[e->high], p[f->low], p[f->high]);
        if (order != 0) return order < 0;
    }
    return e->low < f->low || (e->low == f->low && e->high < f->high);
}

static bool heap_reserve(mw_greedy_heap *heap)
{
    if (heap->count < heap->capacity) return true;
    size_t capacity = 2 * heap->capacity + 64;
    mw_greedy_edge *item = mw__realloc(heap->item, capacity, sizeof *item);
    if (!item) return false;
    heap->item = item;
    heap->capacity = capacity;
    return true;
}

bool mw__greedy_push(mw_greedy_heap *heap, uint32_t a, uint32_t b)
{
    if (!heap_reserve(heap)) return false;
    mw_greedy_edge edge = {mw__square_length(heap->point[a], heap->point[b]), a < b ? a : b,
                           a < b ? b : a};
    size_t i = heap->count++;
    for (; i > 0 && heap_edge_precedes(heap, &edge, &heap->item[(i - 1) / 2]); i = (i - 1) / 2)
        heap->item[i] = heap->item[(i - 1) / 2];
    heap->item[i] = edge;
    return true;
}

mw_greedy_edge mw__greedy_pop(mw_greedy_heap *heap)
{
    mw_greedy_edge *item = heap->item, top = item[0], last = item[--heap->count];
    size_t i = 0;
    for (;;) {
        size_t child = 2 * i + 1;
        if (child + 1 < heap->count && heap_edge_precedes(heap, &item[child + 1], &item[child]))
            child++;
        if (child >= heap->count || !heap_edge_precedes(heap, &item[child], &last)) break;
        item[i] = item[child];
        i = child;
    }
    item[i] = last;
    return top;
}
