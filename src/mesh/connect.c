/* connect.c - neighbours of triangles in O(n): half-edges are gathered at their lower vertex by a counting sort; at one
 * vertex, the two halves of an edge find each other by their upper vertex. Meshes that are laid out are linked otherwise (link.c). */
#include "mesh/connect.h"

#include <stdlib.h>

static MW_INLINE uint32_t lower(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e] : t->v[e + 1];
}

static MW_INLINE uint32_t upper(const mw_triangle *t, uint32_t e)
{
    return t->v[e] < t->v[e + 1] ? t->v[e + 1] : t->v[e];
}

/* --- matching --- */

static MW_INLINE uint32_t *link_of(mw_triangle *tri, uint32_t half)
{
    return &tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static MW_INLINE uint32_t from(const mw_triangle *tri, uint32_t half)
{
    return tri[mw__link_triangle(half)].v[mw__link_edge(half)];
}

static MW_INLINE void join(mw_triangle *tri, uint32_t a, uint32_t b, mw_links *links)
{
    *link_of(tri, a) = b;
    *link_of(tri, b) = a;
    links->linked += 2;
    links->opposite &= from(tri, a) != from(tri, b);
}

enum { FEW = 32 }; /* half-edges at a vertex that are compared each with each */

/* Join the halves of one lower vertex by comparing all. False, and nothing done, where an edge has more than two. */
static MW_INLINE bool match_few(mw_triangle *tri, const mw_half_edge *half, uint32_t count, mw_links *links)
{
    uint32_t mate[FEW];
    for (uint32_t i = 0; i < count; i++) {
        mate[i] = MW_NONE;
        for (uint32_t j = 0; j < i; j++) {
            if (half[j].to != half[i].to) continue;
            if (mate[j] != MW_NONE || mate[i] != MW_NONE) return false;
            mate[i] = j;
            mate[j] = i;
        }
    }
    for (uint32_t i = 0; i < count; i++)
        if (mate[i] < i) join(tri, half[i].half, half[mate[i]].half, links);
    return true;
}

typedef struct keyed_half {
    uint64_t rank; /* by the user's numbers */
    uint32_t to, half;
} keyed_half;

static int compare_halves(const void *left, const void *right)
{
    const keyed_half *a = left, *b = right;
    if (a->to != b->to) return a->to < b->to ? -1 : 1;
    return a->rank < b->rank ? -1 : a->rank > b->rank;
}

static uint64_t rank_of(const mw_triangle *tri, uint32_t half)
{
    return (uint64_t)(tri[mw__link_triangle(half)].user & MW_USER_MASK) << 2 | mw__link_edge(half);
}

void mw__note_extra(const mw_triangle *tri, uint32_t half, uint32_t *extra)
{
    if (*extra == MW_NONE || rank_of(tri, half) < rank_of(tri, *extra)) *extra = half;
}

/* The same for many, or for edges that more than two share: the first two in the user's order are joined. */
bool mw__match_many(mw_triangle *tri, const mw_half_edge *half, uint32_t count, mw_links *links)
{
    keyed_half *keyed = mw__alloc(count, sizeof *keyed);
    if (!keyed) return false;
    for (uint32_t i = 0; i < count; i++) keyed[i] = (keyed_half){rank_of(tri, half[i].half), half[i].to, half[i].half};
    qsort(keyed, count, sizeof *keyed, compare_halves);
    for (uint32_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && keyed[next].to == keyed[i].to;) next++;
        if (next - i > 1) join(tri, keyed[i].half, keyed[i + 1].half, links);
        for (uint32_t j = i + 2; j < next; j++) mw__note_extra(tri, keyed[j].half, &links->extra);
    }
    free(keyed);
    return true;
}

/* --- all --- */

/* Room for the half-edges: those of vertex i are half[first[i]] to before half[first[i + 1]]. */
typedef struct bench {
    uint32_t *first;
    mw_half_edge *half;
} bench;

static void gather(const mw_triangle *tri, uint32_t n, uint32_t vertex_count, bench b)
{
    uint32_t sum = 0;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&tri[t]); e++) b.first[lower(&tri[t], e)]++;
    for (uint32_t i = 0; i <= vertex_count; i++) b.first[i] = sum += b.first[i];
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t e = 0; e < 3 && mw__has_three_vertices(&tri[t]); e++)
            b.half[--b.first[lower(&tri[t], e)]] = (mw_half_edge){upper(&tri[t], e), mw__link(t, e)};
}

bool mw__connect(mw_triangle *tri, uint32_t n, uint32_t vertex_count, mw_links *links)
{
    mw_links found = mw__no_links();
    bench b = {mw__calloc((size_t)vertex_count + 1, sizeof *b.first), mw__alloc_lines(3 * (size_t)n, sizeof *b.half)};
    bool done = b.first && b.half;
    if (done) gather(tri, n, vertex_count, b);
    for (uint32_t i = 0; i < vertex_count && done; i++) {
        const mw_half_edge *half = b.half + b.first[i];
        uint32_t count = b.first[i + 1] - b.first[i];
        if (count > FEW || !match_few(tri, half, count, &found)) done = mw__match_many(tri, half, count, &found);
    }
    free(b.first);
    free(b.half);
    if (links) *links = found;
    return done;
}
