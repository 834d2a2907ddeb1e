/* match.c - the half-edges of one lower vertex are joined by their upper vertices. */
#include "mesh/match.h"

#include <inttypes.h>
#include <stdlib.h>

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
static bool match_many(mw_triangle *tri, const mw_half_edge *half, uint32_t count, mw_links *links)
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

bool mw__match(mw_triangle *tri, const mw_half_edge *half, uint32_t count, mw_links *links)
{
    return (count <= FEW && match_few(tri, half, count, links)) || match_many(tri, half, count, links);
}

void mw__links_add(const mw_triangle *tri, const mw_links *more, mw_links *links)
{
    links->linked += more->linked;
    links->opposite = links->opposite && more->opposite;
    if (more->extra != MW_NONE) mw__note_extra(tri, more->extra, &links->extra);
}

mw_status mw__fail_shared(const mw_triangle *tri, uint32_t extra, uint32_t from, uint32_t to, mw_error *error)
{
    uint32_t user = tri[mw__link_triangle(extra)].user;
    return mw__fail_at(error, user & MW_USER_MASK, from,
                       "triangle %" PRIu32 ": two others share its edge %" PRIu32 ", from vertex %" PRIu32
                       " to %" PRIu32,
                       user & MW_USER_MASK, mw__user_edge(user, mw__link_edge(extra)), from, to);
}
