#include "mend/mend_work.h"

#include <stdlib.h>

bool mw__mend_note(mw_mend_work *w, mw_mend_change_kind kind, uint32_t triangle, uint32_t vertex,
                   uint32_t other)
{
    if (w->change_count == w->change_capacity) {
        size_t capacity = w->change_capacity ? 2 * w->change_capacity : 64;
        mw_mend_change *more = mw__realloc(w->changes, capacity, sizeof *more);
        if (!more) return false;
        w->changes = more;
        w->change_capacity = capacity;
    }
    w->changes[w->change_count++] = (mw_mend_change){kind, triangle, vertex, other};
    return true;
}

static int compare_mend_edges(const void *left, const void *right)
{
    const mw_mend_edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return (a->half > b->half) - (a->half < b->half);
}

mw_mend_edge *mw__mend_edges(const mw_mend_work *w, size_t *count)
{
    *count = 0;
    mw_mend_edge *edge = mw__alloc(3 * w->count, sizeof *edge);
    for (uint32_t t = 0; edge && t < w->count; t++) {
        const uint32_t *v = w->triangle[t].v;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t a = v[k], b = v[(k + 1) % 3];
            edge[(*count)++] = (mw_mend_edge){a < b ? a : b, a < b ? b : a, 4 * t + k};
        }
    }
    if (edge) qsort(edge, *count, sizeof *edge, compare_mend_edges);
    return edge;
}
