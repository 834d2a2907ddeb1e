/* border_loops_create.c - finds the loops of the border and the connected components of a tiling
 * without ghosts. O(n + b log b) for b border edges. */
#include "tiling/border_loops_create.h"

#include "base/hilbert.h"

#include <stdlib.h>

static mw_point half_edge_start(const mw_tiling *tiling, uint32_t half)
{
    return tiling->point[tiling->tri[mw__link_triangle(half)].v[mw__link_edge(half)]];
}

static uint32_t half_edge_end(const mw_tiling *tiling, uint32_t half)
{
    return tiling->tri[mw__link_triangle(half)].v[mw__link_edge(half) + 1];
}

/* --- jumps --- */

/* Find the jumps. At a vertex where only one border edge arrives, turning round it through tiles
 * leads to the only border edge that leaves: no jump is needed. */
static bool loop_jumps_find(mw_border_loops *loops, const mw_tiling *tiling,
                            const mw_loop_edge *edges, uint32_t count)
{
    uint8_t *arriving = mw__calloc(tiling->point_count, sizeof *arriving);
    if (!arriving) return false;
    for (uint32_t i = 0; i < count; i++) {
        uint8_t *here = &arriving[half_edge_end(tiling, edges[i].half)];
        if (*here < 2) ++*here;
    }
    for (int pass = 0; pass < 2; pass++) {
        uint32_t jumps = 0;
        for (uint32_t i = 0; i < count; i++) {
            if (arriving[half_edge_end(tiling, edges[i].half)] < 2) continue;
            if (pass == 1) loops->jump[jumps] = (mw_loop_jump){edges[i].half, edges[i].next};
            jumps++;
        }
        if (pass == 0) loops->jump = mw__alloc(jumps, sizeof *loops->jump);
        if (!loops->jump) break;
        loops->jump_count = jumps;
    }
    free(arriving);
    return loops->jump;
}

/* --- loops --- */

static int compare_loop_edges(const void *left, const void *right)
{
    const mw_loop_edge *a = left, *b = right;
    return a->half < b->half ? -1 : a->half > b->half;
}

/* A loop bounds the outside of its component if the outside reaches the leftmost vertex (of
 * several, the lowest) from the left. All edges there lead to the right. So this is where the loop
 * turns left. */
typedef struct loop_turning {
    mw_point leftmost;
    bool outside;
} loop_turning;

static void loop_turning_add(loop_turning *t, mw_point u, mw_point v, mw_point w)
{
    if (v.x > t->leftmost.x || (v.x == t->leftmost.x && v.y > t->leftmost.y)) return;
    if (v.x != t->leftmost.x || v.y != t->leftmost.y) *t = (loop_turning){v, false};
    if (mw__orient2d(u, v, w) > 0) t->outside = true;
}

/* Follow the loop of edge i and mark its edges. Does it bound a bounded face? */
static bool loop_bounds_face(const mw_tiling *tiling, const mw_loop_edge *edges, uint32_t count,
                             uint32_t i, uint8_t *seen)
{
    loop_turning t = {{INFINITY, INFINITY}, false};
    const mw_loop_edge *edge = &edges[i];
    while (!seen[edge - edges]) {
        seen[edge - edges] = 1;
        const mw_loop_edge key = {.half = edge->next};
        const mw_loop_edge *next = bsearch(&key, edges, count, sizeof key, compare_loop_edges);
        loop_turning_add(&t, half_edge_start(tiling, edge->half),
                         half_edge_start(tiling, next->half),
                         tiling->point[half_edge_end(tiling, next->half)]);
        edge = next;
    }
    return !t.outside;
}

/* The edges are sorted, so the lowest edge of a loop comes first. */
static bool hole_loops_find(mw_border_loops *loops, const mw_tiling *tiling,
                            const mw_loop_edge *edges, uint32_t count)
{
    uint8_t *seen = mw__calloc(count, sizeof *seen);
    /* One component surrounds each hole. */
    loops->loop = mw__alloc(tiling->hole_count, sizeof *loops->loop);
    bool done = seen && loops->loop;
    for (uint32_t i = 0; done && i < count; i++)
        if (!seen[i] && loop_bounds_face(tiling, edges, count, i, seen))
            loops->loop[loops->loop_count++] = (mw_hole_loop){edges[i].half, edges[i].hole};
    free(seen);
    return done;
}

/* --- connected components --- */

static uint32_t component_root(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
}

/* Unite the vertices of each tile. parent[v] leads to the lowest vertex of the component. */
static void components_unite(const mw_tiling *tiling, uint32_t *parent)
{
    for (uint32_t v = 0; v < tiling->point_count; v++) parent[v] = v;
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (uint32_t k = 0; k < 2; k++) {
            uint32_t a = component_root(parent, tiling->tri[t].v[k]),
                     b = component_root(parent, tiling->tri[t].v[k + 1]);
            parent[a > b ? a : b] = a > b ? b : a;
        }
}

/* Number the components that `parent` describes. A vertex without a tile gets MW_NONE. Returns the
 * number of components. */
static uint32_t components_number(const mw_tiling *tiling, uint32_t *parent, uint32_t *number)
{
    uint32_t components = 0;
    for (uint32_t v = 0; v < tiling->point_count; v++) number[v] = MW_NONE;
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        uint32_t root = component_root(parent, tiling->tri[t].v[0]);
        if (number[root] == MW_NONE) number[root] = components++;
        for (uint32_t k = 0; k < 3; k++) number[tiling->tri[t].v[k]] = number[root];
    }
    return components;
}

static void components_measure(mw_border_loops *loops, const mw_tiling *tiling)
{
    for (uint32_t i = 0; i < loops->component_count; i++)
        loops->component[i] = (mw_component){mw__box_empty(), MW_NONE};
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        mw_component *component = &loops->component[loops->component_of[tiling->tri[t].v[0]]];
        if (component->first == MW_NONE) component->first = t;
        for (uint32_t k = 0; k < 3; k++) {
            mw_point p = tiling->point[tiling->tri[t].v[k]];
            mw__box_join(&component->box, (mw_box){{p.x, p.y}, {p.x, p.y}});
        }
    }
}

/* Small components come first: a point in the boxes of several probably lies in the smallest.
 * Sorted by the longer side, in powers of four, then along a Hilbert curve. */
static uint64_t component_rank(const mw_hilbert *hilbert, const mw_box *box)
{
    int size;
    frexp(fmax(box->high[0] / 2 - box->low[0] / 2, box->high[1] / 2 - box->low[1] / 2), &size);
    uint32_t key = mw__hilbert_key(hilbert, box->low[0] / 2 + box->high[0] / 2,
                                   box->low[1] / 2 + box->high[1] / 2);
    return (uint64_t)(size + 4096) / 2 << 32 | key;
}

typedef struct ranked_component {
    uint64_t rank;
    uint32_t component;
} ranked_component;

static int compare_ranked_components(const void *left, const void *right)
{
    const ranked_component *a = left, *b = right;
    if (a->rank != b->rank) return a->rank < b->rank ? -1 : 1;
    return a->component < b->component ? -1 : 1;
}

/* Number the components in the order in which they are to be searched. */
static bool components_sort(mw_border_loops *loops, const mw_tiling *tiling)
{
    ranked_component *order = mw__alloc(loops->component_count, sizeof *order);
    uint32_t *number = mw__alloc(loops->component_count, sizeof *number);
    mw_component *sorted = mw__alloc(loops->component_count, sizeof *sorted);
    bool done = order && number && sorted;
    if (done) {
        mw_box all = mw__box_empty();
        for (uint32_t i = 0; i < loops->component_count; i++)
            mw__box_join(&all, loops->component[i].box);
        mw_hilbert hilbert = mw__hilbert(all.low, all.high);
        for (uint32_t i = 0; i < loops->component_count; i++)
            order[i] = (ranked_component){component_rank(&hilbert, &loops->component[i].box), i};
        qsort(order, loops->component_count, sizeof *order, compare_ranked_components);
        for (uint32_t i = 0; i < loops->component_count; i++) {
            sorted[i] = loops->component[order[i].component];
            number[order[i].component] = i;
        }
        for (uint32_t v = 0; v < tiling->point_count; v++)
            if (loops->component_of[v] != MW_NONE)
                loops->component_of[v] = number[loops->component_of[v]];
        free(loops->component);
        loops->component = sorted;
    } else {
        free(sorted);
    }
    free(order);
    free(number);
    return done;
}

static mw_box component_box(const void *components, uint32_t i)
{
    return ((const mw_component *)components)[i].box;
}

static bool components_list(mw_border_loops *loops, const mw_tiling *tiling)
{
    loops->component = mw__alloc(loops->component_count, sizeof *loops->component);
    if (!loops->component) return false;
    components_measure(loops, tiling);
    return components_sort(loops, tiling) &&
           mw__box_tree_create(&loops->tree, loops->component_count, component_box,
                               loops->component);
}

static bool components_find(mw_border_loops *loops, const mw_tiling *tiling)
{
    uint32_t *parent = mw__alloc(tiling->point_count, sizeof *parent);
    loops->component_of = mw__alloc(tiling->point_count, sizeof *loops->component_of);
    bool done = parent && loops->component_of;
    if (done) {
        components_unite(tiling, parent);
        loops->component_count = components_number(tiling, parent, loops->component_of);
    }
    free(parent);
    if (!done) return false;
    if (loops->component_count > 1) return components_list(loops, tiling);
    free(loops->component_of);
    loops->component_of = NULL;
    return true;
}

/* --- all --- */

bool mw__border_loops_create(mw_border_loops *loops, const mw_tiling *tiling, mw_loop_edge *edges,
                             uint32_t count)
{
    *loops = (mw_border_loops){.edge_count = count};
    qsort(edges, count, sizeof *edges, compare_loop_edges);
    return loop_jumps_find(loops, tiling, edges, count) &&
           hole_loops_find(loops, tiling, edges, count) && components_find(loops, tiling);
}
