/* mend_split.c - triangles with vertices of others inside their border edges (T-junctions) are
 * split there.
 *
 * Only vertices of border edges are looked for. If triangles go all round a vertex that lies in a
 * triangle, they overlap that triangle, and no split mends that. */
#include "mend/mend_geometry.h"
#include "mend/triangle_cut.h"
#include "mend/vertex_tree.h"

#include <stdlib.h>

/* What is found in the border edges. */
typedef struct split_search {
    mw_mend_work *work;
    mw_vertex_tree tree;
    mw_vertex_list near; /* of the present edge */
    mw_cut_vertex *found;
    size_t count, capacity;
} split_search;

static bool split_search_add(split_search *s, mw_cut_vertex vertex)
{
    if (s->count == s->capacity) {
        size_t capacity = s->capacity ? 2 * s->capacity : 64;
        mw_cut_vertex *more = mw__realloc(s->found, capacity, sizeof *more);
        if (!more) return false;
        s->found = more;
        s->capacity = capacity;
    }
    s->found[s->count++] = vertex;
    return true;
}

/* Find the vertices inside one border edge. */
static bool split_search_edge(split_search *s, uint32_t half)
{
    double low[3], high[3];
    mw_mend_work *w = s->work;
    const uint32_t *v = w->triangle[half / 4].v, a = v[half % 4], b = v[(half % 4 + 1) % 3],
                   apex = v[(half % 4 + 2) % 3];
    mw__vertex_box(w, a, b, low, high);
    if (!mw__vertex_tree_find(&s->tree, low, high, &s->near)) return false;
    for (uint32_t i = 0; i < s->near.count; i++) {
        uint32_t u = s->near.vertex[i];
        if (u == a || u == b || u == apex || !mw__mend_inside_edge(w, a, b, u)) continue;
        if (!split_search_add(s, (mw_cut_vertex){half, u, mw__mend_along(w, a, b, u)}))
            return false;
    }
    return true;
}

static int compare_cut_vertices(const void *left, const void *right)
{
    const mw_cut_vertex *a = left, *b = right;
    if (a->half != b->half) return a->half < b->half ? -1 : 1;
    if (a->along != b->along) return a->along < b->along ? -1 : 1;
    return (a->vertex > b->vertex) - (a->vertex < b->vertex);
}

/* The tree of the vertices of border edges. */
static bool split_plant_tree(split_search *s, const mw_mend_edge *edge, size_t count)
{
    mw_vertex_list list = {0};
    uint8_t *seen = mw__calloc(s->work->vertex_count, 1);
    bool done = seen != NULL;
    for (size_t i = 0, run; i < count && done; i += run) {
        run = mw__mend_edge_run(edge, count, i);
        const uint32_t end[2] = {edge[i].low, edge[i].high};
        for (int k = 0; k < 2 && run == 1 && done; k++) {
            if (!seen[end[k]] && mw__mend_finite(s->work, end[k]))
                done = mw__vertex_list_add(&list, end[k]);
            seen[end[k]] = 1;
        }
    }
    free(seen);
    s->tree = mw__vertex_tree_create(s->work, &list);
    return done;
}

/* Of vertices at one point of an edge, which were not welded, only the lowest is needed. */
static void split_sort(split_search *s)
{
    size_t left = 0;
    if (s->count > 0) qsort(s->found, s->count, sizeof *s->found, compare_cut_vertices);
    for (size_t i = 0; i < s->count; i++) {
        const mw_cut_vertex *last = left ? &s->found[left - 1] : NULL;
        if (last && last->half == s->found[i].half && last->along == s->found[i].along) continue;
        s->found[left++] = s->found[i];
    }
    s->count = left;
}

static bool split_is_possible(const mw_mend_work *w, const uint32_t v[3])
{
    for (int k = 0; k < 3; k++)
        if (!mw__mend_finite(w, v[k])) return false;
    return !mw__mend_flat(w, v);
}

static bool split_find(split_search *s)
{
    size_t count;
    mw_mend_edge *edge = mw__mend_edges(s->work, &count);
    bool done = edge && split_plant_tree(s, edge, count);
    for (size_t i = 0, run; i < count && done; i += run) {
        run = mw__mend_edge_run(edge, count, i);
        const uint32_t *v = s->work->triangle[edge[i].half / 4].v;
        if (run == 1 && split_is_possible(s->work, v)) done = split_search_edge(s, edge[i].half);
        if (done) done = mw__job_step(s->work->job, i, count);
    }
    free(edge);
    if (done) split_sort(s);
    return done;
}

/* In the plane: are all parts turned like the triangle? With a tolerance a vertex may lie beyond
 * its other edges. */
static bool split_parts_are_sound(const mw_mend_work *w, const uint32_t v[3],
                                  const mw_mend_triangle *part, size_t count)
{
    if (w->dimension == 3 || w->tolerance == 0) return true;
    bool left = mw__mend_area(w, v[0], v[1], v[2]) > 0;
    for (size_t i = 0; i < count; i++) {
        double area = mw__mend_area(w, part[i].v[0], part[i].v[1], part[i].v[2]);
        if (left ? area <= 0 : area >= 0) return false;
    }
    return true;
}

/* Put the parts of triangle `number` into part[0] and on. Returns how many there are; 0 when out of
 * memory. */
static size_t split_triangle(split_search *s, uint32_t number, size_t first, size_t count,
                             mw_mend_triangle *part, bool *changed)
{
    mw_mend_work *w = s->work;
    const mw_mend_triangle *t = &w->triangle[number];
    if (count > 0) {
        mw__triangle_cut(w, t, s->found + first, count, part);
        bool sound = split_parts_are_sound(w, t->v, part, count + 1);
        for (size_t i = 0; i < count && sound; i++)
            if (!mw__mend_note(w, MW_MEND_SPLIT, t->from, s->found[first + i].vertex, MW_NONE))
                return 0;
        if (sound) {
            *changed = true;
            return count + 1;
        }
    }
    *part = *t;
    return 1;
}

static bool split_all(split_search *s, bool *changed)
{
    mw_mend_work *w = s->work;
    size_t capacity = w->count + s->count, count = 0, at = 0;
    w->too_large = capacity > MW_MAX_TRIANGLES;
    mw_mend_triangle *part = w->too_large ? NULL : mw__alloc(capacity, sizeof *part);
    if (!part) return false;
    for (uint32_t t = 0; t < w->count; t++) {
        size_t first = at;
        while (at < s->count && s->found[at].half / 4 == t) at++;
        size_t parts = split_triangle(s, t, first, at - first, part + count, changed);
        if (parts == 0) {
            free(part);
            return false;
        }
        count += parts;
    }
    free(w->triangle);
    w->triangle = part;
    w->count = count;
    return true;
}

bool mw__mend_split(mw_mend_work *w, bool *changed)
{
    split_search search = {.work = w};
    *changed = false;
    bool done = split_find(&search);
    if (done && search.count > 0) done = split_all(&search, changed);
    free(search.found);
    mw__vertex_list_release(&search.near);
    mw__vertex_tree_release(&search.tree);
    return done;
}
