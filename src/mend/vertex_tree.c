#include "mend/vertex_tree.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

bool mw__vertex_list_add(mw_vertex_list *list, uint32_t vertex)
{
    if (list->count == list->capacity) {
        uint32_t most = UINT32_MAX / 2, capacity = list->capacity ? 2 * list->capacity : 16;
        if (list->capacity > most) capacity = UINT32_MAX;
        uint32_t *more = mw__realloc(list->vertex, capacity, sizeof *more);
        if (!more) return false;
        list->vertex = more;
        list->capacity = capacity;
    }
    list->vertex[list->count++] = vertex;
    return true;
}

void mw__vertex_list_release(mw_vertex_list *list)
{
    free(list->vertex);
    *list = (mw_vertex_list){0};
}

/* --- building --- */

/* Does vertex a come before b? Equal coordinates go by their numbers, so that no input makes the
 * search for the middle slow. */
static bool vertex_before(const mw_mend_work *w, size_t axis, uint32_t a, uint32_t b)
{
    double x = mw__mend_point(w, a)[axis], y = mw__mend_point(w, b)[axis];
    return x < y || (x == y && a < b);
}

/* Put the vertex that is number `middle` of those from..to - 1 in its place, lower ones before it
 * (quickselect, Hoare 1961). */
static void vertices_select(const mw_mend_work *w, uint32_t *v, uint32_t from, uint32_t to,
                            uint32_t middle, size_t axis)
{
    uint64_t random = to;
    while (to - from > 1) {
        uint32_t pivot = v[from + mw__random_below(&random, to - from)], low = from, high = to - 1;
        while (low <= high) {
            while (vertex_before(w, axis, v[low], pivot)) low++;
            while (vertex_before(w, axis, pivot, v[high])) high--;
            if (low > high) break;
            mw__swap(&v[low], &v[high]);
            low++;
            if (high == 0) break;
            high--;
        }
        if (middle <= high)
            to = high + 1;
        else if (middle >= low)
            from = low;
        else
            return;
    }
}

static void vertices_part(const mw_mend_work *w, uint32_t *v, uint32_t from, uint32_t to,
                          size_t axis)
{
    while (to - from > 1) {
        uint32_t middle = from + (to - from) / 2;
        vertices_select(w, v, from, to, middle, axis);
        axis = (axis + 1) % w->dimension;
        vertices_part(w, v, from, middle, axis);
        from = middle + 1;
    }
}

mw_vertex_tree mw__vertex_tree_create(const mw_mend_work *work, mw_vertex_list *list)
{
    mw_vertex_tree tree = {work, list->vertex, list->count};
    *list = (mw_vertex_list){0};
    vertices_part(work, tree.vertex, 0, tree.count, 0);
    return tree;
}

void mw__vertex_tree_release(mw_vertex_tree *tree)
{
    free(tree->vertex);
    *tree = (mw_vertex_tree){0};
}

/* --- searching --- */

typedef struct vertex_search {
    const mw_vertex_tree *tree;
    const double *low, *high;
    mw_vertex_list *list;
} vertex_search;

static bool vertex_in_box(const vertex_search *s, const double *p)
{
    for (size_t k = 0; k < s->tree->work->dimension; k++)
        if (p[k] < s->low[k] || p[k] > s->high[k]) return false;
    return true;
}

static bool vertex_search_range(const vertex_search *s, uint32_t from, uint32_t to, size_t axis)
{
    while (from < to) {
        uint32_t middle = from + (to - from) / 2, v = s->tree->vertex[middle];
        const double *p = mw__mend_point(s->tree->work, v);
        size_t next = (axis + 1) % s->tree->work->dimension;
        if (vertex_in_box(s, p) && !mw__vertex_list_add(s->list, v)) return false;
        bool below = s->low[axis] <= p[axis], above = s->high[axis] >= p[axis];
        if (below && above && !vertex_search_range(s, from, middle, next)) return false;
        if (above)
            from = middle + 1;
        else
            to = middle;
        axis = next;
    }
    return true;
}

bool mw__vertex_tree_find(const mw_vertex_tree *tree, const double low[3], const double high[3],
                          mw_vertex_list *list)
{
    vertex_search search = {tree, low, high, list};
    list->count = 0;
    return vertex_search_range(&search, 0, tree->count, 0);
}

void mw__vertex_box(const mw_mend_work *work, uint32_t a, uint32_t b, double low[3], double high[3])
{
    const double *p = mw__mend_point(work, a), *q = mw__mend_point(work, b);
    for (size_t k = 0; k < work->dimension; k++) {
        low[k] = fmin(p[k], q[k]);
        high[k] = fmax(p[k], q[k]);
        if (work->tolerance == 0) continue;
        low[k] = nextafter(low[k] - work->tolerance, -INFINITY);
        high[k] = nextafter(high[k] + work->tolerance, INFINITY);
    }
}
