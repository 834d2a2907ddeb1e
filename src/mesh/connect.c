/* connect.c - neighbours of triangles in O(n): half-edges are gathered at their lower vertex by a counting sort; at one
 * vertex, the two halves of an edge find each other through a slot at their upper vertex. */
#include "mesh/mesh.h"

#include <stdlib.h>

static uint32_t lower(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e] : t->v[e + 1];
}

static uint32_t upper(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e + 1] : t->v[e];
}

/* first[u] .. first[u + 1] delimit, in `half`, the half-edges whose lower vertex is u. */
static void gather(const mw_triangle *tri, uint32_t n, uint32_t vertex_count, uint32_t *first, uint32_t *half)
{
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&tri[t]); e++) first[lower(&tri[t], e)]++;
    uint32_t sum = 0;
    for (uint32_t u = 0; u <= vertex_count; u++) {
        sum += u < vertex_count ? first[u] : 0;
        first[u] = sum;
    }
    for (uint32_t t = n; t-- > 0;) /* backwards, so that the lists end up in order of triangles */
        for (uint32_t e = 3; e-- > 0 && mw__has_three_vertices(&tri[t]);)
            half[--first[lower(&tri[t], e)]] = mw__link(t, e);
}

/* Link the half-edges of one lower vertex u. slot[w] is the last half-edge towards w; it counts if seen[w] is u. */
static void pair(mw_triangle *tri, uint32_t u, const uint32_t *half, uint32_t count, uint32_t *slot, uint32_t *seen,
                 uint32_t *extra)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t h = half[i];
        mw_triangle *t = &tri[mw__link_triangle(h)];
        uint32_t w = upper(t, mw__link_edge(h));
        if (seen[w] != u) {
            seen[w] = u;
            slot[w] = h;
            continue;
        }
        uint32_t *other = &tri[mw__link_triangle(slot[w])].link[mw__link_edge(slot[w])];
        if (*other == MW_NONE) {
            *other = h;
            t->link[mw__link_edge(h)] = slot[w];
        } else if (*extra == MW_NONE) {
            *extra = h;
        }
    }
}

bool mw__connect(mw_triangle *tri, uint32_t n, uint32_t vertex_count, uint32_t *extra)
{
    uint32_t ignored;
    if (!extra) extra = &ignored;
    *extra = MW_NONE;
    /* at most 3 * 2^30 half-edges: they still fit 32 bits */
    uint32_t *first = mw__calloc((size_t)vertex_count + 1, sizeof *first);
    uint32_t *half = mw__alloc(3 * (size_t)n, sizeof *half);
    uint32_t *slot = mw__alloc(vertex_count, sizeof *slot);
    uint32_t *seen = mw__alloc(vertex_count, sizeof *seen);
    bool done = first && half && slot && seen;
    if (done) {
        gather(tri, n, vertex_count, first, half);
        for (uint32_t v = 0; v < vertex_count; v++) seen[v] = MW_NONE;
        for (uint32_t u = 0; u < vertex_count; u++)
            pair(tri, u, half + first[u], first[u + 1] - first[u], slot, seen, extra);
    }
    free(first);
    free(half);
    free(slot);
    free(seen);
    return done;
}
