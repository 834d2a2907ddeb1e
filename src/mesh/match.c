/* match.c - joins the half-edges of one lower vertex by their upper vertices. */
#include "mesh/match.h"

#include <inttypes.h>
#include <stdlib.h>

static MW_INLINE uint32_t half_edge_from(const mw_triangle *tri, uint32_t half)
{
    return tri[mw__link_triangle(half)].v[mw__link_edge(half)];
}

static MW_INLINE void half_edges_join(mw_triangle *tri, uint32_t a, uint32_t b, mw_links *links)
{
    *mw__half_edge_link(tri, a) = b;
    *mw__half_edge_link(tri, b) = a;
    links->linked += 2;
    links->opposite &= half_edge_from(tri, a) != half_edge_from(tri, b);
}

enum { FEW = 32 }; /* so many half-edges at a vertex are compared pair by pair */

/* Join the half-edges of one lower vertex by comparing all pairs. Returns false and changes nothing
 * where an edge has more than two halves. */
static MW_INLINE bool half_edges_match_few(mw_triangle *tri, const mw_half_edge *half,
                                           uint32_t count, mw_links *links)
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
        if (mate[i] < i) half_edges_join(tri, half[i].half, half[mate[i]].half, links);
    return true;
}

typedef struct ranked_half_edge {
    uint64_t rank; /* by the user's numbers */
    uint32_t to, half;
} ranked_half_edge;

static int compare_ranked_half_edges(const void *left, const void *right)
{
    const ranked_half_edge *a = left, *b = right;
    if (a->to != b->to) return a->to < b->to ? -1 : 1;
    return a->rank < b->rank ? -1 : a->rank > b->rank;
}

static uint64_t half_edge_rank(const mw_triangle *tri, uint32_t half)
{
    return (uint64_t)(tri[mw__link_triangle(half)].user & MW_USER_MASK) << 2 | mw__link_edge(half);
}

void mw__links_note_extra(const mw_triangle *tri, uint32_t half, uint32_t *extra)
{
    if (*extra == MW_NONE || half_edge_rank(tri, half) < half_edge_rank(tri, *extra)) *extra = half;
}

/* The same for many half-edges, or for an edge with more than two: joins the first two in the
 * user's order. */
static bool half_edges_match_many(mw_triangle *tri, const mw_half_edge *half, uint32_t count,
                                  mw_links *links)
{
    ranked_half_edge *ranked = mw__alloc(count, sizeof *ranked);
    if (!ranked) return false;
    for (uint32_t i = 0; i < count; i++)
        ranked[i] = (ranked_half_edge){half_edge_rank(tri, half[i].half), half[i].to, half[i].half};
    qsort(ranked, count, sizeof *ranked, compare_ranked_half_edges);
    for (uint32_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && ranked[next].to == ranked[i].to;) next++;
        if (next - i > 1) half_edges_join(tri, ranked[i].half, ranked[i + 1].half, links);
        for (uint32_t j = i + 2; j < next; j++)
            mw__links_note_extra(tri, ranked[j].half, &links->extra);
    }
    free(ranked);
    return true;
}

bool mw__half_edges_match(mw_triangle *tri, const mw_half_edge *half, uint32_t count,
                          mw_links *links)
{
    return (count <= FEW && half_edges_match_few(tri, half, count, links)) ||
           half_edges_match_many(tri, half, count, links);
}

void mw__links_add(const mw_triangle *tri, const mw_links *more, mw_links *links)
{
    links->linked += more->linked;
    links->opposite = links->opposite && more->opposite;
    if (more->extra != MW_NONE) mw__links_note_extra(tri, more->extra, &links->extra);
}

mw_status mw__fail_non_manifold_edge(const mw_triangle *tri, uint32_t extra, uint32_t from,
                                     uint32_t to, mw_error *error)
{
    uint32_t user = tri[mw__link_triangle(extra)].user;
    return mw__fail_at(error, user & MW_USER_MASK, from,
                       "triangle %" PRIu32 ": two others share its edge %" PRIu32
                       ", from vertex %" PRIu32 " to %" PRIu32,
                       user & MW_USER_MASK, mw__user_local_edge(user, mw__link_edge(extra)), from,
                       to);
}
